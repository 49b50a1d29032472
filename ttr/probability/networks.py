"""Networks: components in which conditionals are all that links the atoms.

Each atom is independent of those before it given its parents (Pearl 1988). Where
degrees are intervals it is a credal network (Cozman 2000): what is sought is, as a
function of one of them, a quotient of two straight lines, so it is least and greatest
at the ends.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from math import prod

from ttr.probability.degrees import (
    REFUTED,
    UNKNOWN,
    Degree,
    degree_of_negation,
    order_ends,
)
from ttr.probability.dependence import Component
from ttr.probability.events import Event, Truth, meets
from ttr.probability.linear_programs import scale_to_integers
from ttr.safety.budgets import spend

CASES = 256
"""The number of cases of the atoms asked for that are distinguished."""

WIDTH = 12
"""The number of atoms that one table may have when others are summed out."""

EFFORT = 8192
"""The number of atoms that are visited in all, over the ends of all intervals."""

Parents = Mapping[Hashable, tuple[Hashable, ...]]

Case = tuple[bool, ...]

Row = tuple[Hashable, Case]
"""An atom, and which of its parents hold."""

Table = tuple[tuple[Hashable, ...], dict[Case, int]]
"""Some atoms, and a weight for each case of them."""


class ImpossibleError(Exception):
    """The condition is certainly not met.

    >>> from ttr.probability import Atomic, Degree, chance
    >>> a, never = Atomic("a", Degree(0.5, 0.5)), Atomic("never", Degree(0, 0))
    >>> chance(a, given=never)
    Traceback (most recent call last):
        ...
    ttr.probability.networks.ImpossibleError
    """


@dataclass(frozen=True)
class Network:
    """The cases of some atoms of a network, and their weights at each corner."""

    cases: Sequence[Truth]
    weights: Sequence[Sequence[int]]
    exact: bool = True

    def share(
        self, worth: Sequence[Degree], given: Truth, others: Sequence[Event] = ()
    ) -> Degree:
        """How probable an event is of which we have the worth in each case.

        What is `given` is so for sure, and so are the other events. Raises
        `ImpossibleError` where that cannot be.
        """
        inside = [meets(case, given, others) for case in self.cases]
        ends, unit = scale_to_integers([x for p in worth for x in p])
        lows, highs = [], []
        for weights in self.weights:
            mine = [w if one else 0 for w, one in zip(weights, inside, strict=True)]
            whole = sum(mine) * unit
            if whole > 0:
                low = sum(w * x for w, x in zip(mine, ends[::2], strict=True))
                high = sum(w * x for w, x in zip(mine, ends[1::2], strict=True))
                lows.append(Fraction(low, whole))
                highs.append(Fraction(high, whole))
        if not lows:
            raise ImpossibleError
        return order_ends(float(min(lows)), float(max(highs)))


def network(component: Component, needed: Sequence[Hashable]) -> Network | None:
    """The network of a component, as far as some atoms go.

    None where it is none, or where too much of it is known in intervals only.

    >>> from ttr.probability import Conditional
    >>> degrees = {"a": Degree(0.5, 0.5), "b": UNKNOWN}
    >>> tell = {(("a", True),): 0.8, (("a", False),): 0.2}
    >>> known = [Conditional("b", on, Degree(p, p)) for on, p in tell.items()]
    >>> pair = Component(("a", "b"), degrees, conditionals=tuple(known))
    >>> found = network(pair, ["b"])
    >>> found.cases, found.weights
    ([{'b': True}, {'b': False}], [[50, 50]])
    """
    everything = component.parents
    if everything is None or 2 ** len(needed) > CASES:
        return None
    corners = _corners(component, _ancestry(everything, needed))
    if corners is None:
        return None
    found = [_joint(tables, tuple(needed)) for tables in corners]
    cases = list(product((True, False), repeat=len(needed)))
    weights = [[joint[case] for case in cases] for joint in found if joint is not None]
    if len(weights) < len(found):
        return None
    return Network([dict(zip(needed, case, strict=True)) for case in cases], weights)


def conjunction(component: Component, truth: Truth, given: Truth) -> Degree | None:
    """How probable it is that some atoms of a network are so, and others not.

    None where it is no network, or where too much of it is known in intervals only.
    Raises `ImpossibleError` where what is given cannot be.
    """
    everything = component.parents
    if everything is None:
        return None
    if any(given.get(atom, so) != so for atom, so in truth.items()):
        return REFUTED
    both = {**given, **truth}
    parents = _ancestry(everything, both)
    if not given and len(parents) == len(truth):
        return _product(component, parents, truth)
    corners = _corners(component, parents)
    found = []
    for tables in corners or ():
        mine = _joint([_fix_values(table, both) for table in tables], ())
        whole = _weight_of(tables, given)
        if mine is None or whole is None:
            return None
        if whole > 0:
            found.append(Fraction(mine[()], whole))
    if corners is not None and not found:
        raise ImpossibleError
    return order_ends(float(min(found)), float(max(found))) if found else None


def _weight_of(tables: list[Table], given: Truth) -> int | None:
    """The weight of all cases in which something is so; None for too wide tables."""
    if not given:
        return prod([_unit(weights) for _, weights in tables])
    joint = _joint([_fix_values(table, given) for table in tables], ())
    return None if joint is None else joint[()]


def _unit(weights: Mapping[Case, int]) -> int:
    """What the weights of an atom come to, whatever its parents are."""
    (_, *on), weight = next(iter(weights.items()))
    return weight + weights[False, *on]


def _product(component: Component, parents: Parents, truth: Truth) -> Degree:
    """The chain rule, where each atom comes with all that it depends on."""
    lo = hi = 1.0
    for atom, on in parents.items():
        p = _degree(component, parents, (atom, tuple([truth[one] for one in on])))
        p = p if truth[atom] else degree_of_negation(p)
        lo, hi = lo * p.lo, hi * p.hi
    return order_ends(lo, hi)


def _corners(component: Component, parents: Parents) -> Iterator[list[Table]] | None:
    """The tables of a network at the ends of all intervals; None if they are many."""
    rows = {row: _degree(component, parents, row) for row in _rows(parents)}
    counts, unit = scale_to_integers([x for p in rows.values() for x in p])
    ends = dict(zip(rows, zip(counts[::2], counts[1::2], strict=True), strict=True))
    wide = [row for row, (lo, hi) in ends.items() if lo < hi]
    if 2 ** len(wide) * len(parents) > EFFORT:
        return None
    corners = product(*[ends[row] for row in wide])
    lowest = {row: lo for row, (lo, _) in ends.items()}
    return (
        _tables(parents, lowest | dict(zip(wide, corner, strict=True)), unit)
        for corner in corners
    )


def _ancestry(parents: Parents, needed: Iterable[Hashable]) -> Parents:
    """The part of a network that bears on some atoms, parents before their children."""
    wanted, waiting = set(needed), list(needed)
    while waiting:
        for parent in parents[waiting.pop()]:
            if parent not in wanted:
                wanted.add(parent)
                waiting.append(parent)
    return {atom: on for atom, on in parents.items() if atom in wanted}


def _rows(parents: Parents) -> Iterator[Row]:
    for atom, on in parents.items():
        for case in product((True, False), repeat=len(on)):
            spend()
            yield atom, case


def _degree(component: Component, parents: Parents, row: Row) -> Degree:
    """How probable an atom is where its parents are so; unknown if nothing says it."""
    atom, case = row
    truth = dict(zip(parents[atom], case, strict=True))
    mine = [one for one in component.conditionals if one.target == atom]
    if not mine:
        return component.degrees[atom]
    found = [one.p for one in mine if one.applies(truth)]
    return found[-1] if found else UNKNOWN


def _tables(parents: Parents, chosen: Mapping[Row, int], unit: int) -> list[Table]:
    """For each atom the weights of it and its parents."""
    found: list[Table] = []
    for atom, on in parents.items():
        weights: dict[Case, int] = {}
        for case in product((True, False), repeat=len(on)):
            spend(3 + len(on) // 4)
            weights[True, *case] = chosen[atom, case]
            weights[False, *case] = unit - chosen[atom, case]
        found.append(((atom, *on), weights))
    return found


def _fix_values(table: Table, truth: Truth) -> Table:
    """The part of a table in which some atoms are so, or not; they are left out."""
    names, weights = table
    spend(len(weights))
    kept = [number for number, name in enumerate(names) if name not in truth]
    found = {
        tuple([case[number] for number in kept]): weight
        for case, weight in weights.items()
        if all(truth.get(n, so) == so for n, so in zip(names, case, strict=True))
    }
    return tuple([names[number] for number in kept]), found


def _joint(tables: list[Table], needed: tuple[Hashable, ...]) -> dict[Case, int] | None:
    """The weights of all cases of some atoms, the others summed out one by one.

    The one that stands with the fewest others is next.
    """
    around = _neighbours(tables)
    others = [atom for atom in around if atom not in needed]
    while others:
        atom = min(others, key=lambda one: len(around[one]))
        if len(around[atom]) > WIDTH:
            return None
        others.remove(atom)
        names = tuple([one for one in around.pop(atom) if one != atom])
        for one in names:
            del around[one][atom]
            around[one].update(dict.fromkeys(names))
        mine = [table for table in tables if atom in table[0]]
        tables = [table for table in tables if atom not in table[0]]
        tables.append((names, _multiply(mine, names, (atom,))))
    return _multiply(tables, needed, ())


def _neighbours(tables: Iterable[Table]) -> dict[Hashable, dict[Hashable, None]]:
    """For each atom those that it stands in a table with, itself too."""
    found: dict[Hashable, dict[Hashable, None]] = {}
    for names, _ in tables:
        for name in names:
            found.setdefault(name, {}).update(dict.fromkeys(names))
    return found


def _multiply(
    tables: Sequence[Table], names: tuple[Hashable, ...], out: tuple[Hashable, ...]
) -> dict[Case, int]:
    """The product of tables as one for some atoms, summed over the cases of others."""
    found: dict[Case, int] = {}
    for case in product((True, False), repeat=len(names)):
        total = 0
        for rest in product((True, False), repeat=len(out)):
            spend(1 + len(tables))
            truth = dict(zip((*names, *out), (*case, *rest), strict=True))
            total += prod(
                [
                    weights[tuple([truth[a] for a in inside])]
                    for inside, weights in tables
                ]
            )
        found[case] = total
    return found
