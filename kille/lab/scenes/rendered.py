"""A rendered table that the whole robot sees through a simulated camera."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from random import Random
from typing import Any
from urllib.parse import quote

from kille.lab.scenes.places import MIDDLE, ring_places, round_place, side_of
from kille.lab.scenes.robot_views import Stand, TableView, Theatre, lay_table
from kille.lab.scenes.scene import Occasion, Scene
from kille.lab.worlds.worlds import STEP, Place, Thing, World
from kille.sensors.sensor import SensorError
from kille.sensors.synthetic.catalogue import TOY_NAMES

RINGS, POINTS = (0.24, 0.30), 8
"""Where a target is put: metres from the landmark, in which it would stand if nearer;
and at how many places on each ring."""

LANDMARK_PLACE = (0.0, 0.05)
"""Metres right and away of the middle of the table, so that all around is in view."""

TURN = 20
"""Degrees by which the target is turned at most."""

TRIES = 6
"""How often it is tried to put the target near a place."""


@dataclass(frozen=True)
class Rendered(Scene):
    """A rendered table: each kind by itself, or a target round a landmark.

    Specimens of each kind that are taught come before those that are kept.
    """

    source: str
    each: int
    new: int
    pair: tuple[str, str]
    theatre: Theatre = field(compare=False)

    def round(self, kind: str, new: bool, chance: Random) -> Sequence[Occasion]:
        """Every specimen of each kind, or the target at each place where it can be."""
        if kind == "relation":
            places = ring_places(RINGS, POINTS)
            found = (self._target_occasion(*place, chance) for place in places)
            return [it for it in found if it is not None]
        first, count = (self.each, self.new) if new else (0, self.each)
        return [
            self._specimen_occasion(kind, x, first + number, chance)
            for number in range(count)
            for x in range(1, len(self.kinds) + 1)
        ]

    def _specimen_occasion(
        self, kind: str, x: int, specimen: int, chance: Random
    ) -> Occasion:
        name = self.start.thing(x).kind
        right, away = chance.uniform(-0.05, 0.05), chance.uniform(-0.05, 0.05)
        stand = Stand(name, right, away, chance.uniform(-25, 25))
        view = TableView(f"{self.source}&specimen={specimen}", (stand,))
        world = self.start.move(x, _place(right, away)).point_at(x)
        return Occasion(kind, world, x, view=view, group=name)

    def _target_occasion(
        self, ring: float, bearing: float, chance: Random
    ) -> Occasion | None:
        """The target near a place; None if it cannot stand there."""
        target, landmark = self.pair
        middle, off = LANDMARK_PLACE
        for _ in range(TRIES):
            right = middle + ring * math.cos(bearing) + chance.gauss(0, 0.01)
            away = off + ring * math.sin(bearing) + chance.gauss(0, 0.01)
            stands = (
                Stand(landmark, *LANDMARK_PLACE, 0.0),
                Stand(target, right, away, chance.uniform(-TURN, TURN)),
            )
            if _fits(self.source, stands):
                return self._relation_occasion(stands)
        return None

    def _relation_occasion(self, stands: tuple[Stand, Stand]) -> Occasion:
        (landmark, *at, _), (target, *by, _) = stands
        y, x = 1 + self.kinds.index(landmark), 1 + self.kinds.index(target)
        world = self.start.move(y, _place(*at)).move(x, _place(*by)).point_at(x)
        group, hard = side_of(world, x, y)
        view = TableView(self.source, stands)
        return Occasion("relation", world, x, y, view=view, group=group, hard=hard)


def _place(right: float, away: float) -> Place:
    """A place on the table in steps, by metres from its middle."""
    return round_place(MIDDLE[0] + right / STEP, MIDDLE[1] + away / STEP)


@lru_cache(1024)
def _fits(source: str, stands: tuple[Stand, ...]) -> bool:
    try:
        lay_table(source, stands)
    except SensorError:
        return False
    return True


def open_rendered(set_: Mapping[str, Any], chance: Random) -> Rendered:
    """A table on which the ten things of the paper can be put."""
    target, landmark = set_["target"], set_["landmark"]
    wanted = dict.fromkeys((*(set_["kinds"] or TOY_NAMES), target, landmark))
    faults = quote(set_["faults"], safe=",")
    source = f"synthetic:empty?seed={chance.randrange(10**6)}&faults={faults}"
    things = tuple(Thing(name, "", front=_FRONTS.get(name, "")) for name in wanted)
    return Rendered(
        World(things),
        source,
        set_["each"],
        set_["new"],
        (target, landmark),
        Theatre(source),
    )


_FRONTS = {"car": "right"}
"""Which way things face that have a front, where they are not turned."""
