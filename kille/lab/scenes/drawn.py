"""A table on which some of the things that there are are laid, each time anew."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from random import Random
from typing import Any

from kille.lab.scenes.places import (
    BEARINGS,
    Astray,
    place_beside,
    relation_occasion,
    round_place,
    word_group,
)
from kille.lab.scenes.scene import Occasion, Scene
from kille.lab.worlds.perception import oddness
from kille.lab.worlds.vocabulary import SIDES
from kille.lab.worlds.worlds import FRONTS, SIDE, Thing, World

SIZES = (0.1, 0.5, 0.9)
"""How big things are."""

SPOTS = list(product(range(SIDE), range(SIDE)))
"""Where things are laid."""


@dataclass(frozen=True)
class Drawn(Scene):
    """A table on which some of the things are laid each time.

    The things of each kind that are `taught` come first.
    """

    taught: tuple[int, ...]
    kept: tuple[int, ...]
    in_view: int
    astray: Astray

    def round(self, kind: str, new: bool, chance: Random) -> Sequence[Occasion]:
        """An occasion for each thing, laid with others; or one for each side."""
        pool = self.kept if new else self.taught
        if kind == "relation" and len(pool) < 2:
            return ()
        if kind == "relation":
            return [self._pair_occasion(side, pool, chance) for side in SIDES]
        return [self._thing_occasion(kind, x, pool, chance) for x in pool]

    def _thing_occasion(
        self, kind: str, x: int, pool: Sequence[int], chance: Random
    ) -> Occasion:
        others = [it for it in pool if it != x]
        count = min(self.in_view - 1, len(others))
        world = self.start
        spots = chance.sample(SPOTS, count + 1)
        for number, spot in zip([x, *chance.sample(others, count)], spots, strict=True):
            world = world.move(number, spot)
        world = world.point_at(x)
        seen = self.astray.world_seen(world, world.in_view, chance)
        group = word_group(kind, world.thing(x))
        return Occasion(kind, world, x, seen=seen, group=group, hard=oddness(world, x))

    def _pair_occasion(
        self, side: str, pool: Sequence[int], chance: Random
    ) -> Occasion:
        """Two things of other kinds, the one on this side of the other."""
        x, y = chance.choice(self._pairs(pool))
        spot = chance.uniform(3.5, 5.5), chance.uniform(3.5, 5.5)
        bearing = BEARINGS[side] + chance.uniform(-math.pi / 6, math.pi / 6)
        put = place_beside(spot, chance.uniform(0.12, 0.35), bearing)
        world = self.start.move(y, round_place(*spot)).move(x, put)
        return relation_occasion(world, x, y, self.astray, (x, y), chance)

    def _pairs(self, pool: Sequence[int]) -> Sequence[tuple[int, int]]:
        """Two things each, of other kinds and colours, or at least of other kinds.

        Of two things of one kind nobody says how they stand to each other.
        """
        thing = self.start.thing
        every = [(x, y) for x in pool for y in pool if x != y]
        apart = [(x, y) for x, y in every if thing(x).kind != thing(y).kind]
        told = [(x, y) for x, y in apart if thing(x).colour != thing(y).colour]
        return told or apart or every


def draw_scene(set_: Mapping[str, Any], chance: Random) -> Drawn:
    """Things of each kind, of which some are kept; of one colour only if there are more
    of them than colours.

    Where they are taught `alike`, all things of a kind that are taught have one colour
    and one size, and those that are kept have any.
    """
    each, count = set_["each"], set_["each"] + set_["new"]
    hues = list(set_["hues"])
    first: list[Thing] = []
    later: list[Thing] = []
    for kind in set_["kinds"]:
        colours = chance.sample(hues * -(-count // len(hues)), count)
        alike = chance.choice(SIZES) if set_["alike"] else 0.0
        if alike:
            others = chance.choices(hues, k=set_["new"])
            colours = [*[colours[0]] * each, *others]
        for number, colour in enumerate(colours):
            size, front = chance.choice(SIZES), chance.choice(("", *FRONTS))
            size = alike if alike and number < each else size
            (first if number < each else later).append(
                Thing(kind, colour, size, None, front)
            )
    things = (*first, *later)
    seed, noise = chance.randrange(10**6), set_["noise"]
    return Drawn(
        World(things, traits=seed, noise=noise),
        tuple(range(1, len(first) + 1)),
        tuple(range(len(first) + 1, len(things) + 1)),
        set_["in_view"],
        Astray(set_["off"], set_["astray"]),
    )
