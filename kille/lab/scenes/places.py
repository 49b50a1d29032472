"""Places in scenes: where things are put, and where the robot sees them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from random import Random

from kille.lab.scenes.scene import Occasion
from kille.lab.worlds.vocabulary import SIDES
from kille.lab.worlds.worlds import STEP, Place, Thing, World

MIDDLE: Place = (4.5, 4.5)
"""The middle of the table."""


@dataclass(frozen=True)
class Astray:
    """How places are seen: `off` by so many metres, and so often anywhere.

    `shift` is how many metres everything is off that way.
    """

    off: float = 0.0
    share: float = 0.0
    shift: float = 0.0
    way: float = 0.0

    def world_seen(
        self, world: World, numbers: Sequence[int], chance: Random
    ) -> World | None:
        """The world as it is seen; None if it is seen as it is."""
        if not (self.off or self.share or self.shift):
            return None
        shift = self.shift / STEP
        for number in numbers:
            right, away = world.place(number)
            right += shift * math.cos(self.way) + chance.gauss(0, self.off / STEP)
            away += shift * math.sin(self.way) + chance.gauss(0, self.off / STEP)
            anywhere = chance.uniform(0, TABLE), chance.uniform(0, TABLE)
            if chance.random() < self.share:
                right, away = anywhere
            world = world.move(number, round_place(right, away))
        return world


TABLE = 9.0
"""How many steps the table is wide, and deep, from its first place to its last."""


def round_place(right: float, away: float) -> Place:
    """Round a place to a tenth of a millimetre, as the names of worlds have it."""
    return round(right, 3), round(away, 3)


def place_beside(place: Place, far: float, bearing: float) -> Place:
    """The place so many metres from there, radians counter-clockwise from right."""
    steps = far / STEP
    right, away = steps * math.cos(bearing), steps * math.sin(bearing)
    return round_place(place[0] + right, place[1] + away)


def ring_places(rings: Sequence[float], points: int) -> Iterator[tuple[float, float]]:
    """Evenly spaced places on each of some rings around a landmark.

    Each is a distance and a bearing, in radians counter-clockwise from right.

    >>> [(ring, round(bearing, 2)) for ring, bearing in ring_places([0.1], 2)]
    [(0.1, 0.0), (0.1, 3.14)]
    """
    for ring in rings:
        for point in range(points):
            yield ring, 2 * math.pi * point / points


BEARINGS = {side: math.atan2(away, right) for side, (right, away) in SIDES.items()}
"""Where each side is: radians counter-clockwise from right."""


def side_of(world: World, x: int, y: int) -> tuple[str, float]:
    """On which side x is of y, for the viewer, and how far off its middle."""
    right, away = world.offset(x, y)
    bearing = math.atan2(away, right)
    fits = {side: math.cos(bearing - way) for side, way in BEARINGS.items()}
    best = max(fits, key=lambda it: fits[it])
    return best, 1.0 - fits[best]


def occasion_alone(start: World, kind: str, x: int) -> Occasion:
    """The occasion to say what x is or which colour it has: nothing else is there."""
    world = start.clear().move(x, MIDDLE).point_at(x)
    return Occasion(kind, world, x, group=word_group(kind, world.thing(x)))


def word_group(kind: str, thing: Thing) -> str:
    """The word that a thing is an example of: its adjective of colour, or its noun."""
    return thing.colour if kind == "adjective" else thing.kind


def relation_occasion(
    world: World, x: int, y: int, astray: Astray, moved: Sequence[int], chance: Random
) -> Occasion:
    """The occasion to say how x, which is pointed at, stands to y."""
    world = world.point_at(x)
    group, hard = side_of(world, x, y)
    seen = astray.world_seen(world, moved, chance)
    return Occasion("relation", world, x, y, seen, group=group, hard=hard)
