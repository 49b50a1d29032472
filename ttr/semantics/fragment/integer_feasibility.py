"""Are there whole numbers, none below zero, that meet some linear demands?

Each demand is Σ wᵢ·xᵢ ≥ b. First over the rationals, exactly, by the simplex method
with Bland's rule, which ends; then by branching on a number that is not whole.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import floor, gcd

__all__ = ["Demand", "solution", "Undecidable"]

Demand = tuple[Sequence[int], int]
"""The weights of the numbers, and what their sum is at least."""

BRANCHES = 40
"""How many times is branched before giving up."""


class Undecidable(Exception):
    """It was not found out in so many steps."""


def solution(demands: Sequence[Demand], size: int) -> tuple[int, ...] | None:
    """Numbers that meet all demands, or None where there are none.

    >>> solution([((1, 1), 3), ((-2, -2), -7)], 2)
    (3, 0)
    >>> solution([((2, -2), 1), ((-2, 2), -1)], 2) is None
    True
    """
    waiting: list[list[Demand]] = [[_tight(one) for one in demands]]
    for _ in range(BRANCHES):
        if not waiting:
            return None
        some = waiting.pop()
        found = _rational(some, size)
        if found is None:
            continue
        broken = next((i for i, x in enumerate(found) if x.denominator != 1), None)
        if broken is None:
            return tuple(int(x) for x in found)
        low = floor(found[broken])
        unit = tuple(int(i == broken) for i in range(size))
        below = (tuple(-u for u in unit), -low)
        waiting += [[*some, (unit, low + 1)], [*some, below]]
    raise Undecidable


def _tight(demand: Demand) -> Demand:
    """The demand with smaller weights: 2x - 2y ≥ 1 is x - y ≥ 1, for whole numbers."""
    weights, bound = demand
    by = gcd(*weights)
    if by < 2:
        return demand
    return tuple(w // by for w in weights), -(-bound // by)


def _rational(demands: Sequence[Demand], size: int) -> list[Fraction] | None:
    """Rational numbers that meet the demands: the first phase of the simplex method."""
    rows, basis = _tableau(demands, size)
    if not rows:
        return [Fraction(0)] * size
    first = size + len(demands)
    if not _driven_out(rows, basis, range(first, len(rows[0]) - 1)):
        return None
    values = [Fraction(0)] * size
    for row, base in zip(rows, basis, strict=True):
        if base < size:
            values[base] = row[-1]
    return values


def _driven_out(
    rows: list[list[Fraction]], basis: list[int], artificial: range
) -> bool:
    """Whether the artificial numbers can all be zero; then they are, afterwards."""
    cost = [Fraction(0)] * len(rows[0])
    for row, base in zip(rows, basis, strict=True):
        if base in artificial:
            cost = [c - x for c, x in zip(cost, row, strict=True)]
    while True:
        entering = next((j for j in range(artificial.start) if cost[j] < 0), None)
        if entering is None:
            return cost[-1] == 0
        # Some row has something to give, as the cost cannot fall without end.
        _, _, leaving = min(
            (row[-1] / row[entering], base, i)
            for i, (row, base) in enumerate(zip(rows, basis, strict=True))
            if row[entering] > 0
        )
        cost = _pivot(rows, cost, leaving, entering)
        basis[leaving] = entering


def _tableau(
    demands: Sequence[Demand], size: int
) -> tuple[list[list[Fraction]], list[int]]:
    """The demands as equations with a surplus each, and where it takes it more."""
    count = len(demands)
    needy = [i for i, (_, bound) in enumerate(demands) if bound > 0]
    rows, basis = [], []
    for i, (weights, bound) in enumerate(demands):
        sign = 1 if bound > 0 else -1
        surplus = [-sign * int(i == j) for j in range(count)]
        extra = [int(i == j) for j in needy]
        row = [*(sign * w for w in weights), *surplus, *extra, sign * bound]
        rows.append([Fraction(x) for x in row])
        start = size + count
        basis.append(start + needy.index(i) if bound > 0 else size + i)
    return rows, basis


def _pivot(
    rows: list[list[Fraction]], cost: list[Fraction], leaving: int, entering: int
) -> list[Fraction]:
    """Brings a number into the basis in place of another; the new cost."""
    factor = rows[leaving][entering]
    pivot = rows[leaving] = [x / factor for x in rows[leaving]]
    for i, row in enumerate(rows):
        if i != leaving and row[entering] != 0:
            by = row[entering]
            rows[i] = [x - by * y for x, y in zip(row, pivot, strict=True)]
    by = cost[entering]
    return [x - by * y for x, y in zip(cost, pivot, strict=True)]
