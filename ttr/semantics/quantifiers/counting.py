"""The probability that enough of P are Q, where some of it is uncertain.

Each thing that may be of P adds to a score: so much where it is Q, so much where it is
not. The chance that the score is reached is worked out one thing after the other
(the recursion of the Poisson-binomial distribution), so it is exact where the things do
not depend on each other. Beyond `EXACT` uncertain things it is bounded.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from ttr.probability import CERTAIN, REFUTED, Degree
from ttr.probability.degrees import degree_of_negation, independent_conjunction
from ttr.semantics.quantifiers.thresholds import Threshold

EXACT = 500
"""The number of uncertain things that are counted exactly."""


@dataclass(frozen=True)
class Chances:
    """The probabilities that one thing is P, P and Q, and P but not Q."""

    first: Degree
    both: Degree
    only: Degree


def independent_chances(p: Degree, q: Degree) -> Chances:
    """The chances of a thing that is P with one degree and Q with another, apart.

    >>> found = independent_chances(Degree(0.5, 0.5), Degree(0.5, 1.0))
    >>> print(found.first, found.both, found.only)
    0.5 [0.25, 0.5] [0, 0.25]
    """
    only = independent_conjunction(p, degree_of_negation(q))
    return Chances(p, independent_conjunction(p, q), only)


def chance_of(
    thresholds: Sequence[Threshold], sure: tuple[int, int], open_: Sequence[Chances]
) -> Degree:
    """How probably k of n meet all thresholds; `sure` are the certain k and n - k.

    >>> from ttr.semantics.quantifiers.thresholds import number
    >>> half = independent_chances(Degree(0.5, 0.5), CERTAIN)
    >>> print(chance_of([number("at least", 2)], (1, 0), [half, half]))
    0.75
    """
    found = [_chance(one, sure, open_) for one in thresholds]
    if any(p == REFUTED for p in found):
        return REFUTED
    if all(p == CERTAIN for p in found):
        return CERTAIN
    if len(found) == 1:
        return found[0]
    # A rising and a falling threshold on one count: all that is below the first one is
    # out, and all that is above the second, so what is left is the rest.
    lo = sum(p.lo for p in found) - (len(found) - 1)
    hi = sum(p.hi for p in found) - (len(found) - 1)
    return Degree(min(max(lo, 0.0), 1.0), min(max(hi, 0.0), min(p.hi for p in found)))


def _chance(
    threshold: Threshold, sure: tuple[int, int], open_: Sequence[Chances]
) -> Degree:
    inside, outside = threshold.weights
    base = sure[0] * inside + sure[1] * outside
    need = threshold.least_score - base
    low = [(one.both.lo, one.only.hi) for one in open_]
    high = [(one.both.hi, one.only.lo) for one in open_]
    reached = _decide(need, inside, outside, low, high)
    if reached is None:
        lo = _chance_of_reaching(need, inside, outside, low)[0]
        hi = _chance_of_reaching(need, inside, outside, high)[1]
        reached = _uncertain(min(lo, hi), hi)
    rising = threshold.is_lower_bound
    p = reached if rising else degree_of_negation(reached)
    if not threshold.presupposes or sure != (0, 0):
        return p
    # If there is nothing of P, it is neither true nor false.
    nothing = math.prod(1.0 - one.first.lo for one in open_)
    met = threshold.is_met_by(0, 0)
    lo, hi = (p.lo - nothing, p.hi) if met else (p.lo, p.hi + nothing)
    return Degree(max(lo, 0.0), min(hi, 1.0))


def _uncertain(lo: float, hi: float) -> Degree:
    """The interval, which rounding must not make certain or refuted."""
    below, above = math.nextafter(1.0, 0.0), math.nextafter(0.0, 1.0)
    if lo == hi:
        within = min(max(lo, above), below)
        return Degree(within, within)
    return Degree(min(lo, below), max(hi, above))


Steps = Sequence[tuple[float, float]]
"""How probably each thing adds to the score, and how probably it takes away."""


def _decide(
    need: int, inside: int, outside: int, low: Steps, high: Steps
) -> Degree | None:
    """The answer if it is the same whatever the uncertain things are; else None."""
    most = sum(inside if one[0] > 0.0 else 0 for one in high)
    least = sum(outside if one[1] > 0.0 else 0 for one in low)
    least += sum(inside for one in low if one[0] == 1.0)
    if need <= least:
        return CERTAIN
    return REFUTED if need > most else None


def _chance_of_reaching(
    need: int, inside: int, outside: int, steps: Steps
) -> tuple[float, float]:
    """Lower and upper chance that the sum of the steps is at least `need`."""
    if len(steps) > EXACT:
        return _hoeffding_bounds(need, inside, outside, steps)
    span = len(steps)
    least = outside * span
    sums = [0.0] * ((inside - outside) * span + 1)
    sums[-least] = 1.0
    first = last = -least
    for add, take in steps:
        stay = max(0.0, 1.0 - add - take)
        new = [0.0] * len(sums)
        for at in range(first, last + 1):
            weight = sums[at]
            new[at] += weight * stay
            new[at + inside] += weight * add
            new[at + outside] += weight * take
        sums, first, last = new, first + outside, last + inside
    found = min(1.0, math.fsum(sums[max(need - least, 0) :]))
    return found, found


def _hoeffding_bounds(
    need: int, inside: int, outside: int, steps: Steps
) -> tuple[float, float]:
    """Hoeffding's bounds (1963) on a sum of many independent steps."""
    mean = math.fsum(inside * add + outside * take for add, take in steps)
    beyond = need - mean
    tail = math.exp(-2.0 * beyond**2 / (len(steps) * (inside - outside) ** 2))
    return (0.0, tail) if beyond > 0 else (1.0 - tail, 1.0)
