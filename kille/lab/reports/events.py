"""What happened in a dialogue without being said, in a few words."""

from __future__ import annotations

from kille.lab.worlds.worlds import World

_LONGEST = 100


def happening(given: str) -> str:
    """What there was to see; of what is no look at a simulated world, its text.

    >>> from kille.lab.worlds.worlds import Thing
    >>> world = World((Thing("cup", "red", 0.5, (2, 3)), Thing("car", "blue")))
    >>> happening(world.name)
    'sees a red cup at 2.0,3.0'
    >>> happening(world.clear().name), happening("stage=empty")
    ('sees nothing', 'stage=empty')
    """
    world = World.from_name(given)
    if world is None:
        return given if len(given) <= _LONGEST else f"{given[: _LONGEST - 1]}…"
    return f"sees {_things(world) or 'nothing'}"


def _things(world: World) -> str:
    """The things in view, that which is attended to first."""
    numbers = sorted(world.in_view, key=lambda it: (it != world.attended_thing, it))
    return ", ".join(_thing(world, number) for number in numbers)


def _thing(world: World, number: int) -> str:
    thing, (right, away) = world.thing(number), world.place(number)
    article = "an" if thing.colour[0] in "aeiou" else "a"
    return f"{article} {thing.colour} {thing.kind} at {right:.1f},{away:.1f}"
