"""Tutoring as a game: its rules with a start, a language and an agenda, to be played.

It is what the robot plays, without its eyes and its memory: what is seen is an event
like any other, and what words are true of is for the model to say. So the rules can be
checked, tested and changed by themselves.
"""

from __future__ import annotations

from collections.abc import Iterable

from kille.dialogue.games import HEARD, SAID, SCENE_CHANGED
from kille.dialogue.language import NotUnderstood, understand
from kille.dialogue.meanings import named, predicate_at, theory
from kille.dialogue.state import STATE, blank_model, forms, initial
from kille.dialogue.wording import english
from ttr import Judgement, Model, Record, RecordType
from ttr.updates import Game, first
from ttr.updates.games import Act

__all__ = ["hear", "say", "tutoring"]


def tutoring(
    nouns: Iterable[Record] = (),
    relations: Iterable[Record] = (),
    *,
    model: Model | None = None,
    act: Act | None = None,
) -> Game:
    """The games of tutoring as one, by a robot that knows these words.

    `model` judges what they are true of, by witness functions of their predicates;
    `act` makes a planned move, where more is to be done for it than to create it.

    >>> game = tutoring()
    >>> turn = game.take(game.begin(), game.hear("What is this?"))
    >>> [game.say(move) for move in turn.said]
    ['I see nothing on the table.']
    """
    return Game(
        "tutoring",
        STATE,
        initial(nouns, relations, english().bands),
        first(HEARD, SAID, SCENE_CHANGED),
        blank_model() if model is None else model,
        agenda="private.agenda",
        hears=(named("Heard"), named("Seen")),
        act=act,
        hear=hear,
        say=say,
        theory=theory(),
    )


def hear(text: str) -> RecordType | None:
    """The type of the event of saying this, or None if it is not understood."""
    try:
        return understand(text).type
    except NotUnderstood:
        return None


def say(move: Judgement) -> str:
    """The robot's sentence for a move of its own.

    Raises `TypeError` for what is none.
    """
    planned, made = move.type, move.sit
    if not isinstance(planned, RecordType) or not isinstance(made, Record):
        raise TypeError(f"a move is a record of a record type, but found {move}")
    return english().say(made, predicate_at(planned, "e").name, forms(made.signs))
