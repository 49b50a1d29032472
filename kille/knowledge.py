"""What the robot has learned: lessons kept for good, and learners made of them."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kille.memory import Arrangement, Memory, ObjectLesson, Scan, Sighting, Turn
from kille.perception.index import View
from kille.perception.objects import ObjectMemory, kept_features
from kille.perception.relations import RelationMemory
from kille.scene import Percept, Point, Traits

__all__ = ["Evidence", "Knowledge"]


@dataclass(frozen=True)
class Evidence:
    """Where a lesson comes from: what was said, seen through which sensor, and when."""

    turn: Turn
    sensor: str
    time: float


class Knowledge:
    """The learners of words, which know what the memory holds and nothing else.

    What is learned inside `together` is on disk when that ends; if anything fails, the
    memory and the learners are as they were. MemoryFileError as the memory raises it.
    """

    def __init__(self, memory: Memory) -> None:
        self.memory = memory
        self._unlearning = ExitStack()
        self.objects = ObjectMemory.of(map(_view, memory.objects()))
        self.relations = RelationMemory()
        for lesson in memory.relations():
            place = lesson.seen.offset
            self.relations.learn_one(place, lesson.word.name, key=lesson.key)

    @contextmanager
    def together(self) -> Iterator[None]:
        """All that is learned and kept inside is so for good, or none of it."""
        with ExitStack() as self._unlearning:
            with self.memory.together():
                yield
            self._unlearning.pop_all()

    def learn_noun(
        self, name: str, surface: str, percept: Percept, evidence: Evidence
    ) -> None:
        """Learn that this is what the word is said of."""
        features, traits = kept_features(percept), percept.traits
        seen = Sighting(
            evidence.sensor,
            evidence.time,
            (Scan(features.descriptors, features.points),),
            percept.region.place,
            traits.colour,
            None if traits.size is None else _lengths(traits.size),
        )
        key = self.memory.learn_object(evidence.turn, name, surface, seen)
        self.objects.learn(View(key, name, features.descriptors, traits))
        self._unlearning.callback(self.objects.forget, key)

    def learn_relation(
        self,
        name: str,
        surface: str,
        things: tuple[str, str],
        offset: Point,
        evidence: Evidence,
    ) -> None:
        """Learn that the relation holds of a target that is so far from a landmark."""
        target, landmark = things
        seen = Arrangement(evidence.sensor, evidence.time, target, landmark, offset)
        key = self.memory.learn_relation(evidence.turn, name, surface, seen)
        self.relations.learn_one(offset, name, key=key)
        self._unlearning.callback(self.relations.forget, key)


def _view(lesson: ObjectLesson) -> View:
    seen = lesson.seen
    (scan,) = seen.scans
    size = None if seen.size is None else np.array(seen.size, np.float32)
    traits = Traits(seen.colour, size)
    return View(lesson.key, lesson.word.name, scan.descriptors, traits)


def _lengths(size: NDArray[np.float32]) -> tuple[float, float, float]:
    length, breadth, thickness = size.tolist()
    return length, breadth, thickness
