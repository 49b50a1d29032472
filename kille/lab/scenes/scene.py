"""A scene, and its occasions: what there is to talk of, in front of a tutor.

An occasion is a value: the world, the thing that is talked of, and what it is compared
with. Scenes give them in rounds, and a phase of a study brings them in an order.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import zip_longest
from random import Random

from kille.lab.worlds.worlds import Thing, World
from ttr.aliases import Alias

KINDS = {"nouns": "noun", "adjectives": "adjective", "relations": "relation"}
"""The kinds of words, by what a phase says that it is about."""

ORDERS = ("given", "shuffled", "blocked", "interleaved", "easy first", "hard first")
"""The orders in which occasions may come."""


@dataclass(frozen=True)
class Occasion:
    """Something to talk of: a thing in a world, by itself or beside another one.

    `kind` is that of the word that is talked about. `seen` is what the robot sees,
    where that is not what there is; `said` is what somebody has said of it, where that
    is known; `view` is what a scene of its own kind needs to show it. `group` is what
    word it is an example of, `hard` how little it is like the others.

    >>> from kille.lab.worlds.worlds import World, Thing
    >>> occasion = Occasion("noun", World((Thing("cup", "red", place=(2, 3)),)), 1)
    >>> occasion.thing.kind
    'cup'
    """

    kind: str
    world: World
    x: int
    y: int | None = None
    seen: World | None = None
    said: str = ""
    view: object = None
    group: str = ""
    hard: float = 0.0

    @property
    def world_seen(self) -> World:
        """What the robot sees."""
        return self.world if self.seen is None else self.seen

    @property
    def thing(self) -> Thing:
        """What is talked of."""
        return self.world.thing(self.x)

    @property
    def landmark(self) -> Thing | None:
        """What it is beside, if that is talked of."""
        return None if self.y is None else self.world.thing(self.y)

    def name(self, number: int) -> str:
        """A name for a thing by which it is told from the others: "red cup"."""
        thing = self.world.thing(number)
        return f"{thing.colour} {thing.kind}".strip()

    def about_noun(self, x: int | None) -> Occasion:
        """The same, but it is another thing that is talked of, and pointed at."""
        x = self.x if x is None else x
        seen = None if self.seen is None else replace(self.seen, focus=x)
        world, said = replace(self.world, focus=x), self.said if x == self.x else ""
        return replace(
            self, kind="noun", world=world, seen=seen, x=x, y=None, said=said
        )

    def without_pointing(self) -> Occasion:
        """The same, but nothing is pointed at."""
        seen = None if self.seen is None else replace(self.seen, focus=None)
        return replace(self, world=replace(self.world, focus=None), seen=seen)

    def at_glance(self, glance: int) -> Occasion:
        """The same, as it is looked at for this time."""
        seen = None if self.seen is None else replace(self.seen, glance=glance)
        return replace(self, world=replace(self.world, glance=glance), seen=seen)

    def look_again(self) -> Occasion:
        """The same, looked at once more."""
        return self.at_glance(self.world.glance + 1)

    shown = Alias("world_seen")
    of_noun = Alias("about_noun")
    unpointed = Alias("without_pointing")
    looked = Alias("look_again")
    at = Alias("at_glance")


@dataclass(frozen=True)
class Scene(ABC):
    """What there is to talk of in a run; `start` has all things as the run begins.

    >>> from kille.lab.worlds.worlds import Thing, World
    >>> class OneCup(Scene):
    ...     kinds = ("noun",)
    ...     def round(self, kind, new, chance):
    ...         return [Occasion(kind, self.start, 1)]
    >>> table = OneCup(World((Thing("cup", "red", place=(2, 3)),)))
    >>> [it.thing.kind for it in table.round("noun", True, Random(1))]
    ['cup']
    """

    start: World

    @property
    def kinds(self) -> tuple[str, ...]:
        """What kinds of things there are."""
        return tuple(dict.fromkeys(it.kind for it in self.start.things))

    @abstractmethod
    def round(self, kind: str, new: bool, chance: Random) -> Sequence[Occasion]:
        """An occasion for each thing, or place, that words of a kind may be said of.

        Those that are `new` are kept from all the others.
        """


def order_occasions(
    rounds: Iterable[Sequence[Occasion]], order: str, chance: Random
) -> list[Occasion]:
    """Occasions that come in rounds, one after the other, in one of the `ORDERS`.

    `given` is round by round, and so is `shuffled`, each in an order of its own;
    `blocked` has all that are of one word in a row, `interleaved` never two if it can
    be helped.

    >>> from kille.lab.worlds.worlds import World
    >>> ring = [Occasion("noun", World(), 1, group=word) for word in "aab"]
    >>> [it.group for it in order_occasions([ring, ring], "blocked", Random(1))]
    ['a', 'a', 'a', 'a', 'b', 'b']
    >>> [it.group for it in order_occasions([ring, ring], "interleaved", Random(1))]
    ['a', 'b', 'a', 'b', 'a', 'a']
    """
    given = [list(one) for one in rounds]
    together = [it for one in given for it in one]
    match order:
        case "shuffled":
            return [it for one in given for it in chance.sample(one, len(one))]
        case "blocked":
            return [it for block in _group_occasions(together) for it in block]
        case "interleaved":
            return list(_interleave(together))
        case "easy first":
            return sorted(together, key=lambda it: it.hard)
        case "hard first":
            return sorted(together, key=lambda it: -it.hard)
    return together


def _group_occasions(them: Sequence[Occasion]) -> list[list[Occasion]]:
    groups = dict.fromkeys(it.group for it in them)
    return [[it for it in them if it.group == group] for group in groups]


def _interleave(them: Sequence[Occasion]) -> Iterator[Occasion]:
    for together in zip_longest(*_group_occasions(them)):
        yield from (it for it in together if it is not None)
