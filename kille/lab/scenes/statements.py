"""What people have said of where things are, as occasions: lessons that are data.

Each statement that was judged to be true of a target beside a landmark becomes a world
with these two in it, a blue thing and a red one, and the word that was said of them.
Words for heights and for holding are left out: they mean nothing on a table.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from random import Random
from typing import Any

from kille.lab.errors import StudyError
from kille.lab.scenes.places import MIDDLE, occasion_alone, round_place
from kille.lab.scenes.published_judgements import read
from kille.lab.scenes.scene import Occasion, Scene
from kille.lab.settings import suggest_name
from kille.lab.worlds.worlds import STEP, Place, Thing, World
from kille.scene import Configuration

_REACH = 0.4  # metres: the farthest statement of a study is brought so near
_FLAT = 0.05  # metres: what is nearer than that has no direction on the table
_TRUE = 0.5

_LEVEL = ("left", "right", "away", "towards", "near", "far")
"""The topics of words that say something of places on a table."""

_OTHERWISE = ("between", "touching", "in", "inside", "against")
"""Words for what is near that say more than that."""


@dataclass(frozen=True)
class Statements(Scene):
    """Statements of people, some of which are `taught` and others `kept` for later."""

    taught: tuple[tuple[str, Place], ...]
    kept: tuple[tuple[str, Place], ...]

    def round(self, kind: str, new: bool, chance: Random) -> Sequence[Occasion]:
        """All the statements, in an order of chance; or the two things one by one."""
        if kind != "relation":
            return [occasion_alone(self.start, kind, x) for x in (1, 2)]
        some = list(self.kept if new else self.taught)
        chance.shuffle(some)
        return [self._statement_occasion(*it) for it in some]

    def _statement_occasion(self, word: str, place: Place) -> Occasion:
        world = self.start.move(2, MIDDLE).move(1, place).point_at(1)
        return Occasion("relation", world, 1, 2, said=word, group=word)


def open_statements(
    folder: Path, set_: Mapping[str, Any], chance: Random
) -> Statements:
    """The statements in a folder of judgements; `ExperimentError` if it has none."""
    said = _true_statements(folder)
    wanted = set_["words"] or tuple(said)
    for word in wanted:
        if word not in said:
            raise StudyError([f"{folder} has no {word}: {suggest_name(word, said)}"])
    taught: list[tuple[str, Place]] = []
    kept: list[tuple[str, Place]] = []
    for word in wanted:
        places = list(said.get(word, ()))
        chance.shuffle(places)
        each, new = set_["each"], set_["new"]
        taught += ((word, it) for it in places[:each])
        kept += ((word, it) for it in places[each : each + new])
    things = Thing("book", "blue"), Thing("car", "red")
    start = World(things, traits=chance.randrange(10**6))
    return Statements(start, tuple(taught), tuple(kept))


@lru_cache(8)
def _true_statements(folder: Path) -> Mapping[str, tuple[Place, ...]]:
    """Where the target was in the true statements of each word, on the table.

    What was said twice of one place is there once: else it may be taught and kept.
    """
    study = read(folder)
    far = max((_level_distance(it.x) for it in study.every()), default=1.0)
    scale = _REACH / far
    return {
        word: tuple(
            dict.fromkeys(
                _place(it.x, scale)
                for it in judged
                if it.degree >= _TRUE and _level_distance(it.x) * scale >= _FLAT
            )
        )
        for word, judged in study.words.items()
        if study.about.get(word) in _LEVEL and word not in _OTHERWISE
    }


def _level_distance(x: Configuration) -> float:
    """The horizontal distance of the target from the landmark, in metres."""
    return math.hypot(x.offset[0], x.offset[1])


def _place(x: Configuration, scale: float) -> Place:
    right, away = (scale * it / STEP for it in x.offset[:2])
    return round_place(MIDDLE[0] + right, MIDDLE[1] + away)
