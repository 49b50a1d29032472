"""A landmark in the middle of a table, and a target that is put at places round it.

Source: Dobnik and de Graaf 2017, section 4.2.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from random import Random
from typing import Any

from kille.lab.scenes.places import (
    MIDDLE,
    Astray,
    occasion_alone,
    place_beside,
    relation_occasion,
    ring_places,
    round_place,
)
from kille.lab.scenes.scene import Occasion, Scene
from kille.lab.worlds.worlds import FRONTS, STEP, Thing, World


@dataclass(frozen=True)
class Around(Scene):
    """A landmark in the middle, and a target that is put at places on rings round it.

    Where it `turns`, the landmark faces another way each time.

    Source: Dobnik and de Graaf 2017, section 4.2.
    """

    rings: tuple[float, ...]
    points: int
    spread: float
    turns: bool
    astray: Astray

    def round(self, kind: str, new: bool, chance: Random) -> Sequence[Occasion]:
        """The two things, one by one; or the target at each of the places."""
        if kind == "relation":
            return [
                self._target_occasion(*place, new, chance)
                for place in ring_places(self.rings, self.points)
            ]
        return [occasion_alone(self.start, kind, x) for x in (1, 2)]

    def _target_occasion(
        self, ring: float, bearing: float, new: bool, chance: Random
    ) -> Occasion:
        right, away = place_beside(MIDDLE, ring, bearing)
        by = self.spread / STEP
        place = round_place(right + chance.gauss(0, by), away + chance.gauss(0, by))
        astray = self.astray if new else replace(self.astray, shift=0.0)
        world = self.start.move(1, place)
        front = chance.choice(FRONTS)
        world = world.turn(2, front) if self.turns else world
        return relation_occasion(world, 1, 2, astray, (1,), chance)


def open_around(set_: Mapping[str, Any], chance: Random) -> Around:
    """A blue target and a red landmark, which may face some way."""
    target = Thing(set_["target"], "blue", 0.5)
    front = "" if set_["front"] == "any" else set_["front"]
    landmark = Thing(set_["landmark"], "red", 0.5, MIDDLE, front)
    seed, noise = chance.randrange(10**6), set_["noise"]
    way = chance.uniform(-math.pi, math.pi)
    return Around(
        World((target, landmark), traits=seed, noise=noise),
        tuple(set_["rings"]),
        set_["points"],
        set_["spread"],
        set_["front"] == "any",
        Astray(set_["off"], set_["astray"], set_["shift"], way),
    )
