"""Linear programs in exact arithmetic: the least and the greatest share of worlds.

Weights v ≥ 0 of worlds are sought with g · v = 1 and r · v ≥ 0 for each row r, and
f · v least or greatest. Every claim about probabilities has this form, conditional ones
too (Charnes and Cooper 1962: f · v is then the share of f among the worlds of g). All
numbers are whole: degrees are counted in units of a power of ten.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from decimal import Decimal
from fractions import Fraction

from ttr.safety.budgets import spend

__all__ = ["Infeasible", "Row", "least", "units"]

Row = Sequence[int]


class Infeasible(Exception):
    """No weights are as the rows say."""


def units(numbers: Iterable[float]) -> tuple[list[int], int]:
    """The numbers as counts of a unit, and how many units one is.

    A float stands for its shortest decimal, so 0.1 is a tenth.

    >>> units([0.1, 0.25, 1.0])
    ([10, 25, 100], 100)
    """
    decimals = [Decimal(repr(float(x))).as_tuple() for x in numbers]
    places = max((-int(d.exponent) for d in decimals), default=0)
    counts = [
        int("".join(map(str, d.digits))) * 10 ** (places + int(d.exponent))
        for d in decimals
    ]
    return counts, 10**places


def least(f: Row, g: Row, rows: Sequence[Row]) -> Fraction:
    """The least f · v where v ≥ 0, g · v = 1 and r · v ≥ 0 for each row r.

    Raises `Infeasible` where there is no such v. f must be bounded on them.

    >>> least([1, 0], [1, 1], [[3, -1]])
    Fraction(1, 4)
    """
    table = _Table(f, g, rows)
    table.minimise(table.missing)
    if table.missing[-1] != 0:
        raise Infeasible
    table.minimise(table.cost)
    return Fraction(-table.cost[-1], table.divisor)


class _Table:
    """A simplex tableau of integers over one divisor (Edmonds 1967, Bareiss 1968).

    Columns are worlds, the slack of each row, what is missing of g · v = 1, and the
    right-hand side, which is 0 but for g · v: so as long as something is missing of it,
    that is more than nothing, and afterwards it is no longer in the basis. Bland's rule
    keeps it from going round in circles.
    """

    def __init__(self, f: Row, g: Row, rows: Sequence[Row]) -> None:
        self.width = len(f)
        slacks = len(rows)
        self.divisor = 1
        self.rows = []
        for number, row in enumerate(rows):
            slack = [int(one == number) for one in range(slacks)]
            self.rows.append([-x for x in row] + [*slack, 0, 0])
        self.rows.append([*g, *[0] * slacks, 1, 1])
        self.cost = [*f, *[0] * (slacks + 2)]
        self.missing = [-x for x in g] + [*[0] * (slacks + 1), -1]
        self.basis = [self.width + number for number in range(slacks + 1)]
        self.columns = self.width + slacks

    def minimise(self, cost: list[int]) -> None:
        """Pivots until no column makes the cost less.

        The column that does so fastest is taken, but the first after a step that got
        nowhere: else there might be no end.
        """
        stuck = False
        while True:
            falling = [j for j in range(self.columns) if cost[j] < 0]
            if not falling:
                return
            column = falling[0] if stuck else min(falling, key=cost.__getitem__)
            number = self._leaving(column)
            stuck = self.rows[number][-1] == 0
            self._pivot(number, column)

    def _leaving(self, column: int) -> int:
        """The row whose basic column is the first to get to 0."""
        best = -1
        for number, row in enumerate(self.rows):
            if row[column] <= 0:
                continue
            if best < 0 or self._sooner(number, best, column):
                best = number
        return best

    def _sooner(self, one: int, other: int, column: int) -> bool:
        mine, theirs = self.rows[one], self.rows[other]
        left, right = mine[-1] * theirs[column], theirs[-1] * mine[column]
        return left < right or (left == right and self.basis[one] < self.basis[other])

    def _pivot(self, number: int, column: int) -> None:
        spend(1 + len(self.rows) * len(self.cost) // 8)
        row = self.rows[number]
        by, old = row[column], self.divisor
        others = [one for i, one in enumerate(self.rows) if i != number]
        for one in (*others, self.cost, self.missing):
            factor = one[column]
            if factor or by != old:
                one[:] = [
                    (x * by - factor * y) // old for x, y in zip(one, row, strict=True)
                ]
        self.basis[number] = column
        self.divisor = by
