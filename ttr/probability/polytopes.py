"""Polytopes: components of which any distribution will do that agrees with the degrees.

A world says of each atom whether it is so, in line with what entails and excludes what.
The shares that the worlds can have are a polytope, and the least and the greatest share
of an event among them a linear program (Hailperin 1965).
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Sequence
from dataclasses import dataclass

from ttr.probability.degrees import Degree, ordered
from ttr.probability.dependence import Component
from ttr.probability.events import Truth
from ttr.probability.networks import Impossible
from ttr.probability.programs import Infeasible, Row, least, units
from ttr.safety.budgets import spend

__all__ = ["Polytope", "feasible", "polytope"]

WORLDS = 64
"""How many worlds are told apart."""

ATOMS = 33
"""Of how many atoms."""


@dataclass(frozen=True)
class Polytope:
    """The worlds of a component, or of some of its atoms: then it is not exact."""

    component: Component
    cases: Sequence[Truth]
    exact: bool

    def share(self, worth: Sequence[Degree], given: Truth) -> Degree:
        """How probable an event is of which we have the worth in each world.

        `given` is what is so for sure. Raises `Impossible` where that cannot be, and
        `Infeasible` where the degrees of the component contradict one another.
        """
        inside = [
            int(all(case[a] == so for a, so in given.items())) for case in self.cases
        ]
        rows = list(_rows(self.component, self.cases))
        ends, unit = units([x for p in worth for x in p])
        low = [x * one for x, one in zip(ends[::2], inside, strict=True)]
        high = [-x * one for x, one in zip(ends[1::2], inside, strict=True)]
        try:
            lo = least(low, inside, rows)
        except Infeasible:
            if all(inside) or not self.feasible():
                raise
            raise Impossible from None
        hi = -least(high, inside, rows)
        return ordered(float(lo / unit), float(hi / unit))

    def feasible(self) -> bool:
        """Whether some shares of the worlds agree with all degrees."""
        count = len(self.cases)
        try:
            least([0] * count, [1] * count, list(_rows(self.component, self.cases)))
        except Infeasible:
            return False
        return True


def feasible(component: Component, atom: Hashable) -> bool:
    """Whether the degrees of a component go together, as far as can be told.

    Those of a network always do, and those of an order if any two do, which is seen
    before. Where it is large, what is close to an atom is looked at.

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
    """The worlds of some atoms, and of what is close to them if there is room.

    None where there are too many.

    >>> half = Degree(0.5, 0.5)
    >>> pair = Component(("a", "b"), {"a": half, "b": half}, entailed=(("a", "b"),))
    >>> [list(case.values()) for case in polytope(pair, ["a"]).cases]
    [[True, True], [False, True], [False, False]]
    """
    cases: list[dict[Hashable, bool]] = [{}]
    kept: list[Hashable] = []
    for atom in component.closest(needed):
        more = list(_extended(component, cases, atom)) if len(kept) < ATOMS else None
        if more is not None and len(more) <= WORLDS:
            cases = more
            kept.append(atom)
        elif atom in needed:
            return None
    some = len(kept) < len(component.atoms)
    inside = component.restricted(kept) if some else component
    return Polytope(inside, list(cases), inside.whole and component.parents is None)


def _extended(
    component: Component, cases: Sequence[dict[Hashable, bool]], atom: Hashable
) -> Iterator[dict[Hashable, bool]]:
    """The worlds with one atom more."""
    p = component.degrees[atom]
    choices = [so for so in (True, False) if (p.hi > 0.0 if so else p.lo < 1.0)]
    for case in cases:
        for so in choices:
            world = {**case, atom: so}
            if _allowed(component, world, atom):
                yield world


def _allowed(component: Component, world: Truth, new: Hashable) -> bool:
    """Whether nothing is so without what it entails, or with what it excludes."""
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
    """What is known of the shares of the worlds, each as a row r with r · v ≥ 0."""
    for atom in component.atoms:
        holds = [int(world[atom]) for world in known]
        yield from _between(component.degrees[atom], holds, [1] * len(known))
    for one in component.conditionals:
        applies = [int(one.applies(world)) for world in known]
        holds = [int(world[one.target]) for world in known]
        both = [x * y for x, y in zip(holds, applies, strict=True)]
        yield from _between(one.p, both, applies)


def _between(p: Degree, part: Sequence[int], whole: Sequence[int]) -> Iterator[Row]:
    """That a part is between p.lo and p.hi of the whole."""
    (lo, hi), unit = units(p)
    if lo > 0:
        yield [unit * x - lo * y for x, y in zip(part, whole, strict=True)]
    if hi < unit:
        yield [hi * y - unit * x for x, y in zip(part, whole, strict=True)]
