"""The paper's method for spatial words: a linear support vector machine on places.

What is learned from is the target's place minus the landmark's, (right, away, up) in
metres. Each word has its own plane that parts it from the others; the margins become
degrees by a softmax, which leaves their order as it is. With one word only there is
nothing to part it from, and it fits everywhere; there is no answer "none of these".
Source: Dobnik and de Graaf 2017, section 4.2 (scikit-learn's LinearSVC).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from kille.extras import check_extra
from kille.perception.learners import Key, own_key
from kille.scene import Configuration, Direction

if TYPE_CHECKING:
    from sklearn.svm import LinearSVC

_UNIT = 0.1  # metres; offsets on a table are about one unit long
_FARTHEST = 100.0  # metres: the solver does not end on numbers without measure
_STRICTNESS = 10.0
_SHARPNESS = 2.0


class PaperRelations:
    """A learner of spatial words by planes in space; see the module.

    Raises `MissingExtraError` where scikit-learn is not installed.

    >>> from kille.scene import Configuration
    >>> left, right = Configuration((-0.3, 0, 0)), Configuration((0.3, 0, 0))
    >>> memory = PaperRelations()
    >>> for _ in range(3):
    ...     memory.learn_one(left, "left")
    ...     memory.learn_one(right, "right")
    >>> degrees = memory.predict_proba_one(Configuration((0.4, 0.1, 0)))
    >>> max(degrees, key=degrees.get)
    'right'
    """

    def __init__(self) -> None:
        check_extra("experiments", "the paper's learner of spatial words")
        self._heard: dict[Key, tuple[Direction, str]] = {}
        self._model: LinearSVC | None = None

    @property
    def labels(self) -> tuple[str, ...]:
        """The learned words in alphabetical order."""
        return tuple(sorted({label for _, label in self._heard.values()}))

    def learn_one(
        self, x: Configuration, label: str, *, key: Key | None = None
    ) -> None:
        """Take x as an instance of the word; ValueError if the key is taken."""
        if key in self._heard:
            raise ValueError(f"the key {key!r} was learned before; forget it first")
        self._heard[own_key(self._heard) if key is None else key] = (x.offset, label)
        self._model = None

    def forget(self, key: Key) -> None:
        """Undo a lesson, as if it had never been given; KeyError if there was none."""
        del self._heard[key]
        self._model = None

    def predict_proba_one(self, x: Configuration) -> dict[str, float]:
        """Each word's share of the margins; all 0 for an unknown place."""
        labels = self._words_with_places()
        if not labels or not np.isfinite(x.offset).all():
            return dict.fromkeys(self.labels, 0.0)
        shares = np.ones(1) if len(labels) == 1 else self._shares(x.offset)
        return dict(zip(labels, shares.tolist(), strict=True))

    def _words_with_places(self) -> list[str]:
        """The words that were taught at a known place."""
        known = {w for x, w in self._heard.values() if np.isfinite(x).all()}
        return sorted(known)

    def _shares(self, place: Direction) -> NDArray[np.float64]:
        """The softmax of the margins, in the order of the labels."""
        if self._model is None:
            self._model = self._fit_model()
        margins = self._model.decision_function(_in_units([place]))[0]
        if len(self._model.classes_) == 2:
            margins = np.array([-margins, margins])
        raised = np.exp(_SHARPNESS * (margins - margins.max()))
        shares: NDArray[np.float64] = raised / raised.sum()
        return shares

    def _fit_model(self) -> LinearSVC:
        # Its import takes longer than all else at start: wait until a word needs it.
        from sklearn.svm import LinearSVC

        known = [it for it in self._heard.values() if np.isfinite(it[0]).all()]
        places = _in_units([place for place, _ in known])
        labels = [label for _, label in known]
        # In the primal form the solver takes no random steps.
        model = LinearSVC(C=_STRICTNESS, dual=False, class_weight="balanced")
        return model.fit(places, labels)


def _in_units(places: Sequence[Direction]) -> NDArray[np.float64]:
    metres = np.clip(np.array(places, np.float64), -_FARTHEST, _FARTHEST)
    return np.asarray(metres / _UNIT, np.float64)
