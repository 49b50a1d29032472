"""The robots that are talked to in tests: what they know and see, and how they talk.

Together they apply every rule.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from kille.lab.worlds.games import simulated_game, world_of
from kille.lab.worlds.perception import glance_event
from kille.lab.worlds.schooling import (
    continue_game,
    game_after_school,
    game_next_day,
    kinds_told,
)
from kille.lab.worlds.worlds import draw_world
from ttr.updates import Game


@dataclass(frozen=True)
class RobotProfile:
    """Who the tutor talks to, in which language, in which share of the dialogues.

    It has been told so many `times` what it sees, and something has become of it
    `since`; `knows` is what else it knows.
    """

    name: str
    share: float
    language: str = "en"
    times: int = 0
    strategy: Mapping[str, str] = field(default_factory=dict)
    world: Mapping[str, Any] = field(default_factory=dict)
    knows: Mapping[str, Any] = field(default_factory=dict)
    since: Callable[[Game], Game] | None = None

    def game(self, seed: int) -> Game:
        """The game of this robot in the world of a seed."""
        world = draw_world(seed, **self.world)
        settings = {"language": self.language, **self.strategy, **self.knows}
        game = simulated_game(world, **settings)
        if self.times:
            game = game_after_school(game, self.language, self.times)
        return game if self.since is None else self.since(game)


def _flatten_view(game: Game) -> Game:
    """The game after a look that does not show where things are."""
    world = world_of(game.start)
    return continue_game(game, [glance_event(world.flip_depth(), world)])


def _relay_table(game: Game) -> Game:
    """The game after all things in view were exchanged for the others."""
    world = before = world_of(game.start)
    for number in range(1, len(world.things) + 1):
        place = None if number in before else next(iter(world.free_places()))
        world = world.move(number, place)
    return continue_game(game, [glance_event(world, before)])


def _tell_kinds_the_day_before(game: Game) -> Game:
    """The game on the day after it was told which kinds are kinds of which."""
    nouns = game.start.private.nouns
    return game_next_day(continue_game(game, kinds_told("en", nouns)))


FOUR = {"wording": "four"}
LIVELY = {"turns": "lively"}
ALONE = {"mode": "autonomous"}
FLAT = {"deep": False}
DIM = {"noise": 0.15, "kinds": ("cup", "mug", "book")}
ALIKE = {"kinds": ("cup", "mug", "book"), "colours": ("red", "green", "blue")}

ROBOTS = (
    RobotProfile("assisted", 0.05),
    RobotProfile("assisted, before one thing", 0.025, world={"in_view": 1}),
    RobotProfile(
        "assisted, after school, before two things",
        0.025,
        times=1,
        world={"in_view": 2},
    ),
    RobotProfile("assisted, after school", 0.05, times=1),
    RobotProfile("assisted, after school, lively", 0.05, times=1, strategy=LIVELY),
    RobotProfile(
        "assisted, after school, among like things", 0.05, times=1, world=ALIKE
    ),
    RobotProfile("assisted, after school, seeing badly", 0.05, times=1, world=DIM),
    RobotProfile("assisted, seeing badly", 0.05, world=DIM),
    RobotProfile("assisted, seeing flat pictures", 0.025, world=FLAT),
    RobotProfile(
        "assisted, after school, seeing flat pictures",
        0.05,
        times=1,
        since=_flatten_view,
    ),
    RobotProfile("assisted, on another day", 0.05, times=1, since=game_next_day),
    RobotProfile(
        "assisted, on another day, told of kinds",
        0.1,
        times=3,
        since=_tell_kinds_the_day_before,
    ),
    RobotProfile("assisted, knowing no colours", 0.05, knows={"colours": ()}),
    RobotProfile("assisted, Swedish", 0.05, "sv"),
    RobotProfile("assisted, Swedish, after school", 0.05, "sv", times=1),
    RobotProfile("four bands", 0.05, strategy=FOUR),
    RobotProfile(
        "four bands, after school, seeing other things badly",
        0.05,
        times=1,
        strategy=FOUR,
        world=DIM,
        since=_relay_table,
    ),
    RobotProfile("autonomous", 0.05, strategy=ALONE),
    RobotProfile("autonomous, after school", 0.05, times=3, strategy=ALONE),
    RobotProfile("autonomous, four bands", 0.05, strategy={**ALONE, **FOUR}),
    RobotProfile("driven", 0.025, strategy={"mode": "driven"}),
)
"""All of them: each in a share of the dialogues."""
