"""What is in front of somebody, as a person reads it."""

from __future__ import annotations

from kille.lab.scenes.occasions import Occasion
from kille.lab.worlds.worlds import World


def format_view(occasion: Occasion, world: World) -> str:
    """What there is in a world of an occasion, or in what a camera has taken.

    >>> from kille.lab.worlds.worlds import Thing
    >>> world = World((Thing("cup", "red", place=(2, 3)),)).point_at(1)
    >>> print(format_view(Occasion("noun", world, 1), world))
    On the table:
      #1 red cup, 2 right 3 away  <- pointed at
    """
    things = [f"  {_format_thing(world, it, occasion.view)}" for it in world.in_view]
    if occasion.view is not None:
        return "\n".join((f"Before the camera ({occasion.view}):", *things))
    return "\n".join(("On the table:", *things)) if things else "The table is empty."


def _format_thing(world: World, number: int, view: object) -> str:
    """A thing; where it is, a camera's view says itself, if that is known."""
    thing, (right, away) = world.thing(number), world.place(number)
    place = "" if view is not None else f", {_steps(right)} right {_steps(away)} away"
    front = f", facing {thing.front}" if thing.front else ""
    pointed = "  <- pointed at" if number == world.focus else ""
    called = f"{thing.colour} {thing.kind}".strip()
    return f"#{number} {called}{place}{front}{pointed}"


def _steps(far: float) -> str:
    return f"{round(far, 1):zg}"
