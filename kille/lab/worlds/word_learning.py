"""Words that learn: what a word is true of, as a value that is replaced by lessons.

A word judges what is seen by how near it is to what it was said, or denied, to be true
of. With p the sum of a kernel over the lessons that say so, and n over those that deny
it, the degree is p / (p + n + r), where r is how little a word is sure of from afar. A
word is judged by its own lessons only, so that what one word learns changes no other,
and to take a lesson away is to have never had it.

An adjective may speak of the colour or of the size: that aspect counts in which things
that it is true of are alike, and those that it is not true of are not. A relation is
taken to speak of the direction, until what it is true of is more alike in how far away
it is.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations
from typing import NamedTuple

from kille.dialogue.meanings import word_of
from kille.lab.worlds.perception import (
    Vector,
    colour,
    direction,
    distance,
    number_of,
    size,
    traits,
)
from kille.lab.worlds.worlds import COLOURS, World
from ttr import Record

Observation = tuple[Vector, ...]
"""The features that are seen, aspect by aspect."""

ASPECTS = {
    "noun": ("features",),
    "adjective": ("colour", "size"),
    "relation": ("configuration", "distance"),
}
"""What words of a kind may speak of."""

BY_CHANCE = (0.32, 0.4)
"""The expected similarity of two random places in direction and in distance."""

EXPECTED = 2
"""The number of imaginary pairs of lessons that agree in the direction."""

FARTHER = 0.6
"""The width of the kernel of distances, in natural logarithms."""

UNKNOWN = (0.0, 1.0)
BACKGROUND = 0.25
"""The weight against every word where there are no lessons."""

WIDTH = 0.3
"""The width of the kernel of features."""

LEAST = 0.02
"""The least weight of an aspect."""


class WordLesson(NamedTuple):
    """A lesson: its key, what was seen, and whether the word was said to hold of it.

    Lessons of all words are numbered in the order in which they were given.
    """

    key: str
    of: Observation
    holds: bool = True
    number: int = 0


class WordCriterion(NamedTuple):
    """What was said of a cue, or of all things that the word is true of: its key.

    `cue` is empty for what the word is not judged by.
    """

    key: str
    cue: str
    matters: bool


@dataclass(frozen=True, eq=False)
class LearnedWord:
    """What a word is true of by its lessons; it is called to judge its predicate.

    `prior` is what is known of it without any lesson, `count` how many it has had;
    `criteria` are what was said by what it is known.

    >>> from kille.dialogue.meanings import noun
    >>> from kille.lab.worlds.worlds import Thing
    >>> things = Thing("cup", "red", place=(2, 3)), Thing("car", "red", place=(5, 3))
    >>> world = World(things)
    >>> cup = LearnedWord(noun("cup")).after_lesson("o1", world.name)
    >>> cup("o1", world.name), round(cup("o2", world.name), 3)
    (0.8, ...)
    """

    sign: Record
    lessons: tuple[WordLesson, ...] = ()
    prior: tuple[WordLesson, ...] = ()
    count: int = 0
    criteria: tuple[WordCriterion, ...] = ()

    @classmethod
    def without_lessons(cls, sign: Record) -> LearnedWord:
        """A word that was never taught: colours are known all the same."""
        shade = COLOURS.get(word_of(sign).name.removeprefix("is_"))
        if sign.kind != "adjective" or shade is None:
            return cls(sign)
        return cls(sign, prior=(WordLesson("", (shade,)),))

    def __call__(self, *args: str) -> float | tuple[float, float]:
        """The degree to which it is true of a thing, or two, in a look."""
        of = observe(self.sign.kind, *args)
        if of is None or not (self.lessons or self.prior):
            return UNKNOWN if of is None or self.sign.kind == "adjective" else 0.0
        return self.degree(of)

    def degree(self, of: Observation) -> float:
        """The degree to which it is true of what is seen."""
        shares = self.weights()
        return math.fsum(
            share * self._degree(aspect, of) for aspect, share in enumerate(shares)
        )

    def after_lesson(
        self, *args: str, holds: bool = True, number: int = 0
    ) -> LearnedWord:
        """The word after one more lesson, which is about this in a look."""
        of = observe(self.sign.kind, *args)
        if of is None:
            raise ValueError(
                f"{args} is not to be seen, so that nothing is to be learned"
            )
        count = self.count + 1
        lesson = WordLesson(f"{word_of(self.sign).name}/{count}", of, holds, number)
        return replace(self, lessons=(*self.lessons, lesson), count=count)

    def without_lesson(self, key: str) -> LearnedWord:
        """The word as if it had never been given this lesson."""
        left = tuple(lesson for lesson in self.lessons if lesson.key != key)
        said = tuple(it for it in self.criteria if it.key != key)
        return replace(self, lessons=left, criteria=said)

    def after_criterion(self, cue: str, matters: bool) -> LearnedWord:
        """The word after it was said that it is known by this, or not."""
        key = f"{word_of(self.sign).name}/{self.count + 1}"
        said = (*self.criteria, WordCriterion(key, cue, matters))
        return replace(self, criteria=said, count=self.count + 1)

    @property
    def keys(self) -> tuple[str, ...]:
        """The keys of its lessons, and of what was said by what it is known."""
        return (*(it.key for it in self.lessons), *(it.key for it in self.criteria))

    @property
    def aspects(self) -> Sequence[str]:
        """What the word may speak of."""
        return ASPECTS[self.sign.kind]

    @property
    def is_known(self) -> bool:
        """Whether it is known to be true of anything."""
        return any(lesson.holds for lesson in (*self.prior, *self.lessons))

    def nearest(self, of: Observation) -> WordLesson | None:
        """The positive lesson that is most similar to what is seen."""
        holding = [lesson for lesson in self.lessons if lesson.holds]
        return max(
            holding, key=lambda it: self._overall_similarity(it.of, of), default=None
        )

    def cues(self, of: Observation) -> Sequence[tuple[str, float]]:
        """The cues that speak for the word with their shares, the largest first."""
        speaks = {
            name: share * self._degree(aspect, of)
            for aspect, (name, share) in enumerate(
                zip(self.aspects, self.weights(), strict=False)
            )
        }
        whole = math.fsum(speaks.values())
        shares = [(name, it / whole) for name, it in speaks.items() if it > 0.0]
        return sorted(shares, key=lambda it: -it[1])

    def weights(self) -> Sequence[float]:
        """The weights of the aspects."""
        return self._weights

    @cached_property
    def _weights(self) -> Sequence[float]:
        if self.prior:
            return (1.0,)
        kinds = ASPECTS[self.sign.kind]
        if len(kinds) == 1:
            return (1.0,)
        agreeing = (
            self._place_agreement if self.sign.kind == "relation" else self._agreement
        )
        agreement = [agreeing(aspect) for aspect in range(len(kinds))]
        whole = math.fsum(agreement)
        return [one / whole for one in agreement] if whole else (1.0, 0.0)

    def _place_agreement(self, aspect: int) -> float:
        """How much more alike than by chance the places are that it is true of.

        At first it is the direction that is expected to be alike, and nothing else.
        """
        pairs = combinations([it.of for it in self.lessons if it.holds], 2)
        same = [
            self.similarity(one[aspect], other[aspect], aspect) for one, other in pairs
        ]
        expected = EXPECTED if aspect == 0 else 0.0
        mean = (math.fsum(same) + expected) / (len(same) + EXPECTED)
        return max(0.0, (mean - BY_CHANCE[aspect]) / (1.0 - BY_CHANCE[aspect]))

    def _agreement(self, aspect: int) -> float:
        """How well an aspect separates positive lessons from negative ones."""
        same, apart = [], []
        for one, other in combinations(self.lessons, 2):
            if one.holds and other.holds:
                same.append(self.similarity(one.of[aspect], other.of[aspect], aspect))
            elif one.holds or other.holds:
                apart.append(self.similarity(one.of[aspect], other.of[aspect], aspect))
        return max(LEAST, _mean(same, 1.0) - _mean(apart, 0.0))

    def _degree(self, aspect: int, of: Observation) -> float:
        says, denies = (self.support(aspect, of, holds) for holds in (True, False))
        return says / (says + denies + BACKGROUND)

    def support(self, aspect: int, of: Observation, holds: bool) -> float:
        """The support of positive, or of negative, lessons for this, in an aspect."""
        seen = of[aspect]
        lessons = (it for it in (*self.prior, *self.lessons) if it.holds is holds)
        return math.fsum(self.similarity(it.of[aspect], seen, aspect) for it in lessons)

    def _overall_similarity(self, one: Observation, other: Observation) -> float:
        shares = self.weights()
        return math.fsum(
            w * self.similarity(one[i], other[i], i) for i, w in enumerate(shares)
        )

    def similarity(self, one: Vector, other: Vector, aspect: int) -> float:
        """The similarity of two things in an aspect: the kernel, 1 for the same."""
        if self.sign.kind != "relation":
            return _gaussian(one, other)
        return (_cosine, _as_far)[aspect](one, other)


def observe(kind: str, *args: str) -> Observation | None:
    """The features of what a word is said of; None if it is not in view."""
    *things, look = args[:3] if kind == "relation" else args
    world = World.from_name(look)
    numbers = [number_of(x) for x in things]
    if world is None or not all(number in world for number in numbers):
        return None
    match kind:
        case "noun":
            seen = traits, colour, size
            return tuple(it(world, numbers[0]) for it in seen)
        case "adjective":
            return colour(world, numbers[0]), size(world, numbers[0])
    way = direction(world, numbers[0], numbers[1], args[3])
    return None if way is None else (way, (distance(world, *numbers),))


def _cosine(a: Vector, b: Vector) -> float:
    """The similarity of two directions: the cosine of their angle, at least 0."""
    dot = math.fsum(p * q for p, q in zip(a, b, strict=True))
    return max(0.0, dot) / ((math.hypot(*a) * math.hypot(*b)) or 1.0)


def _as_far(a: Vector, b: Vector) -> float:
    """The similarity of two distances."""
    farther = math.log(a[0] / b[0])
    return math.exp(-((farther / FARTHER) ** 2))


def _gaussian(a: Vector, b: Vector) -> float:
    far = math.fsum((p - q) ** 2 for p, q in zip(a, b, strict=True))
    return math.exp(-far / WIDTH**2)


def _mean(values: Sequence[float], none: float) -> float:
    return math.fsum(values) / len(values) if values else none
