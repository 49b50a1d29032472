"""The index of all learned views, in parts that are later replaced by larger ones."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from itertools import compress, islice
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from kille.perception.descriptor_index.builders import AtOnce, Builder
from kille.perception.descriptor_index.index_parts import (
    NOBODY,
    Exact,
    Neighbours,
    Part,
)
from kille.perception.descriptor_index.partition import Partition, partition_views
from kille.perception.descriptor_index.repeats import Numbers, find_repeats
from kille.perception.descriptor_index.searches import search_called
from kille.perception.descriptor_index.views import (
    Rows,
    View,
    count,
    rooted,
    thin_views,
)
from kille.perception.features import descriptors_of
from kille.perception.learners import Key
from kille.scene import Features

_SKETCH = 200_000  # descriptors of a sketch: it is ready in a third of a second
_SKETCHED = 3 * _SKETCH  # from here on a part is worth one
_EXACT = 8_000  # descriptors that are compared one by one at most: about .01 s
_WORTH_A_THREAD = 500_000  # pairs of a query and a newest descriptor: about .002 s


class Index:
    """All views learned and not forgotten, searched by their descriptors.

    Most views are in parts with trees; the newest, and those whose parts are still
    being built, are in older parts or compared one by one. So what is learned counts
    at once, and what is forgotten never again: which parts answer makes no difference
    but that trees find only nearly all of the nearest. When all parts are built, they
    are those of an index that was given the present views, however it came to them.

    >>> import numpy as np
    >>> from kille.perception.descriptor_index import View, rooted
    >>> shades = np.random.default_rng(1).integers(0, 255, (40, 128))
    >>> view = View(1, "cup", shades.astype(np.uint8))
    >>> index = Index([view])
    >>> index.labels
    ('cup',)
    """

    def __init__(
        self,
        views: Iterable[View] = (),
        *,
        builder: Builder | None = None,
        search: str = "trees",
    ) -> None:
        """Index the views; ValueError if two have the same key.

        `builder` decides when parts are built, at once if none is given; `search` is
        one of SEARCHES, by which large parts are searched.
        """
        self._builder = builder or AtOnce()
        self._make = search_called(search)
        self._views: dict[Key, View] = {}
        self._words: dict[str, tuple[View, ...]] = {}
        self._sizes: Counter[str] = Counter()  # the descriptors of each word
        self._columns: dict[str, int] = {}
        self._exact: Exact | None = None
        self._owners: list[NDArray[np.intp]] | None = None
        for view in views:
            self._take(view)
        self._partition = Partition()
        self._has_forgotten = False
        self._wanted: tuple[Part, ...] = ()
        self._others: tuple[
            Part, ...
        ] = ()  # these answer until the wanted ones are ready
        self._sketches: tuple[Part, ...] = ()  # these answer while nothing else can
        self._serving: list[tuple[Part, NDArray[np.bool_]]] = []
        self._tail: list[View] = []  # what no part serves
        self._awaited: tuple[Part, ...] = ()
        self._partition_anew()

    def copy(self) -> Index:
        """A copy with the same views; either learns without the other."""
        twin = object.__new__(Index)
        twin.__dict__.update(self.__dict__)
        twin._views, twin._tail = dict(self._views), list(self._tail)
        twin._words, twin._sizes = dict(self._words), self._sizes.copy()
        return twin

    @property
    def views(self) -> Mapping[Key, View]:
        """The views learned and not forgotten, by key, in the order of learning."""
        return MappingProxyType(self._views)

    @property
    def words(self) -> Mapping[str, tuple[View, ...]]:
        """The views of each word, in the order of learning."""
        return MappingProxyType(self._words)

    @property
    def labels(self) -> tuple[str, ...]:
        """The words of the views in alphabetical order."""
        return tuple(self._word_columns())

    @property
    def sizes(self) -> NDArray[np.intp]:
        """The number of descriptors of each word, in the order of the labels."""
        return np.array([self._sizes[label] for label in self._word_columns()], np.intp)

    def learn(self, view: View) -> None:
        """Add a view; ValueError if its key is taken."""
        self._take(view)
        if self._has_forgotten:
            return
        self._tail.append(view)
        self._exact = None
        before = self._partition
        self._partition = before.with_view(view.size)
        if self._partition.runs != before.runs:
            self._arrange()

    def forget(self, key: Key) -> None:
        """Remove a view, as if it had never been learned; KeyError if it was not."""
        self._views[key].load()  # others may still hold it
        view = self._views.pop(key)
        left = tuple(it for it in self._words[view.label] if it is not view)
        self._words[view.label] = left
        self._sizes[view.label] -= view.size
        if not left:
            del self._words[view.label]
            self._renumber()
        self._has_forgotten = True

    def settled(self) -> Index:
        """Build all parts and return this index; raises what building raised."""
        self._catch_up()
        self._builder.finish(self._wanted)
        for part in self._wanted:
            if part.failure is not None:
                raise part.failure
        self._catch_up()
        return self

    def neighbours(self, query: Rows) -> Neighbours:
        """The nearest descriptors to RootSIFT descriptors (n, 128), of all words.

        The ten nearest of each part, and the nearest of each word among the newest.
        """
        self._catch_up()
        exact, parts = self._exact_and_parts()

        def search_parts() -> Sequence[Neighbours]:
            return [
                part.neighbours(query, own, part.find_rows(query, own))
                for part, own in parts
            ]

        compare = partial(exact.neighbours, query)
        return self._search(len(query), compare, search_parts)

    def neighbours_in(self, scans: Sequence[Features], within: float) -> Neighbours:
        """The nearest descriptors to all features of some scans, of all words.

        The ten nearest of each part, and the nearest of each word among the newest. Of
        features that repeat each other only the first is searched for in the parts: the
        others are compared with what it found. What is not within the distance may be
        left out. All features of the first scan are new: they are searched for at once,
        while the other scans may still be extracted. A single scan is searched for as
        `neighbours` does.
        """
        if len(scans) < 2:
            return self.neighbours(rooted(descriptors_of(scans)))
        self._catch_up()
        exact, parts = self._exact_and_parts()
        coming = iter(scans)
        seen = [next(coming)]
        rows = [rooted(seen[0].descriptors)]
        begun = [part.find_rows(rows[0], own) for part, own in parts]
        for scan in coming:
            seen.append(scan)
            rows.append(rooted(scan.descriptors))
        query = np.concatenate(rows)
        order, repeats = find_repeats(query, seen).in_order()
        ordered = query.take(order, axis=0)

        def search_parts() -> Sequence[Neighbours]:
            firsts = order[repeats.firsts]
            later = firsts >= len(rows[0])
            places = np.where(later, len(rows[0]) + np.cumsum(later) - 1, firsts)
            found = []
            for (part, own), some in zip(parts, begun, strict=True):
                others = part.find_rows(query[firsts[later]], own)
                nearest = np.concatenate([some, others])[places]
                found.append(part.neighbours(ordered, own, nearest, repeats.same))
            return found

        compare = partial(exact.neighbours_within, ordered, repeats, within)
        found = self._search(len(query), compare, search_parts)
        words, apart = map(np.empty_like, found)
        words[order], apart[order] = found
        return Neighbours(words, apart)

    def _search(
        self,
        queries: int,
        compare: Callable[[], Neighbours],
        search_parts: Callable[[], Sequence[Neighbours]],
    ) -> Neighbours:
        """The nearest of the newest descriptors, and those in each of the parts.

        The newest are compared in a thread if there is much to compare, since NumPy and
        FLANN release the interpreter's lock.
        """
        exact, parts = self._exact_and_parts()
        if not parts or queries * exact.size < _WORTH_A_THREAD:
            return _join([compare(), *search_parts()])
        with ThreadPoolExecutor(1, "kille-index") as worker:
            comparison = worker.submit(compare)
            in_parts = search_parts()
            return _join([comparison.result(), *in_parts])

    def _exact_and_parts(self) -> tuple[Exact, Sequence[tuple[Part, Numbers]]]:
        """The newest views, and the parts that answer, with the columns of their
        words."""
        if self._exact is None:
            columns = self._word_columns()
            self._exact = Exact(thin_views(self._tail, _EXACT), columns)
        if self._owners is None:
            self._owners = [self._words_of(*serving) for serving in self._serving]
        parts = (part for part, _ in self._serving)
        return self._exact, list(zip(parts, self._owners, strict=True))

    def nearest(self, query: Rows) -> Rows:
        """The distance (n, labels) from each query to each word's nearest descriptor.

        It is infinite where none of that word is among the neighbours.
        """
        words, apart = self.neighbours(query)
        nearest = np.full((len(query), len(self.labels)), np.inf, np.float32)
        rows = np.broadcast_to(np.arange(len(query))[:, None], words.shape)
        someone = words != NOBODY
        np.minimum.at(nearest, (rows[someone], words[someone]), apart[someone])
        return nearest

    def _take(self, view: View) -> None:
        if view.key in self._views:
            raise ValueError(
                f"the key {view.key!r} was learned before; forget it first"
            )
        self._views[view.key] = view
        self._sizes[view.label] += view.size
        before = self._words.get(view.label, ())
        self._words[view.label] = (*before, view)
        if not before:
            self._renumber()

    def _renumber(self) -> None:
        self._columns = {}
        self._exact = self._owners = None

    def _word_columns(self) -> Mapping[str, int]:
        """The column of each word."""
        if len(self._columns) != len(self._words):
            self._columns = {word: i for i, word in enumerate(sorted(self._words))}
        return self._columns

    def _partition_anew(self) -> None:
        """Partition the views as if they had been learned one after the other."""
        sizes = (view.size for view in self._views.values())
        self._partition = partition_views(sizes)
        self._has_forgotten = False
        self._arrange()

    def _arrange(self) -> None:
        """Start building the parts that are wanted and missing."""
        order = tuple(self._views.values())
        there = {part.views: part for part in (*self._wanted, *self._others)}
        runs = [order[run.start : run.stop] for run in self._partition.runs]
        self._others = tuple(there.values())
        self._wanted = tuple(there.get(run) or Part(run, self._make) for run in runs)
        self._serve()
        newest = self._partition.views - self._partition.tail_start
        bare = tuple(self._tail[: len(self._tail) - newest])
        if (size := count(bare)) > _SKETCHED and not self._sketches:
            self._sketches = (Part(bare, self._make, size // _SKETCH),)
            self._awaited = (*self._sketches, *self._awaited)
        new = [part for part in self._awaited if part.views not in there]
        self._builder.begin(new)

    def _serve(self) -> None:
        """Choose the parts that answer: those wanted, or others that are ready.

        Each view is searched once. The newest, and those in no part that is ready, are
        compared one by one. Parts that are of no use any more are let go.
        """
        self._awaited = tuple(
            part for part in (*self._wanted, *self._sketches) if not part.is_ready
        )
        left = dict(islice(self._views.items(), self._partition.tail_start))
        newest = islice(self._views.values(), self._partition.tail_start, None)
        self._serving = []
        others = sorted(self._others, key=lambda part: -part.size)
        for part in dict.fromkeys((*self._wanted, *others, *self._sketches)):
            if not part.is_ready:
                continue
            served = [left.get(view.key) is view for view in part.views]
            if any(served):
                self._serving.append((part, np.array(served)))
                for view in compress(part.views, served):
                    del left[view.key]
        self._tail = [*left.values(), *newest]
        used = {part for part, _ in self._serving}
        self._others = tuple(part for part in self._others if part in used)
        if all(part.is_ready for part in self._wanted):
            self._sketches = ()
        self._exact = self._owners = None

    def _catch_up(self) -> None:
        """Leave out forgotten views, and use the parts that have become ready."""
        if self._has_forgotten:
            self._partition_anew()
        if not self._awaited:
            return
        self._builder.need([part for part in self._wanted if not part.is_ready])
        if any(part.is_ready for part in self._awaited):
            self._serve()

    def _words_of(self, part: Part, served: NDArray[np.bool_]) -> NDArray[np.intp]:
        """The column of the word of each view of a part; -1 if it is not served
        here."""
        columns = self._word_columns()
        words = [columns.get(view.label, NOBODY) for view in part.views]
        return np.where(served, np.array(words, np.intp), NOBODY)


def _join(found: Sequence[Neighbours]) -> Neighbours:
    """What was found in several places for the same queries."""
    words, apart = zip(*found, strict=True)
    return Neighbours(np.concatenate(words, axis=1), np.concatenate(apart, axis=1))
