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
from kille.lab.scenes.scene import Occasion
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

    >>> Asked("noun", right="cup", x=1, accepted=frozenset({"mug"})).right
    'cup'
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

    >>> Says("What is this?", "ask_name", asks=Asked("noun", "cup", x=1)).act
    'ask_name'
    """

    text: str
    act: str
    asks: Asked | None = None
    corrects: bool = False
    of: Thing | None = None


@dataclass(frozen=True)
class Shows:
    """The tutor lays the table, and points.

    >>> from kille.lab.worlds.worlds import Thing, World
    >>> occasion = Occasion("noun", World((Thing("cup", "red", place=(2, 3)),)), 1)
    >>> Shows(occasion).occasion.thing.kind
    'cup'
    """

    occasion: Occasion


@dataclass(frozen=True)
class Waits:
    """The tutor leaves the floor to the robot, which looks once more.

    >>> from kille.lab.worlds.worlds import Thing, World
    >>> occasion = Occasion("noun", World((Thing("cup", "red", place=(2, 3)),)), 1)
    >>> Waits(occasion).occasion.kind
    'noun'
    """

    occasion: Occasion


@dataclass(frozen=True)
class Happens:
    """Something happens, by a command of a script: `look`, `point 2`, `restart`.

    >>> Happens("point 2").command
    'point 2'
    """

    command: str


Move: TypeAlias = Says | Shows | Waits | Happens
"""What a tutor may do.

>>> from kille.lab.tutors.tutor import Happens, Move
>>> isinstance(Happens("restart"), Move)
True
"""

Turns: TypeAlias = Generator[Move, Reply, None]
"""The moves of a tutor, who is sent what the robot replies to each.

>>> from kille.lab.tutors.tutor import Says, Turns
>>> def greet_and_leave() -> Turns:
...     reply = yield Says("Hello.", "greet")
...     if reply.text:
...         yield Says("Goodbye.", "part")
>>> next(greet_and_leave()).text
'Hello.'
"""


@dataclass(frozen=True)
class Task:
    """What a tutor is to do next: in a phase, about something or about nothing.

    All chance in it follows from its name, so that it is the same whatever was said
    before. `settings` are those of the phase.

    >>> from kille.lab.study import Run
    >>> task = Task(Run("plain", "ann", "table", 1), "teach", "teach", 1)
    >>> task.chance("order").random() == task.chance("order").random()
    True
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
    """Who talks to the robot.

    >>> class Polite:
    ...     name = "polite"
    ...     def turns(self, task):
    ...         yield Says("Hello.", "greet")
    >>> tutor: Tutor = Polite()
    >>> from kille.lab.study import Run
    >>> task = Task(Run("plain", "polite", "table", 1), "teach", "teach", 1)
    >>> [move.text for move in tutor.turns(task)]
    ['Hello.']
    """

    @property
    def name(self) -> str:
        """The name; of several tutors, that of the one whose turn it is."""
        ...

    def turns(self, task: Task) -> Turns:
        """The moves by which the tutor does a task."""
        ...
