"""Nearest neighbours among all learned descriptors, whoever they belong to.

There is one index over everything, never one for each learned view. FLANN's trees
cannot grow, so the index consists of a few immutable parts: trees over the older
descriptors, each part at least eight times as large as the next, and an exact search
over the newest ones. How views are parted depends on nothing but their sizes and
order: an index that forgot a view is the one that never had it.

Descriptors are compared as RootSIFT, d -> sqrt(d / sum d), which have length 1.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.perception.learners import Key
from kille.scene import UNMEASURED, Traits

Rows = NDArray[np.float32]

_TAIL = 2000  # descriptors; up to here exact search is the quicker one
_FACTOR = 8  # between the sizes of neighbouring parts
_NEIGHBOURS = 10
_TREES = 4
_CHECKS = 32
_KD_TREE = 1  # FLANN's number for randomised kd-trees
_SEED = 1


@dataclass(frozen=True, eq=False)
class View:
    """One lesson about one thing: its key, the word, its descriptors (n, 128) uint8.

    The traits are those it had as a whole, as far as they were measured.
    """

    key: Key
    label: str
    descriptors: NDArray[np.uint8]
    traits: Traits = UNMEASURED


class Part(Protocol):
    """Some views that are searched together."""

    @property
    def views(self) -> tuple[View, ...]:
        """What it holds."""
        ...

    @property
    def labels(self) -> tuple[str, ...]:
        """The words of its views, in the order of the columns of `nearest`."""
        ...

    def nearest(self, query: Rows) -> Rows:
        """The distance (n, labels) of each query to its nearest descriptor of a word.

        It is infinite where none of that word is among the neighbours looked at.
        """
        ...


class Index:
    """All views: the distance from a query to the nearest descriptor of each word."""

    def __init__(self, views: Sequence[View], old: Index | None = None) -> None:
        """An index of the views; parts which an old index has are taken over."""
        known = {} if old is None else {part.views: part for part in old._parts}
        self._parts: list[Part] = [
            known.get(tuple(views[run]))
            or (_Exact if is_tail else _Trees)(tuple(views[run]))
            for run, is_tail in _runs([len(view.descriptors) for view in views])
        ]
        self.labels = tuple(sorted({view.label for view in views}))
        self._columns = {label: i for i, label in enumerate(self.labels)}

    def nearest(self, query: Rows) -> Rows:
        """Distances (n, labels) from RootSIFT descriptors (n, 128), infinite if far."""
        nearest = np.full((len(query), len(self.labels)), np.inf, np.float32)
        for part in self._parts:
            columns = [self._columns[label] for label in part.labels]
            nearest[:, columns] = np.minimum(nearest[:, columns], part.nearest(query))
        return nearest


def rooted(descriptors: NDArray[np.uint8]) -> Rows:
    """RootSIFT (n, 128) float32 of SIFT descriptors (n, 128) uint8.

    >>> float(np.linalg.norm(rooted(np.full((1, 128), 7, np.uint8))).round(3))
    1.0
    """
    rows = descriptors.astype(np.float32)
    root: Rows = np.sqrt(rows / np.maximum(rows.sum(axis=1, keepdims=True), 1))
    return root


def distances(query: Rows, others: Rows) -> Rows:
    """The distances (n, m) between descriptors of length 1."""
    apart: Rows = np.sqrt(np.maximum(2 - 2 * (query @ others.T), 0))
    return apart


def _runs(sizes: Sequence[int]) -> list[tuple[slice, bool]]:
    """How views of these sizes are parted: a slice of them, and whether it is the tail.

    >>> _runs([4000, 4000, 100])
    [(slice(0, 2, None), False), (slice(2, 3, None), True)]
    """
    runs: list[tuple[int, int, int]] = []  # first, last + 1, descriptors
    first, size = 0, 0
    for last, more in enumerate(sizes, start=1):
        size += more
        if size <= _TAIL:
            continue
        while runs and runs[-1][2] < _FACTOR * size:
            first, _, older = runs.pop()
            size += older
        runs.append((first, last, size))
        first, size = last, 0
    parts = [(slice(start, stop), False) for start, stop, _ in runs]
    return parts if first == len(sizes) else [*parts, (slice(first, len(sizes)), True)]


class _Owned:
    """The descriptors of some views in one array, and whose each is."""

    def __init__(self, views: tuple[View, ...]) -> None:
        self.views = views
        self.labels = tuple(sorted({v.label for v in views if len(v.descriptors)}))
        ordered = sorted(
            (view for view in views if len(view.descriptors)), key=lambda it: it.label
        )
        columns = {label: i for i, label in enumerate(self.labels)}
        self._owners = np.repeat(
            [columns[view.label] for view in ordered],
            [len(view.descriptors) for view in ordered],
        ).astype(np.intp)
        self._rows = rooted(
            np.concatenate(
                [np.empty((0, 128), np.uint8), *(view.descriptors for view in ordered)]
            )
        )


class _Exact(_Owned):
    """Every descriptor is compared: exact, and quick while there are few."""

    def nearest(self, query: Rows) -> Rows:
        if not self.labels:
            return np.empty((len(query), 0), np.float32)
        firsts = np.searchsorted(self._owners, np.arange(len(self.labels)))
        alike = np.maximum.reduceat(query @ self._rows.T, firsts, axis=1)
        apart: Rows = np.sqrt(np.maximum(2 - 2 * alike, 0))
        return apart


class _Trees(_Owned):
    """Randomised kd-trees: the ten nearest descriptors, nearly always."""

    @cached_property
    def _trees(self) -> cv2.flann.Index:
        cv2.setRNGSeed(_SEED)  # the same views, the same trees
        return cv2.flann.Index(self._rows, {"algorithm": _KD_TREE, "trees": _TREES})

    def nearest(self, query: Rows) -> Rows:
        apart = np.full((len(query), len(self.labels)), np.inf, np.float32)
        if not len(query):
            return apart
        found, squares = self._trees.knnSearch(
            query, _NEIGHBOURS, params={"checks": _CHECKS}
        )
        rows = np.arange(len(query))[:, None]
        np.minimum.at(apart, (rows, self._owners[found]), np.sqrt(squares))
        return apart
