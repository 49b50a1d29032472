"""The robots of a study: simulated ones, quick, and the whole robot with its own eyes.

A robot is shown an occasion, hears a text, or is left the floor, and replies. Nothing
else is known of it than what it says and thinks, so that a person can play it, too.
"""

from __future__ import annotations

from typing import Protocol

from kille.lab.robots.replies import Reply
from kille.lab.scenes.scene import Occasion

__all__ = ["Reply", "Robot"]


class Robot(Protocol):
    """Who is taught.

    >>> from kille.lab.robots.simulated import SimulatedRobot
    >>> from kille.lab.worlds.games import simulated_game
    >>> from kille.lab.worlds.worlds import Thing, World
    >>> game = simulated_game(World((Thing("cup", "red", place=(2, 3)),)))
    >>> robot: Robot = SimulatedRobot(game)
    >>> robot.hear("This is a cup.").text
    'OK, I learned a cup.'
    """

    def see(self, occasion: Occasion) -> Reply:
        """Be shown something, while the tutor has the floor."""
        ...

    def wait(self, occasion: Occasion) -> Reply:
        """Look once more, and have the floor."""
        ...

    def hear(self, text: str) -> Reply:
        """Be told something."""
        ...

    def happen(self, command: str) -> Reply:
        """Carry out a command of a script: `look`, `point 2`, `restart` …"""
        ...

    def rest(self) -> Reply:
        """Begin another day: know what was taught, but not what was said."""
        ...

    def name(self, number: int) -> str | None:
        """The robot's own name for a thing of the world in the latest look."""
        ...

    def close(self) -> None:
        """Release all resources."""
        ...
