"""How similar a thing is to the examples of each word: a weighted sum of kernels.

In cue c, with vectors x and y, two things are as unlike as d_c = |x - y|² / m_c, where
m_c is the mean of |x - y|² between different things, and as like as k_c = exp(-d_c).
Likeness as a whole is k = Σ w_c k_c / √(W(x) W(y)), summed over the cues that tell of
both, with W(x) the weights of all cues that tell of x. So it is 1 for a thing with
itself, and positive definite whatever is unknown, as it would not be if the sum were
divided by the weights of the shared cues. Words are told apart by kernel ridge
regression, each word against the rest: with K the likeness of the examples to each
other,

    α = (K + λ D)⁻¹ Y,   score of word w for x = Σ_i α_iw k(x, x_i)

where Y is 1 for a word's own examples and -1 for others, and D is for each example how
many its word has to the mean of the words, so that a word is not favoured for having
been taught more often. One example more stands for all that was never taught: it is of
no word, and as like to anything as different things mostly are, k = 1/e. So a single
word is told from everything else. A score is a sum over cues: it shows how much each
spoke for a word. What a word was denied of counts against that word and for no other
(see `kille.perception.negative_examples`).

Only some examples of a word are compared, so that the time does not grow with what was
learned: the newest, and as many of the older ones, whose keys come first in an order of
chance. Which these are depends on nothing but what is remembered: to forget a view is
to be as if it had never been. Of very many words only those nearest to a thing are told
apart (`kille.perception.nearest_words`).

Source: kernel sums with a fixed width, Gehler & Nowozin 2009, "On feature combination
for multiclass object classification"; ridge regression, Rifkin & Klautau 2004.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from heapq import nsmallest

import numpy as np
from numpy.typing import NDArray

from kille.perception.calibration import LeftOut, leave_out
from kille.perception.descriptor_index import View
from kille.perception.descriptor_index.views import load_traits
from kille.perception.negative_examples import weights_with_denials
from kille.scene import Traits, Vector

Numbers = NDArray[np.float64]
Places = NDArray[np.intp]

SIZE = "size"
"""The cue of metric size."""

_NOTHING = np.empty(0, np.float32)
_HUGE = 1e6

_RIDGE = 0.1  # λ
_ELSE = math.exp(-1)  # how like different things mostly are, by what m_c is
_ELSE_RIDGE = _RIDGE / 3  # what was never taught counts for three examples
_EXAMPLES = 1000  # compared in all, unless there are more words
_LEAST, _MOST = 1, 48  # of one word
_MOST_DENIED = 12  # of one word, the newest


Stacked = tuple[NDArray[np.float32], Numbers]
"""The vectors (n, k) of a cue, 0 where unknown, and which are known (n,)."""

Vectors = Callable[[str, Sequence[View], int], Stacked | None]
"""Gives those of a cue of some views, of which the first so many are taught; or None if
the cue tells of none of these."""


@dataclass(frozen=True)
class Kernel:
    """One cue's part in likeness: its weight w, and m, how unlike things mostly are."""

    weight: float
    width: float


@dataclass(frozen=True, eq=False)
class Likeness:
    """What the cues say for each word, by cue, in the order of the words.

    `scores` (words,) add up to the score of the regression; `unlike` (words,) is d_c of
    the most similar example of a word, infinite if the cue tells of none. `others` are
    the scores of any word that has no examples.
    """

    scores: Mapping[str, Numbers]
    unlike: Mapping[str, Numbers]
    others: Mapping[str, float]

    def with_column(self, column: int, other: Likeness) -> Likeness:
        """The same, but for one word what the other says of it by the same cues.

        Of a cue by which the other says nothing the word has no score.
        """
        return Likeness(
            _with_column(self.scores, column, other.scores, 0.0),
            _with_column(self.unlike, column, other.unlike, np.inf),
            self.others,
        )

    def without(self, cue: str, columns: Sequence[int]) -> Likeness:
        """The same, but how unlike a cue is of some words is not known."""
        if cue not in self.unlike:
            return self
        apart = self.unlike[cue].copy()
        apart[list(columns)] = np.inf
        return replace(self, unlike={**self.unlike, cue: apart})


class Examples:
    """Some views of each word, and the regression that tells the words apart.

    It never changes.
    """

    def __init__(
        self,
        views: Iterable[View],
        labels: Sequence[str],
        kernels: Mapping[str, Kernel],
        old: Examples | None = None,
        *,
        denied: Iterable[View] = (),
        vectors: Vectors | None = None,
    ) -> None:
        """Take examples from these views; `labels` are their words, in the order of
        answers.

        `denied` are views that the words do not hold of. What examples of the same
        kernels worked out before is taken over. `vectors` are those of the views, where
        they have been stacked already.
        """
        compared = _compared_views(views, labels)
        taught = [view for some in compared.values() for view in some]
        load_traits(taught)
        against = _against(denied, labels)
        self._views = [*taught, *(view for some in against for view in some)]
        self._taught = len(taught)
        self._opposed = np.repeat(np.arange(len(labels)), [len(it) for it in against])
        counts = np.array([len(some) for some in compared.values()], np.intp)
        self._firsts = np.cumsum(counts) - counts
        self._owners = np.repeat(np.arange(len(labels)), counts)
        self._blocks = [
            _Block(cue, kernel, *rows)
            for cue, kernel in kernels.items()
            if (rows := (vectors or stack_vectors)(cue, self._views, len(taught)))
        ]
        if old is not None and not self._measured_like(old):
            old = None
        told = sum(
            (it.weight * it.known for it in self._blocks), np.zeros(len(self._views))
        )
        self._told_of = np.maximum(told, 1e-9)
        before = self._places_in(old)
        self._kernel = self._compare(old, before)
        self._weights = self._fit(counts)

    def likeness(self, traits: Traits) -> Likeness:
        """What each cue says of a thing with these traits; unknown traits say
        nothing."""
        told = [it for it in self._blocks if it.tells_of(traits)]
        apart = {it.cue: it.apart(traits[it.cue][None])[0] for it in told}
        told_of = max(sum(it.weight for it in told), 1e-9)
        parts = self._weights[:-1] / np.sqrt(told_of * self._told_of)[:, None]
        untaught = _ELSE * self._weights[-1] / told_of
        scores = {
            it.cue: it.weight * (np.exp(-apart[it.cue]) @ parts + untaught)
            for it in told
        }
        return Likeness(
            {cue: some[:-1] for cue, some in scores.items()},
            {
                cue: np.minimum.reduceat(d[: self._taught], self._firsts)
                for cue, d in apart.items()
            },
            {cue: float(some[-1]) for cue, some in scores.items()},
        )

    def nearest(self, traits: Traits, column: int) -> View | None:
        """The example of a word that is most similar to a thing with these traits.

        None if no cue tells both of the thing and of an example.
        """
        told = [it for it in self._blocks if it.tells_of(traits)]
        alike = np.zeros(len(self._views))
        shared = np.zeros(len(self._views))
        for block in told:
            alike += block.weight * np.exp(-block.apart(traits[block.cue][None])[0])
            shared += block.weight * block.known
        own = np.flatnonzero(self._owners == column)
        known = own[shared[own] > 0]
        if not len(known):
            return None
        return self._views[int(known[np.argmax(alike[known] / shared[known])])]

    def left_out(self) -> LeftOut | None:
        """What the examples say of each other, for calibration.

        None where that tells nothing, as of one example a word, or of one word.
        """
        counts = np.bincount(self._owners)
        if len(counts) < 2 or counts.max() < 2:
            return None
        size, unlike = self._taught, self._unlike_in_size()
        inverse = np.asarray(np.linalg.inv(self._system(counts)), np.float64)
        return leave_out(self._kernel[:size, :size], inverse, self._owners, unlike)

    def _unlike_in_size(self) -> Numbers:
        """How unlike in size the examples (n, n) are; infinite where it is unknown."""
        size = self._taught
        for block in self._blocks:
            if block.cue == SIZE:
                apart = block.apart(block.rows[:size])[:, :size]
                return np.where(block.known[:size, None] > 0, apart, np.inf)
        return np.full((size, size), np.inf)

    def _places_in(self, old: Examples | None) -> Places:
        """The former numbers (n,) of the examples; -1 for a new one."""
        there = {} if old is None else {view: i for i, view in enumerate(old._views)}
        return np.array([there.get(view, -1) for view in self._views], np.intp)

    def _compare(self, old: Examples | None, before: Places) -> Numbers:
        """The likeness K (n, n) of the examples to each other."""
        size = len(self._views)
        kernel = np.empty((size, size))
        kept, new = np.flatnonzero(before >= 0), np.flatnonzero(before < 0)
        if old is not None:
            taken = before[kept]
            kernel[np.ix_(kept, kept)] = old._kernel[np.ix_(taken, taken)]
        kernel[new] = self._likeness_of(new)
        kernel[:, new] = kernel[new].T
        return kernel

    def _measured_like(self, old: Examples) -> bool:
        """Do the cues have vectors of the same lengths, so that K can be reused?"""
        before = {it.cue: it.length for it in old._blocks}
        return all(before.get(it.cue, it.length) == it.length for it in self._blocks)

    def _likeness_of(self, rows: NDArray[np.intp]) -> Numbers:
        """The likeness (m, n) of some examples to all of them."""
        alike = np.zeros((len(rows), len(self._views)))
        for block in self._blocks:
            known = block.known[rows]
            apart = block.apart(block.rows[rows])
            alike += block.weight * known[:, None] * np.exp(-apart)
        alike /= np.sqrt(np.outer(self._told_of[rows], self._told_of))
        return alike

    def _fit(self, counts: NDArray[np.intp]) -> Numbers:
        """The weights α (n + 1, words + 1).

        The last row belongs to everything untaught, the last column to a word that has
        no examples.
        """
        size, system = self._taught, self._system(counts)
        signs = np.full((size + 1, len(counts) + 1), -1.0)
        signs[np.arange(size), self._owners] = 1.0
        alone = np.asarray(np.linalg.solve(system, signs), np.float64)
        return alone if not len(self._opposed) else self._oppose(alone, system)

    def _system(self, counts: NDArray[np.intp]) -> Numbers:
        """K + λ D (n + 1, n + 1), the last row for everything untaught."""
        size = self._taught
        system = np.full((size + 1, size + 1), _ELSE)
        system[:size, :size] = self._kernel[:size, :size]
        excess = (counts / counts.mean())[self._owners] if size else np.empty(0)
        system[np.arange(size), np.arange(size)] += _RIDGE * excess
        system[size, size] = 1 + _ELSE_RIDGE
        return system

    def _oppose(self, alone: Numbers, system: Numbers) -> Numbers:
        """The weights α (all examples + 1, words) with negative examples included."""
        size, denials = self._taught, len(self._opposed)
        border = np.full((size + 1, denials), _ELSE)
        border[:size] = self._kernel[:size, size:]
        through = np.linalg.solve(system, border)
        among = self._kernel[size:, size:] + _RIDGE * np.eye(denials)
        weights, against = weights_with_denials(
            alone, through, border, among, self._opposed
        )
        return np.concatenate([weights[:-1], against, weights[-1:]])


def _with_column(
    these: Mapping[str, Numbers],
    column: int,
    others: Mapping[str, Numbers],
    missing: float,
) -> dict[str, Numbers]:
    changed = {cue: numbers.copy() for cue, numbers in these.items()}
    for cue, numbers in changed.items():
        numbers[column] = others[cue][column] if cue in others else missing
    return changed


class _Block:
    """One cue of all examples: rows (n, k), and which of them are known (n,)."""

    def __init__(
        self, cue: str, kernel: Kernel, rows: NDArray[np.float32], known: Numbers
    ) -> None:
        self.cue, self.weight, self._width = cue, kernel.weight, kernel.width
        self.rows, self.known, self.length = rows, known, int(rows.shape[1])
        self._squares = (rows**2).sum(axis=1)

    def tells_of(self, traits: Traits) -> bool:
        return self.length == len(vector_of(traits, self.cue))

    def apart(self, others: NDArray[np.float32]) -> Numbers:
        """The dissimilarity (m, n) of others (m, k) to the rows; infinite if
        unknown."""
        squares = (others**2).sum(axis=1)[:, None] + self._squares
        apart = np.maximum(squares - 2 * (others @ self.rows.T), 0) / self._width
        return np.where(self.known > 0, apart.astype(np.float64), np.inf)


def stack_vectors(cue: str, views: Sequence[View], taught: int) -> Stacked | None:
    """The vectors (n, k) of a cue, 0 where unknown, and which are known (n,).

    One of another length than most of those taught, which come first, was measured in
    another way, and is unknown.
    """
    vectors = [vector_of(view.traits, cue) for view in views]
    lengths = Counter(len(it) for it in vectors[:taught] if len(it))
    if not lengths:
        return None
    length = lengths.most_common(1)[0][0]
    rows = np.zeros((len(views), length), np.float32)
    known = np.zeros(len(views))
    for i, vector in enumerate(vectors):
        if len(vector) == length:
            rows[i], known[i] = vector, 1.0
    return rows, known


def vector_of(traits: Traits, cue: str) -> Vector:
    """The vector of a cue; empty if it is unknown, or too large to be a measurement.

    A memory may have come from elsewhere.
    """
    vector = traits.get(cue, _NOTHING)
    return vector if np.abs(vector).max(initial=0) < _HUGE else _NOTHING


def _compared_views(
    views: Iterable[View], labels: Sequence[str]
) -> Mapping[str, Sequence[View]]:
    """Choose the views of each word that are compared."""
    of: dict[str, list[View]] = {label: [] for label in labels}
    for view in views:
        of[view.label].append(view)
    most = int(np.clip(_EXAMPLES // max(len(labels), 1), _LEAST, _MOST))
    return {label: choose_views(some, most) for label, some in of.items()}


def choose_views(views: Sequence[View], most: int) -> Sequence[View]:
    """Choose at most `most` views: half of them the newest, the rest at random."""
    if len(views) <= most:
        return views
    newest = views[len(views) - most // 2 :]
    older = nsmallest(
        most - most // 2, views[: len(views) - most // 2], key=lambda it: it.lot
    )
    return [*older, *newest]


def _against(denied: Iterable[View], labels: Sequence[str]) -> Sequence[Sequence[View]]:
    """The newest views that were denied of each word."""
    of: dict[str, list[View]] = {label: [] for label in labels}
    for view in denied:
        of.get(view.label, []).append(view)
    return [some[-_MOST_DENIED:] for some in of.values()]
