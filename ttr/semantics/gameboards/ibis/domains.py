"""A domain: what can be asked in it, how the answer is found, and the database.

Source: Larsson 2002, chapter 2.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

from ttr.errors import TTRError
from ttr.judging.models import Model
from ttr.semantics.gameboards.ibis.moves import (
    Action,
    Proposition,
    findout,
    if_then,
    raise_,
    with_terms,
)
from ttr.semantics.questions import (
    combine,
    find_answer,
    is_question,
    relevant,
    resolves,
)
from ttr.types.objects import Object, freeze
from ttr.types.printing import notation
from ttr.types.syntax import Negation, TypeNode, kind_of

Lookup: TypeAlias = Callable[[Object, Sequence[TypeNode], Model], TypeNode | None]
"""The answer to a question, given what is agreed on; None where there is none."""


@dataclass(frozen=True, eq=False)
class Domain:
    """Plans for questions, the sorts of objects, and a database.

    `plans` maps issues, which are questions that users ask, to the actions by which the
    system finds an answer; `model` says which objects are of which sorts. Raises
    `TTRError` where an issue is no question, or something in a plan is no action.

    >>> from ttr import Basic, Model, Pred
    >>> from ttr.semantics.gameboards.ibis.moves import findout
    >>> from ttr.semantics.questions import which
    >>> City = Basic("City")
    >>> price, to = which(Pred("price", City)), which(Pred("dest_city", City))
    >>> M = Model().given("paris", City)
    >>> travel = Domain({price: [findout(to)]}, lambda *_: None, M)
    >>> [*travel.issues()] == [price], [*travel.dependent_issues(to)] == [price]
    (True, True)
    """

    plans: Mapping[Object, Sequence[Object]]
    lookup: Lookup
    model: Model

    def __post_init__(self) -> None:
        object.__setattr__(self, "model", with_terms(self.model))
        plans = {issue: freeze(list(plan)) for issue, plan in self.plans.items()}
        object.__setattr__(self, "plans", plans)
        for issue, plan in plans.items():
            if not is_question(issue):
                raise TTRError(f"a plan is for a question, not for {kind_of(issue)}")
            for item in plan:
                if not self.model.judge(item, Action).holds:
                    raise TTRError(
                        f"the plan for {issue} has {notation(item)}, which is no action"
                    )

    def issues(self) -> Iterator[Object]:
        """The questions that have a plan."""
        return iter(self.plans)

    def plan(self, issue: Object) -> tuple[Object, ...]:
        """The plan for a question; empty where there is none."""
        return tuple(self.plans.get(issue, ()))

    @cached_property
    def questions(self) -> tuple[Object, ...]:
        """The questions that the system may ask the user, each once."""
        asked = [q for plan in self.plans.values() for q in questions_in(plan)]
        return tuple(dict.fromkeys(asked))

    def dependent_issues(self, question: Object) -> tuple[Object, ...]:
        """The issues that depend on this question, as it is asked in their plans."""
        return tuple(
            issue
            for issue, plan in self.plans.items()
            if question in questions_in(plan)
        )

    # --- answers ---

    def questions_about(
        self, answer: Object, questions: Iterable[Object]
    ) -> list[Object]:
        """The questions among these that an answer is about."""
        return [q for q in questions if relevant(answer, q, self.model)]

    def find_answer(self, question: Object, known: Iterable[Object]) -> TypeNode | None:
        """The first proposition known that resolves a question, or None."""
        return find_answer(question, known, self.model)

    def issues_about(self, answer: Object) -> list[Object]:
        """The issues whose plans ask a question that an answer is about."""
        return [
            issue
            for issue, plan in self.plans.items()
            if self.questions_about(answer, questions_in(plan))
        ]

    def questions_answered_again(
        self, answer: Object, agreed: Sequence[TypeNode]
    ) -> list[tuple[Object, TypeNode]]:
        """The questions that an answer is about again, each with what it conveys.

        Something about each of them is agreed on already.
        """
        return [
            (q, combine(q, answer, self.model))
            for q in self.questions_about(answer, self.questions)
            if any(relevant(P, q, self.model) for P in agreed)
        ]

    def incompatible(
        self, P: TypeNode, question: Object, agreed: Sequence[TypeNode]
    ) -> tuple[TypeNode, ...]:
        """The propositions agreed on that are incompatible with P as the answer.

        A question which has at most one answer.
        """
        is_resolved = resolves(P, question, self.model)
        return tuple(
            Q
            for Q in agreed
            if Q is not P
            and relevant(Q, question, self.model)
            and (_denies(P, Q) or (is_resolved and resolves(Q, question, self.model)))
        )

    # --- the database ---

    def look_up(self, question: Object, agreed: Sequence[TypeNode]) -> TypeNode | None:
        """The answer to a question in the database, given what is agreed on."""
        answer = self.lookup(question, agreed, self.model)
        if answer is None or self.model.judge(answer, Proposition).holds:
            return answer
        raise TTRError(
            f"the database answers by a proposition or None, but it gave {answer!r}"
        )


def _denies(P: TypeNode, Q: TypeNode) -> bool:
    """Is one of two propositions the negation of the other?"""
    return (isinstance(P, Negation) and P.body is Q) or (
        isinstance(Q, Negation) and Q.body is P
    )


def questions_in(plan: Sequence[Object]) -> Iterator[Object]:
    """The questions to the user in a plan, in order, in all of its alternatives."""
    for item in plan:
        if item.pred in (findout, raise_):
            yield item.args[0]
        elif item.pred is if_then:
            _, chosen, other = item.args
            yield from questions_in(chosen)
            yield from questions_in(other)


def plan_size(plan: Sequence[Object]) -> int:
    """The number of actions in a plan, in all of its alternatives."""
    return sum(
        1 + sum(map(plan_size, item.args[1:])) if item.pred is if_then else 1
        for item in plan
    )
