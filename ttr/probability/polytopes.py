"""Polytopes: all the distributions over the worlds of a component that fit its degrees.

A world makes each atom true or false, in line with what entails and excludes what. The
probabilities of the worlds form a polytope, and the bounds of the probability of an
event are linear programs over it (Hailperin 1965).
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Sequence
from dataclasses import dataclass

from ttr.probability.degrees import Degree, order_ends
from ttr.probability.dependence import Component
from ttr.probability.events import Event, Truth, meets
from ttr.probability.linear_programs import (
    InfeasibleError,
    Row,
    feasible_point,
    minimise,
    scale_to_integers,
)
from ttr.probability.networks import ImpossibleError
from ttr.safety.budgets import spend

_WORLDS = 64
"""The most worlds that a polytope has."""

_ATOMS = 33
"""The most atoms that its worlds are about."""


@dataclass(frozen=True)
class Polytope:
    """The worlds of a component, or of some of its atoms; then bounds are not exact."""

    component: Component
    cases: Sequence[Truth]
    exact: bool

    def share(
        self, worth: Sequence[Degree], given: Truth, others: Sequence[Event] = ()
    ) -> Degree:
        """The bounds of p(E | given), where `worth` has p(E | world) for each world.

        The other events are given, too. Raises `ImpossibleError` where what is given
        cannot be, and `InfeasibleError` where the degrees of the component contradict
        one another.
        """
        inside = [int(meets(case, given, others)) for case in self.cases]
        rows = list(_rows(self.component, self.cases))
        ends, unit = scale_to_integers([x for p in worth for x in p])
        low = [x * one for x, one in zip(ends[::2], inside, strict=True)]
        high = [-x * one for x, one in zip(ends[1::2], inside, strict=True)]
        try:
            lo = minimise(low, inside, rows)
        except InfeasibleError:
            if all(inside) or not self.feasible():
                raise
            raise ImpossibleError from None
        hi = -minimise(high, inside, rows)
        return order_ends(float(lo / unit), float(hi / unit))

    def feasible(self) -> bool:
        """Does some distribution over the worlds fit all degrees?"""
        count = len(self.cases)
        try:
            rows = list(_rows(self.component, self.cases))
            feasible_point([1] * count, rows)
        except InfeasibleError:
            return False
        return True


def feasible(component: Component, atom: Hashable) -> bool:
    """Can the degrees of a component all be right, as far as can be checked?

    Those of a network always can. Those of an order can if any two of them can, which
    has been checked before. Of a large component only what is close to the atom is
    looked at.

    >>> most = Degree(0.6, 0.6)
    >>> apart = (("a", "b"),)
    >>> feasible(Component(("a", "b"), {"a": most, "b": most}, exclusive=apart), "a")
    False
    """
    if component.parents is not None or component.is_order:
        return True
    found = polytope(component, (atom,))
    return found is None or found.feasible()


def polytope(component: Component, needed: Sequence[Hashable]) -> Polytope | None:
    """The worlds of the atoms needed, and of atoms close to them while there is room.

    None where the atoms needed have too many worlds.

    >>> half = Degree(0.5, 0.5)
    >>> pair = Component(("a", "b"), {"a": half, "b": half}, entailed=(("a", "b"),))
    >>> [list(case.values()) for case in polytope(pair, ["a"]).cases]
    [[True, True], [False, True], [False, False]]
    """
    cases: list[dict[Hashable, bool]] = [{}]
    kept: list[Hashable] = []
    for atom in component.closest(needed):
        more = list(_extend(component, cases, atom)) if len(kept) < _ATOMS else None
        if more is not None and len(more) <= _WORLDS:
            cases = more
            kept.append(atom)
        elif atom in needed:
            return None
    some = len(kept) < len(component.atoms)
    inside = component.restrict(kept) if some else component
    return Polytope(inside, list(cases), inside.whole and component.parents is None)


def _extend(
    component: Component, cases: Sequence[dict[Hashable, bool]], atom: Hashable
) -> Iterator[dict[Hashable, bool]]:
    """The worlds with one more atom made true or false."""
    p = component.degrees[atom]
    choices = [so for so in (True, False) if (p.hi > 0.0 if so else p.lo < 1.0)]
    for case in cases:
        for so in choices:
            world = {**case, atom: so}
            if _is_allowed(component, world, atom):
                yield world


def _is_allowed(component: Component, world: Truth, new: Hashable) -> bool:
    """Does every atom hold with all that it entails, and with none that it excludes?"""
    spend()
    for lower, upper in component.entailed:
        if new in (lower, upper) and world.get(lower) and world.get(upper) is False:
            return False
    return not any(
        world.get(one) and world.get(other)
        for one, other in component.exclusive
        if new in (one, other)
    )


def _rows(component: Component, known: Sequence[Truth]) -> Iterator[Row]:
    """The degrees and conditionals, as rows r with r · v ≥ 0 for the weights v."""
    for atom in component.atoms:
        holds = [int(world[atom]) for world in known]
        yield from _between(component.degrees[atom], holds, [1] * len(known))
    for one in component.conditionals:
        applies = [int(one.applies(world)) for world in known]
        holds = [int(world[one.target]) for world in known]
        both = [x * y for x, y in zip(holds, applies, strict=True)]
        yield from _between(one.p, both, applies)


def _between(p: Degree, part: Sequence[int], whole: Sequence[int]) -> Iterator[Row]:
    """The rows for: the part is between p.lo and p.hi of the whole."""
    (lo, hi), unit = scale_to_integers(p)
    if lo > 0:
        yield [unit * x - lo * y for x, y in zip(part, whole, strict=True)]
    if hi < unit:
        yield [hi * y - unit * x for x, y in zip(part, whole, strict=True)]
