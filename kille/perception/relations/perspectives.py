"""Perspectives: a configuration as seen by another person, or from a thing's front.

A *person's* is the viewer's, turned: for who sits opposite and looks `towards` the
viewer, left is right, and what is in front of a thing is on their own side of it. A
*thing* has a front of its own: it `faces_left`, and what is in front of it is at that
front, while its left and right are those of somebody who looks where it faces. So near
and far are mirrored as well. This is so in languages such as English and Swedish, where
a thing without a front is taken to face the viewer (Levinson 2003, *Space in Language
and Cognition*, ch. 2).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

from kille.scene import Configuration, Direction

AWAY = "away"
"""The perspective of the viewer."""


@dataclass(frozen=True)
class Perspective:
    """Where a front is, in quarter turns counter-clockwise from the viewer's "away";
    and whether near and far change places, since it is the front of a thing."""

    quarters: int
    mirrored: bool


_QUARTERS = {AWAY: 0, "left": 1, "towards": 2, "right": 3}

FRONTS: Mapping[str, Perspective] = MappingProxyType(
    {
        **{name: Perspective(n, False) for name, n in _QUARTERS.items()},
        **{f"faces_{name}": Perspective(n, True) for name, n in _QUARTERS.items()},
    }
)
"""All perspectives by name: who looks that way, and what faces that way."""


def seen_from(stand: Configuration, front: str) -> Configuration:
    """The configuration from another perspective; KeyError if that is unknown.

    The viewer's ray to the landmark is unknown in the result.

    >>> behind = Configuration((0.0, 0.3, 0.1))
    >>> seen_from(behind, "towards").offset, seen_from(behind, "faces_towards").offset
    ((0.0, -0.3, 0.1), (0.0, 0.3, 0.1))
    """
    if front == AWAY:
        return stand
    seen = FRONTS[front]
    return replace(
        stand,
        offset=_turn_direction(seen, stand.offset),
        viewed=None,
        others=tuple(_turn_direction(seen, it) for it in stand.others),
        heading=None if stand.heading is None else _turn_angle(seen, stand.heading),
    )


def _turn_direction(perspective: Perspective, direction: Direction) -> Direction:
    """Turn a direction, given as right, away, up."""
    right, away, up = direction
    for _ in range(perspective.quarters):
        right, away = away, 0.0 - right
    return right, (0.0 - away if perspective.mirrored else away), up


def _turn_angle(perspective: Perspective, angle: float) -> float:
    """Turn an angle, which is counter-clockwise from right."""
    after = angle - perspective.quarters * math.pi / 2
    return -after if perspective.mirrored else after
