"""Simulated people who say how a target stands to a landmark.

A person says "near" or "close" at some places and elsewhere one of four directions, the
likelier the better it fits: by the square of the cosine, as in the paper's discussion
of spatial templates. In the landmark's own frame of reference left, right, front and
behind are those of the landmark. They are our assumptions, not measured on people.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

_SIDES: Mapping[str, float] = {
    "to the right of": 0.0,
    "behind of": math.pi / 2,
    "to the left of": math.pi,
    "in front of": -math.pi / 2,
}
_CLOSENESS = ("near", "close to")

WORDS = (*_SIDES, *_CLOSENESS)
"""The paper's six words."""

_INSIDE, _OUTSIDE = 0.45, 0.10  # how often one of the words for closeness is said
_BORDER = 0.2  # metres: between the two rings

ACCEPTED = 0.15
"""A word that one says with this chance or more is accepted from others."""

Place = tuple[float, float]
"""Metres right and away of the landmark."""


@dataclass(frozen=True)
class Person:
    """How often one speaks of closeness, on the inner ring and on the outer."""

    inside: float = _INSIDE
    outside: float = _OUTSIDE

    def chances(self, place: Place, front: float | None = None) -> dict[str, float]:
        """How likely each word is said of a target so far (right, away) of a landmark.

        `front` is where the landmark faces if the person speaks in its own frame,
        radians counter-clockwise from right; None is the viewer's frame.

        >>> [f"{p:.2f}" for p in Person().chances((0.28, 0.0)).values()]
        ['0.90', '0.00', '0.00', '0.00', '0.05', '0.05']
        """
        right, away = place
        bearing = math.atan2(away, right)
        if front is not None:
            # Seen from the viewer right follows front counter-clockwise, and by the
            # landmark's own front it follows clockwise.
            bearing = front - bearing - math.pi / 2
        close = self.inside if math.hypot(right, away) < _BORDER else self.outside
        fits = [max(0.0, math.cos(bearing - way)) ** 2 for way in _SIDES.values()]
        sides = [(1 - close) * fit / sum(fits) for fit in fits]
        return dict(zip(WORDS, [*sides, close / 2, close / 2], strict=True))

    def says(
        self, place: Place, chance: np.random.Generator, front: float | None = None
    ) -> str:
        """One word, drawn by its chances."""
        chances = self.chances(place, front)
        return str(chance.choice(list(chances), p=list(chances.values())))


def answer(degrees: Mapping[str, float]) -> str:
    """The likeliest word, the first of equals; none where there is none."""
    return max(degrees, key=lambda word: degrees[word], default="")


def born(habit: float, chance: np.random.Generator) -> Person:
    """A person whose habit differs from the usual by this deviation of log-odds."""
    by = habit * chance.normal()
    return Person(_moved(_INSIDE, by), _moved(_OUTSIDE, by))


def _moved(share: float, by: float) -> float:
    return 1 / (1 + math.exp(-(math.log(share / (1 - share)) + by)))
