"""A domain: what can be asked in it, how that is found out, and who knows the answers.

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
from ttr.types.printing import notation
from ttr.types.syntax import Negation, Object, TypeNode, freeze, kind_of

__all__ = ["Domain", "Lookup", "asked_in", "size"]

Lookup: TypeAlias = Callable[[Object, Sequence[TypeNode], Model], TypeNode | None]
"""The answer to a question, by what is agreed on; None where there is none."""


@dataclass(frozen=True, eq=False)
class Domain:
    """The plans by which questions are dealt with, the sorts of objects, the database.

    `plans` takes a question that users ask, an issue, to the list of actions by which
    the system comes to an answer; `model` says which objects are of which sorts. Raises
    `TTRError` where an issue is no question, or a plan has something else than actions.
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
        """The questions that there is a plan for."""
        return iter(self.plans)

    def plan(self, issue: Object) -> tuple[Object, ...]:
        """How to find the answer to a question; empty where that is not known."""
        return tuple(self.plans.get(issue, ()))

    @cached_property
    def questions(self) -> tuple[Object, ...]:
        """What the system may want to know from the user, each question once."""
        asked = [q for plan in self.plans.values() for q in asked_in(plan)]
        return tuple(dict.fromkeys(asked))

    def resting_on(self, question: Object) -> tuple[Object, ...]:
        """The issues whose answers depend on what the answer to this question is."""
        return tuple(
            issue for issue, plan in self.plans.items() if question in asked_in(plan)
        )

    # --- answers ---

    def about(self, answer: Object, questions: Iterable[Object]) -> list[Object]:
        """Those of the questions that an answer is about."""
        return [q for q in questions if relevant(answer, q, self.model)]

    def answers(self, question: Object, known: Iterable[Object]) -> TypeNode | None:
        """What of this resolves a question, or None."""
        return find_answer(question, known, self.model)

    def open(
        self, questions: Iterable[Object], known: Sequence[Object]
    ) -> tuple[Object, ...]:
        """Those of the questions that nothing known resolves."""
        return tuple(q for q in questions if self.answers(q, known) is None)

    def concerned(self, answer: Object) -> list[Object]:
        """The issues in whose plans there is a question that an answer is about."""
        return [
            issue
            for issue, plan in self.plans.items()
            if self.about(answer, asked_in(plan))
        ]

    def said_before(
        self, answer: Object, agreed: Sequence[TypeNode]
    ) -> list[tuple[Object, TypeNode]]:
        """The questions an answer is about that are agreed on, and what it says."""
        return [
            (q, combine(q, answer, self.model))
            for q in self.about(answer, self.questions)
            if any(relevant(P, q, self.model) for P in agreed)
        ]

    def opposed(
        self, P: TypeNode, question: Object, agreed: Sequence[TypeNode]
    ) -> tuple[TypeNode, ...]:
        """What is agreed on and cannot be, if this is the answer to the question.

        A question which has one answer at most.
        """
        settled = resolves(P, question, self.model)
        return tuple(
            Q
            for Q in agreed
            if Q is not P
            and relevant(Q, question, self.model)
            and (_denies(P, Q) or (settled and resolves(Q, question, self.model)))
        )

    # --- the database ---

    def found(self, question: Object, agreed: Sequence[TypeNode]) -> TypeNode | None:
        """The answer to a question in the database, by what is agreed on."""
        answer = self.lookup(question, agreed, self.model)
        if answer is None or self.model.judge(answer, Proposition).holds:
            return answer
        raise TTRError(
            f"the database answers by a proposition or None, but it gave {answer!r}"
        )


def _denies(P: TypeNode, Q: TypeNode) -> bool:
    """Whether one is the negation of the other."""
    return (isinstance(P, Negation) and P.body is Q) or (
        isinstance(Q, Negation) and Q.body is P
    )


def asked_in(plan: Sequence[Object]) -> Iterator[Object]:
    """The questions to the user in a plan, in order, whatever is chosen in it."""
    for item in plan:
        if item.pred in (findout, raise_):
            yield item.args[0]
        elif item.pred is if_then:
            _, chosen, other = item.args
            yield from asked_in(chosen)
            yield from asked_in(other)


def size(plan: Sequence[Object]) -> int:
    """How many actions a plan has, those to choose between included."""
    return sum(
        1 + sum(map(size, item.args[1:])) if item.pred is if_then else 1
        for item in plan
    )
