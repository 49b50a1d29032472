"""What the robot has learned: lessons kept for good, and learners made of them."""

from __future__ import annotations

from dataclasses import dataclass

from kille.memory import Arrangement, Memory, ObjectLesson, Scan, Sighting, Turn
from kille.perception.index import View
from kille.perception.objects import ObjectMemory, kept_features
from kille.perception.relations import RelationMemory
from kille.scene import Percept, Point

__all__ = ["Evidence", "Knowledge"]


@dataclass(frozen=True)
class Evidence:
    """Where a lesson comes from: what was said, seen through which sensor, and when."""

    turn: Turn
    sensor: str
    time: float


class Knowledge:
    """The learners of words, which know what the memory holds and nothing else.

    A lesson is on disk before a learner has it, so that a memory that fails leaves
    both as they were: MemoryFileError.
    """

    def __init__(self, memory: Memory) -> None:
        self.memory = memory
        self.objects = ObjectMemory.of(map(_view, memory.objects()))
        self.relations = RelationMemory()
        for lesson in memory.relations():
            place = lesson.seen.offset
            self.relations.learn_one(place, lesson.word.name, key=lesson.key)

    def learn_noun(
        self, name: str, surface: str, percept: Percept, evidence: Evidence
    ) -> None:
        """Learn that this is what the word is said of."""
        features = kept_features(percept)
        seen = Sighting(
            evidence.sensor,
            evidence.time,
            (Scan(features.descriptors, features.points),),
            percept.region.place,
        )
        key = self.memory.learn_object(evidence.turn, name, surface, seen)
        self.objects.learn(View(key, name, features.descriptors))

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


def _view(lesson: ObjectLesson) -> View:
    (scan,) = lesson.seen.scans
    return View(lesson.key, lesson.word.name, scan.descriptors)
