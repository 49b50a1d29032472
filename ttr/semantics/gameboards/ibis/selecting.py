"""Selection: rules for what the system does next, and by which moves.

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
from ttr.semantics.gameboards.ibis.planning import known_answer
from ttr.semantics.gameboards.ibis.state import TO_DO, utterance_type
from ttr.semantics.questions import Question
from ttr.types.objects import Record
from ttr.types.records import replace
from ttr.types.syntax import ListOf, NonEmpty, Pred, PType
from ttr.updates import Algorithm, all_, first, repeat, rule, seq

_WITH_PLAN = rectype(
    private=rectype(agenda=ListOf(Action) @ (), plan=NonEmpty(Action)),
    shared=rectype(lu=rectype(speaker=Participant @ USR)),
)
_AFTER_OWN = rectype(
    private=rectype(agenda=ListOf(Action) @ (), plan=NonEmpty(Action)),
    shared=rectype(lu=rectype(speaker=Participant @ SYS)),
)
_AFTER_PLAN = rectype(
    private=rectype(agenda=ListOf(Action) @ (), plan=ListOf(Action) @ ()),
    shared=rectype(qud=NonEmpty(Question)),
)
_NOTHING_TO_SAY = rectype(
    private=rectype(agenda=ListOf(Action) @ ()),
    shared=rectype(lu=rectype(speaker=Participant @ USR)),
    next_moves=ListOf(Move) @ (),
)


def _select(s: Record, move: PType) -> Record:
    """The state in which the first action on the agenda is done by a move."""
    changes = {
        "private.agenda": s.private.agenda[1:],
        "next_moves": (*s.next_moves, move),
    }
    return replace(s, changes)


def _has(moves: tuple[PType, ...], pred: Pred) -> bool:
    return any(move.pred is pred for move in moves)


@rule(when=TO_DO, kind="select_move")
def select_other(s: Record) -> Record | None:
    """The first action is to make a move: the system makes it."""
    action = s.private.agenda[0]
    return _select(s, action.args[0]) if action.pred is say else None


@rule(when=TO_DO, kind="select_move")
def select_ask(s: Record) -> Record | None:
    """The system asks what is to be found out or raised; it raises a question once."""
    action = s.private.agenda[0]
    if action.pred not in (findout, raise_):
        return None
    asked = _select(s, ask(SYS, action.args[0]))
    if action.pred is findout:
        return asked
    plan = tuple(other for other in s.private.plan if other is not action)
    return replace(asked, {"private.plan": plan})


@rule(when=_WITH_PLAN, kind="select_action")
def select_from_plan(s: Record) -> Record | None:
    """There is a plan: its first action is done unless something is being asked."""
    return None if _has(s.next_moves, ask) else _next_action(s)


@rule(when=_AFTER_OWN, kind="select_action")
def resume_plan(s: Record) -> Record | None:
    """The system has answered and asked nothing: it goes on with its plan."""
    said = s.shared.lu.moves
    goes_on = _has(said, answer) and not _has((*said, *s.next_moves), ask)
    return _next_action(s) if goes_on else None


def _next_action(s: Record) -> Record:
    return replace(s, {"private.agenda": s.private.plan[:1]})


@rule(when=_NOTHING_TO_SAY, kind="select_move")
def select_prompt(s: Record) -> Record:
    """There is nothing to be done: the user is invited to ask."""
    return replace(s, {"next_moves": (prompt(SYS),)})


@rule(when=rectype(next_moves=NonEmpty(Move)), kind="generate")
def utter(s: Record) -> Record:
    """The moves that were selected become one utterance, which is to be made."""
    said = utterance_type(SYS, s.next_moves)
    return replace(s, {"next_moves": (), "output": (*s.output, said)})


_SELECTIONS = 100_000
"""The most actions and moves that are selected in a turn: more than anybody needs."""


class Selection(NamedTuple):
    """The selection after a turn of the user, and after one of the system."""

    answering: Algorithm
    going_on: Algorithm


def selection(domain: Domain) -> Selection:
    """The algorithms that select actions and moves, and make an utterance of them.

    After an utterance of its own, the system goes on if that answered a question.
    """

    @rule(when=TO_DO, kind="select_move")
    def select_answer(s: Record) -> Record | None:
        """The system knows how to respond to a question: it answers."""
        action = s.private.agenda[0]
        if action.pred is not respond:
            return None
        known = known_answer(s, action.args[0], domain)
        return None if known is None else _select(s, answer(SYS, known))

    @rule(when=_AFTER_PLAN, kind="select_action")
    def select_respond(s: Record) -> Record | None:
        """The plan is done and a question under discussion has an answer: respond."""
        for question in s.shared.qud:
            known = known_answer(s, question, domain)
            if known is not None and answer(SYS, known) not in s.next_moves:
                return replace(s, {"private.agenda": (respond(question),)})
        return None

    select = first(
        select_other, select_answer, select_ask, select_from_plan, select_respond
    )
    return Selection(
        all_(repeat(select, times=_SELECTIONS), select_prompt, utter),
        seq(
            first(resume_plan, select_respond), first(select_ask, select_answer), utter
        ),
    )
