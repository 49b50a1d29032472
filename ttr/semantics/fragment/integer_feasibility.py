"""Do linear demands have a solution in integers that are not negative?

Each demand is Σ wᵢ·xᵢ ≥ b. A linear program gives a rational solution; where a number
in it is not whole, the search branches on it (Land and Doig 1960).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import floor, gcd
from typing import TypeAlias

from ttr.probability.linear_programs import InfeasibleError, feasible_point

Demand: TypeAlias = tuple[Sequence[int], int]
"""The weights w, and the bound b."""

_NODES = 40
"""How many linear programs are solved before giving up."""


class UndecidedError(Exception):
    """The search was given up before there was an answer."""


def integer_solution(demands: Sequence[Demand], size: int) -> tuple[int, ...] | None:
    """Integers x₁ … xₙ ≥ 0 that meet all demands, or None where there are none.

    Raises `UndecidedError` where this takes too many branches.

    >>> integer_solution([((1, 1), 3), ((-2, -2), -7)], 2)
    (3, 0)
    >>> integer_solution([((2, -2), 1), ((-2, 2), -1)], 2) is None
    True
    """
    waiting: list[list[Demand]] = [[_tighten(one) for one in demands]]
    for _ in range(_NODES):
        if not waiting:
            return None
        some = waiting.pop()
        found = _rational_solution(some, size)
        if found is None:
            continue
        split = next((i for i, x in enumerate(found) if x.denominator != 1), None)
        if split is None:
            return tuple(int(x) for x in found)
        low = floor(found[split])
        unit = tuple(int(i == split) for i in range(size))
        at_most = (tuple(-u for u in unit), -low)
        waiting += [[*some, (unit, low + 1)], [*some, at_most]]
    raise UndecidedError


def _tighten(demand: Demand) -> Demand:
    """The same demand on integers, divided: 2x - 2y ≥ 1 is x - y ≥ 1."""
    weights, bound = demand
    by = gcd(*weights)
    if by < 2:
        return demand
    return tuple(w // by for w in weights), -(-bound // by)


def _rational_solution(
    demands: Sequence[Demand], size: int
) -> tuple[Fraction, ...] | None:
    """Rational numbers that meet the demands, or None where there are none."""
    one = [*[0] * size, 1]
    rows = [[*weights, -bound] for weights, bound in demands]
    try:
        return feasible_point(one, rows)[:size]
    except InfeasibleError:
        return None
