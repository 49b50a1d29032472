"""An index of conditions by the predicates they demand at some path of a state.

A rule may demand that the latest move is a question. Where the move is a greeting, its
predicate alone shows that the rule does not apply, and nothing has to be judged.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from operator import is_
from typing import TypeAlias

from ttr.judging.assignments import Assignment
from ttr.safety.budgets import spend
from ttr.signature.signature import head
from ttr.types.objects import Object, Record
from ttr.types.syntax import Join, Meet, Pred, PType, RecordType, TypeNode

Labels: TypeAlias = tuple[str, ...]
"""The labels of a path, from the state inwards."""

Demands: TypeAlias = Mapping[Labels, frozenset[Pred]]
"""For each path, the predicates of which the situation there has to have one."""


def demands_of(T: TypeNode) -> Demands:
    """The predicates that every object of a type has at some of its paths.

    >>> from ttr import Ind, rectype, this
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
            return demands_of_any(map(demands_of, parts))
        case Meet(parts):
            return {k: v for part in parts for k, v in demands_of(part).items()}
    return {}


def demands_of_any(demands: Iterable[Demands]) -> Demands:
    """What an object has at some paths if it meets any of several demands.

    >>> P, Q = Pred("p"), Pred("q")
    >>> demands_of_any([{("x",): {P}, ("y",): {P}}, {("x",): {Q}}]) == {("x",): {P, Q}}
    True
    """
    first, *others = demands
    return {
        path: frozenset(preds).union(*(other[path] for other in others))
        for path, preds in first.items()
        if all(path in other for other in others)
    }


class RuleIndex:
    """Finds the demands that a state may meet by looking at one of its paths.

    That is the path that most demands mention. Law: a demand that is left out is not
    met.
    """

    def __init__(self, several: Iterable[Demands]) -> None:
        demands = list(several)
        found = [path for one in demands for path in one]
        self._path = max(found, key=found.count, default=())
        self._wanted = [one.get(self._path) for one in demands]
        self._every = _NONE.union(*(preds for preds in self._wanted if preds))
        self._left: dict[frozenset[Pred], Sequence[int]] = {}
        self._open: tuple[tuple[object, ...], frozenset[Pred]] = (), _NONE

    def possible_demands(self, sit: Object, facts: Assignment) -> Sequence[int]:
        """The numbers of the demands that sit may meet, in order."""
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
        """The predicates that what is at the path may have (`Assignment.can_be`)."""
        there = sit
        for label in self._path:
            if not isinstance(there, Record) or label not in there:
                return _NONE
            there = there._fields[label]
        told = self._every.intersection(map(head, facts.types_of(there)))
        return told | self._open_predicates(facts)

    def _open_predicates(self, facts: Assignment) -> frozenset[Pred]:
        """The predicates that may be true of objects of which no fact says so."""
        by = facts.functions, facts.opened, facts.theory.axiom_heads
        known, found = self._open
        if not known or not all(map(is_, known, by)):
            found = frozenset(P for P in self._every if any(P in one for one in by))
            self._open = by, found
        return found


_NONE: frozenset[Pred] = frozenset()
