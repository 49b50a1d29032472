"""KILLE's original method for object words, for comparison with other methods.

Dobnik and de Graaf, *KILLE: a framework for situated agents for learning language
through interaction*, NoDaLiDa 2017: SIFT as OpenCV has it, and FLANN, which matches
what is seen with every stored view, one after the other. A feature matches a view if
its nearest descriptor there is clearly nearer than the second nearest (Lowe's ratio).
The score of a view is the share of features that match it, a word has that of its best
view, scores are averaged over ten scans, and the word with the highest is said, however
low it is: no thing counts as new. The numbers of FLANN are not in the paper, nor is the
ratio: the former are those of OpenCV's tutorial on matching, the latter is .75.

It is slow by design: its time grows with every view. It also has KILLE's bias, that
things with few features are taken for things with many. Where hardly a view matches, as
in pictures of categories, the votes of `kille.perception.pooled_votes` do better.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from weakref import WeakKeyDictionary

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.perception.descriptor_index import Rows
from kille.perception.features import NONE, features_of
from kille.perception.learners import Key, own_key
from kille.perception.look import Scans
from kille.scene import Features, Percept, Point

Options = dict[str, bool | int | float | str]

_RATIO = 0.75
_COMPARED = 2  # descriptors of a view with each feature
_TREES: Options = {"algorithm": 1, "trees": 5}  # 1: randomised kd-trees
_CHECKS: Options = {"checks": 50}
_SEED = 1
_BEST = 20  # features whose points make the place of a thing


@dataclass(frozen=True, eq=False)
class _StoredView:
    """A stored view: its word, and search trees over its descriptors.

    There are none over fewer than two descriptors, which nothing can match.
    """

    label: str
    trees: cv2.flann.Index | None


class PaperObjects:
    """The paper's learner of object words, from percepts."""

    def __init__(self) -> None:
        self._views: dict[Key, _StoredView] = {}

    def learn_one(self, x: Percept, label: str, *, key: Key | None = None) -> None:
        """Store the first scan as a view of the word; ValueError if the key is
        taken."""
        named = own_key(self._views) if key is None else key
        if named in self._views:
            raise ValueError(f"the key {named!r} was learned before; forget it first")
        scans = _scans(x)
        self._views[named] = _store_view(
            label, (scans[0] if scans else NONE).descriptors
        )

    def forget(self, key: Key) -> None:
        """Undo a lesson, as if it had never been given; KeyError if there was none."""
        del self._views[key]

    def scores(self, x: Percept) -> dict[str, float]:
        """The share of features that match each word, averaged over the scans."""
        words = sorted({view.label for view in self._views.values()})
        scans = [self._score_words(scan, words) for scan in _scans(x)]
        means = np.mean(scans, axis=0) if scans else np.zeros(len(words))
        return dict(zip(words, means.tolist(), strict=True))

    def predict_proba_one(self, x: Percept) -> dict[str, float]:
        """The scores divided by their sum: the paper leaves no room for new things."""
        scores = self.scores(x)
        total = sum(scores.values())
        return {word: score / total if total else 0.0 for word, score in scores.items()}

    def locate(self, x: Percept, label: str) -> Point | None:
        """The mean point of the 20 features that are nearest to the word.

        None where there are none, or their points were not measured.
        """
        views = [it for it in self._views.values() if it.label == label]
        scans = _scans(x)
        if not views or not scans:
            return None
        apart = [[_nearest(view, scan)[:, 0] for view in views] for scan in scans]
        near = np.concatenate([np.min(rows, axis=0) for rows in apart])
        points = np.concatenate([scan.points for scan in scans])
        near[~np.isfinite(points).all(axis=1)] = np.inf
        best = np.argsort(near, kind="stable")[:_BEST]
        best = best[np.isfinite(near[best])]
        if not len(best):
            return None
        right, down, forward = points[best].mean(axis=0).tolist()
        return Point(right, down, forward)

    def _score_words(self, scan: Features, words: Sequence[str]) -> list[float]:
        best = dict.fromkeys(words, 0.0)
        for view in self._views.values():
            best[view.label] = max(best[view.label], _match_share(view, scan))
        return list(best.values())


_OWN: WeakKeyDictionary[Percept, tuple[Features, ...]] = WeakKeyDictionary()
"""The features of percepts by OpenCV's defaults, extracted once for each."""


def _scans(x: Percept) -> tuple[Features, ...]:
    """The scans by OpenCV's default SIFT; those given, if there are no frames."""
    if not isinstance(x.scans, Scans):
        return tuple(x.scans)
    if x not in _OWN:
        _OWN[x] = tuple(features_of(*it, _sift()) for it in x.scans.sightings)
    return _OWN[x]


@cache
def _sift() -> cv2.SIFT:
    return cv2.SIFT.create()


def _store_view(label: str, descriptors: NDArray[np.uint8]) -> _StoredView:
    rows = descriptors.astype(np.float32)
    cv2.setRNGSeed(_SEED)  # the same lesson, the same trees
    trees = cv2.flann.Index(rows, _TREES) if len(rows) >= _COMPARED else None
    return _StoredView(label, trees)


def _nearest(stored: _StoredView, scan: Features) -> Rows:
    """The distances (n, 2) of features to the two nearest descriptors of a view."""
    if stored.trees is None or not len(scan.descriptors):
        return np.full((len(scan.descriptors), _COMPARED), np.inf, np.float32)
    query = scan.descriptors.astype(np.float32)
    _, squares = stored.trees.knnSearch(query, _COMPARED, params=_CHECKS)
    return np.sqrt(squares)


def _match_share(stored: _StoredView, scan: Features) -> float:
    """The share of the features that match the view by Lowe's ratio test."""
    first, second = _nearest(stored, scan).T
    return float((first < _RATIO * second).mean()) if len(first) else 0.0
