"""Spatial words: a linear support vector machine on where the target is.

What is learned from is the target's place minus the landmark's, in metres on level axes
(right, away, up; see `kille.perception.geometry.offset`). Each word has its own plane
that parts it from the others; the margins become degrees by a softmax.

A word is no evidence about places unlike those it was heard of. So all degrees are
multiplied by how near the offset is to one that was heard, exp(-d² / 2s²) with
s = 20 cm, and the rest is left to relations not yet learned. With one word only there
is nothing to part it from, and that nearness is its degree.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from kille.perception.geometry import Direction
from kille.perception.learners import Key

if TYPE_CHECKING:
    from sklearn.svm import LinearSVC

_UNIT = 0.1  # metres; offsets on a table are about one unit long
_STRICTNESS = 10.0
_SHARPNESS = 2.0
_NEARBY = 0.2  # metres: s


class RelationMemory:
    """A learner of spatial words, from offsets (right, away, up) in metres."""

    def __init__(self) -> None:
        self._heard: dict[Key, tuple[Direction, str]] = {}
        self._model: LinearSVC | None = None

    def copy(self) -> RelationMemory:
        """Another memory that knows the same; either learns without the other."""
        twin = RelationMemory()
        twin._heard, twin._model = dict(self._heard), self._model
        return twin

    @property
    def labels(self) -> tuple[str, ...]:
        """The learned words in alphabetical order."""
        return tuple(sorted({label for _, label in self._heard.values()}))

    def learn_one(self, x: Direction, label: str, *, key: Key) -> None:
        """Take the offset as an instance of it; ValueError if the key is taken."""
        if key in self._heard:
            raise ValueError(f"the key {key!r} was learned before; forget it first")
        self._heard[key] = (x, label)
        self._model = None

    def forget(self, key: Key) -> None:
        """Be as if this had never been learned; KeyError if it was not."""
        del self._heard[key]
        self._model = None

    def predict_proba_one(self, x: Direction) -> dict[str, float]:
        """The degree of each learned word for a target that is there."""
        labels = self.labels
        if not labels:
            return {}
        shares = np.ones(1) if len(labels) == 1 else self._shares(x)
        return dict(zip(labels, (self._nearness(x) * shares).tolist(), strict=True))

    def _nearness(self, x: Direction) -> float:
        places = np.array([place for place, _ in self._heard.values()])
        apart = np.linalg.norm(places - np.array(x), axis=1).min()
        return float(np.exp(-0.5 * (apart / _NEARBY) ** 2))

    def _shares(self, x: Direction) -> NDArray[np.float64]:
        """The softmax of the margins, in the order of the labels."""
        if self._model is None:
            self._model = self._fitted()
        margins = self._model.decision_function([np.array(x) / _UNIT])[0]
        if len(self._model.classes_) == 2:
            margins = np.array([-margins, margins])
        raised = np.exp(_SHARPNESS * (margins - margins.max()))
        shares: NDArray[np.float64] = raised / raised.sum()
        return shares

    def _fitted(self) -> LinearSVC:
        # Its import takes longer than all else at start: wait until a word needs it.
        from sklearn.svm import LinearSVC

        places = np.array([place for place, _ in self._heard.values()]) / _UNIT
        labels = [label for _, label in self._heard.values()]
        # In the primal form the solver takes no random steps.
        model = LinearSVC(C=_STRICTNESS, dual=False, class_weight="balanced")
        return model.fit(places, labels)
