"""The worlds of a component, and the shares that they can have.

A world says of each atom of a component whether it is so, in line with what entails and
excludes what. Where conditionals are all that links the atoms, they are a network: each
atom is independent of those before it given its parents (Pearl 1988; with intervals, a
credal network, Cozman 2000). Elsewhere any shares will do that agree with all degrees.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import product

from ttr.probability.degrees import UNKNOWN, Degree, ordered
from ttr.probability.dependence import Component
from ttr.probability.events import Truth
from ttr.probability.programs import Infeasible, Row, least, units

__all__ = ["Impossible", "feasible", "share", "worlds"]

WORLDS = 256
"""How many worlds a component may have for a probability to be exact."""

CORNERS = 10
"""How many intervals a network may have for a probability to be exact."""


class Impossible(Exception):
    """A condition surely is not met."""


def worlds(component: Component) -> list[Truth] | None:
    """The worlds of a component; None where they are more than `WORLDS`.

    >>> half = Degree(0.5, 0.5)
    >>> pair = Component(("a", "b"), {"a": half, "b": half}, entailed=(("a", "b"),))
    >>> [list(world.values()) for world in worlds(pair)]
    [[True, True], [False, True], [False, False]]
    """
    found: list[dict[Hashable, bool]] = [{}]
    for atom in component.atoms:
        p = component.degrees[atom]
        choices = [so for so in (True, False) if (p.hi > 0.0 if so else p.lo < 1.0)]
        extended = [{**world, atom: so} for world in found for so in choices]
        found = [world for world in extended if _allowed(component, world, atom)]
        if len(found) > WORLDS:
            return None
    return list(found)


def _allowed(component: Component, world: Truth, new: Hashable) -> bool:
    """Whether nothing is so without what it entails, or with what it excludes."""
    for lower, upper in component.entailed:
        if new in (lower, upper) and world.get(lower) and world.get(upper) is False:
            return False
    return not any(
        world.get(one) and world.get(other)
        for one, other in component.exclusive
        if new in (one, other)
    )


def share(
    component: Component,
    known: Sequence[Truth],
    worth: Sequence[Degree],
    given: Truth,
) -> Degree:
    """How probable an event is in a component, of which it has a worth in each world.

    `given` is what is so for sure. Raises `Impossible` where that cannot be, and
    `Infeasible` where the degrees of the component contradict one another.
    """
    inside = [all(world[a] == so for a, so in given.items()) for world in known]
    parents = component.parents()
    if parents is not None:
        found = _in_network(component, parents, known, worth, inside)
        if found is not None:
            return found
    return _of_any(component, known, worth, inside)


# --- any shares that agree with the degrees ---


def feasible(component: Component) -> bool:
    """Whether some shares of the worlds agree with all degrees of a component.

    >>> half = Degree(0.6, 0.6)
    >>> feasible(Component(("a", "b"), {"a": half, "b": half}, exclusive=(("a", "b"),)))
    False
    """
    known = worlds(component)
    if known is None:
        return True
    try:
        least([0] * len(known), [1] * len(known), list(_rows(component, known)))
    except Infeasible:
        return False
    return True


def _of_any(
    component: Component,
    known: Sequence[Truth],
    worth: Sequence[Degree],
    inside: Sequence[bool],
) -> Degree:
    rows = list(_rows(component, known))
    condition = [int(one) for one in inside]
    ends, unit = units([*[p.lo for p in worth], *[p.hi for p in worth]])
    low = [x * one for x, one in zip(ends, condition, strict=False)]
    high = [-x * one for x, one in zip(ends[len(worth) :], condition, strict=True)]
    try:
        lo = least(low, condition, rows)
    except Infeasible:
        if all(inside) or not feasible(component):
            raise
        raise Impossible from None
    hi = -least(high, condition, rows)
    return ordered(float(lo / unit), float(hi / unit))


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


# --- networks ---

Key = tuple[Hashable, tuple[bool, ...]]
"""An atom, and whether its parents are so."""


def _in_network(
    component: Component,
    parents: Mapping[Hashable, tuple[Hashable, ...]],
    known: Sequence[Truth],
    worth: Sequence[Degree],
    inside: Sequence[bool],
) -> Degree | None:
    """The least and the greatest at the corners of the intervals; None if too many.

    A share is a product with one factor for each atom, so that what is sought is, as a
    function of one factor, a quotient of two straight lines: it is least at an end.
    """
    table = {
        key: _factor(component, *key, parents[key[0]])
        for world in known
        for key in _keys(world, parents)
    }
    wide = [key for key, p in table.items() if p.lo < p.hi]
    if len(wide) > CORNERS:
        return None
    counts, unit = units([x for p in (*table.values(), *worth) for x in p])
    ends = list(zip(counts[::2], counts[1::2], strict=True))
    factors = dict(zip(table, ends, strict=False))
    worths = ends[len(table) :]
    lows, highs = [], []
    for corner in product(*[factors[key] for key in wide]):
        chosen = {key: lo for key, (lo, _) in factors.items()}
        chosen.update(zip(wide, corner, strict=True))
        weights = [
            _weight(world, parents, chosen, unit) if one else 0
            for world, one in zip(known, inside, strict=True)
        ]
        whole = sum(weights) * unit
        if whole > 0:
            pairs = list(zip(weights, worths, strict=True))
            lows.append(Fraction(sum(w * lo for w, (lo, _) in pairs), whole))
            highs.append(Fraction(sum(w * hi for w, (_, hi) in pairs), whole))
    if not lows:
        raise Impossible
    return ordered(float(min(lows)), float(max(highs)))


def _keys(
    world: Truth, parents: Mapping[Hashable, tuple[Hashable, ...]]
) -> Iterator[Key]:
    for atom, on in parents.items():
        yield atom, tuple([world[parent] for parent in on])


def _factor(
    component: Component,
    atom: Hashable,
    case: tuple[bool, ...],
    on: tuple[Hashable, ...],
) -> Degree:
    """How probable an atom is where its parents are so; unknown if nothing says it."""
    truth = dict(zip(on, case, strict=True))
    mine = [one for one in component.conditionals if one.target == atom]
    if not mine:
        return component.degrees[atom]
    found = [one.p for one in mine if one.applies(truth)]
    return found[-1] if found else UNKNOWN


def _weight(
    world: Truth,
    parents: Mapping[Hashable, tuple[Hashable, ...]],
    chosen: Mapping[Key, int],
    unit: int,
) -> int:
    """The share of a world, in units to the power of the number of atoms."""
    return math.prod(
        [
            chosen[key] if world[key[0]] else unit - chosen[key]
            for key in _keys(world, parents)
        ]
    )
