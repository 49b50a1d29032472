"""The information state of IBiS1, and the utterances that change it.

Source: Larsson 2002, chapter 2, for `private` and `shared`; he calls the other fields
module interface variables. `nim`, the moves of the latest utterance that are still to
be integrated, is from IBiS2, chapter 3.
"""

from __future__ import annotations

from collections.abc import Iterable

from ttr.building.constructors import rectype
from ttr.semantics.gameboards.ibis.moves import (
    SYS,
    USR,
    Action,
    Move,
    Participant,
    Program,
    Proposition,
    greet,
    say,
)
from ttr.semantics.questions import Question
from ttr.types.objects import Object, Record, record
from ttr.types.syntax import ListOf, NonEmpty, PType, RecordType, RecType

STATE: RecordType = rectype(
    private=rectype(
        agenda=ListOf(Action),
        plan=ListOf(Action),
        bel=ListOf(Proposition),
        nim=ListOf(Move),
    ),
    shared=rectype(
        com=ListOf(Proposition),
        qud=ListOf(Question),
        lu=rectype(speaker=Participant, moves=ListOf(Move)),
    ),
    next_moves=ListOf(Move),
    output=ListOf(RecType),
    program=Program,
)
"""The type of every information state.

`agenda` has what is to be done next, `plan` what is to be done in the long run, and
`bel` what only the system believes. `com` has the propositions agreed on, `qud` the
questions under discussion, the maximal one first, and `lu` the latest utterance.
`next_moves` are the moves that the system has selected, and `output` has the type of
the utterance that it will make of them.

>>> from ttr.semantics.gameboards.ibis import STATE
>>> print(STATE["shared"])
[com : list(Proposition), lu : [moves : list(Move), speaker : Participant], qud :
list(Question)]
"""

START: Record = record(
    private=record(agenda=[say(greet(SYS))], plan=[], bel=[], nim=[]),
    shared=record(com=[], qud=[], lu=record(speaker=USR, moves=[])),
    next_moves=[],
    output=[],
    program="run",
)
"""The state in which a dialogue begins: the system is to greet.

>>> from ttr.semantics.gameboards.ibis import START
>>> print(*START.private.agenda)
say(greet(sys))
"""

USER: RecordType = rectype(spkr=Participant @ USR, moves=ListOf(Move))
"""The type of utterances of the user.

>>> from ttr.semantics.gameboards.ibis import USER
>>> print(USER)
[moves : list(Move), spkr = usr : Participant]
"""

OWN: RecordType = rectype(spkr=Participant @ SYS, moves=ListOf(Move))
"""The type of utterances of the system."""

TO_DO: RecordType = rectype(private=rectype(agenda=NonEmpty(Action)))
"""The states in which something is to be done next."""


def utterance(speaker: str, moves: Iterable[Object]) -> Record:
    """The utterance of some moves by a speaker.

    >>> print(utterance(USR, [greet(USR)]))
    {moves = [greet(usr)], spkr = usr}
    """
    return record(spkr=speaker, moves=tuple(moves))


def utterance_type(speaker: str, moves: Iterable[PType]) -> RecordType:
    """The type of utterances of exactly these moves by a speaker.

    >>> print(utterance_type(SYS, [greet(SYS)]))
    [moves = [greet(sys)] : list(Move), spkr = sys : Participant]
    """
    return rectype(
        spkr=Participant @ speaker,
        moves=ListOf(Move) @ tuple(moves),
    )
