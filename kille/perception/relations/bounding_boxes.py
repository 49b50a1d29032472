"""How one thing holds another, computed from their bounding boxes.

Boxes are level: their sides are along right, away and up. Two boxes touch where the
gap between them is small for their sizes, since a sensor loses what is at the edges.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float64]

_SLACK = 0.15  # of the smaller size: a gap there does not part two things
_FLAT = 1e-6


@dataclass(frozen=True, eq=False)
class Bounds:
    """The box around a thing: its least and greatest right, away and up, (3,) each."""

    low: Vector
    high: Vector

    @property
    def sides(self) -> Vector:
        """How far it reaches along right, away and up."""
        return self.high - self.low

    @property
    def size(self) -> float:
        """Its longest side."""
        return float(self.sides.max())

    @property
    def middle(self) -> Vector:
        """The middle of the box."""
        return (self.low + self.high) / 2


@dataclass(frozen=True)
class Containment:
    """How a landmark holds a target; each number is in [0, 1]."""

    contact: float
    support: float
    containment: float


def containment(target: Bounds, landmark: Bounds) -> Containment:
    """How far the landmark touches, supports and contains the target.

    contact: 1 where the boxes meet, 0 from a gap of 15 % of the smaller size on.
    support: the share of the target's foot that is over the landmark, as far as it is
    at the height of the landmark's top; or the share of the target in the landmark.
    containment: the share of the target's box that is in the landmark's.

    >>> box = Bounds(np.zeros(3), np.ones(3))
    >>> on_it = Bounds(np.array([0.0, 0.0, 1.0]), np.array([0.5, 1.0, 1.5]))
    >>> containment(on_it, box)
    Containment(contact=1.0, support=1.0, containment=0.0)
    """
    shared = np.minimum(target.high, landmark.high) - np.maximum(
        target.low, landmark.low
    )
    slack = _SLACK * max(min(target.size, landmark.size), _FLAT)
    apart = float(np.linalg.norm(np.maximum(0.0, -shared)))
    shares = np.clip(shared / np.maximum(target.sides, _FLAT), 0, 1)
    over = float(shares[0] * shares[1])
    foot = float(target.low[2])
    off = abs(foot - float(landmark.high[2]))
    contained = float(shares.prod())
    return Containment(
        contact=max(0.0, 1 - apart / slack),
        support=max(over * max(0.0, 1 - off / slack), contained),
        containment=contained,
    )


def bounds_of(points: Vector, spare: float = 0.0) -> Bounds | None:
    """The bounding box of points (n, 3); None if there are none.

    A share of the points may be out of it on each side, as strays of a sensor are.
    """
    known = points[np.isfinite(points).all(axis=1)]
    if not len(known):
        return None
    low, high = np.quantile(known, [spare, 1 - spare], axis=0)
    return Bounds(low, high)
