"""What the system does next, and the moves by which it does it.

Source: Larsson 2002, chapter 2: the selection module.
"""

from __future__ import annotations

from typing import NamedTuple

from ttr.building.constructors import rectype
from ttr.semantics.gameboards.ibis.domains import Domain
from ttr.semantics.gameboards.ibis.moves import (
    SYS,
    USR,
    Action,
    Move,
    Participant,
    answer,
    ask,
    findout,
    prompt,
    raise_,
    respond,
    say,
)
from ttr.semantics.gameboards.ibis.planning import settled
from ttr.semantics.gameboards.ibis.state import TO_DO, utterance_type
from ttr.semantics.questions import Question
from ttr.types.records import replace
from ttr.types.syntax import ListOf, NonEmpty, Pred, PType, Record
from ttr.updates import Algorithm, all_, first, repeat, rule, seq

__all__ = ["Selection", "selection"]

WITH_PLAN = rectype(
    private=rectype(agenda=ListOf(Action) @ (), plan=NonEmpty(Action)),
    shared=rectype(lu=rectype(speaker=Participant @ USR)),
)
AFTER_OWN = rectype(
    private=rectype(agenda=ListOf(Action) @ (), plan=NonEmpty(Action)),
    shared=rectype(lu=rectype(speaker=Participant @ SYS)),
)
AFTER_PLAN = rectype(
    private=rectype(agenda=ListOf(Action) @ (), plan=ListOf(Action) @ ()),
    shared=rectype(qud=NonEmpty(Question)),
)
NOTHING_TO_SAY = rectype(
    private=rectype(agenda=ListOf(Action) @ ()),
    shared=rectype(lu=rectype(speaker=Participant @ USR)),
    next_moves=ListOf(Move) @ (),
)


def _select(s: Record, move: PType) -> Record:
    """The state in which the first thing on the agenda is done by a move."""
    changes = {
        "private.agenda": s.private.agenda[1:],
        "next_moves": (*s.next_moves, move),
    }
    return replace(s, changes)


def _has(moves: tuple[PType, ...], pred: Pred) -> bool:
    return any(move.pred is pred for move in moves)


@rule(when=TO_DO, kind="select_move")
def select_other(s: Record) -> Record | None:
    """What is to be done is to make a move: the system makes it."""
    action = s.private.agenda[0]
    return _select(s, action.args[0]) if action.pred is say else None


@rule(when=TO_DO, kind="select_move")
def select_ask(s: Record) -> Record | None:
    """What is to be found out or raised, the system asks; it raises it once only."""
    action = s.private.agenda[0]
    if action.pred not in (findout, raise_):
        return None
    asked = _select(s, ask(SYS, action.args[0]))
    if action.pred is findout:
        return asked
    plan = tuple(other for other in s.private.plan if other is not action)
    return replace(asked, {"private.plan": plan})


@rule(when=WITH_PLAN, kind="select_action")
def select_from_plan(s: Record) -> Record | None:
    """There is a plan: its first action is to be done, if nothing is asked yet."""
    return None if _has(s.next_moves, ask) else _next_action(s)


@rule(when=AFTER_OWN, kind="select_action")
def resume_plan(s: Record) -> Record | None:
    """The system has answered, and asked nothing: it goes on with an open plan."""
    said = s.shared.lu.moves
    goes_on = _has(said, answer) and not _has((*said, *s.next_moves), ask)
    return _next_action(s) if goes_on else None


def _next_action(s: Record) -> Record:
    return replace(s, {"private.agenda": s.private.plan[:1]})


@rule(when=NOTHING_TO_SAY, kind="select_move")
def select_prompt(s: Record) -> Record:
    """There is nothing to be done: the user is asked to ask."""
    return replace(s, {"next_moves": (prompt(SYS),)})


@rule(when=rectype(next_moves=NonEmpty(Move)), kind="generate")
def utter(s: Record) -> Record:
    """The moves that were selected are one utterance, which is about to be made."""
    said = utterance_type(SYS, s.next_moves)
    return replace(s, {"next_moves": (), "output": (*s.output, said)})


SELECTIONS = 100_000
"""How many actions and moves are selected in a turn at most: more than anybody asks."""


class Selection(NamedTuple):
    """What the system does after a turn of the user's, and after one of its own."""

    answering: Algorithm
    going_on: Algorithm


def selection(domain: Domain) -> Selection:
    """Selects what to do and the moves for it, and makes an utterance of them.

    After an utterance of its own the system goes on where that answered a question.
    """

    @rule(when=TO_DO, kind="select_move")
    def select_answer(s: Record) -> Record | None:
        """The system knows how to respond to a question: it answers."""
        action = s.private.agenda[0]
        if action.pred is not respond:
            return None
        known = settled(s, action.args[0], domain)
        return None if known is None else _select(s, answer(SYS, known))

    @rule(when=AFTER_PLAN, kind="select_action")
    def select_respond(s: Record) -> Record | None:
        """The plan is done, and a question discussed has an answer: respond to it."""
        for question in s.shared.qud:
            known = settled(s, question, domain)
            if known is not None and answer(SYS, known) not in s.next_moves:
                return replace(s, {"private.agenda": (respond(question),)})
        return None

    select = first(
        select_other, select_answer, select_ask, select_from_plan, select_respond
    )
    return Selection(
        all_(repeat(select, times=SELECTIONS), select_prompt, utter),
        seq(
            first(resume_plan, select_respond), first(select_ask, select_answer), utter
        ),
    )
