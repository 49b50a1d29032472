"""Which of two things is bigger, taller, longer or nearer, by what is measured of them.

Sizes are metric, of what is visible: the extents of the points of a thing along their
principal axes, and how far it reaches up. How probably one exceeds another is

    Φ(log(a / b) / s)  for sizes,  Φ((a − b) / d)  for distances,

Φ the normal distribution, s and d how well sizes and distances are told apart.

Source: Weber's law for what difference of sizes is noticed.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from kille.dialogue.reference.comparing import ASIDE
from kille.perception.geometry import points_in, table_axes
from kille.scene import Look, Point

SIZES_APART = 0.12
"""The deviation of the logarithm of the ratio of two sizes that are the same."""

PLACES_APART = 0.03
"""The deviation of the difference of two distances that are the same, in metres."""

_ASIDE_APART = 0.1  # of the distance: the deviation of how far off the line it is
_LEAST_POINTS = 20
_ENDS = (2, 98)  # percentiles: what is farther out is noise
_FLATTEST = 0.004  # metres: what is flatter is not told to be


class Extents(NamedTuple):
    """What is measured of a thing, in metres."""

    size: float
    """The side of the square that its largest face would fill."""
    height: float
    length: float
    distance: float


COMPARISONS: Mapping[str, tuple[str, int]] = {
    "bigger_than": ("size", 1),
    "smaller_than": ("size", -1),
    "taller_than": ("height", 1),
    "lower_than": ("height", -1),
    "longer_than": ("length", 1),
    "shorter_than": ("length", -1),
    "further_than": ("distance", 1),
    "nearer_than": ("distance", -1),
}
"""What each comparative compares, and whether it says that there is more of it."""


SUPERLATIVES: Mapping[str, int] = {"closest_to": 1, "furthest_from": -1}
"""The relations to the thing that something is closest to, or furthest from."""


def extents_of(look: Look) -> tuple[Extents | None, ...]:
    """What is measured of the things in a look; None where there is no depth."""
    up = table_axes(look.up)[2]
    found: list[Extents | None] = []
    for it in look.percepts:
        points = points_in(look.frame, it.region.mask, it.region.box).astype(np.float64)
        if len(points) < _LEAST_POINTS or it.region.place is None:
            found.append(None)
            continue
        middle = points - np.median(points, axis=0)
        _, axes = np.linalg.eigh(middle.T @ middle)
        longest, second = np.sort(_reach(middle @ axes))[::-1][:2]
        found.append(
            Extents(
                size=math.sqrt(longest * second),
                height=float(_reach((middle @ up)[:, None])[0]),
                length=float(longest),
                distance=math.hypot(*it.region.place),
            )
        )
    return tuple(found)


def degree_of(word: str, one: Extents, other: Extents) -> float:
    """How probably a comparative is true of two things.

    >>> cup, box = Extents(0.08, 0.1, 0.1, 0.9), Extents(0.2, 0.1, 0.3, 0.6)
    >>> degree_of("bigger_than", box, cup) > 0.99
    True
    >>> degree_of("taller_than", box, cup)
    0.5
    """
    measure, sign = COMPARISONS[word]
    a, b = getattr(one, measure), getattr(other, measure)
    if measure == "distance":
        apart = (a - b) / PLACES_APART
    else:
        apart = math.log(a / b) / SIZES_APART
    return _normal(sign * apart)


def superlative_degree(
    word: str, x: int, y: int, places: Sequence[Point | None]
) -> float | None:
    """How probably no third thing is closer to y than x is, or farther from it.

    Things are numbers, from 0; None if a place is not known.

    >>> row = [Point(0.0, 0.0, 1.0), Point(0.1, 0.0, 1.0), Point(0.4, 0.0, 1.0)]
    >>> round(superlative_degree("closest_to", 1, 0, row), 2)
    1.0
    >>> round(superlative_degree("closest_to", 2, 0, row), 2)
    0.0
    """
    there, own = places[y], places[x]
    if x == y or there is None or own is None:
        return None
    others = [
        math.dist(it, there) - math.dist(own, there)
        for n, it in enumerate(places)
        if n not in (x, y) and it is not None
    ]
    sign = SUPERLATIVES[word]
    return min((_normal(sign * it / PLACES_APART) for it in others), default=1.0)


def degree_between(x: Point, one: Point, other: Point) -> float:
    """How probably a thing is between two others, by where they are.

    It is between their places along the line from one to the other, and not farther off
    it than a third of the way.

    >>> left, right = Point(-0.2, 0.0, 1.0), Point(0.2, 0.0, 1.0)
    >>> round(degree_between(Point(0.0, 0.0, 1.02), left, right), 2)
    1.0
    >>> round(degree_between(Point(0.3, 0.0, 1.0), left, right), 2)
    0.0
    """
    line = np.subtract(other, one)
    length = float(np.linalg.norm(line))
    if length < PLACES_APART:
        return 0.0
    to = np.subtract(x, one)
    along = float(to @ line) / length
    aside = float(np.linalg.norm(to - along / length * line)) / length
    ends = min(along, length - along) / PLACES_APART
    return _normal(ends) * _normal((ASIDE - aside) / _ASIDE_APART)


def _normal(deviations: float) -> float:
    return 0.5 * math.erfc(-deviations / math.sqrt(2.0))


def _reach(along: np.ndarray) -> np.ndarray:
    """How far points (n, k) reach along each of k axes."""
    low, high = np.percentile(along, _ENDS, axis=0)
    reach: np.ndarray = np.maximum(high - low, _FLATTEST)
    return reach
