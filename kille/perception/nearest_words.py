"""Very many words: only those nearest to a thing are told apart.

With thousands of words, one regression for all of them (`kille.perception.likeness`)
would take minutes and gigabytes, and would tell little: nearly all it has to say is
that a thing is none of the other words. So a question is answered in two steps. First
the thing is compared with examples of every word: a word is as near as its example most
like the thing, by the likeness k of the regression. Then the nearest words, each with
those of its examples that are most like the thing, are told apart by the regression, as
by a robot that knows no other words. Of all other words it says what it says of a word
without examples: that the thing is not like them.

So the time grows only with the comparison of the first step; nothing is worked out
beforehand but rows of vectors, to which a lesson adds one. What is answered depends on
what is remembered, and not on how it came to be.

Source: learning from the neighbours of a question, Bottou & Vapnik 1992, "Local
learning algorithms"; Zhang, Berg, Maire & Malik 2006, "SVM-KNN: discriminative nearest
neighbor classification for visual category recognition".
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from hashlib import blake2b

import numpy as np
from numpy.typing import NDArray

from kille.perception.calibration import LeftOut
from kille.perception.descriptor_index import View
from kille.perception.descriptor_index.views import load_traits
from kille.perception.likeness import (
    Examples,
    Kernel,
    Likeness,
    Numbers,
    Stacked,
    choose_views,
    vector_of,
)
from kille.scene import Traits

MANY = 100
"""Words: of more, only the nearest are told apart."""

_COMPARED = 10_000  # examples of all words, unless there are more words
_MOST = 8  # examples of one word
_NEAREST = 40  # words that are told apart
_NEAR = 4  # examples of each of these
_SPARE = 1_000  # rows for views that are forgotten, or are no examples any more


class NearestWords:
    """Some views of each of many words, of which the nearest are told apart.

    It never changes.
    """

    def __init__(
        self,
        words: Mapping[str, Sequence[View]],
        labels: Sequence[str],
        kernels: Mapping[str, Kernel],
        old: NearestWords | None = None,
        *,
        denied: Iterable[View] = (),
    ) -> None:
        """Take examples from the views of each word; `labels` are the words in the
        order of answers.

        `denied` are views that the words do not hold of. What is known of views of
        former examples, with whatever kernels, is taken over.
        """
        self._labels, self._kernels = labels, kernels
        self._words = dict(words)
        self._denied: dict[str, list[View]] = {}
        for view in denied:
            self._denied.setdefault(view.label, []).append(view)
        self._most = int(np.clip(_COMPARED // max(len(labels), 1), 1, _MOST))
        self._chosen = self._choose(old)
        load_traits(view for views in self._chosen.values() for view in views)
        self._views = [view for label in labels for view in self._chosen[label]]
        counts = np.array([len(self._chosen[label]) for label in labels], np.intp)
        self._firsts = np.cumsum(counts) - counts
        self._lengths = self._count_lengths(old)
        lengths = {cue: _commonest(it) for cue, it in self._lengths.items() if it}
        self._vectors = _vectors_for(lengths, self._views, old)
        self._rows = self._vectors.rows_of(self._views)

    def likeness(self, traits: Traits) -> Likeness:
        """What each cue says of a thing with these traits, for each word."""
        apart = self._vectors.apart(traits, self._kernels, self._rows)
        alike = self._likeness_to_examples(apart)
        near = self._nearest_words(alike)
        found = self._tell_apart(near, alike).likeness(traits)
        nothing = np.zeros(len(near))
        others = {cue: found.others.get(cue, 0.0) for cue in apart}
        return Likeness(
            {
                cue: _spread(
                    found.scores.get(cue, nothing), near, other, len(self._labels)
                )
                for cue, other in others.items()
            },
            {cue: np.minimum.reduceat(d, self._firsts) for cue, d in apart.items()},
            others,
        )

    def nearest(self, traits: Traits, column: int) -> View | None:
        """The example of a word that is most similar to a thing with these traits.

        None if no cue tells both of the thing and of an example.
        """
        label = self._labels[column]
        only = Examples(self._chosen[label], [label], self._kernels)
        return only.nearest(traits, 0)

    def left_out(self) -> LeftOut | None:
        """What the examples say of each other that one question compares.

        The question is about an example of a word drawn by lot: its nearest words are
        as hard to tell apart as those of any thing. None where that tells nothing.
        """
        pivot = min(self._labels, key=_lot, default=None)
        if pivot is None or not self._chosen[pivot]:
            return None
        traits = self._chosen[pivot][-1].traits
        apart = self._vectors.apart(traits, self._kernels, self._rows)
        alike = self._likeness_to_examples(apart)
        return self._tell_apart(self._nearest_words(alike), alike).left_out()

    def _likeness_to_examples(self, apart: Mapping[str, Numbers]) -> Numbers:
        """The likeness k (n,) of a thing that is so unlike each example."""
        told_of = sum((self._kernels[cue].weight for cue in apart), 0.0)
        alike: Numbers = sum(
            (self._kernels[cue].weight * np.exp(-d) for cue, d in apart.items()),
            np.zeros(len(self._views)),
        ) / np.sqrt(max(told_of, 1e-9) * self._told_of())
        return alike

    def _choose(self, old: NearestWords | None) -> dict[str, Sequence[View]]:
        """The views of each word that are compared."""
        before: Mapping[str, Sequence[View]] = {}
        chosen: Mapping[str, Sequence[View]] = {}
        if old is not None and old._most == self._most:
            before, chosen = old._words, old._chosen
        return {
            label: chosen[label]
            if before.get(label) is views
            else choose_views(views, self._most)
            for label, views in self._words.items()
        }

    def _count_lengths(self, old: NearestWords | None) -> dict[str, Counter[int]]:
        """How many examples have vectors of each length, by cue."""
        lengths = {cue: Counter[int]() for cue in self._kernels}
        known: Mapping[str, Sequence[View]] = {}
        if old is not None and old._kernels.keys() == self._kernels.keys():
            lengths = {cue: it.copy() for cue, it in old._lengths.items()}
            known = old._chosen
        for step, some, others in (
            (1, self._chosen, known),
            (-1, known, self._chosen),
        ):
            for label, views in some.items():
                if others.get(label) is views:
                    continue
                for view in views:
                    for cue in self._kernels:
                        lengths[cue][len(vector_of(view.traits, cue))] += step
        return {cue: +it for cue, it in lengths.items()}

    def _told_of(self) -> Numbers:
        """The weights (n,) of all cues that tell of each example."""
        known = self._vectors.known_rows(self._rows)
        told = sum(
            (self._kernels[cue].weight * it for cue, it in known.items()),
            np.zeros(len(self._views)),
        )
        return np.maximum(told, 1e-9)

    def _nearest_words(self, alike: Numbers) -> NDArray[np.intp]:
        """The columns of the nearest words, in order."""
        nearness = np.maximum.reduceat(alike, self._firsts)
        return np.sort(np.argsort(-nearness, kind="stable")[:_NEAREST])

    def _tell_apart(self, near: NDArray[np.intp], alike: Numbers) -> Examples:
        """The regression that tells these words apart, near a thing that is so much
        like each example."""
        labels = [self._labels[column] for column in near]
        views = [
            self._views[number]
            for column in near
            for number in self._most_alike(column, alike)
        ]
        denied = [view for label in labels for view in self._denied.get(label, ())]
        return Examples(
            views, labels, self._kernels, denied=denied, vectors=self._vectors.stack
        )

    def _most_alike(self, column: int, alike: Numbers) -> Iterator[int]:
        """The examples of a word that are most like the thing, in order."""
        first = self._firsts[column]
        own = alike[first : first + len(self._chosen[self._labels[column]])]
        best = np.argsort(-own, kind="stable")[:_NEAR]
        yield from (first + np.sort(best)).tolist()


def _lot(label: str) -> bytes:
    """The place of a word in a random order that is the same on every machine."""
    return blake2b(label.encode("utf-8", "surrogatepass"), digest_size=8).digest()


def _spread(
    scores: Numbers, columns: NDArray[np.intp], other: float, size: int
) -> Numbers:
    """The scores in their columns among so many, all others alike."""
    spread = np.full(size, other)
    spread[columns] = scores
    return spread


def _commonest(lengths: Counter[int]) -> int:
    """The length that most vectors have, without those that are unknown: 0."""
    known = {length: times for length, times in lengths.items() if length}
    return max(known, key=lambda it: (known[it], it), default=0)


def _vectors_for(
    lengths: Mapping[str, int], views: Sequence[View], old: NearestWords | None
) -> _Vectors:
    """The vectors of former examples if they can be taken over, or new ones."""
    if old is not None and old._vectors.serves(lengths, len(views)):
        return old._vectors
    return _Vectors(lengths)


class _Vectors:
    """The vectors of views, by cue: a row for each view that was asked for.

    Rows are added, and never changed: what has numbers of rows finds the same there. It
    is of one thread at a time, as is the memory that asks.
    """

    def __init__(self, lengths: Mapping[str, int]) -> None:
        self._lengths = {cue: length for cue, length in lengths.items() if length}
        self._places: dict[View, int] = {}
        self._rows = {
            cue: np.zeros((0, length), np.float32)
            for cue, length in self._lengths.items()
        }
        self._known = dict.fromkeys(self._lengths, np.zeros(0))
        self._squares = dict.fromkeys(self._lengths, np.zeros(0, np.float32))

    def serves(self, lengths: Mapping[str, int], views: int) -> bool:
        """Do they have these lengths, and not too many rows for so few views?"""
        same = {cue: length for cue, length in lengths.items() if length}
        return same == self._lengths and len(self._places) <= 2 * views + _SPARE

    def rows_of(self, views: Sequence[View]) -> NDArray[np.intp]:
        """The rows (n,) of the views, which are added where they are missing."""
        places = self._places
        missing = [view for view in views if view not in places]
        if missing:
            self._make_room(len(places) + len(missing))
        for view in missing:
            self._write(len(places), view)
            places[view] = len(places)
        return np.array([places[view] for view in views], np.intp)

    def known_rows(self, rows: NDArray[np.intp]) -> Mapping[str, Numbers]:
        """Which of these rows are known (n,), by cue."""
        return {cue: it[rows] for cue, it in self._known.items()}

    def stack(self, cue: str, views: Sequence[View], taught: int) -> Stacked | None:
        """The vectors of some views, of which the first so many are taught."""
        rows = self.rows_of(views)
        if cue not in self._lengths or not self._known[cue][rows[:taught]].any():
            return None
        return self._rows[cue][rows], self._known[cue][rows]

    def apart(
        self, traits: Traits, kernels: Mapping[str, Kernel], rows: NDArray[np.intp]
    ) -> dict[str, Numbers]:
        """How unlike a thing is to the views of these rows (n,), by the cues that tell
        of it; infinite where it is unknown of a view."""
        apart = {}
        size = len(self._places)
        for cue, length in self._lengths.items():
            vector = vector_of(traits, cue)
            if len(vector) != length:
                continue
            products = (self._rows[cue][:size] @ vector)[rows]
            squares = self._squares[cue][rows] + (vector**2).sum()
            distances = np.maximum(squares - 2 * products, 0) / kernels[cue].width
            known = self._known[cue][rows] > 0
            apart[cue] = np.where(known, distances.astype(np.float64), np.inf)
        return apart

    def _write(self, row: int, view: View) -> None:
        for cue, length in self._lengths.items():
            vector = vector_of(view.traits, cue)
            if len(vector) == length:
                self._rows[cue][row] = vector
                self._known[cue][row] = 1.0
                self._squares[cue][row] = (vector**2).sum()

    def _make_room(self, rows: int) -> None:
        """Have room for so many rows, and a quarter more if there was not."""
        for table in (self._rows, self._known, self._squares):
            for cue, numbers in table.items():
                if len(numbers) < rows:
                    larger = np.zeros(
                        (rows * 5 // 4, *numbers.shape[1:]), numbers.dtype
                    )
                    larger[: len(numbers)] = numbers
                    table[cue] = larger
