"""Loading plans and carrying them out, as far as nothing has to be said for it.

Source: Larsson 2002, chapter 2.
"""

from __future__ import annotations

from collections.abc import Iterator

from ttr.building.constructors import rectype
from ttr.semantics.gameboards.ibis.domains import Domain, size
from ttr.semantics.gameboards.ibis.moves import (
    Action,
    consult,
    findout,
    if_then,
    no_answer,
    raise_,
    respond,
)
from ttr.semantics.gameboards.ibis.state import TO_DO
from ttr.semantics.questions import Question
from ttr.types.records import replace
from ttr.types.syntax import (
    ListOf,
    NonEmpty,
    Object,
    PType,
    Record,
    RecordType,
    TypeNode,
)
from ttr.updates import Algorithm, all_, first, repeat, rule

__all__ = ["load", "planning", "settled", "unanswered", "without_answer"]

WITH_PLAN = rectype(private=rectype(plan=NonEmpty(Action)))
WITHOUT_PLAN = rectype(
    private=rectype(plan=ListOf(Action) @ ()), shared=rectype(qud=NonEmpty(Question))
)


def without_answer(question: Object) -> TypeNode:
    """The proposition that a question has no answer that could be found."""
    return rectype(e=no_answer(question))


def unanswered(P: Object) -> Object | None:
    """The question that a proposition says to have no answer, if it does."""
    fact = P.get("e") if isinstance(P, RecordType) else None
    return fact.args[0] if isinstance(fact, PType) and fact.pred is no_answer else None


def settled(s: Record, question: Object, domain: Domain) -> TypeNode | None:
    """What the system knows that resolves a question, or that there is no answer."""
    answer = domain.answers(question, (*s.private.bel, *s.shared.com))
    if answer is None and any(unanswered(P) is question for P in s.private.bel):
        return without_answer(question)
    return answer


def load(domain: Domain) -> Algorithm:
    """Finds out how the user's question is dealt with."""

    @rule(when=TO_DO, kind="load")
    def find_plan(s: Record) -> Record | None:
        """The user's question is dealt with by the plan that the domain has for it."""
        for action in _to_settle(s):
            plan = domain.plan(action.args[0])
            if plan:
                agenda = tuple(one for one in s.private.agenda if one is not action)
                return replace(s, {"private.agenda": agenda, "private.plan": plan})
        return None

    @rule(when=TO_DO, kind="load")
    def look_up(s: Record) -> Record | None:
        """There is no plan for the user's question: it is looked up at once."""
        for action in _to_settle(s):
            return _believing(s, _looked_up(s, action.args[0], domain))
        return None

    def _to_settle(s: Record) -> Iterator[PType]:
        """The responses on the agenda that the system cannot give yet."""
        for action in s.private.agenda:
            if action.pred is respond and settled(s, action.args[0], domain) is None:
                yield action

    return first(find_plan, look_up)


def _looked_up(s: Record, question: Object, domain: Domain) -> TypeNode:
    """What the database says about a question, or that it has no answer."""
    return domain.found(question, s.shared.com) or without_answer(question)


def _believing(s: Record, P: TypeNode) -> Record:
    return replace(s, {"private.bel": tuple(dict.fromkeys((*s.private.bel, P)))})


def planning(domain: Domain) -> Algorithm:
    """Carries out the plan as far as nobody has to be asked for it."""

    @rule(when=WITHOUT_PLAN, kind="load")
    def recover_plan(s: Record) -> Record | None:
        """A question is still under discussion: go on with its plan."""
        for question in s.shared.qud:
            plan = domain.plan(question)
            if plan and settled(s, question, domain) is None:
                return replace(s, {"private.plan": plan})
        return None

    @rule(when=WITH_PLAN, kind="exec_plan")
    def remove_answered(s: Record) -> Record | None:
        """What was to be found out or raised is answered."""
        action, *rest = s.private.plan
        if action.pred not in (findout, raise_):
            return None
        if domain.answers(action.args[0], s.shared.com) is None:
            return None
        return replace(s, {"private.plan": rest})

    @rule(when=WITH_PLAN, kind="exec_plan")
    def exec_consult(s: Record) -> Record | None:
        """What the database says is believed, or that it has no answer."""
        action, *rest = s.private.plan
        if action.pred is not consult:
            return None
        (question,) = action.args
        found = _believing(s, _looked_up(s, question, domain))
        return replace(found, {"private.plan": rest})

    @rule(when=WITH_PLAN, kind="exec_plan")
    def exec_if_then(s: Record) -> Record | None:
        """What is agreed on decides how the plan goes on."""
        action, *rest = s.private.plan
        if action.pred is not if_then:
            return None
        condition, chosen, other = action.args
        holds = condition in (*s.shared.com, *s.private.bel)
        return replace(s, {"private.plan": (*(chosen if holds else other), *rest)})

    execute = first(remove_answered, exec_consult, exec_if_then)
    return all_(recover_plan, repeat(execute, measure=_plan_size))


def _plan_size(s: Record) -> int:
    return size(s.private.plan)
