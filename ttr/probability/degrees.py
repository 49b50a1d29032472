"""Degrees: probabilities as intervals."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import NamedTuple

from ttr.errors import TTRError


class Degree(NamedTuple):
    """An interval of probability: [1, 1] certain, [0, 0] refuted, [0, 1] unknown."""

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
            return shown(self.lo)
        return f"[{shown(self.lo)}, {shown(self.hi)}]"


def shown(x: float) -> str:
    """A number in four digits, unless they would make it certain or refuted."""
    short = f"{x:.4g}"
    return short if x in (0.0, 1.0) or 0.0 < float(short) < 1.0 else repr(x)


CERTAIN = Degree(1.0, 1.0)
REFUTED = Degree(0.0, 0.0)
UNKNOWN = Degree(0.0, 1.0)


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


def order_ends(lo: float, hi: float) -> Degree:
    """The interval of two ends that rounding may have put out of order.

    >>> order_ends(0.3000000001, 0.3)
    Degree(lo=0.3, hi=0.3000000001)
    """
    lo, hi = min(max(lo, 0.0), 1.0), min(max(hi, 0.0), 1.0)
    return Degree(min(lo, hi), max(lo, hi))
