"""The probability of an event whose atoms are independent of one another."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Hashable, Mapping
from itertools import product

from ttr.probability.degrees import (
    CERTAIN,
    REFUTED,
    Degree,
    degree_of_negation,
    frechet_conjunction,
    frechet_disjunction,
    independent_conjunction,
    independent_disjunction,
    order_ends,
)
from ttr.probability.events import All, AnyOf, Atomic, Event, Not, atoms, signs
from ttr.safety.budgets import spend

SHARED = 10
"""The number of atoms that may occur more than once for an exact probability."""


def _shared_atoms(event: Event) -> list[Hashable]:
    """The atoms that occur more than once, in the order in which they do."""
    times = Counter(one.atom for one in atoms(event))
    return [atom for atom, count in times.items() if count > 1]


def sum_over_cases(event: Event) -> Degree | None:
    """The sum over the cases of the shared atoms, at the corners of their intervals.

    An event rises with an atom that it is only for, so a corner is enough there; with
    one it is for and against, it may be lowest or highest at either end. None where
    more than `SHARED` atoms are shared.

    >>> a, b = Atomic("a", Degree(0.4, 0.4)), Atomic("b", Degree(0.5, 1))
    >>> print(sum_over_cases(AnyOf((a, b))), sum_over_cases(All((a, Not(a)))))
    [0.7, 1] 0
    """
    names = _shared_atoms(event)
    if not names:
        return order_ends(*_separate(event, {}))
    degrees = {one.atom: one.p for one in atoms(event)}
    rising: dict[Hashable, set[bool]] = {}
    for one, sign in signs(event):
        rising.setdefault(one.atom, set()).add(sign)
    mixed = [a for a in names if len(rising[a]) > 1 and degrees[a].lo < degrees[a].hi]
    if len(names) + len(mixed) > SHARED:
        return None
    lows, highs = [], []
    for corner in product(*[degrees[atom] for atom in mixed]):
        fixed = dict(zip(mixed, corner, strict=True))
        low = {a: fixed.get(a, degrees[a][False in rising[a]]) for a in names}
        high = {a: fixed.get(a, degrees[a][True in rising[a]]) for a in names}
        lows.append(_weigh(event, low)[0])
        highs.append(_weigh(event, high)[1])
    return order_ends(min(lows), max(highs))


def _weigh(event: Event, p: Mapping[Hashable, float]) -> tuple[float, float]:
    """Lower and upper probability where the shared atoms have these probabilities."""
    lo = hi = 0.0
    for truth in product((True, False), repeat=len(p)):
        case = dict(zip(p, truth, strict=True))
        weight = math.prod(x if case[a] else 1.0 - x for a, x in p.items())
        if weight > 0.0:
            one = _separate(event, case)
            lo, hi = lo + weight * one.lo, hi + weight * one.hi
    return lo, hi


def _separate(event: Event, case: Mapping[Hashable, bool]) -> Degree:
    """The probability in a case where no other atom occurs twice."""
    spend()
    match event:
        case Atomic(atom, p):
            if atom in case:
                return CERTAIN if case[atom] else REFUTED
            return p
        case Not(part):
            return degree_of_negation(_separate(part, case))
        case All(parts):
            return independent_conjunction(*[_separate(it, case) for it in parts])
        case AnyOf(parts):
            return independent_disjunction(*[_separate(it, case) for it in parts])


def bounds(event: Event) -> Degree:
    """Bounds that hold for any dependence: Fréchet's, part by part.

    >>> a, b = Atomic("a", Degree(0.7, 0.7)), Atomic("b", Degree(0.8, 0.8))
    >>> print(bounds(All((a, b))))
    [0.5, 0.7]
    """
    spend()
    match event:
        case Atomic(_, p):
            return p
        case Not(part):
            return degree_of_negation(bounds(part))
        case All(parts):
            return frechet_conjunction(*[bounds(part) for part in parts])
        case AnyOf(parts):
            return frechet_disjunction(*[bounds(part) for part in parts])
