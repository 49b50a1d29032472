"""Linear programs, solved exactly by the simplex method.

Minimise f · v over the v ≥ 0 with g · v = 1 and r · v ≥ 0 for each row r. All numbers
are integers. Two questions have this form:

- the bounds of a probability, also of a conditional one: v are weights of worlds, and
  f · v is the share of f among the worlds of g (Charnes and Cooper 1962);
- linear inequalities w · x ≥ b over x ≥ 0: v is x with one more number t, g picks t,
  and each row is (w, −b).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from math import lcm

from ttr.safety.budgets import spend

Row = Sequence[int]


class InfeasibleError(Exception):
    """No v meets the conditions of a linear program."""


def scale_to_integers(numbers: Iterable[float]) -> tuple[list[int], int]:
    """The numbers as integers over one unit, and that unit.

    A float stands for its shortest decimal, so 0.1 is a tenth; but where that has all
    the digits that a float can have, for the simple fraction that rounds to it.

    >>> scale_to_integers([0.1, 0.25, 1.0])
    ([2, 5, 20], 20)
    >>> scale_to_integers([1 / 3, 4 / 9])
    ([3, 4], 9)
    """
    fractions = [_fraction_of(float(x)) for x in numbers]
    unit = lcm(*[one.denominator for one in fractions])
    return [one.numerator * (unit // one.denominator) for one in fractions], unit


def _fraction_of(x: float) -> Fraction:
    decimal = Fraction(repr(x))
    if decimal.denominator > _EXACT:
        simple = decimal.limit_denominator(_SIMPLE)
        if float(simple) == x:
            return simple
    return decimal


_EXACT, _SIMPLE = 10**12, 10**6
"""Denominators: a decimal up to the first is meant as it is written, and a fraction up
to the second is simple. Two simple fractions do not round to one float."""


def minimise(f: Row, g: Row, rows: Sequence[Row]) -> Fraction:
    """The least f · v over the v ≥ 0 with g · v = 1 and r · v ≥ 0 for each row r.

    Raises `InfeasibleError` where there is no such v. f must be bounded below on them.

    >>> minimise([1, 0], [1, 1], [[3, -1]])
    Fraction(1, 4)
    """
    table = _Table(f, g, rows)
    table.make_feasible()
    table.minimise(table.cost)
    return Fraction(-table.cost[-1], table.divisor)


def feasible_point(g: Row, rows: Sequence[Row]) -> tuple[Fraction, ...]:
    """Some v ≥ 0 with g · v = 1 and r · v ≥ 0 for each row r; else `InfeasibleError`.

    >>> print(*feasible_point([1, 1], [[3, -1], [-2, 1]]))
    1/3 2/3
    """
    table = _Table([0] * len(g), g, rows)
    table.make_feasible()
    return table.point()


class _Table:
    """A simplex tableau of integers over one divisor (Edmonds 1967, Bareiss 1968).

    Its columns are the components of v, the slack of each row, what is missing of
    g · v = 1, and the right-hand side. The last is 0 in every row but that of g · v, so
    what is missing leaves the basis with the first step that gets anywhere.
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

    def make_feasible(self) -> None:
        """Pivot until nothing is missing of g · v = 1; raises `InfeasibleError`."""
        self.minimise(self.missing)
        if self.missing[-1] != 0:
            raise InfeasibleError

    def minimise(self, cost: list[int]) -> None:
        """Pivot until no column lowers the cost.

        The column that lowers it fastest enters the basis; but after a step that got
        nowhere, the first one does (Bland's rule), so that there is always an end.
        """
        stuck = False
        while True:
            falling = [j for j in range(self.columns) if cost[j] < 0]
            if not falling:
                return
            column = falling[0] if stuck else min(falling, key=cost.__getitem__)
            number = self._leaving_row(column)
            stuck = self.rows[number][-1] == 0
            self._pivot(number, column)

    def point(self) -> tuple[Fraction, ...]:
        """The v of the present basis."""
        v = [Fraction(0)] * self.width
        for row, column in zip(self.rows, self.basis, strict=True):
            if column < self.width:
                v[column] = Fraction(row[-1], self.divisor)
        return tuple(v)

    def _leaving_row(self, column: int) -> int:
        """The row whose basic column reaches 0 first as this one grows."""
        best = -1
        for number, row in enumerate(self.rows):
            if row[column] <= 0:
                continue
            if best < 0 or self._reaches_zero_sooner(number, best, column):
                best = number
        return best

    def _reaches_zero_sooner(self, one: int, other: int, column: int) -> bool:
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
