"""Descriptions of what happened in a dialogue without being said."""

from __future__ import annotations

from kille.lab.worlds.worlds import World

_LONGEST = 100


def describe_event(given: str) -> str:
    """Describe what was seen of a simulated world; of other events, their text.

    >>> from kille.lab.worlds.worlds import Thing
    >>> world = World((Thing("cup", "red", 0.5, (2, 3)), Thing("car", "blue")))
    >>> describe_event(world.name)
    'sees a red cup at 2.0,3.0'
    >>> describe_event(world.clear().name), describe_event("stage=empty")
    ('sees nothing', 'stage=empty')
    """
    world = World.from_name(given)
    if world is None:
        return given if len(given) <= _LONGEST else f"{given[: _LONGEST - 1]}…"
    return f"sees {_describe_things(world) or 'nothing'}"


def _describe_things(world: World) -> str:
    """The things in view, that which is attended to first."""
    numbers = sorted(world.in_view, key=lambda it: (it != world.attended_thing, it))
    return ", ".join(_describe_thing(world, number) for number in numbers)


def _describe_thing(world: World, number: int) -> str:
    thing, (right, away) = world.thing(number), world.place(number)
    article = "an" if thing.colour[0] in "aeiou" else "a"
    return f"{article} {thing.colour} {thing.kind} at {right:.1f},{away:.1f}"
