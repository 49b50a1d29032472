"""Grounding: whose turn it was and what was said, the first rules of every update.

Grounding is optimistic: what was probably said is taken to be understood by both.
Source: Larsson 2002, chapter 2.
"""

from __future__ import annotations

from ttr.building.constructors import rectype
from ttr.semantics.gameboards.ibis.moves import USR, Program, unclear
from ttr.semantics.gameboards.ibis.state import OWN, USER
from ttr.types.objects import Record, record
from ttr.types.records import replace
from ttr.types.syntax import ListOf, NonEmpty, RecType
from ttr.updates import Algorithm, first, rule

LIKELY, HARDLY = 0.5, 0.001
"""The probabilities from which an utterance is understood, and from which heard."""

_RUNNING = rectype(program=Program @ "run")


@rule(when=_RUNNING, on=USER, p=LIKELY, kind="grounding")
def get_user_moves(s: Record, e: Record) -> Record:
    """The user's utterance becomes the latest; its moves are to be integrated."""
    latest = record(speaker=e.spkr, moves=e.moves)
    return replace(s, {"shared.lu": latest, "private.nim": e.moves})


@rule(when=_RUNNING, on=USER, p=(HARDLY, LIKELY), kind="grounding")
def hear_badly(s: Record, e: Record) -> Record:
    """The user said something, but it is too uncertain what: it is unclear."""
    unheard = (unclear(USR),)
    latest = record(speaker=e.spkr, moves=unheard)
    return replace(s, {"shared.lu": latest, "private.nim": unheard})


@rule(when=rectype(output=NonEmpty(RecType)), on=OWN, kind="grounding")
def get_own_moves(s: Record, e: Record) -> Record:
    """The system's utterance has been made; it becomes the latest."""
    latest = record(speaker=e.spkr, moves=e.moves)
    changes = {"shared.lu": latest, "private.nim": e.moves, "output": s.output[1:]}
    return replace(s, changes)


@rule(
    when=rectype(program=Program @ "run", output=ListOf(RecType) @ ()),
    kind="grounding",
)
def hear_nothing(s: Record) -> Record:
    """The user says nothing and leaves the turn to the system."""
    return replace(s, {"shared.lu": record(speaker=USR, moves=[]), "private.nim": ()})


GROUNDING: Algorithm = first(get_user_moves, hear_badly, hear_nothing)
