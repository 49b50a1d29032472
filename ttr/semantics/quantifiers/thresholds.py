"""How many is most, many or few: numbers and shares, as an agent understands them."""

from __future__ import annotations

from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from numbers import Rational
from typing import Literal, TypeAlias

from ttr.errors import TTRError
from ttr.types.syntax import kind_of

Sign: TypeAlias = Literal["at least", "more than", "at most", "fewer than"]
"""How a count is compared."""

SIGNS: tuple[Sign, ...] = ("at least", "more than", "at most", "fewer than")
RISING: tuple[Sign, ...] = ("at least", "more than")


@dataclass(frozen=True)
class Threshold:
    """A demand on how many of P are Q: a number of them, or a share of P.

    Built by `number` and `share`. With k of n, a number m asks for k ≥ m or the like,
    and a share r for k ≥ r·n.

    >>> share("more than", 1 / 2).is_met_by(2, 3), number("at most", 1).is_met_by(2, 3)
    (True, False)
    """

    sign: Sign
    amount: Fraction
    unit: Literal["number", "share"]

    @property
    def is_lower_bound(self) -> bool:
        """Is it a lower bound: at least, or more than?"""
        return self.sign in RISING

    @property
    def presupposes(self) -> bool:
        """Is it undefined for an empty P: a share that is neither none nor all?"""
        return self.unit == "share" and 0 < self.amount < 1

    @property
    def weights(self) -> tuple[int, int]:
        """What one of P adds to the score, where it is Q and where it is not."""
        if self.unit == "number":
            return 1, 0
        over = self.amount.denominator - self.amount.numerator
        return over, -self.amount.numerator

    @property
    def least_score(self) -> int:
        """The least score of "at least" and "fewer than", else the greatest, plus one.

        So a score s meets a threshold that rises iff s ≥ bound, else iff s < bound.
        """
        zero = int(self.amount) if self.unit == "number" else 0
        return zero + (self.sign in ("more than", "at most"))

    def is_met_by(self, k: int, n: int) -> bool:
        """Do k of n meet it?"""
        inside, outside = self.weights
        return self.is_reached_by(k * inside + (n - k) * outside)

    def is_reached_by(self, score: int) -> bool:
        """Does a score meet it?"""
        return (score >= self.least_score) == self.is_lower_bound

    def __str__(self) -> str:
        if self.unit == "number":
            return f"{self.sign} {self.amount}"
        if self.amount == 1:
            return "all" if self.sign == "at least" else f"{self.sign} all"
        return f"{self.sign} {self.amount} of them"


def number(sign: Sign, amount: int) -> Threshold:
    """A threshold on the number of those of P that are Q.

    >>> print(number("at least", 3))
    at least 3
    """
    if type(amount) is not int or amount < 0:
        raise TTRError(f"a number of things is 0, 1, 2 and so on, found {amount!r}")
    return Threshold(_check_sign(sign), Fraction(amount), "number")


def share(sign: Sign, amount: Rational | float | str) -> Threshold:
    """A threshold on the share of P that is Q; 0.1, "1/10" and Fraction(1, 10) are one.

    >>> print(share("more than", 0.5))
    more than 1/2 of them
    """
    try:
        exact = Decimal(repr(amount)) if isinstance(amount, float) else amount
        part = Fraction(exact)
    except (TypeError, ValueError, ArithmeticError):
        raise TTRError(f"a share is a number from 0 to 1, found {amount!r}") from None
    if isinstance(amount, bool) or not 0 <= part <= 1:
        raise TTRError(f"a share is a number from 0 to 1, found {amount!r}")
    if part.denominator > LARGEST:
        raise TTRError(f"a share is of at most {LARGEST} parts, found {amount!r}")
    return Threshold(_check_sign(sign), part, "share")


LARGEST = 10_000
"""The largest denominator of a share."""


def _check_sign(sign: str) -> Sign:
    for known in SIGNS:
        if sign == known:
            return known
    raise TTRError(f"a threshold is {' or '.join(SIGNS)} so much, found {sign!r}")


@dataclass(frozen=True)
class Thresholds:
    """What an agent takes most, many and few to be; other agents may differ.

    By default most is more than half, many at least a third, and few is less than that,
    so that few is not many; a few and several are two or more. Source: Barwise and
    Cooper 1981; decision 020. Raises `TTRError` for most, many, a few or several with a
    threshold that falls, or few with one that rises.

    >>> print(Thresholds().most)
    more than 1/2 of them
    """

    most: Threshold = Threshold("more than", Fraction(1, 2), "share")
    many: Threshold = Threshold("at least", Fraction(1, 3), "share")
    few: Threshold = Threshold("fewer than", Fraction(1, 3), "share")
    several: Threshold = Threshold("at least", Fraction(2), "number")

    def __post_init__(self) -> None:
        for name in ("most", "many", "few", "several"):
            found = getattr(self, name)
            if not isinstance(found, Threshold):
                raise TTRError(f"{name} takes a threshold, found {found!r}")
            if found.is_lower_bound == (name == "few"):
                wanted = RISING if found.sign not in RISING else SIGNS[2:]
                raise TTRError(f"{name} is {' or '.join(wanted)} so much, not {found}")


def thresholds_of(agent: object) -> Thresholds:
    """The thresholds that an agent was given, or the usual ones for None.

    >>> thresholds_of(None) == Thresholds()
    True
    """
    if agent is None:
        return Thresholds()
    if isinstance(agent, Thresholds):
        return agent
    raise TTRError(
        f"a quantifier takes thresholds, found {kind_of(agent)}",
        hint="write Thresholds(most=share('at least', 0.9)) or the like",
    )
