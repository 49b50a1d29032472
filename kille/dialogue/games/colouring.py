"""What colour is this? The robot says as much as it is certain of."""

from __future__ import annotations

from kille.dialogue.beliefs import as_told, beliefs_about, certainty
from kille.dialogue.meanings import DialogueTypes, word_of
from kille.dialogue.moves import content_of, plan, said_of
from kille.dialogue.reference import thing_at
from kille.dialogue.reference.resolving import taught_words
from kille.dialogue.rules import rule
from ttr import Model, Record, replace
from ttr.updates import first, seq


@rule(answers="AskQuality")
def recognise_colour(s: Record, *, model: Model) -> Record | None:
    """The tutor asks what colour a thing is: judge every colour of it.

    What the tutor called it, as long as it is in view, has no rivals but one another.
    """
    x = thing_at(content_of(s), "target")
    if x is None:
        return None
    beliefs = as_told(s, beliefs_about(s, model, s.private.colours, x))
    told = taught_words(s)
    called = [it for it in beliefs if told.get((word_of(it.sign), x))]
    return replace(s, {"private.beliefs": called or beliefs})


@rule(answers="AskQuality")
def say_colour(s: Record, *, types: DialogueTypes) -> Record:
    """It says the colour as certainly as it knows it, or that it does not."""
    told = plan_colour(s, types=types)
    if told is not None:
        return told
    return plan(
        s, "AdmitQuality", content_of(s), signs=s.shared.latest.signs, types=types
    )


def plan_colour(s: Record, *, types: DialogueTypes) -> Record | None:
    """The plan to say of what colour a thing is; None if the robot does not know."""
    how, beliefs = certainty(s, s.private.beliefs), s.private.beliefs
    if how == "Admit":
        return None
    named = beliefs[: 2 if how == "Hedge" else 1]
    claims = [said_of(s, it.sign, it.sit.x, "Having", types=types) for it in named]
    signs = [it.sign for it in named]
    return plan(s, f"{how}Quality", *claims, signs=signs, pending=claims, types=types)


COLOURING = first(seq(recognise_colour, say_colour))
