"""A person at the keyboard who is the tutor: what is seen is printed, and they type."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass

from kille.sensors.sensor import SensorError
from kille.simulation.worlds import World
from kille.studies.errors import StudyError
from kille.studies.robots.replies import Reply
from kille.studies.scenes.occasions import Occasion
from kille.studies.tutors.tutor import (
    Asked,
    Happens,
    Move,
    Says,
    Shows,
    Task,
    Turns,
    Waits,
)

__all__ = ["Keyboard", "shown", "typed"]

HELP = "type what you say, @ COMMAND for what happens, nothing to wait, or . to go on"

Ask = Callable[[str], str]


def typed(prompt: str) -> str:
    """A line that a person types; nothing at the end of the input."""
    sys.stdout.write(prompt)
    sys.stdout.flush()
    return sys.stdin.readline() or ".\n"


@dataclass(frozen=True)
class Keyboard:
    """A person who types; `ask` is given a prompt, and gives the line.

    In phases that ask for words, the first line is taken as the question of the phase.
    """

    name: str
    ask: Ask = typed

    def turns(self, task: Task) -> Turns:
        """What they type until they go on."""
        occasion = task.of
        told = f"\n[{task.phase}] {task.do}"
        asked = None
        if occasion is not None:
            yield Shows(occasion)
            told = f"{told}: {shown(occasion.world)}"
            asked = _asked(task, occasion)
        line = self.ask(f"{told}\n({HELP})\n> ").strip()
        while line != ".":
            move = _move(line, asked, occasion)
            asked = None if isinstance(move, Says) else asked
            try:
                reply: Reply = yield move
                told = reply.text or "(nothing)"
            except (StudyError, SensorError) as error:
                told = str(error)
            line = self.ask(f"{told}\n> ").strip()


def _move(line: str, asked: Asked | None, occasion: Occasion | None) -> Move:
    if line.startswith("@"):
        return Happens(line.removeprefix("@").strip())
    if not line and occasion is not None:
        return Waits(occasion.looked())
    return Says(line, "says", asked)


def _asked(task: Task, occasion: Occasion) -> Asked | None:
    """What the first question of a phase that asks is for."""
    if task.do not in ("ask", "practise") or occasion.kind == "relation":
        return None
    return Asked(occasion.kind, occasion.group, occasion.x)


def shown(world: World) -> str:
    """What is in view, as a person reads it.

    >>> from kille.simulation.worlds import Thing
    >>> shown(World((Thing("cup", "red", place=(2, 3)),)).pointed(1))
    '#1 a red cup at 2 3 (pointed at)'
    """
    things = []
    for number in world.in_view:
        thing, (right, away) = world.thing(number), world.place(number)
        front = f", facing {thing.front}" if thing.front else ""
        pointed = " (pointed at)" if number == world.focus else ""
        things.append(
            f"#{number} a {thing.colour} {thing.kind} at {right:g} {away:g}"
            f"{front}{pointed}"
        )
    return "; ".join(things) or "nothing is in view"
