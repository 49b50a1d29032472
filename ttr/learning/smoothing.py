"""Smoothing, by name: what is counted for what was never seen."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from ttr.errors import TTRError

__all__ = [
    "JEFFREYS",
    "LAPLACE",
    "NO_SMOOTHING",
    "Smoothing",
    "as_smoothing",
    "lidstone",
]


@dataclass(frozen=True)
class Smoothing:
    """So much evidence is added for each of two: that it is so, that it is not.

    A frequency n/N becomes (n + a)/(N + 2a), where a is the pseudocount.
    """

    name: str
    pseudocount: Fraction

    def __str__(self) -> str:
        return self.name


def as_smoothing(value: object) -> Smoothing:
    """The value, if it is a smoothing; else `TTRError` says what there is."""
    if isinstance(value, Smoothing):
        return value
    raise TTRError(
        f"expected a smoothing, found {value!r}",
        hint="write NO_SMOOTHING, LAPLACE, JEFFREYS or lidstone(a)",
    )


def lidstone(pseudocount: float) -> Smoothing:
    """Lidstone's smoothing with a pseudocount of 0 or more; else `TTRError`.

    >>> print(lidstone(0.1))
    Lidstone(0.1)
    """
    is_number = isinstance(pseudocount, int | float | Fraction)
    if not is_number or not 0 <= pseudocount < float("inf"):
        raise TTRError(
            f"a pseudocount is a finite number, 0 or more, found {pseudocount!r}"
        )
    return Smoothing(f"Lidstone({pseudocount})", Fraction(pseudocount))


NO_SMOOTHING = Smoothing("no smoothing", Fraction(0))
"""Frequencies as they are: what was never seen has the probability 0."""

LAPLACE = Smoothing("Laplace", Fraction(1))
"""Laplace's rule of succession: one observation for and one against."""

JEFFREYS = Smoothing("Jeffreys", Fraction(1, 2))
"""Half an observation for and half against."""
