"""Worlds: what there is on the table, as immutable values with a name.

The name of a world says all of it, so that a look at it is named by a text, and what is
seen in the look follows from that text alone: nothing else has to be kept anywhere.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from random import Random

from ttr.aliases import Alias, former_names

__all__ = [
    "COLOURS",
    "FRONTS",
    "KINDS",
    "SIDE",
    "STEP",
    "Place",
    "Thing",
    "World",
    "draw_world",
]

__getattr__ = former_names(__name__, {"drawn": "draw_world"})

KINDS = ("cup", "mug", "bowl", "book", "box", "apple", "car", "shoe")
"""What kinds of things there are.

>>> from kille.lab.worlds.worlds import KINDS
>>> print(*KINDS)
cup mug bowl book box apple car shoe
"""

COLOURS = {
    "red": (0.9, 0.1, 0.1),
    "orange": (0.9, 0.5, 0.1),
    "yellow": (0.9, 0.9, 0.1),
    "green": (0.1, 0.7, 0.1),
    "blue": (0.1, 0.2, 0.9),
    "black": (0.0, 0.0, 0.0),
    "white": (1.0, 1.0, 1.0),
    "brown": (0.5, 0.3, 0.1),
}
"""The colours of things: how much red, green and blue.

>>> from kille.lab.worlds.worlds import COLOURS
>>> COLOURS["red"]
(0.9, 0.1, 0.1)
"""

FRONTS = ("away", "left", "right", "towards")
"""The ways in which a thing may face, as the robot sees it.

>>> from kille.lab.worlds.worlds import FRONTS, Thing
>>> [Thing("car", "red", place=(2, 3), front=front).front for front in FRONTS]
['away', 'left', 'right', 'towards']
"""

SIDE = 10
"""The table is so many steps wide, and deep.

>>> from kille.lab.worlds.worlds import SIDE
>>> SIDE
10
"""

STEP = 0.1
"""Metres of a step.

>>> from kille.lab.worlds.worlds import SIDE, STEP
>>> SIDE * STEP
1.0
"""

Place = tuple[float, float]
"""Steps to the right, and steps away from the robot, to the thousandth at most.

>>> from kille.lab.worlds.worlds import Place, Thing
>>> near_left: Place = (1, 1)
>>> Thing("cup", "red", place=near_left).place
(1, 1)
"""


@dataclass(frozen=True)
class Thing:
    """A thing of a kind and a colour, small at 0 and big at 1.

    It is at a place on the table, or not in view; it may have a front.

    >>> Thing("cup", "red", size=0.2, place=(2, 3)).kind
    'cup'
    """

    kind: str
    colour: str
    size: float = 0.5
    place: Place | None = None
    front: str = ""

    def __str__(self) -> str:
        place = "" if self.place is None else f" {self.place[0]:g},{self.place[1]:g}"
        front = self.front and f" {self.front}"
        return f"{self.colour} {self.kind} {self.size:g}{place}{front}"


@dataclass(frozen=True)
class World:
    """The things that there are, which one is pointed at, and how well one sees.

    `traits` is the seed of what each kind looks like, `noise` how much things of a kind
    and looks at a thing differ, `glance` counts what has happened. A world that is not
    `deep` is seen as a flat picture: where things are is not known.

    >>> world = World((Thing("cup", "red", 0.5, (2, 3)), Thing("car", "blue")))
    >>> world.move(2, (7, 3)).point_at(2).name
    'look2 of 0~0.05: red cup 0.5 2,3; *blue car 0.5 7,3'
    >>> World.from_name(world.name) == world
    True
    """

    things: tuple[Thing, ...] = ()
    focus: int | None = None
    deep: bool = True
    traits: int = 0
    noise: float = 0.05
    glance: int = 0

    @cached_property
    def name(self) -> str:
        """The name of a look at this world, which says all of it."""
        things = (
            f"{'*' * (number == self.focus)}{thing}"
            for number, thing in enumerate(self.things, start=1)
        )
        flat = "" if self.deep else " flat"
        seen = f"look{self.glance} of {self.traits}~{self.noise:g}{flat}"
        return f"{seen}: {'; '.join(things)}"

    @staticmethod
    @lru_cache(8192)
    def from_name(name: str) -> World | None:
        """The world that a look of this name is at; None for any other text."""
        found = _NAME.fullmatch(name)
        if found is None:
            return None
        texts = found["things"].split("; ") if found["things"] else []
        things = [_THING.fullmatch(text) for text in texts]
        focus = [i for i, it in enumerate(texts, start=1) if it.startswith("*")]
        if not all(things) or len(focus) > 1:
            return None
        return World(
            tuple(_read_thing(thing) for thing in things if thing),
            focus[0] if focus else None,
            not found["flat"],
            int(found["traits"]),
            float(found["noise"]),
            int(found["glance"]),
        )

    def __contains__(self, number: object) -> bool:
        """Whether the thing with this number is in view."""
        return isinstance(number, int) and number in self.in_view

    @cached_property
    def in_view(self) -> tuple[int, ...]:
        """The numbers of the things in view."""
        things = enumerate(self.things, start=1)
        return tuple(number for number, thing in things if thing.place is not None)

    @cached_property
    def attended_thing(self) -> int | None:
        """The thing that "this" speaks of: what is pointed at, or the nearest."""
        if self.focus in self.in_view:
            return self.focus
        return min(self.in_view, key=self._nearness, default=None)

    def _nearness(self, number: int) -> tuple[float, float, int]:
        right, away = self.place(number)
        return away, right, number

    def thing(self, number: int) -> Thing:
        """The thing with this number."""
        return self.things[number - 1]

    def place(self, number: int) -> Place:
        """Where a thing in view is."""
        place = self.thing(number).place
        if place is None:
            raise ValueError(f"thing {number} of {self.name} is not in view")
        return place

    def offset(self, x: int, y: int) -> Place:
        """How many steps x is to the right of y, and how many farther away."""
        (ax, ay), (bx, by) = self.place(x), self.place(y)
        return ax - bx, ay - by

    # --- what may happen -------------------------------------------------------------

    def move(self, number: int, place: Place | None) -> World:
        """The world in which a thing is put somewhere, or taken away."""
        return self._with(number, place=place)

    def turn(self, number: int, front: str) -> World:
        """The world in which a thing faces this way."""
        return self._with(number, front=front)

    def point_at(self, number: int | None) -> World:
        """The world in which this thing is pointed at, or none is."""
        return replace(self, focus=number, glance=self.glance + 1)

    def look_again(self) -> World:
        """The same world, looked at once more."""
        return replace(self, glance=self.glance + 1)

    def flip_depth(self) -> World:
        """The same world, but it is not seen any more where things are; or again."""
        return replace(self, deep=not self.deep, glance=self.glance + 1)

    def clear(self) -> World:
        """The world in which nothing is on the table."""
        things = tuple(replace(thing, place=None) for thing in self.things)
        return replace(self, things=things, glance=self.glance + 1)

    def free_places(self) -> Iterable[Place]:
        """The places where nothing is, from the left and from the front."""
        taken = {thing.place for thing in self.things}
        everywhere = ((x, y) for y in range(SIDE) for x in range(SIDE))
        return (place for place in everywhere if place not in taken)

    def _with(self, number: int, **changes: object) -> World:
        things = list(self.things)
        things[number - 1] = replace(things[number - 1], **changes)  # type: ignore[arg-type]
        return replace(self, things=tuple(things), glance=self.glance + 1)

    moved = Alias("move")
    turned = Alias("turn")
    pointed = Alias("point_at")
    looked = Alias("look_again")
    seen_flat = Alias("flip_depth")
    cleared = Alias("clear")
    named = Alias("from_name")
    attended = Alias("attended_thing")
    free = Alias("free_places")


_NAME = re.compile(
    r"look(?P<glance>\d+) of (?P<traits>\d+)~(?P<noise>[\d.e-]+)(?P<flat> flat)?"
    r": (?P<things>.*)"
)
_THING = re.compile(
    r"\*?(?P<colour>[\w-]+) (?P<kind>[\w-]+) (?P<size>[\d.e-]+)"
    r"( (?P<x>-?[\d.]+),(?P<y>-?[\d.]+))?( (?P<front>away|left|right|towards))?"
)


def _read_thing(found: re.Match[str]) -> Thing:
    place = None if found["x"] is None else (float(found["x"]), float(found["y"]))
    size, front = float(found["size"]), found["front"] or ""
    return Thing(found["kind"], found["colour"], size, place, front)


def draw_world(
    seed: int,
    things: int = 8,
    in_view: int = 4,
    *,
    kinds: Sequence[str] = KINDS,
    colours: Sequence[str] = tuple(COLOURS),
    noise: float = 0.05,
    deep: bool = True,
) -> World:
    """A world of so many things, of which the first are in view, by the seed.

    No two of them are of one kind and one colour.

    >>> print(draw_world(1, 3, 2).name)
    look0 of 1~0.05: ...
    """
    random = Random(f"world {seed}")
    looks = random.sample([(kind, hue) for kind in kinds for hue in colours], things)
    places = random.sample([(x, y) for x in range(SIDE) for y in range(SIDE)], things)
    found = [
        Thing(
            kind,
            colour,
            random.choice((0.1, 0.5, 0.9)),
            place if number < in_view else None,
            random.choice(("", *FRONTS)),
        )
        for number, ((kind, colour), place) in enumerate(
            zip(looks, places, strict=True)
        )
    ]
    return World(tuple(found), deep=deep, traits=seed, noise=noise)
