"""The gameboard of Cooper: what is private, an agenda, and what is shared.

The agenda is a list of types of events to be brought about. The shared commitments are
one record type, which becomes more specific by merging. An assertion is agreed on once
it is acknowledged. Source: Cooper 2023, chapter 2.
"""

from __future__ import annotations

from collections.abc import Iterable

from ttr.building.constructors import rectype
from ttr.building.merging import merge
from ttr.judging.models import Model
from ttr.types.objects import Record, record
from ttr.types.path_notation import outer, this
from ttr.types.records import replace
from ttr.types.syntax import (
    Ind,
    ListOf,
    Pred,
    Rec,
    RecordType,
    RecType,
    TypeNode,
    Universe,
)
from ttr.updates import Algorithm, Game, all_, first, rule

__all__ = [
    "ACKNOWLEDGEMENT",
    "ALGORITHM",
    "ASSERTION",
    "BOARD",
    "MOVE",
    "acknowledge",
    "acknowledging",
    "assert_that",
    "asserting",
    "game",
]

assert_that = Pred("assert", Ind, Ind, RecType)
"""The predicate of assertions: speaker, addressee and what is said.

>>> from ttr import Ind, Pred, rectype
>>> from ttr.semantics.gameboards.cooper import assert_that
>>> print(assert_that("a", "b", rectype(e=Pred("run", Ind)("sam"))))
assert(a, b, [e : run(sam)])
"""
acknowledge = Pred("acknowledge", Ind, Ind, RecType)
"""The predicate of acknowledgements: speaker, addressee and what was said.

>>> from ttr import Ind, Pred, rectype
>>> from ttr.semantics.gameboards.cooper import acknowledge
>>> print(acknowledge("b", "a", rectype(e=Pred("run", Ind)("sam"))))
acknowledge(b, a, [e : run(sam)])
"""

MOVE: RecordType = rectype(spkr=Ind, addr=Ind, content=RecType)
"""The type of moves: somebody says something to somebody.

>>> from ttr.semantics.gameboards.cooper import MOVE
>>> print(MOVE)
[addr : Ind, content : RecType, spkr : Ind]
"""

ASSERTION: RecordType = rectype(
    spkr=Ind,
    addr=Ind,
    content=RecType,
    e=assert_that(this.spkr, this.addr, this.content),
)
"""The type of assertions.

>>> from ttr.semantics.gameboards.cooper import ASSERTION, MOVE
>>> ASSERTION <= MOVE
True
"""

ACKNOWLEDGEMENT: RecordType = rectype(
    spkr=Ind,
    addr=Ind,
    content=RecType,
    e=acknowledge(this.spkr, this.addr, this.content),
)
"""The type of acknowledgements.

>>> from ttr.semantics.gameboards.cooper import ACKNOWLEDGEMENT, MOVE
>>> ACKNOWLEDGEMENT <= MOVE
True
"""

_AGENDA = ListOf(Universe("RecType", 1))

BOARD: RecordType = rectype(
    private=rectype(self=Ind, agenda=_AGENDA),
    shared=rectype(latest=Rec, commitments=RecType),
)
"""The type of every gameboard; `self` is whose board it is.

The types on the agenda mention types, namely what is to be said, so they are record
types of level 1. Before anything has been said, `latest` is the empty record.

>>> from ttr.semantics.gameboards.cooper import BOARD
>>> print(BOARD["shared"])
[commitments : RecType, latest : Rec]
"""

_MINE = rectype(me=(Ind @ outer.s.private.self) @ outer.e.spkr)
_TO_ME = rectype(me=(Ind @ outer.s.private.self) @ outer.e.addr)


@rule(when=BOARD, on=MOVE, where=_MINE, kind="grounding")
def make_move(s: Record, e: Record) -> Record:
    """A move of one's own is taken off the agenda when it has been made."""
    changes = {"private.agenda": s.private.agenda[1:], "shared.latest": e}
    return replace(s, changes)


@rule(when=BOARD, on=MOVE, where=_TO_ME, kind="grounding")
def hear_move(s: Record, e: Record) -> Record:
    """A move that is addressed to one is the latest move."""
    return replace(s, {"shared.latest": e})


@rule(
    when=rectype(shared=rectype(latest=ASSERTION)),
    on=ACKNOWLEDGEMENT,
    where=rectype(said=(RecType @ outer.s.shared.latest.content) @ outer.e.content),
    kind="integrate",
)
def integrate_acknowledgement(s: Record, e: Record, said: RecordType) -> Record:
    """What was asserted is agreed on when it is acknowledged."""
    return replace(s, {"shared.commitments": merge(s.shared.commitments, said)})


@rule(
    when=rectype(
        private=rectype(agenda=_AGENDA @ ()), shared=rectype(latest=ASSERTION)
    ),
    where=rectype(me=(Ind @ outer.s.private.self) @ outer.s.shared.latest.addr),
    kind="plan",
)
def plan_acknowledgement(s: Record) -> Record:
    """Acknowledging what was asserted to one is put on the agenda."""
    said = s.shared.latest
    planned = acknowledging(said.addr, said.spkr, said.content)
    return replace(s, {"private.agenda": (planned,)})


ALGORITHM: Algorithm = all_(
    integrate_acknowledgement, first(make_move, hear_move), plan_acknowledgement
)
"""Integrate an acknowledgement, record the latest move, then plan.

>>> from ttr.semantics.gameboards.cooper import ALGORITHM
>>> print(ALGORITHM)
all(integrate_acknowledgement, first(make_move, hear_move), plan_acknowledgement)
"""


def asserting(spkr: str, addr: str, content: TypeNode) -> RecordType:
    """The type of assertions by spkr to addr with this content.

    >>> print(asserting("a", "b", rectype(e=Pred("run", Ind)("sam"))))
    ... # doctest: +NORMALIZE_WHITESPACE
    [addr = b : Ind, content = [e : run(sam)] : RecType, spkr = a : Ind,
     e : assert(spkr, addr, content)]
    """
    return _move_type(assert_that, spkr, addr, content)


def acknowledging(spkr: str, addr: str, content: TypeNode) -> RecordType:
    """The type of acknowledgements by spkr to addr of this content.

    >>> print(acknowledging("b", "a", rectype(e=Pred("run", Ind)("sam")))["e"])
    acknowledge(.spkr, .addr, .content)
    """
    return _move_type(acknowledge, spkr, addr, content)


def _move_type(act: Pred, spkr: str, addr: str, content: TypeNode) -> RecordType:
    return rectype(
        spkr=Ind @ spkr,
        addr=Ind @ addr,
        content=RecType @ content,
        e=act(this.spkr, this.addr, this.content),
    )


def game(me: str, model: Model, agenda: Iterable[RecordType] = ()) -> Game:
    """The game on the board of one participant, whose agenda has these moves.

    >>> from ttr.dialogues.encounters import Participant, meeting
    >>> M = Model().given("a", Ind).given("b", Ind)
    >>> runs = rectype(e=Pred("run", Ind)("sam"))
    >>> a = game("a", M, [asserting("a", "b", runs)])
    >>> talk = meeting(
    ...     Participant("a", a, rectype(spkr=Ind @ "a")),
    ...     Participant("b", game("b", M), rectype(spkr=Ind @ "b")),
    ... )
    >>> after = talk.in_turn()
    >>> print(after.board("a").shared.commitments, after.board("b").shared.commitments)
    [e : run(sam)] [e : run(sam)]
    """
    start = record(
        private=record(self=me, agenda=list(agenda)),
        shared=record(latest=record(), commitments=Rec),
    )
    return Game(
        f"the board of {me}",
        BOARD,
        start,
        ALGORITHM,
        model,
        agenda="private.agenda",
        hears=(MOVE,),
    )
