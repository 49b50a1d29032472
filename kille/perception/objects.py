"""Object words: features vote for them, size and colour are heard beside the votes.

Each SIFT feature of a query votes for the word of its nearest learned descriptor, at
distance d, with the weight 1 - d / d', where d' is the distance to the nearest of any
other word, or that to the things nobody taught, whichever is less. Votes are averaged
over the scans and divided by the square root of the word's share of the memory, since
a word with many descriptors collects chance votes. With V the votes of a word and n
the features of a scan, v = (V / C)^g is how far the votes are beyond chance, C = a n^b.

With S and K in [0, 1] how well the word fits in size and in colour, the strength of a
word and its degree are

    s(word) = S (v + K (h v + k)),  p(word) = s(word) / (1 + Σs)

and the rest belongs to what has not been learned. So another size speaks against any
word, and colour speaks for a word but never against it: alone, at the right size, it
gives a degree of k / (1 + k) at most, which is less than a half, so that what no
feature confirms is not asserted. Where size is unknown S = 1 and k = 0: colour alone is
no reason to use a word. All numbers were fitted to rendered objects and real captures,
among which most things asked about had not been taught.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from kille.perception.index import Index, Rows, View, distances, rooted
from kille.perception.learners import Key
from kille.perception.resemblance import Resemblance
from kille.scene import Features, Percept, Point

_UNTAUGHT = 0.45  # RootSIFT distance to expect of a descriptor of something else
_CHANCE, _CHANCE_POWER = 0.23, 0.65  # a and b
_STEEPNESS = 3.0  # g
_HELP = 40.0  # h
_LOOKS = 0.9  # k
_SIZE_POWER = 0.5

_KEPT_SCANS = 4
_NEW = 0.25  # RootSIFT distance; what is nearer was seen in an earlier scan
NO_FEATURES = Features(
    np.empty((0, 128), np.uint8),
    np.empty((0, 2), np.float32),
    np.empty((0, 3), np.float32),
)
_BEST = 20  # features whose points make the place of a thing


class ObjectMemory:
    """A learner of words for things, from percepts.

    It keeps the views it was taught and nothing else, so that it can be stored as they
    are and built anew from them.
    """

    def __init__(self) -> None:
        self._views: dict[Key, View] = {}
        self._index = Index(())
        self._resemblance = Resemblance((), ())
        self._indexed: tuple[View, ...] = ()

    @classmethod
    def of(cls, views: Iterable[View]) -> ObjectMemory:
        """The memory that was taught these views in this order."""
        memory = cls()
        for view in views:
            memory.learn(view)
        return memory

    def copy(self) -> ObjectMemory:
        """Another memory that knows the same; either learns without the other."""
        twin = ObjectMemory()
        twin._views = dict(self._views)
        twin._index, twin._resemblance = self._index, self._resemblance
        twin._indexed = self._indexed
        return twin

    @property
    def views(self) -> tuple[View, ...]:
        """All that was learned, in order."""
        return tuple(self._views.values())

    @property
    def labels(self) -> tuple[str, ...]:
        """The learned words in alphabetical order."""
        return tuple(sorted({view.label for view in self._views.values()}))

    def learn_one(self, x: Percept, label: str, *, key: Key) -> None:
        """Take the percept as an instance of it; ValueError if the key is taken."""
        self.learn(view_of(x, label, key=key))

    def learn(self, view: View) -> None:
        """Take a view as `view_of` makes it; ValueError if its key is taken."""
        if view.key in self._views:
            raise ValueError(
                f"the key {view.key!r} was learned before; forget it first"
            )
        self._views[view.key] = view

    def forget(self, key: Key) -> None:
        """Be as if this had never been learned; KeyError if it was not."""
        del self._views[key]

    def predict_proba_one(self, x: Percept) -> dict[str, float]:
        """The degree of each learned word for what is seen; {} if nothing is."""
        query, traits = _descriptors(x.scans), x.traits
        unseen = traits.size is None and traits.colour is None
        if not self._views or (unseen and not len(query)):
            return {}
        index = self._current()
        beyond = self._beyond_chance(index, query, len(x.scans))
        fit = self._resemblance.fit(traits)
        looks = fit.colour * (_HELP * beyond + _LOOKS * fit.size_known)
        strength = fit.size * (beyond + looks)
        degrees = strength / (1 + strength.sum())
        return dict(zip(index.labels, degrees.tolist(), strict=True))

    def locate(self, x: Percept, label: str) -> Point | None:
        """The mean of the points of the 20 features that match the word best.

        Where none can be had, the place of the region; None where that is unknown too.
        """
        index = self._current()
        points = _points(x.scans)
        measured = np.isfinite(points).all(axis=1)
        if label not in index.labels or not measured.any():
            return x.region.place
        nearest = index.nearest(rooted(_descriptors(x.scans)[measured]))
        misfits = _misfits(nearest, index.labels.index(label))
        best = np.argsort(misfits, kind="stable")[:_BEST]
        best = best[np.isfinite(misfits[best])]
        if not len(best):
            return x.region.place
        right, down, forward = points[measured][best].mean(axis=0, dtype=np.float64)
        return Point(float(right), float(down), float(forward))

    def _beyond_chance(
        self, index: Index, query: NDArray[np.uint8], scans: int
    ) -> NDArray[np.float64]:
        """How far the votes for each word are beyond what chance gives: v."""
        if not len(query):
            return np.zeros(len(index.labels))
        votes = _votes(index.nearest(rooted(query))) / scans
        chance = _CHANCE * (len(query) / scans) ** _CHANCE_POWER
        beyond: NDArray[np.float64] = votes / self._bulk(index.labels) / chance
        return beyond**_STEEPNESS

    def _current(self) -> Index:
        if self._indexed != self.views:
            self._index = Index(self.views, self._index)
            self._resemblance = Resemblance(self.views, self._index.labels)
            self._indexed = self.views
        return self._index

    def _bulk(self, labels: Sequence[str]) -> NDArray[np.float64]:
        """How much of the memory each word takes, as what its votes are divided by."""
        sizes = dict.fromkeys(labels, 0)
        for view in self._views.values():
            sizes[view.label] += len(view.descriptors)
        counts = np.array([max(sizes[label], 1) for label in labels], np.float64)
        bulk: NDArray[np.float64] = (counts / counts.mean()) ** _SIZE_POWER
        return bulk


def view_of(x: Percept, label: str, *, key: Key) -> View:
    """What is learned from a lesson: the features that are kept of it, and traits."""
    return View(key, label, kept_features(x).descriptors, x.traits)


def kept_features(x: Percept) -> Features:
    """What is kept of a lesson: each feature once, from some scans of the look.

    The first scan is kept whole, and of three later ones what the earlier lack.
    """
    count = len(x.scans)
    chosen = sorted(
        {round(i) for i in np.linspace(0, count - 1, min(count, _KEPT_SCANS))}
    )
    kept = NO_FEATURES
    for i in chosen:
        scan = x.scans[i]
        new = _is_new(scan.descriptors, kept.descriptors)
        kept = Features(
            np.concatenate([kept.descriptors, scan.descriptors[new]]),
            np.concatenate([kept.pixels, scan.pixels[new]]),
            np.concatenate([kept.points, scan.points[new]]),
        )
    return kept


def _is_new(more: NDArray[np.uint8], kept: NDArray[np.uint8]) -> NDArray[np.bool_]:
    apart = distances(rooted(more), rooted(kept)).min(axis=1, initial=np.inf)
    new: NDArray[np.bool_] = apart > _NEW
    return new


def _descriptors(scans: Sequence[Features]) -> NDArray[np.uint8]:
    return np.concatenate(
        [np.empty((0, 128), np.uint8), *(it.descriptors for it in scans)]
    )


def _points(scans: Sequence[Features]) -> Rows:
    return np.concatenate([np.empty((0, 3), np.float32), *(it.points for it in scans)])


def _misfits(nearest: Rows, column: int) -> Rows:
    """How badly features fit a word: its distance over that to the next other word."""
    others = np.delete(nearest, column, axis=1).min(axis=1, initial=np.inf)
    misfits: Rows = nearest[:, column] / np.clip(others, 1e-6, _UNTAUGHT)
    return misfits


def _votes(nearest: Rows) -> NDArray[np.float64]:
    """The votes for each column from distances (n, labels) of each feature."""
    rows = np.arange(len(nearest))
    winner = nearest.argmin(axis=1)
    first = nearest[rows, winner]
    others = nearest.copy()
    others[rows, winner] = np.inf
    second = np.minimum(others.min(axis=1), _UNTAUGHT)
    # The same picture under two words: both distances are 0, and so is the weight.
    weights = np.where(first < second, 1 - first / np.maximum(second, 1e-9), 0)
    votes = np.bincount(winner, weights, minlength=nearest.shape[1])
    return np.asarray(votes, np.float64)
