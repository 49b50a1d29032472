"""Game 2: what is this? The robot says as much as it is certain of.

Source: Dobnik and de Graaf 2017, section 3.
"""

from __future__ import annotations

from kille.dialogue.beliefs import certainty, names_of
from kille.dialogue.games.surveying import see_nothing
from kille.dialogue.meanings import DialogueTypes
from kille.dialogue.moves import content_of, plan, said_of
from kille.dialogue.reference import thing_at
from kille.dialogue.reference.salience import talked_about
from kille.dialogue.rules import rule
from ttr import Model, Record, RecordType, replace
from ttr.updates import first, maybe, seq


@rule(answers=("AskName", "AskGuess"))
def recognise(s: Record, *, model: Model) -> Record | None:
    """The tutor asks what a thing is: judge every noun of it."""
    talked_of = [it for it in talked_about(s) if it in s.view.things]
    x = thing_at(content_of(s), "target") or next(iter(talked_of), None)
    if x is None or not s.private.nouns:
        return None
    beliefs = names_of(s, model, x)
    return replace(s, {"private.beliefs": beliefs})


@rule(answers=("AskName", "AskGuess"))
def assert_name(s: Record, *, types: DialogueTypes) -> Record | None:
    """It is sure, and no rival is near: it says what this is."""
    return _plan_naming(s, "Assert", types=types)


@rule(answers=("AskName", "AskGuess"))
def hedge_name(s: Record, *, types: DialogueTypes) -> Record | None:
    """It has an opinion, but also a rival to it: it names both."""
    if certainty(s, s.private.beliefs) != "Hedge":
        return None
    (content, sign), (rival, other) = (
        _naming_by_rank(s, 0, types=types),
        _naming_by_rank(s, 1, types=types),
    )
    claims = [content, rival]
    return plan(
        s, "HedgeName", content, rival, signs=[sign, other], pending=claims, types=types
    )


@rule(answers=("AskName", "AskGuess"))
def guess_name(s: Record, *, types: DialogueTypes) -> Record | None:
    """It thinks so, is not sure of it, and has no rival to it."""
    return _plan_naming(s, "Guess", types=types)


@rule(answers=("AskName", "AskGuess"))
def doubt_name(s: Record, *, types: DialogueTypes) -> Record | None:
    """It has an opinion, and hardly more than that."""
    return _plan_naming(s, "Doubt", types=types)


@rule(answers="AskGuess")
def guess_wildly(s: Record, *, types: DialogueTypes) -> Record | None:
    """It does not know, and says what is the likeliest of what it knows."""
    if not s.private.beliefs:
        return None
    content, sign = _naming_by_rank(s, 0, types=types)
    act = "GuessWildly"
    return plan(s, act, content, signs=[sign], pending=[content], types=types)


@rule(answers="AskGuess")
def cannot_guess(s: Record, *, types: DialogueTypes) -> Record:
    """It knows no word that it could guess."""
    return plan(s, "CannotGuess", types=types)


@rule(answers="AskName")
def admit_name(s: Record, *, types: DialogueTypes) -> Record:
    """It does not know what this is, and asks."""
    return plan(s, "AdmitName", types=types)


def _plan_naming(s: Record, how: str, *, types: DialogueTypes) -> Record | None:
    """The plan to say its first belief in this way, if it is that certain."""
    if certainty(s, s.private.beliefs) != how:
        return None
    content, sign = _naming_by_rank(s, 0, types=types)
    return plan(s, f"{how}Name", content, signs=[sign], pending=[content], types=types)


def _naming_by_rank(
    s: Record, rank: int, *, types: DialogueTypes
) -> tuple[RecordType, Record]:
    """What it says of the thing by its belief of this rank, and the sign it uses."""
    belief = s.private.beliefs[rank]
    return said_of(s, belief.sign, belief.sit.x, types=types), belief.sign


NAMING = seq(
    maybe(recognise),
    first(
        assert_name,
        hedge_name,
        guess_name,
        doubt_name,
        see_nothing,
        guess_wildly,
        cannot_guess,
        admit_name,
    ),
)
