"""Tutors: who talks to a robot in a study, whoever or whatever they are.

A tutor is given a task of a phase and takes turns until it is done: they say or show
something, and are told how the robot has replied. They decide nothing else, so that a
simulated tutor, a script, and a person at the keyboard can stand in for each other.
"""

from __future__ import annotations

from collections.abc import Generator, Mapping
from dataclasses import dataclass, field
from random import Random
from typing import Any, Protocol, TypeAlias

from kille.lab.robots.replies import Reply
from kille.lab.scenes.occasions import Occasion
from kille.lab.study import Run
from kille.lab.worlds.worlds import Thing

__all__ = [
    "Asked",
    "Happens",
    "Move",
    "Says",
    "Shows",
    "Task",
    "Tutor",
    "Turns",
    "Waits",
]


@dataclass(frozen=True)
class Asked:
    """A question to which the tutor knows the answer.

    `right` is what they hold to be so, `accepted` what they might have said as well,
    `judge` what another person would have said. It is about the thing x of the world,
    and how that stands to y, if it does.
    """

    kind: str
    right: str
    x: int
    y: int | None = None
    accepted: frozenset[str] = frozenset()
    judge: str = ""


@dataclass(frozen=True)
class Says:
    """The tutor says a text as a move; it `asks` something, or sets the robot right.

    `of` is the thing that is spoken of by a phrase which may not be clear, if any.
    """

    text: str
    act: str
    asks: Asked | None = None
    corrects: bool = False
    of: Thing | None = None


@dataclass(frozen=True)
class Shows:
    """The tutor lays the table, and points."""

    occasion: Occasion


@dataclass(frozen=True)
class Waits:
    """The tutor leaves the floor to the robot, which looks once more."""

    occasion: Occasion


@dataclass(frozen=True)
class Happens:
    """Something happens, by a command of a script: `look`, `point 2`, `restart`."""

    command: str


Move: TypeAlias = Says | Shows | Waits | Happens

Turns: TypeAlias = Generator[Move, Reply, None]
"""The moves of a tutor, who is sent what the robot replies to each."""


@dataclass(frozen=True)
class Task:
    """What a tutor is to do next: in a phase, about something or about nothing.

    All chance in it follows from its name, so that it is the same whatever was said
    before. `settings` are those of the phase.
    """

    run: Run
    phase: str
    do: str
    number: int
    of: Occasion | None = None
    settings: Mapping[str, Any] = field(default_factory=dict)

    def chance(self, of: str) -> Random:
        """The random generator for something in this task."""
        return self.run.chance(f"{of} {self.phase} {self.number}")

    @property
    def occasion(self) -> Occasion:
        """What it is about. Raises `ValueError` where it is about nothing."""
        if self.of is None:
            raise ValueError(f"there is nothing to {self.do} in the phase {self.phase}")
        return self.of


class Tutor(Protocol):
    """Who talks to the robot."""

    @property
    def name(self) -> str:
        """The name; of several tutors, that of the one whose turn it is."""
        ...

    def turns(self, task: Task) -> Turns:
        """The moves by which the tutor does a task."""
        ...
