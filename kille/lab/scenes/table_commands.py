"""What may happen in front of a simulated scene, by a command."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from kille.lab.errors import StudyError
from kille.lab.scenes.places import TABLE, round_place
from kille.lab.scenes.scene import Occasion
from kille.lab.worlds.worlds import World


def change_world(world: World, command: str) -> World:
    """The world after `point 2`, `place 2 3.5 4` or `remove 2`.

    Raises `StudyError` for another command, a thing that is not there, and a place that
    is not on the table.

    >>> from kille.lab.worlds.worlds import Thing
    >>> world = World((Thing("cup", "red", place=(2, 3)),))
    >>> change_world(world, "place #1 3.5 4").place(1)
    (3.5, 4.0)
    >>> change_world(world, "point 2")
    Traceback (most recent call last):
        ...
    kille.lab.errors.StudyError: @ point 2: there is no #2 in view, but #1
    """
    try:
        match command.split():
            case ["point", number]:
                return world.point_at(_number_among(number, world.in_view, "in view"))
            case ["remove", number]:
                return world.move(_number_among(number, world.in_view, "in view"), None)
            case ["place", number, right, away]:
                every = range(1, len(world.things) + 1)
                at = round_place(_read_step(right), _read_step(away))
                return world.move(_number_among(number, every, "in this scene"), at)
    except _Unfit as error:
        raise StudyError([f"@ {command}: {error}"]) from error
    raise StudyError(
        [
            f"@ {command or '…'}: in front of a simulated scene write `look`, "
            "`point 2`, `place 2 3.5 4`, `remove 2` or `restart`"
        ]
    )


def occasion_after(occasion: Occasion, command: str) -> Occasion:
    """An occasion after a command: so it is, and so it is seen."""
    seen = None if occasion.seen is None else change_world(occasion.seen, command)
    return replace(occasion, world=change_world(occasion.world, command), seen=seen)


PLACED = f"a place is two numbers from 0 to {TABLE:g}, steps of 10 cm"
"""What those are told who put a thing beside the table."""


def is_step(number: str) -> bool:
    """Whether a text is a number of steps that is on the table."""
    try:
        return 0 <= float(number) <= TABLE
    except ValueError:
        return False


class _Unfit(Exception):
    """A number that a command cannot have."""


def _number_among(number: str, known: Collection[int], where: str) -> int:
    named, asked = {f"#{it}": it for it in known}, f"#{number.removeprefix('#')}"
    if asked in named:
        return named[asked]
    raise _Unfit(f"there is no {asked} {where}, but {', '.join(named) or 'nothing'}")


def _read_step(number: str) -> float:
    if is_step(number):
        return float(number)
    raise _Unfit(PLACED)
