"""What is seen in a look at a world: events of seeing, and features of things."""

from __future__ import annotations

import math
from functools import lru_cache
from random import Random

from kille.dialogue.reference.comparing import ASIDE
from kille.dialogue.reference.salience import NEUTRAL
from kille.lab.worlds.worlds import COLOURS, SIDE, STEP, Thing, World
from ttr import Record, record
from ttr.aliases import former_names

__all__ = [
    "Vector",
    "across",
    "between",
    "colour",
    "comparative",
    "direction",
    "distance",
    "glance_event",
    "number_of",
    "oddness",
    "look_event",
    "sights",
    "size",
    "thing",
    "traits",
    "view",
    "watch_event",
]

__getattr__ = former_names(__name__, {"seen": "look_event", "glanced": "glance_event"})

Vector = tuple[float, ...]
"""Features, colours and sizes as numbers.

>>> from kille.lab.worlds.perception import Vector, colour
>>> from kille.lab.worlds.worlds import Thing, World
>>> seen: Vector = colour(World((Thing("cup", "red", place=(2, 3)),)), 1)
>>> len(seen)
3
"""

TRAITS = 4
"""The number of features of a kind."""

LOOKS = 0.25
"""The difference between two looks at a thing, relative to that of two things."""


def thing(number: int) -> str:
    """The name of the thing with this number.

    >>> thing(3)
    'o3'
    """
    return f"o{number}"


def number_of(x: str) -> int:
    """The number of the thing with this name.

    >>> number_of(thing(3))
    3
    """
    return int(x[1:])


# --- views ---------------------------------------------------------------------------


def view(world: World) -> Record:
    """What is in view.

    >>> from kille.lab.worlds.worlds import Thing
    >>> print(view(World((Thing("cup", "red", place=(2, 3)),))).things)
    ('o1',)
    """
    things = [thing(number) for number in world.in_view]
    attended = [] if world.attended_thing is None else [thing(world.attended_thing)]
    return record(
        look=world.name,
        things=things,
        placed=things if world.deep else [],
        focus=attended,
        pointed=attended,
    )


def look_event(world: World, before: World) -> Record:
    """The event of looking, on the robot's own turn.

    >>> from kille.lab.worlds.worlds import Thing
    >>> world = World((Thing("cup", "red", place=(2, 3)),))
    >>> sorted(look_event(world, World()))
    ['floor', 'kept', 'sights', 'view']
    """
    return _seeing_event(world, before, "robot")


def glance_event(world: World, before: World) -> Record:
    """The event of looking while the tutor has the floor.

    >>> from kille.lab.worlds.worlds import Thing
    >>> world = World((Thing("cup", "red", place=(2, 3)),))
    >>> sorted(glance_event(world, World()))
    ['floor', 'kept', 'sights', 'view']
    """
    return _seeing_event(world, before, "tutor")


def watch_event(world: World, before: World, silence: float, still: float) -> Record:
    """The event of looking after so many seconds of silence, in which nothing moved.

    >>> from kille.lab.worlds.worlds import Thing
    >>> world = World((Thing("cup", "red", place=(2, 3)),))
    >>> watch_event(world, World(), 3.0, 3.0).came
    ('o1',)
    """
    seen = _seeing_event(world, before, "")
    went = [thing(it) for it in before.in_view if not _has_stayed(it, before, world)]
    return record(
        view=seen.view,
        kept=seen.kept,
        came=[x for x in seen.view.things if x not in seen.kept],
        went=went,
        silence=silence,
        still=still,
        sights=seen.sights,
    )


def _seeing_event(world: World, before: World, floor: str) -> Record:
    kept = [thing(it) for it in world.in_view if _has_stayed(it, world, before)]
    seen = view(world)
    return record(view=seen, kept=kept, floor=floor, sights=sights(world))


def sights(world: World) -> list[Record]:
    """How much each thing in view stands out; how near it is, if that is seen.

    >>> from kille.lab.worlds.worlds import Thing
    >>> [it.x for it in sights(World((Thing("cup", "red", place=(2, 3)),)))]
    ['o1']
    """
    return [_sight(it, world.thing(it), world.deep) for it in world.in_view]


@lru_cache(8192)
def _sight(number: int, it: Thing, deep: bool) -> Record:
    right, away = it.place or (0.0, 0.0)
    middle = (SIDE - 1) / 2
    return record(
        x=thing(number),
        size=it.size,
        centrality=max(0.0, 1.0 - abs(right - middle) / middle),
        nearness=max(0.0, 1.0 - away / SIDE) if deep else NEUTRAL,
    )


def _has_stayed(number: int, world: World, before: World) -> bool:
    """Whether a thing stands where it stood.

    What has been moved is not known again. So it is for the whole robot, which follows
    nothing through the air, and what was said of where it was says nothing of now.
    """
    return number in before and world.place(number) == before.place(number)


# --- what is seen of a thing ---------------------------------------------------------


@lru_cache(65536)
def traits(world: World, number: int) -> Vector:
    """The features of a thing: those of its kind, with its own noise and the look's.

    >>> from kille.lab.worlds.worlds import Thing
    >>> world = World((Thing("cup", "red", place=(2, 3)),))
    >>> len(traits(world, 1)) == len(traits(world.look_again(), 1))
    True
    """
    kind = world.thing(number).kind
    typical = _uniform(f"kind {world.traits} {kind}", TRAITS)
    return _blur(typical, world, number)


@lru_cache(65536)
def colour(world: World, number: int) -> Vector:
    """The colour of a thing, as it looks.

    >>> from kille.lab.worlds.worlds import Thing
    >>> r, g, b = colour(World((Thing("cup", "red", place=(2, 3)),)), 1)
    >>> r > g and r > b
    True
    """
    return _blur(COLOURS[world.thing(number).colour], world, number)


def size(world: World, number: int) -> Vector:
    """How big a thing is.

    >>> from kille.lab.worlds.worlds import Thing
    >>> things = Thing("cup", "red", 0.1, (2, 3)), Thing("car", "red", 0.9, (5, 7))
    >>> size(World(things), 1) < size(World(things), 2)
    True
    """
    return (world.thing(number).size,)


def across(world: World, number: int) -> float:
    """How far to the right a thing is seen, from 0 to 1.

    >>> from kille.lab.worlds.worlds import Thing
    >>> things = Thing("cup", "red", place=(2, 3)), Thing("car", "red", place=(7, 3))
    >>> across(World(things), 1) < across(World(things), 2)
    True
    """
    return world.place(number)[0] / SIDE


def direction(world: World, x: int, y: int, front: str) -> Vector | None:
    """Which way x is from y, for somebody with this front: to the right, and ahead.

    A thing's own front, as `faces_left`, is what a viewer would call its back: in front
    of a car is before it, but in front of what one looks at is on one's own side. None
    where places are not known, or are one and the same.

    >>> from kille.lab.worlds.worlds import Thing
    >>> things = Thing("cup", "red", place=(2, 3)), Thing("car", "red", place=(5, 3))
    >>> direction(World(things), 2, 1, "away")
    (1.0, 0.0)
    """
    way = front.removeprefix("faces_")
    if not world.deep or way not in _TURNS or x == y:
        return None
    dx, dy = map(float, world.offset(x, y))
    far = (dx * dx + dy * dy) ** 0.5
    if not far:
        return None
    cos, sin = _TURNS[way]
    ahead = (sin * dx + cos * dy) / far
    return (cos * dx - sin * dy) / far, (ahead if way == front else -ahead)


_TURNS = {"away": (1, 0), "left": (0, -1), "right": (0, 1), "towards": (-1, 0)}
"""The cosine and sine of the turn after which that front is ahead."""


def distance(world: World, x: int, y: int) -> float:
    """How far two things are from each other, in metres.

    >>> from kille.lab.worlds.worlds import Thing
    >>> things = Thing("cup", "red", place=(2, 3)), Thing("car", "red", place=(5, 7))
    >>> distance(World(things), 1, 2)
    0.5
    """
    return STEP * math.hypot(*world.offset(x, y))


def comparative(word: str, x: str, y: str, look: str) -> float | tuple[float, float]:
    """The degree of a comparative of two things in a look: 1, 0, or ½ of equals.

    Things are as tall and as long as they are big; how far away they are is not seen in
    a flat picture.

    >>> from kille.lab.worlds.worlds import Thing
    >>> things = Thing("cup", "red", 0.1, (2, 3)), Thing("car", "red", 0.9, (5, 7))
    >>> comparative("bigger_than", "o2", "o1", World(things).name)
    1.0
    """
    world = World.from_name(look)
    if world is None or not {number_of(x), number_of(y)} <= {*world.in_view}:
        return 0.0, 1.0
    more = word.partition("_")[0] in ("bigger", "taller", "longer", "further")
    far = word in ("nearer_than", "further_than", "closest_to", "furthest_from")
    if far and not world.deep:
        return 0.0, 1.0
    one, other = (
        world.place(number_of(it))[1] if far else world.thing(number_of(it)).size
        for it in (x, y)
    )
    return 0.5 if one == other else float((one > other) is more)


def between(x: str, y: str, z: str, look: str) -> float | tuple[float, float]:
    """Whether a thing is between two others in a look, on the line or beside it.

    >>> from kille.lab.worlds.worlds import Thing
    >>> row = [Thing("cup", "red", place=(n, 3)) for n in (2, 5, 7)]
    >>> look = World(tuple(row)).name
    >>> between("o2", "o1", "o3", look), between("o1", "o2", "o3", look)
    (1.0, 0.0)
    """
    world = World.from_name(look)
    numbers = [number_of(it) for it in (x, y, z)]
    if world is None or not {*numbers} <= {*world.in_view} or not world.deep:
        return 0.0, 1.0
    if len({*numbers}) < 3:
        return 0.0, 1.0
    (ax, ay), (bx, by) = (
        world.offset(numbers[0], numbers[1]),
        world.offset(numbers[2], numbers[1]),
    )
    far = bx * bx + by * by
    if not far:
        return 0.0
    along = (ax * bx + ay * by) / far
    aside = abs(ax * by - ay * bx) / far
    return float(0.0 < along < 1.0 and aside < ASIDE)


def oddness(world: World, number: int) -> float:
    """How far the features of a thing are from what is typical of its kind.

    >>> from kille.lab.worlds.worlds import Thing
    >>> oddness(World((Thing("cup", "red", place=(2, 3)),)), 1) >= 0
    True
    """
    own = _normal(f"thing {world.traits} {number} {TRAITS}", TRAITS)
    return math.hypot(*own)


def _blur(typical: Vector, world: World, number: int) -> Vector:
    """Typical features with the noise of this thing and of this look."""
    n = len(typical)
    own = _normal(f"thing {world.traits} {number} {n}", n)
    now = _normal(f"look {world.traits} {number} {world.glance} {n}", n)
    return tuple(
        a + world.noise * (b + LOOKS * c)
        for a, b, c in zip(typical, own, now, strict=True)
    )


@lru_cache(8192)
def _uniform(seed: str, n: int) -> Vector:
    random = Random(seed)
    return tuple(random.random() for _ in range(n))


@lru_cache(65536)
def _normal(seed: str, n: int) -> Vector:
    random = Random(seed)
    return tuple(random.gauss(0.0, 1.0) for _ in range(n))
