"""What the robot has learned: lessons kept for good, and learners made of them."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass

import numpy as np

from kille.memory import (
    Arrangement,
    Memory,
    ObjectLesson,
    Picture,
    Scan,
    Sighting,
    Turn,
)
from kille.perception.cues import CUES, measured
from kille.perception.index import Background, View
from kille.perception.objects import NO_FEATURES, ObjectMemory, kept_features
from kille.perception.relations import RelationMemory
from kille.perception.thumbnails import evidence_of, restored
from kille.scene import Configuration, Percept, Region, Traits

__all__ = ["Evidence", "Knowledge", "Named"]

Named = tuple[str, Percept]
"""A thing and the name of its word."""


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
        self.objects = ObjectMemory(
            (_view(memory, lesson) for lesson in memory.objects()), builder=Background()
        )
        self.relations = RelationMemory()
        for lesson in memory.relations():
            stand = lesson.seen.configuration
            self.relations.learn_one(stand, lesson.word.name, key=lesson.key)

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
        features, traits = kept_features(percept), self.objects.traits_of(percept)
        seen = Sighting(
            evidence.sensor,
            evidence.time,
            (Scan(features.descriptors, features.points),),
            percept.region.place,
            traits,
            _picture(percept),
        )
        key = self.memory.learn_object(evidence.turn, name, surface, seen)
        self.objects.learn(View(key, name, features.descriptors, traits))
        self._unlearning.callback(self.objects.forget, key)

    def learn_relation(
        self,
        name: str,
        surface: str,
        things: tuple[Named, Named],
        stand: Configuration,
        evidence: Evidence,
    ) -> None:
        """Learn that the relation holds of a target that stands so to a landmark."""
        (target, percept), (landmark, other) = things
        picture = _picture(percept, other.region)
        seen = Arrangement(
            evidence.sensor, evidence.time, target, landmark, stand, picture
        )
        key = self.memory.learn_relation(evidence.turn, name, surface, seen)
        self.relations.learn_one(stand, name, key=key)
        self._unlearning.callback(self.relations.forget, key)


def _picture(percept: Percept, *others: Region) -> Picture | None:
    """What is kept to show what was seen; nothing of what was only described."""
    frame = percept.frame
    return None if frame is None else evidence_of(frame, percept.region, *others)


def _view(memory: Memory, lesson: ObjectLesson) -> View:
    descriptors = np.concatenate(
        [NO_FEATURES.descriptors, *(it.descriptors for it in lesson.seen.scans)]
    )
    traits = _up_to_date(memory, lesson)
    return View(lesson.key, lesson.word.name, descriptors, traits)


def _up_to_date(memory: Memory, lesson: ObjectLesson) -> Traits:
    """The traits of a lesson, measured anew if cues have changed since it was given."""
    kept = {
        cue: vector
        for cue, vector in lesson.seen.traits.items()
        if cue in CUES and len(vector) == CUES[cue].length
    }
    if len(kept) == len(lesson.seen.traits) and kept:
        return kept
    picture = memory.picture(lesson.key)
    if picture is None or picture.crop is None:
        return kept
    try:
        return measured(*restored(picture.crop))
    except ValueError:  # a picture that another program made, and nobody can read
        return kept
