"""Planning what the robot says next, and what it is about."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from kille.dialogue.meanings import named, theory, word_of
from ttr import (
    Pred,
    PType,
    Rec,
    Record,
    RecordType,
    RecType,
    TypeNode,
    merge,
    rectype,
    replace,
)

__all__ = ["answering", "in_look", "plan", "related", "uses"]

NOTHING_PLANNED = theory()["Agenda"] @ ()


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
    said = rectype(
        signs=named("Said")["signs"] @ tuple(signs),
        content=RecType @ content,
        rival=RecType @ rival,
    )
    move = together(named("Said"), named(act), said)
    return replace(s, {"private.agenda": (move,), "shared.pending": tuple(pending)})


def in_look(s: Record, content: TypeNode, x: str) -> RecordType:
    """A content, set to be about this individual in the latest look."""
    naming = named("Naming")
    there = rectype(x=naming["x"] @ x, look=naming["look"] @ s.view.look)
    return together(content, there)


def related(
    s: Record, x: str, target: Record, y: str, landmark: Record, *relation: Record
) -> RecordType:
    """That x, a target, and y, a landmark, stand so, by these signs in the latest look.

    Without a relation it says only that both are there.
    """
    look, ind = named("Naming")["look"], named("Naming")["x"]
    roles = rectype(
        look=look @ s.view.look,
        target=together(target.meaning, rectype(x=ind @ x)),
        landmark=together(landmark.meaning, rectype(x=ind @ y)),
    )
    return together(named("Relating"), roles, *(sign.meaning for sign in relation))


def together(S: TypeNode, *others: TypeNode) -> RecordType:
    """The merge of record types."""
    for other in others:
        S = merge(S, other)
    if not isinstance(S, RecordType):
        raise TypeError(f"what is said is a record type, but found {S}")
    return S


def uses(content: TypeNode, sign: Record) -> bool:
    """Whether the sign's predicate occurs in the content."""
    return any(pred is word_of(sign) for pred in _predicates(content))


def _predicates(T: TypeNode) -> Iterator[Pred]:
    if isinstance(T, PType):
        yield T.pred
    if isinstance(T, RecordType):
        for _, field in T.fields:
            yield from _predicates(field)
