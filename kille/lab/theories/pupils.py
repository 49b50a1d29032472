"""Learners that are taught what a robot was taught: those of the robot, or one's own.

What a robot knows are its lessons, and they may be taken back. A learner that changes
as it learns follows them: before it is asked, it is taught what it lacks, and forgets
what is no longer there. So what it says depends on the lessons only, as long as to
forget is for it to be as if it had never learned.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Generic, NamedTuple, TypeVar

from kille.lab.theories.candidates import Make, degrees_of
from kille.perception.learners import Key

X = TypeVar("X")


class PupilLesson(NamedTuple, Generic[X]):
    """A lesson: its key, what was seen, and the word that holds of it, or does not."""

    key: Key
    x: X
    label: str
    holds: bool = True


class Pupil(Generic[X]):
    """A learner that is kept up to date with lessons; `make` gives a new one.

    >>> class Last:
    ...     def learn_one(self, x, label, key): self.label = label
    ...     def predict_proba_one(self, x): return {self.label: 1.0}
    >>> heard = [PupilLesson(1, "o1", "cup"), PupilLesson(2, "o2", "mug")]
    >>> Pupil(Last).degrees(heard, "o3")
    {'mug': 1.0}
    """

    def __init__(self, make: Make) -> None:
        self._make = make
        self._learner = make()
        self._taught: dict[Key, PupilLesson[X]] = {}
        self._followed: Sequence[PupilLesson[X]] = ()
        self._asked: tuple[X, Mapping[str, float]] | None = None

    def degrees(self, heard: Sequence[PupilLesson[X]], x: X) -> Mapping[str, float]:
        """The degrees of the words after these lessons, for what is seen."""
        if heard is not self._followed:
            self._follow(heard)
            self._followed = heard
        if self._asked is None or self._asked[0] != x:
            self._asked = x, degrees_of(self._learner, x)
        return self._asked[1]

    def _follow(self, heard: Sequence[PupilLesson[X]]) -> None:
        now = {lesson.key: lesson for lesson in heard}
        gone = [key for key, it in self._taught.items() if now.get(key) != it]
        kept = self._taught.keys() - gone
        new = [it for key, it in now.items() if key not in kept]
        if not gone:
            self._learn(new)
            return
        if hasattr(self._learner, "forget"):
            for key in gone:
                self._forget(key)
            self._learn(new)
            return
        self._learner, self._taught = self._make(), {}
        self._learn(heard)

    def _learn(self, lessons: Sequence[PupilLesson[X]]) -> None:
        for lesson in lessons:
            self._asked = None
            self._taught[lesson.key] = lesson
            if lesson.holds:
                self._learner.learn_one(lesson.x, lesson.label, key=lesson.key)
            elif hasattr(self._learner, "deny_one"):
                self._learner.deny_one(lesson.x, lesson.label, key=lesson.key)
            elif hasattr(self._learner, "judge_one"):
                self._learner.judge_one(lesson.x, lesson.label, 0.0, key=lesson.key)

    def _forget(self, key: Key) -> None:
        self._asked = None
        lesson = self._taught.pop(key)
        denying = ("deny_one", "judge_one")
        if lesson.holds or any(hasattr(self._learner, it) for it in denying):
            self._learner.forget(key)
