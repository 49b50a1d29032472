"""Degrees: probabilities as intervals."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import NamedTuple, TypeAlias

from ttr.errors import TTRError


class Degree(NamedTuple):
    """An interval of probability: [1, 1] certain, [0, 0] refuted, [0, 1] unknown.

    >>> from ttr import Ind, Model
    >>> lo, hi = Model().given("fido", Ind, (0.5, 1)).judge("fido", Ind).p
    >>> lo, hi
    (0.5, 1.0)
    """

    lo: float
    hi: float

    def __str__(self) -> str:
        """The interval as a semanticist writes it.

        >>> print(Degree(0.25, 0.25), Degree(0, 1))
        0.25 [0, 1]
        >>> print(Degree(0.99999, 0.99999))
        0.99999
        """
        if self.lo == self.hi:
            return format_probability(self.lo)
        return f"[{format_probability(self.lo)}, {format_probability(self.hi)}]"


def format_probability(x: float) -> str:
    """A number in four digits, unless they would make it certain or refuted.

    >>> format_probability(2 / 3), format_probability(0.99999)
    ('0.6667', '0.99999')
    """
    short = f"{x:.4g}"
    return short if x in (0.0, 1.0) or 0.0 < float(short) < 1.0 else repr(x)


ROUNDING = 1e-9
"""Two probabilities that differ by no more than this count as the same."""

CERTAIN = Degree(1.0, 1.0)
"""What is so: [1, 1].

>>> from ttr import Ind, Model
>>> from ttr.probability import CERTAIN
>>> Model().given("fido", Ind).judge("fido", Ind).p == CERTAIN
True
"""
REFUTED = Degree(0.0, 0.0)
"""What is not so: [0, 0].

>>> from ttr import Ind, Model
>>> from ttr.probability import REFUTED
>>> Model().judge("fido", Ind).p == REFUTED
True
"""
UNKNOWN = Degree(0.0, 1.0)
"""What nothing is known of: [0, 1].

>>> from ttr.probability import UNKNOWN, Atomic, Not, chance
>>> chance(Not(Atomic("rain", UNKNOWN))).p == UNKNOWN
True
"""


def degree(value: object, what: str = "a probability") -> Degree:
    """A number, a truth value or a pair [lo, hi] as a degree; else `TTRError`.

    >>> degree(True), degree((0.2, 0.4))
    (Degree(lo=1.0, hi=1.0), Degree(lo=0.2, hi=0.4))
    >>> degree(1.5)
    Traceback (most recent call last):
    ttr.errors.TTRError: a probability is a number in [0, 1] or an interval ...
    """
    pair = tuple(value) if isinstance(value, tuple | list) else (value, value)
    lo, hi = map(_float, pair) if len(pair) == 2 else (math.nan, math.nan)
    if not 0.0 <= lo <= hi <= 1.0:
        raise TTRError(
            f"{what} is a number in [0, 1] or an interval of two, lower first, "
            f"but found {value!r}"
        )
    return Degree(lo, hi)


def _float(value: object) -> float:
    """The value as a number; not a number for what is none."""
    if isinstance(value, str | bytes | bytearray):
        return math.nan
    try:
        return float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError, RuntimeError):
        return math.nan


def complement(x: float) -> float:
    """1 − x as for decimals, so that 1 − 0.9 is 0.1.

    >>> complement(0.9), 1 - 0.9
    (0.1, 0.09999999999999998)
    """
    return float(1 - Fraction(repr(float(x))))


def is_within(p: tuple[float, float], wanted: tuple[float, float]) -> bool:
    """Is an interval within another one, up to rounding?

    >>> is_within(Degree(0.1 + 0.2, 0.5), Degree(0.3, 0.5))
    True
    """
    (lo, hi), (least, most) = p, wanted
    return least - ROUNDING <= lo and hi <= most + ROUNDING


def order_ends(lo: float, hi: float) -> Degree:
    """The interval of two ends that rounding may have put out of order.

    >>> order_ends(0.3000000001, 0.3)
    Degree(lo=0.3, hi=0.3000000001)
    """
    lo, hi = min(max(lo, 0.0), 1.0), min(max(hi, 0.0), 1.0)
    return Degree(min(lo, hi), max(lo, hi))


# --- degrees made of degrees ---------------------------------------------------------


def degree_of_negation(p: Degree) -> Degree:
    """p(¬E) for p = p(E).

    >>> print(degree_of_negation(Degree(0.25, 1)))
    [0, 0.75]
    """
    return Degree(1.0 - p.hi, 1.0 - p.lo)


def independent_conjunction(*degrees: Degree) -> Degree:
    """Π pᵢ: the probability that all of some independent events happen.

    >>> print(independent_conjunction(Degree(0.5, 0.5), Degree(0.25, 1.0)))
    [0.125, 0.5]
    """
    least = most = 1.0
    for lo, hi in degrees:
        least, most = least * lo, most * hi
    return Degree(least, most)


def independent_disjunction(*degrees: Degree) -> Degree:
    """1 − Π (1 − pᵢ): the probability that one of some independent events happens.

    Rounding does not take it below any of them.

    >>> print(independent_disjunction(Degree(0.5, 0.5), Degree(0.25, 1.0)))
    [0.625, 1]
    """
    if not degrees:
        return REFUTED
    none_least = none_most = 1.0
    for lo, hi in degrees:
        none_least, none_most = none_least * (1.0 - hi), none_most * (1.0 - lo)
    least, most = map(max, zip(*degrees, strict=True))
    return Degree(max(least, 1.0 - none_most), max(most, 1.0 - none_least))


def frechet_conjunction(*degrees: Degree) -> Degree:
    """[max(0, Σ pᵢ − (n − 1)), min pᵢ]: the probability of all, however dependent.

    >>> print(frechet_conjunction(Degree(0.75, 0.75), Degree(0.5, 0.5)))
    [0.25, 0.5]
    """
    total, most = 0.0, 1.0
    for lo, hi in degrees:
        total, most = total + lo, min(most, hi)
    return Degree(min(max(0.0, total - (len(degrees) - 1)), most), most)


def frechet_disjunction(*degrees: Degree) -> Degree:
    """[max pᵢ, min(1, Σ pᵢ)]: the probability of any, however dependent.

    >>> print(frechet_disjunction(Degree(0.25, 0.25), Degree(0.5, 0.5)))
    [0.5, 0.75]
    """
    least = total = 0.0
    for lo, hi in degrees:
        least, total = max(least, lo), total + hi
    return Degree(least, min(1.0, total))


Weight: TypeAlias = tuple[float, float] | tuple[Fraction, Fraction]
"""The least and the greatest value of a weight, of 0 or more."""


def share(mine: Weight, rest: Weight) -> Degree | None:
    """mine / (mine + rest), at its least and its greatest.

    None where both are certainly 0; else the cases in which they are do not count.

    >>> print(share((1, 2), (2, 3)), share((0, 1), (0, 0)), share((0, 0), (0, 0)))
    [0.25, 0.5] 1 None
    """
    if not mine[1] + rest[1]:
        return None
    lo = mine[0] / (mine[0] + rest[1]) if rest[1] else 1.0
    hi = mine[1] / (mine[1] + rest[0]) if mine[1] else 0.0
    return order_ends(float(lo), float(hi))
