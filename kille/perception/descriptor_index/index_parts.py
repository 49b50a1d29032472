"""Parts of an index: views searched together, exactly if few, by a search if many."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from itertools import pairwise, starmap
from threading import Event
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kille.perception.descriptor_index.repeats import Repeats, products_with_found
from kille.perception.descriptor_index.searches import Maker, Search
from kille.perception.descriptor_index.views import (
    LENGTH,
    Descriptors,
    Rows,
    View,
    apart,
    load_descriptors,
    rooted,
    stack_descriptors,
)

NEIGHBOURS = 10
"""How many of the nearest descriptors each part gives."""

NOBODY = -1
"""The column of a view that was forgotten.

>>> from kille.perception.descriptor_index import NOBODY
>>> NOBODY
-1
"""

_AT_ONCE = 256  # descriptors that are compared with all others: what a cache can hold
_FEW = 20_000  # descriptors of a part that are kept as RootSIFT too: 10 MB
_CLOSE = 24  # descriptors near a feature that are compared one by one with its repeats
_ROUNDING = 0.002  # of a distance: that of equal descriptors may be taken for so much
_SPARE = 30  # neighbours more, where some of what is found may have been forgotten


class Neighbours(NamedTuple):
    """The nearest descriptors: the word of each, and its distance from the query.

    Both (n, k); the number of a word is its column in `Index.labels`, or -1 with an
    infinite distance where fewer were found.

    >>> import numpy as np
    >>> from kille.perception.descriptor_index import View, rooted
    >>> shades = np.random.default_rng(1).integers(0, 255, (40, 128))
    >>> view = View(1, "cup", shades.astype(np.uint8))
    >>> from kille.perception.descriptor_index import Index
    >>> words, distances = Index([view]).neighbours(rooted(view.descriptors))
    >>> words.shape == distances.shape
    True
    """

    words: NDArray[np.intp]
    distances: Rows

    def nearest(self) -> tuple[NDArray[np.intp], Rows]:
        """The word (n,) of each query's nearest neighbour, and its distance (n,)."""
        rows = np.arange(len(self.words))
        column = self.distances.argmin(axis=1)
        return self.words[rows, column], self.distances[rows, column]

    def without(self, words: NDArray[np.intp]) -> Neighbours:
        """The neighbours of other words: infinitely far is what is of these (n,)."""
        far = np.where(self.words == words[:, None], np.inf, self.distances)
        return Neighbours(self.words, far)


class Exact:
    """A few views, all descriptors of which are compared with a query."""

    def __init__(self, views: Sequence[View], columns: Mapping[str, int]) -> None:
        ordered = sorted(
            (view for view in views if len(view.descriptors)),
            key=lambda view: columns[view.label],
        )
        owners = np.repeat(
            np.array([columns[view.label] for view in ordered], np.intp),
            [len(view.descriptors) for view in ordered],
        )
        self._owners = owners
        self._words, firsts = np.unique(owners, return_index=True)
        self._spans = list(starmap(slice, pairwise([*firsts.tolist(), len(owners)])))
        self._rows = rooted(stack_descriptors(ordered))

    @property
    def size(self) -> int:
        """The number of descriptors."""
        return len(self._rows)

    def neighbours(self, query: Rows) -> Neighbours:
        """The nearest descriptor of each word, one column for each word."""
        words = np.broadcast_to(self._words, (len(query), len(self._words)))
        if not len(self._words):
            return Neighbours(words, np.empty((len(query), 0), np.float32))
        alike = np.empty((len(query), len(self._words)), np.float32)
        for some, products in self._products(query):
            for word, own in enumerate(self._spans):
                products[:, own].max(axis=1, out=alike[some, word])
        return Neighbours(words, apart(alike))

    def neighbours_within(
        self, query: Rows, repeats: Repeats, distance: float
    ) -> Neighbours:
        """The nearest descriptor to each query, and the nearest of another word, in two
        columns.

        What is farther than the distance may be left out: its word is -1, its distance
        infinite. Where q repeats f, and x is a descriptor, d(f, x) ≤ d(f, q) + d(q, x):
        so only what is near the first of some features is compared with those that
        repeat it.
        """
        words = np.full((len(query), 2), NOBODY)
        far = np.full((len(query), 2), np.inf, np.float32)
        if not self.size:
            return Neighbours(words, far)
        firsts, same, _ = repeats
        reach = distance + repeats.reach() + _ROUNDING
        least = np.asarray(1 - reach**2 / 2, np.float32)
        near, often = self._near(query.take(firsts, axis=0), least)
        many = np.flatnonzero((often > _CLOSE)[same])
        found = self.neighbours(query.take(many, axis=0))
        words[many], far[many] = _nearest_two(found)
        some = (often > 0) & (often <= _CLOSE)
        few = np.flatnonzero(some[same])
        which = (np.cumsum(some) - 1)[same[few]]
        rows = near[some]
        there, repeated = rows >= 0, query.take(few, axis=0)
        alike = products_with_found(self._rows.take(rows, axis=0), repeated, which)
        owners = np.where(there, self._owners[rows], NOBODY)[which]
        near_some = np.where(there[which], apart(alike), np.inf)
        words[few], far[few] = _nearest_two(Neighbours(owners, near_some))
        return Neighbours(words, far)

    def _near(
        self, query: Rows, least: Rows
    ) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """The rows (n, _CLOSE) whose dot product with a query is the least or more,
        and how many there are (n,).

        -1 stands where there are fewer, and in all places where there are more.
        """
        near = np.full((len(query), _CLOSE), NOBODY)
        often = np.zeros(len(query), np.intp)
        for some, products in self._products(query):
            pairs = np.flatnonzero(products >= least[some, None])
            which, rows = np.divmod(pairs, products.shape[1])
            often[some] = np.bincount(which, minlength=len(products))
            place = np.arange(len(which)) - np.searchsorted(which, which)
            few = (often[some] <= _CLOSE)[which]
            near[some][which[few], place[few]] = rows[few]
        return near, often

    def _products(self, query: Rows) -> Iterator[tuple[slice, Rows]]:
        """The dot products of some of the query at a time with all descriptors."""
        for start in range(0, len(query), _AT_ONCE):
            some = slice(start, start + _AT_ONCE)
            yield some, query[some] @ self._rows.T


def _nearest_two(found: Neighbours) -> Neighbours:
    """The nearest neighbour of each query, and the nearest of another word."""
    word, far = found.nearest()
    other, farther = found.without(word).nearest()
    other[np.isinf(farther)] = NOBODY
    return Neighbours(np.stack([word, other], axis=1), np.stack([far, farther], axis=1))


class Part:
    """Many views that are searched together once their search is built.

    `step` takes only every so many descriptors: a sketch of the views, which is ready
    early.
    """

    def __init__(self, views: tuple[View, ...], make: Maker, step: int = 1) -> None:
        self.views = views
        self.step = step
        self.failure: Exception | None = None
        self._make = make
        self._search: Search | None = None
        self._done = Event()

    @cached_property
    def size(self) -> int:
        """The number of descriptors."""
        return int(self._starts[-1])

    @property
    def is_ready(self) -> bool:
        """Can it be searched?"""
        return self._search is not None

    def build(self) -> None:
        """Build the search, however long that takes; later calls do nothing."""
        if self._done.is_set():
            return
        try:
            self._search = self._make(self._blocks)
        except Exception as error:
            self.failure = error
            raise
        finally:
            self._done.set()

    def wait(self, seconds: float) -> bool:
        """Wait until another thread has built it, or failed to; tell whether it has."""
        return self._done.wait(seconds)

    def find_rows(self, query: Rows, owners: NDArray[np.intp]) -> NDArray[np.int32]:
        """The rows (n, k) of descriptors near each query; -1 where there are fewer.

        `owners` has the column of each view's word, or -1 if it was forgotten.
        """
        if self._search is None:
            raise RuntimeError("a part was searched before it was built")
        some_gone = bool((owners == NOBODY).any())
        wanted = min(NEIGHBOURS + some_gone * _SPARE, self.size)
        if not len(query):
            return np.empty((0, wanted), np.int32)
        return self._search.find_rows(query, wanted)

    def neighbours(
        self,
        query: Rows,
        owners: NDArray[np.intp],
        rows: NDArray[np.int32],
        same: NDArray[np.intp] | None = None,
    ) -> Neighbours:
        """The nearest descriptors among the rows (n, k) that were found for each query.

        Forgotten views are left out at once, although the trees still hold them. Where
        features are repeated, the rows (m, k) are those of the first of each, and
        `same` (n,) says which of the m each is, in order.
        """
        same = np.arange(len(query)) if same is None else same
        if not len(query):
            return Neighbours(np.empty((0, 0), np.intp), np.empty((0, 0), np.float32))
        some = np.maximum(rows, 0)
        views = np.searchsorted(self._starts, some, side="right") - 1
        words = np.where(rows < 0, NOBODY, owners[views])[same]
        far = apart(products_with_found(self._rooted(some), query, same))
        far[words == NOBODY] = np.inf
        return Neighbours(words, far)

    def _rooted(self, rows: NDArray[np.int32]) -> Rows:
        """The descriptors of these rows (m, k) as RootSIFT (m, k, 128)."""
        if self.size <= _FEW:
            return self._all_rooted.take(rows, axis=0)
        once, places = np.unique(rows, return_inverse=True)
        owning = np.searchsorted(self._starts, once, side="right") - 1
        return rooted(self._descriptors(owning, once))[places.reshape(rows.shape)]

    @cached_property
    def _all_rooted(self) -> Rows:
        return rooted(np.concatenate(self._blocks))

    @cached_property
    def _blocks(self) -> list[Descriptors]:
        load_descriptors(self.views)
        return [view.descriptors[:: self.step] for view in self.views]

    @cached_property
    def _starts(self) -> NDArray[np.intp]:
        """The row at which each view starts, and that after the last."""
        sizes = [-(-view.size // self.step) for view in self.views]
        return np.cumsum([0, *sizes])

    @cached_property
    def _bytes(self) -> list[memoryview]:
        return [
            np.ascontiguousarray(view.descriptors).reshape(-1).data
            for view in self.views
        ]

    def _descriptors(
        self, views: NDArray[np.intp], rows: NDArray[np.int32]
    ) -> Descriptors:
        """The descriptors of these rows, gathered from the views they belong to.

        Slices of bytes are joined, since the descriptors are not kept in one array.
        """
        first = (rows - self._starts[views]) * (self.step * LENGTH)
        gathered = b"".join(
            self._bytes[view][start : start + LENGTH]
            for view, start in zip(views.tolist(), first.tolist(), strict=True)
        )
        return np.frombuffer(gathered, np.uint8).reshape(-1, LENGTH)
