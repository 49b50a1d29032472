"""Smoothing: counts that are added for what was never observed."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from ttr.errors import TTRError
from ttr.semantics.argument_checks import in_one_line


@dataclass(frozen=True)
class Smoothing:
    """A frequency n/N becomes (n + a)/(N + 2a), where a is the pseudocount.

    >>> Smoothing("mine", Fraction(1, 10)).pseudocount
    Fraction(1, 10)
    """

    name: str
    pseudocount: Fraction

    def __post_init__(self) -> None:
        object.__setattr__(self, "pseudocount", _as_fraction(self.pseudocount))

    def __str__(self) -> str:
        return self.name


def _as_fraction(pseudocount: float | Fraction) -> Fraction:
    is_number = isinstance(pseudocount, int | float | Fraction)
    if not is_number or not 0 <= pseudocount < float("inf"):
        raise TTRError(
            "a pseudocount is a finite number, 0 or more, "
            f"found {in_one_line(pseudocount)}"
        )
    return Fraction(pseudocount)


def as_smoothing(value: object) -> Smoothing:
    """A smoothing itself; `TTRError` for what is none."""
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
    return Smoothing(f"Lidstone({pseudocount})", _as_fraction(pseudocount))


NO_SMOOTHING = Smoothing("no smoothing", Fraction(0))
"""Frequencies as they are: what was never observed has the probability 0.

>>> from ttr.semantics.learning import NO_SMOOTHING
>>> print(NO_SMOOTHING, NO_SMOOTHING.pseudocount)
no smoothing 0
"""

LAPLACE = Smoothing("Laplace", Fraction(1))
"""Laplace's rule of succession: one observation for and one against.

>>> from ttr import Basic
>>> from ttr.judging import proposition
>>> from ttr.semantics.learning import LAPLACE, Counts, posterior
>>> Apple, Pear, Red = Basic("Apple"), Basic("Pear"), Basic("Red")
>>> seen = Counts().learned(proposition("a", Apple & Red), proposition("b", Pear))
>>> print(posterior(seen, [Apple, Pear], [Red], smoothing=LAPLACE)[Apple])
0.6667
"""

JEFFREYS = Smoothing("Jeffreys", Fraction(1, 2))
"""Half an observation for and half against.

>>> from ttr.semantics.learning import JEFFREYS
>>> print(JEFFREYS, JEFFREYS.pseudocount)
Jeffreys 1/2
"""
