"""An index of facts by arguments: which objects can fill a field of a record type?

The fields of [x : Ind, y : Ind, c : r(x, y)] are filled one after the other, as a
database joins relations. What cannot be an x, as no fact is about a situation of
r(x, …), is left out before a y is looked for.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple, TypeAlias

from ttr.judging.assignments import Assignment
from ttr.safety.budgets import spend
from ttr.types.interning import cache_on_node, identity
from ttr.types.objects import Object, Path, UnresolvedError
from ttr.types.paths import free_paths
from ttr.types.substitution import follow_path
from ttr.types.syntax import Meet, Pred, PType, RecordType, Singleton, TypeNode

_Positions: TypeAlias = tuple[int, ...]
"""Numbers of arguments of a predicate, in ascending order."""

_Values: TypeAlias = dict[tuple[object, ...], set[object]]
"""For values at some positions, the values that facts have at another one."""


_Some: TypeAlias = set[object] | frozenset[object]


class _Unknown:
    """Stands for an argument that is not known before the record is filled."""


_UNKNOWN = _Unknown()


class _Demand(NamedTuple):
    """A ptype that something has to be of, with a label's value at a position.

    Arguments that are paths start in the record.
    """

    pred: Pred
    args: tuple[Object, ...]
    position: int


class FactIndex:
    """Finds the arguments that the facts of an assignment have, as they are needed."""

    def __init__(self, facts: Assignment) -> None:
        self._facts = facts
        self._by_pred: dict[Pred, list[PType]] | None = None
        self._values: dict[tuple[Pred, int, _Positions, int], _Values] = {}

    def values_that_fit(
        self, T: RecordType, label: str, fields: Mapping[str, Object]
    ) -> _Some | None:
        """The identities of what a label may have, given the fields before it.

        They are those for which each ptype that the record needs may have a witness.
        None where that leaves out nothing.
        """
        found: list[_Some] = []
        for demand in _demands(T).get(label, ()):
            if demand.pred in self._facts.theory.axiom_heads:
                continue
            fitting = self._values_for(demand, fields)
            if not fitting:
                return frozenset()
            found.append(fitting)
        if not found:
            return None
        least, *others = sorted(found, key=len)
        spend(1 + len(least) * len(others) // 8)
        return least.intersection(*others) if others else least

    def _values_for(self, demand: _Demand, fields: Mapping[str, Object]) -> _Some:
        """The values at the position of a demand in facts that agree elsewhere."""
        positions: list[int] = []
        values: list[object] = []
        for number, arg in enumerate(demand.args):
            if isinstance(arg, Path):
                if arg.labels[0] not in fields:
                    continue
                first, *rest = arg.labels
                try:
                    arg = follow_path(fields[first], tuple(rest))
                except UnresolvedError:
                    return frozenset()
            if arg is not _UNKNOWN:
                positions.append(number)
                values.append(identity(arg))
        known = self._at(demand, tuple(positions))
        return known.get(tuple(values), frozenset())

    def _at(self, demand: _Demand, positions: _Positions) -> _Values:
        key = demand.pred, len(demand.args), positions, demand.position
        known = self._values.get(key)
        if known is None:
            known = self._values[key] = {}
            for T in self._facts_of(demand.pred):
                spend()
                if len(T.args) == len(demand.args):
                    values = tuple([identity(T.args[n]) for n in positions])
                    mine = identity(T.args[demand.position])
                    known.setdefault(values, set()).add(mine)
        return known

    def _facts_of(self, pred: Pred) -> Iterable[PType]:
        """The ptypes of a predicate with facts."""
        if self._by_pred is None:
            self._by_pred = {}
            for T in self._facts.told:
                spend()
                if isinstance(T, PType):
                    self._by_pred.setdefault(T.pred, []).append(T)
        return self._by_pred.get(pred, ())


@cache_on_node
def _demands(T: RecordType) -> Mapping[str, tuple[_Demand, ...]]:
    """For each label, the ptypes that a record of T needs, and that mention it."""
    found: dict[str, list[_Demand]] = {}
    for _, field in T.fields:
        for pred, args in _needed_ptypes(field, 0):
            for number, arg in enumerate(args):
                if isinstance(arg, Path) and len(arg.labels) == 1:
                    mine = found.setdefault(arg.labels[0], [])
                    others = (*args[:number], _UNKNOWN, *args[number + 1 :])
                    mine.append(_Demand(pred, others, number))
    return {label: tuple(mine) for label, mine in found.items()}


def _needed_ptypes(
    T: TypeNode, depth: int
) -> Iterator[tuple[Pred, tuple[Object, ...]]]:
    """The ptypes that need a witness where something is of T, so many records in."""
    match T:
        case PType(pred, args):
            yield pred, tuple([_seen_from_outside(arg, depth) for arg in args])
        case Meet(parts):
            for part in parts:
                yield from _needed_ptypes(part, depth)
        case Singleton(base, _):
            yield from _needed_ptypes(base, depth)
        case RecordType(fields):
            for _, field in fields:
                yield from _needed_ptypes(field, depth + 1)


def _seen_from_outside(arg: Object, depth: int) -> Object:
    """An argument as seen from the record; unknown if it depends on anything else."""
    if isinstance(arg, Path):
        return Path(0, arg.labels) if arg.up == depth else _UNKNOWN
    return _UNKNOWN if free_paths(arg) else arg
