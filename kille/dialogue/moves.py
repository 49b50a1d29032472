"""Planning what the robot says next, and what it is about."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cache

from kille.dialogue.meanings import named, set_to, spoken, theory, word_of
from ttr import (
    Pred,
    PType,
    Rec,
    Record,
    RecordType,
    RecType,
    TypeNode,
    outer,
    rectype,
    replace,
)

__all__ = ["answering", "in_look", "plan", "related", "uses"]

NOTHING_PLANNED = theory()["Agenda"] @ ()


@cache
def answering(move: str) -> RecordType:
    """The states in which this is the latest move and no answer is planned yet."""
    return rectype(
        private=rectype(agenda=NOTHING_PLANNED), shared=rectype(latest=named(move))
    )


def plan(
    s: Record,
    act: str,
    content: TypeNode = Rec,
    rival: TypeNode = Rec,
    *,
    signs: Iterable[Record] = (),
    pending: Iterable[TypeNode] = (),
) -> Record:
    """The state in which the robot is about to say this, and what it thereby claims.

    `signs` are the words that it will use or learn; `pending` is what the tutor may
    confirm afterwards.
    """
    move = set_to(
        spoken("Said", act),
        signs=named("Said")["signs"] @ tuple(signs),
        content=RecType @ content,
        rival=RecType @ rival,
    )
    return replace(s, {"private.agenda": (move,), "shared.pending": tuple(pending)})


def in_look(s: Record, content: RecordType, x: str) -> RecordType:
    """A content, set to be about this individual in the latest look."""
    naming = named("Naming")
    return set_to(content, x=naming["x"] @ x, look=naming["look"] @ s.view.look)


def related(
    s: Record, x: str, target: Record, y: str, landmark: Record, *relation: Record
) -> RecordType:
    """That x, a target, and y, a landmark, stand so, by these signs in the latest look.

    Without a relation it says only that both are there.
    """
    relating = named("Relating")
    content = set_to(
        relating,
        look=relating["look"] @ s.view.look,
        target=_standing(target, x),
        landmark=_standing(landmark, y),
    )
    for sign in relation:
        content = set_to(sign.meaning, **dict(content.fields))
    return content


def _standing(sign: Record, x: str) -> RecordType:
    """That x is what a sign means, in the look that the record around it has."""
    naming = named("Naming")
    return set_to(sign.meaning, x=naming["x"] @ x, look=naming["look"] @ outer.look)


def uses(content: TypeNode, sign: Record) -> bool:
    """Whether the sign's predicate occurs in the content."""
    return any(pred is word_of(sign) for pred in _predicates(content))


def _predicates(T: TypeNode) -> Iterator[Pred]:
    if isinstance(T, PType):
        yield T.pred
    if isinstance(T, RecordType):
        for _, field in T.fields:
            yield from _predicates(field)
