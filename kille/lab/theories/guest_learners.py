"""Guests among the whole robot's learners: others judge, in the place of its own.

Lessons are kept as ever, so that the robot can say what reminds it and take them back;
but the degrees of words are those of a pupil who has heard them all.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from kille.lab.theories.candidates import Make
from kille.lab.theories.pupils import Pupil, PupilLesson
from kille.perception.descriptor_index import View
from kille.perception.evidence import Evidence
from kille.perception.learners import Key
from kille.perception.objects import ObjectMemory
from kille.perception.relations import RelationMemory
from kille.scene import Configuration, Percept

_LEAST = 1e-9
"""What is left for no word, at least, so that degrees have logarithms."""

_CUE = "learner"
"""What speaks for a word where a guest judges."""


ShownLessons = dict[Key, PupilLesson[Percept]]
"""What a robot was shown, by the keys of its lessons."""


class GuestObjects(ObjectMemory):
    """An object memory in which a pupil judges, who is shown percepts.

    What is kept of lessons are views, and from these a robot knows its words again on
    another day; the pupil hears of each again what was `shown` of it.
    """

    def __init__(
        self, make: Make, shown: ShownLessons, views: Iterable[View] = ()
    ) -> None:
        super().__init__(views)
        self._pupil: Pupil[Percept] = Pupil(make)
        self._shown = shown

    def learn_one(self, x: Percept, label: str, *, key: Key | None = None) -> None:
        """Take the percept as an instance of it; ValueError if the key is taken."""
        named = self._own_key() if key is None else key
        super().learn_one(x, label, key=named)
        self._shown[named] = PupilLesson(named, x, label)

    def deny_one(self, x: Percept, label: str, *, key: Key | None = None) -> None:
        """Take the percept as no instance of it; ValueError if the key is taken."""
        named = self._own_key() if key is None else key
        super().deny_one(x, label, key=named)
        self._shown[named] = PupilLesson(named, x, label, holds=False)

    def evidence(self, x: Percept) -> Evidence:
        """What the pupil says of each word, as what one cue adds for it."""
        labels = self.labels
        if not labels:
            return Evidence((), 0.0, {})
        known = {view.key for view in (*self.views, *self.denied)}
        heard = [it for it in self._shown.values() if it.key in known]
        found = self._pupil.degrees(heard, x)
        degrees = np.array([found.get(word, 0.0) for word in labels])
        return Evidence(labels, 0.0, {_CUE: logits(degrees)})


class GuestRelations(RelationMemory):
    """A relation memory in which a pupil judges, who is shown configurations."""

    def __init__(self, make: Make) -> None:
        super().__init__()
        self._pupil: Pupil[Configuration] = Pupil(make)

    def degrees(self, x: Configuration) -> dict[str, float]:
        """How well each learned word fits x."""
        heard = [
            PupilLesson(key, it.x, it.label, not it.denies)
            for key, it in self._heard.items()
        ]
        found = self._pupil.degrees(heard, x) if heard else {}
        return {word: min(max(found.get(word, 0.0), 0.0), 1.0) for word in self.labels}

    def degrees_of(
        self, seen: Sequence[Configuration], odds: NDArray[np.float64] | None = None
    ) -> list[dict[str, float]]:
        """The same of several configurations at once."""
        return [self.degrees(x) for x in seen]

    def predict_proba_one(self, x: Configuration) -> dict[str, float]:
        """How likely each word is the one to be said of x: as well as it fits."""
        degrees = self.degrees(x)
        whole = max(sum(degrees.values()), 1.0)
        return {word: degree / whole for word, degree in degrees.items()}


def logits(degrees: NDArray[np.float64]) -> NDArray[np.float64]:
    """The logarithms of how many times likelier each word is than none of them.

    >>> Evidence(("cup", "mug"), 0.0, {"": logits(np.array([0.5, 0.3]))}).degrees()
    {'cup': 0.5, 'mug': 0.3}
    """
    rest = max(1.0 - float(degrees.sum()), _LEAST)
    logs: NDArray[np.float64] = np.log(np.maximum(degrees, _LEAST) / rest)
    return logs
