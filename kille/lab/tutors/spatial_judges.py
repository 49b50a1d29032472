"""Simulated people who say how a target stands to a landmark, and in which frame.

A `Person` says "near" or "close" at some places and elsewhere one of four directions,
the likelier the better it fits: by the square of the cosine, as in the paper's
discussion of spatial templates. In the landmark's own frame of reference left, right,
front and behind are those of the landmark. They are our assumptions, not measured on
people. `RatedWords` are those of people who have rated words on a grid: a word is the
likelier, by the square of its rating. A `Speaker` is a tutor who speaks of places as
one of them does.

Source: Logan and Sadler 1996, A computational analysis of the apprehension of spatial
relations.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from random import Random
from typing import Protocol

import numpy as np

from kille.lab.scenes.published_judgements import read
from kille.lab.worlds.vocabulary import PLACES

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
        bearing = _angle_from_front(place, front)
        close = self.inside if math.hypot(*place) < _BORDER else self.outside
        fits = [max(0.0, math.cos(bearing - way)) ** 2 for way in _SIDES.values()]
        sides = [(1 - close) * fit / sum(fits) for fit in fits]
        return dict(zip(WORDS, [*sides, close / 2, close / 2], strict=True))

    def says(
        self, place: Place, chance: np.random.Generator, front: float | None = None
    ) -> str:
        """One word, drawn by its chances."""
        chances = self.chances(place, front)
        return str(chance.choice(list(chances), p=list(chances.values())))

    def shift(self, by: float) -> Person:
        """A person who speaks of closeness more often, by so much in log-odds."""
        return Person(_shift_share(self.inside, by), _shift_share(self.outside, by))


def _shift_share(share: float, by: float) -> float:
    share = min(max(share, 1e-6), 1 - 1e-6)
    return 1 / (1 + math.exp(-(math.log(share / (1 - share)) + by)))


def _angle_from_front(place: Place, front: float | None) -> float:
    """The bearing of a place, radians counter-clockwise from right; see `Person`."""
    right, away = place
    bearing = math.atan2(away, right)
    if front is None:
        return bearing
    # Seen from the viewer right follows front counter-clockwise, and by the landmark's
    # own front it follows clockwise.
    return front - bearing - math.pi / 2


def mix_chances(
    viewed: Mapping[str, float], headed: Mapping[str, float], own: float
) -> dict[str, float]:
    """The chances of words where the frame is the landmark's own in a share of cases.

    p(w) = (1 - own) p(w | viewer's frame) + own p(w | landmark's frame).

    >>> mix_chances({"behind": 1.0}, {"behind": 0.5, "near": 0.5}, 0.5)
    {'behind': 0.75, 'near': 0.25}
    """
    return {
        word: (1 - own) * viewed.get(word, 0.0) + own * headed.get(word, 0.0)
        for word in (*viewed, *headed)
    }


def likeliest_word(degrees: Mapping[str, float]) -> str:
    """The likeliest word, the first of equals; none where there is none."""
    return max(degrees, key=lambda word: degrees[word], default="")


# --- people's ratings ---------------------------------------------------------------

HEADINGS = {"right": 0.0, "away": math.pi / 2, "left": math.pi, "towards": -math.pi / 2}
"""Where a thing faces, in radians counter-clockwise from right."""

_CALLED = {
    "behind of": "behind",
    "left": "to the left of",
    "right": "to the right of",
    "above": "behind",
    "below": "in front of",
    "near to": "near",
    "next to": "next to",
    "far from": "far from",
}
"""How words are called here that people judged on an upright plane, seen from above."""


SIDES = frozenset(PLACES)
"""The words that must be rated for somebody to speak so."""


SELDOM = 0.01
"""Words that are said with no more chance than that, all together, hardly ever are."""


class Placing(Protocol):
    """How likely each word is said of a place, in the viewer's frame or the landmark's.

    A place is in metres right and away of the landmark; `front` is where that faces.
    """

    def chances(self, place: Place, front: float | None = None) -> dict[str, float]:
        """The words and their chances, which sum to 1."""
        ...


@dataclass(frozen=True)
class RatedWords:
    """A person who says words as people have rated them for places on a grid."""

    words: Mapping[str, Sequence[tuple[Place, float]]]

    def chances(self, place: Place, front: float | None = None) -> dict[str, float]:
        """By the square of the rating at the nearest place that was rated."""
        if front is not None:
            far, bearing = math.hypot(*place), _angle_from_front(place, front)
            place = far * math.cos(bearing), far * math.sin(bearing)
        weights = {
            word: min((math.dist(at, place), it) for at, it in rated)[1] ** 2
            for word, rated in self.words.items()
        }
        whole = math.fsum(weights.values())
        return {word: weight / whole for word, weight in weights.items()}


@lru_cache(8)
def read_ratings(folder: Path) -> RatedWords:
    """The ratings in a folder of judgements on an upright plane."""
    words: dict[str, list[tuple[Place, float]]] = {}
    for word, judged in read(folder).words.items():
        if word in _CALLED:
            places = [((it.x.offset[0], it.x.offset[2]), it.degree) for it in judged]
            words[_CALLED[word]] = places
    return RatedWords(words)


# --- tutors -------------------------------------------------------------------------


@dataclass(frozen=True)
class Speaker:
    """A tutor who speaks of places so, in the landmark's frame in this share of cases.

    One who `draws` says a word by its chances, others say the likeliest. They have
    `only` these words, or all where none is named, and where these are hardly ever said
    they say nothing.
    """

    placing: Placing
    own: float = 0.0
    draws: bool = False
    only: tuple[str, ...] = ()

    def says(self, place: Place, front: str, chance: Random) -> str:
        """A word for a place beside what faces that way, if any."""
        heading = HEADINGS.get(front) if self.frame(chance) == "landmark" else None
        chances = self._chances(place, heading)
        if not chances:
            return ""
        drawn = chance.choices(list(chances), list(chances.values()))[0]
        return drawn if self.draws else likeliest_word(chances)

    @property
    def words(self) -> tuple[str, ...]:
        """The words that they may say of places."""
        every = (_CALLED.get(it, it) for it in self.placing.chances((0.1, 0.0)))
        return tuple(it for it in every if not self.only or it in self.only)

    def frame(self, chance: Random) -> str:
        """In whose frame they speak now: that of the `viewer` or the `landmark`."""
        return "landmark" if chance.random() < self.own else "viewer"

    def accepts(self, place: Place, front: str) -> frozenset[str]:
        """The words that they may well say there: with a chance of .15 or more."""
        chances = self._chances(place)
        if front in HEADINGS:
            headed = self._chances(place, HEADINGS[front])
            chances = mix_chances(chances, headed, self.own)
        return frozenset(it for it, p in chances.items() if p >= ACCEPTED)

    def _chances(self, place: Place, front: float | None = None) -> dict[str, float]:
        """The chances of their own words, as these are called here."""
        chances = self.placing.chances(place, front)
        called = {_CALLED.get(word, word): p for word, p in chances.items()}
        if not self.only:
            return called
        own = {word: p for word, p in called.items() if word in self.only}
        whole = math.fsum(own.values())
        return {word: p / whole for word, p in own.items()} if whole > SELDOM else {}
