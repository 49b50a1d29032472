"""Planning: rules that load plans, and carry them out as far as nobody need be asked.

Source: Larsson 2002, chapter 2.
"""

from __future__ import annotations

from collections.abc import Iterator

from ttr.building.constructors import rectype
from ttr.semantics.gameboards.ibis.domains import Domain, plan_size
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
from ttr.types.objects import Object, Record
from ttr.types.records import replace
from ttr.types.syntax import ListOf, NonEmpty, PType, RecordType, TypeNode
from ttr.updates import Algorithm, all_, first, repeat, rule

_WITH_PLAN = rectype(private=rectype(plan=NonEmpty(Action)))
_WITHOUT_PLAN = rectype(
    private=rectype(plan=ListOf(Action) @ ()), shared=rectype(qud=NonEmpty(Question))
)


def no_answer_to(question: Object) -> TypeNode:
    """The proposition that no answer to a question could be found."""
    return rectype(e=no_answer(question))


def question_without_answer(P: Object) -> Object | None:
    """The question that has no answer by this proposition, or None."""
    fact = P.get("e") if isinstance(P, RecordType) else None
    return fact.args[0] if isinstance(fact, PType) and fact.pred is no_answer else None


def known_answer(s: Record, question: Object, domain: Domain) -> TypeNode | None:
    """What the system knows that resolves a question, or that there is no answer."""
    answer = domain.find_answer(question, (*s.private.bel, *s.shared.com))
    if answer is None and any(
        question_without_answer(P) is question for P in s.private.bel
    ):
        return no_answer_to(question)
    return answer


def load(domain: Domain) -> Algorithm:
    """The algorithm that finds a plan for the user's question, or its answer."""

    @rule(when=TO_DO, kind="load")
    def find_plan(s: Record) -> Record | None:
        """The domain's plan for the user's question is loaded."""
        for action in _unresolved_responses(s):
            plan = domain.plan(action.args[0])
            if plan:
                agenda = tuple(one for one in s.private.agenda if one is not action)
                return replace(s, {"private.agenda": agenda, "private.plan": plan})
        return None

    @rule(when=TO_DO, kind="load")
    def look_up(s: Record) -> Record | None:
        """There is no plan for the user's question: its answer is looked up at once."""
        for action in _unresolved_responses(s):
            return _believe(s, _look_up(s, action.args[0], domain))
        return None

    def _unresolved_responses(s: Record) -> Iterator[PType]:
        """The responses on the agenda that the system cannot give yet."""
        for action in s.private.agenda:
            if (
                action.pred is respond
                and known_answer(s, action.args[0], domain) is None
            ):
                yield action

    return first(find_plan, look_up)


def _look_up(s: Record, question: Object, domain: Domain) -> TypeNode:
    """The database's answer to a question, or that there is none."""
    return domain.look_up(question, s.shared.com) or no_answer_to(question)


def _believe(s: Record, P: TypeNode) -> Record:
    return replace(s, {"private.bel": tuple(dict.fromkeys((*s.private.bel, P)))})


def plan_execution(domain: Domain) -> Algorithm:
    """The algorithm that carries out the plan as far as nobody need be asked."""

    @rule(when=_WITHOUT_PLAN, kind="load")
    def recover_plan(s: Record) -> Record | None:
        """A question is still under discussion: its plan is loaded again."""
        for question in s.shared.qud:
            plan = domain.plan(question)
            if plan and known_answer(s, question, domain) is None:
                return replace(s, {"private.plan": plan})
        return None

    @rule(when=_WITH_PLAN, kind="exec_plan")
    def remove_answered(s: Record) -> Record | None:
        """What was to be found out or raised is answered: it leaves the plan."""
        action, *rest = s.private.plan
        if action.pred not in (findout, raise_):
            return None
        if domain.find_answer(action.args[0], s.shared.com) is None:
            return None
        return replace(s, {"private.plan": rest})

    @rule(when=_WITH_PLAN, kind="exec_plan")
    def exec_consult(s: Record) -> Record | None:
        """The database's answer is believed, or that there is none."""
        action, *rest = s.private.plan
        if action.pred is not consult:
            return None
        (question,) = action.args
        found = _believe(s, _look_up(s, question, domain))
        return replace(found, {"private.plan": rest})

    @rule(when=_WITH_PLAN, kind="exec_plan")
    def exec_if_then(s: Record) -> Record | None:
        """What is known decides how the plan goes on."""
        action, *rest = s.private.plan
        if action.pred is not if_then:
            return None
        condition, chosen, other = action.args
        holds = condition in (*s.shared.com, *s.private.bel)
        return replace(s, {"private.plan": (*(chosen if holds else other), *rest)})

    execute = first(remove_answered, exec_consult, exec_if_then)
    return all_(recover_plan, repeat(execute, measure=_size_of_plan))


def _size_of_plan(s: Record) -> int:
    return plan_size(s.private.plan)
