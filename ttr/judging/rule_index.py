"""What a condition demands of a state that a look at it can deny: predicates, by path.

A rule may want the latest move to be a question. Where it is a greeting, which rules
want something else is plain from the predicate of the move, and need not be judged.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from operator import is_
from typing import TypeAlias

from ttr.judging.assignments import Assignment, head
from ttr.safety.budgets import spend
from ttr.types.syntax import (
    Join,
    Meet,
    Object,
    Pred,
    PType,
    Record,
    RecordType,
    TypeNode,
)

__all__ = ["Demands", "Sieve", "any_of", "demands_of"]

Labels: TypeAlias = tuple[str, ...]
"""The labels of a path, from the state inwards."""

Demands: TypeAlias = Mapping[Labels, frozenset[Pred]]
"""At each of these paths has to be a situation of one of these predicates."""


def demands_of(T: TypeNode) -> Demands:
    """What whatever is of a type has at some paths.

    >>> from ttr.building.constructors import rectype
    >>> from ttr.types.syntax import Ind, this
    >>> ask, tell = Pred("ask", Ind), Pred("tell", Ind)
    >>> asks, tells = (rectype(x=Ind, e=P(this.x)) for P in (ask, tell))
    >>> demands_of(rectype(latest=asks | tells)) == {("latest", "e"): {ask, tell}}
    True
    """
    spend()
    match T:
        case PType(pred, _):
            return {(): frozenset((pred,))}
        case RecordType(fields):
            return {
                (label, *path): preds
                for label, field in fields
                for path, preds in demands_of(field).items()
            }
        case Join(parts):
            return any_of(map(demands_of, parts))
        case Meet(parts):
            return {k: v for part in parts for k, v in demands_of(part).items()}
    return {}


def any_of(demands: Iterable[Demands]) -> Demands:
    """What all of several demand, as far as one of the predicates is enough for each.

    >>> P, Q = Pred("p"), Pred("q")
    >>> any_of([{("x",): {P}, ("y",): {P}}, {("x",): {Q}}]) == {("x",): {P, Q}}
    True
    """
    first, *others = demands
    return {
        path: frozenset(preds).union(*(other[path] for other in others))
        for path, preds in first.items()
        if all(path in other for other in others)
    }


class Sieve:
    """Finds those of several demands that a state may meet, by one path.

    It is the path that most of them have. Law: a demand that is left out is not met.
    """

    def __init__(self, several: Iterable[Demands]) -> None:
        demands = list(several)
        found = [path for one in demands for path in one]
        self._path = max(found, key=found.count, default=())
        self._wanted = [one.get(self._path) for one in demands]
        self._every = _NONE.union(*(preds for preds in self._wanted if preds))
        self._left: dict[frozenset[Pred], Sequence[int]] = {}
        self._open: tuple[tuple[object, ...], frozenset[Pred]] = (), _NONE

    def __len__(self) -> int:
        return len(self._wanted)

    def left(self, sit: Object, facts: Assignment) -> Sequence[int]:
        """The numbers of those that something may meet, in order."""
        possible = self._possible(sit, facts) if self._every else _NONE
        left = self._left.get(possible)
        if left is None:
            left = self._left[possible] = [
                number
                for number, preds in enumerate(self._wanted)
                if preds is None or preds & possible
            ]
        return left

    def _possible(self, sit: Object, facts: Assignment) -> frozenset[Pred]:
        """Those that may be true of what is at the path (`Assignment.can_be`)."""
        there = sit
        for label in self._path:
            if not isinstance(there, Record) or label not in there:
                return _NONE
            there = there._fields[label]
        told = self._every.intersection(map(head, facts.types_of(there)))
        return told | self._open_predicates(facts)

    def _open_predicates(self, facts: Assignment) -> frozenset[Pred]:
        """Those that may be true of anything, be it told or not."""
        by = facts.functions, facts.opened, facts.theory.axiom_heads
        known, found = self._open
        if not known or not all(map(is_, known, by)):
            found = frozenset(P for P in self._every if any(P in one for one in by))
            self._open = by, found
        return found


_NONE: frozenset[Pred] = frozenset()
