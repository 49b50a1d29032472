"""How like a thing is to the examples of each word: kernels of the cues, summed.

In cue c, with vectors x and y, two things are as unlike as d_c = |x - y|² / m_c, where
m_c is the mean of |x - y|² between different things, and as like as k_c = exp(-d_c).
Likeness as a whole is k = Σ w_c k_c / Σ w_c over the cues that tell of both. Words are
told apart by kernel ridge regression, each word against the rest: with K the likeness
of the examples to each other,

    α = (K + λ D)⁻¹ Y,   score of word w for x = Σ_i α_iw k(x, x_i)

where Y is 1 for a word's own examples and -1 for others, and D is for each example how
many its word has to the mean of the words, so that a word is not favoured for having
been taught more often. One example more stands for all that was never taught: it is of
no word, and as like to anything as different things mostly are, k = 1/e. So a single
word is told from everything else. A score is a sum over cues: it shows how much each
spoke for a word.

Only some examples of a word are compared, so that the time does not grow with what was
learned: the newest, and of the older ones those whose keys come first in an order of
chance. Which these are depends on nothing but what is remembered: to forget a view is
to be as if it had never been.

Source: kernel sums with a fixed width, Gehler & Nowozin 2009, "On feature combination
for multiclass object classification"; ridge regression, Rifkin & Klautau 2004.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from hashlib import blake2b

import numpy as np
from numpy.typing import NDArray

from kille.perception.index import View
from kille.perception.learners import Key
from kille.scene import Traits, Vector

Numbers = NDArray[np.float64]

_NOTHING = np.empty(0, np.float32)
_HUGE = 1e6

_RIDGE = 0.1  # λ
_ELSE = math.exp(-1)  # how like different things mostly are, by what m_c is
_ELSE_RIDGE = _RIDGE / 3  # what was never taught counts for three examples
_EXAMPLES = 1000  # compared in all
_LEAST, _MOST = 1, 48  # of one word


@dataclass(frozen=True)
class Kernel:
    """One cue's part in likeness: its weight w, and m, how unlike things mostly are."""

    weight: float
    width: float


@dataclass(frozen=True, eq=False)
class Likeness:
    """What the cues say for each word, by cue and in the order of the words.

    `scores` (words,) add up to the score of the regression; `unlike` (words,) is d_c of
    the most similar example of a word, infinite if the cue tells of none.
    """

    scores: Mapping[str, Numbers]
    unlike: Mapping[str, Numbers]


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
    ) -> None:
        """Examples from these views; `labels` are their words, as answers have them.

        What examples of the same kernels worked out before is taken over.
        """
        compared = _compared(views, labels)
        self._views = [view for some in compared.values() for view in some]
        counts = np.array([len(some) for some in compared.values()], np.intp)
        self._firsts = np.cumsum(counts) - counts
        self._owners = np.repeat(np.arange(len(labels)), counts)
        self._blocks = [
            _Block(cue, kernel, *rows)
            for cue, kernel in kernels.items()
            if (rows := _rows(cue, self._views)) is not None
        ]
        self._kernel = self._compare(old)
        self._weights = self._fit(counts)

    def likeness(self, traits: Traits) -> Likeness:
        """What each cue says of a thing with these traits; the unknown says nothing."""
        told = [it for it in self._blocks if it.tells_of(traits)]
        apart = {it.cue: it.apart(traits[it.cue][None])[0] for it in told}
        shared = sum((it.weight * it.known for it in told), np.zeros(len(self._views)))
        parts = self._weights[:-1] / np.maximum(shared, 1e-9)[:, None]
        all_told = max(sum(it.weight for it in told), 1e-9)
        untaught = _ELSE * self._weights[-1] / all_told
        return Likeness(
            {
                it.cue: it.weight * (np.exp(-apart[it.cue]) @ parts + untaught)
                for it in told
            },
            {cue: np.minimum.reduceat(d, self._firsts) for cue, d in apart.items()},
        )

    def _compare(self, old: Examples | None) -> Numbers:
        """The likeness K (n, n) of the examples to each other."""
        size = len(self._views)
        kernel = np.empty((size, size))
        if old is not None and not self._measured_like(old):
            old = None
        there = {} if old is None else {it: i for i, it in enumerate(old._views)}
        before = np.array([there.get(view, -1) for view in self._views], np.intp)
        kept, new = np.flatnonzero(before >= 0), np.flatnonzero(before < 0)
        if old is not None:
            taken = before[kept]
            kernel[np.ix_(kept, kept)] = old._kernel[np.ix_(taken, taken)]
        kernel[new] = self._likeness_of(new)
        kernel[:, new] = kernel[new].T
        return kernel

    def _measured_like(self, old: Examples) -> bool:
        """Whether the cues have vectors of the same lengths, so that K can be kept."""
        before = {it.cue: it.length for it in old._blocks}
        return all(before.get(it.cue, it.length) == it.length for it in self._blocks)

    def _likeness_of(self, rows: NDArray[np.intp]) -> Numbers:
        """The likeness (m, n) of some examples to all of them."""
        alike = np.zeros((len(rows), len(self._views)))
        shared = np.zeros_like(alike)
        for block in self._blocks:
            known = block.known[rows]
            apart = block.apart(block.rows[rows])
            alike += block.weight * known[:, None] * np.exp(-apart)
            shared += block.weight * np.outer(known, block.known)
        return alike / np.maximum(shared, 1e-9)

    def _fit(self, counts: NDArray[np.intp]) -> Numbers:
        """α (n + 1, words), the last row that of what was never taught."""
        size = len(self._views)
        excess = (counts / counts.mean())[self._owners] if size else np.empty(0)
        kernel = np.full((size + 1, size + 1), _ELSE)
        kernel[:size, :size] = self._kernel + _RIDGE * np.diag(excess)
        kernel[size, size] = 1 + _ELSE_RIDGE
        signs = np.full((size + 1, len(counts)), -1.0)
        signs[np.arange(size), self._owners] = 1.0
        return np.asarray(np.linalg.solve(kernel, signs), np.float64)


class _Block:
    """One cue of all examples: rows (n, k), and which of them are known (n,)."""

    def __init__(
        self, cue: str, kernel: Kernel, rows: NDArray[np.float32], known: Numbers
    ) -> None:
        self.cue, self.weight, self._width = cue, kernel.weight, kernel.width
        self.rows, self.known, self.length = rows, known, int(rows.shape[1])
        self._squares = (rows**2).sum(axis=1)

    def tells_of(self, traits: Traits) -> bool:
        return self.length == len(_vector(traits, self.cue))

    def apart(self, others: NDArray[np.float32]) -> Numbers:
        """How unlike (m, n) others (m, k) are to the rows, infinite if unknown."""
        squares = (others**2).sum(axis=1)[:, None] + self._squares
        apart = np.maximum(squares - 2 * (others @ self.rows.T), 0) / self._width
        return np.where(self.known > 0, apart.astype(np.float64), np.inf)


def _rows(
    cue: str, views: Sequence[View]
) -> tuple[NDArray[np.float32], Numbers] | None:
    """The vectors (n, k) of a cue, 0 where unknown, and which are known (n,).

    One of another length than most was measured in another way, and is unknown.
    """
    vectors = [_vector(view.traits, cue) for view in views]
    lengths = [len(it) for it in vectors if len(it)]
    if not lengths:
        return None
    length = max(lengths, key=lengths.count)
    rows = np.zeros((len(views), length), np.float32)
    known = np.zeros(len(views))
    for i, vector in enumerate(vectors):
        if len(vector) == length:
            rows[i], known[i] = vector, 1.0
    return rows, known


def _vector(traits: Traits, cue: str) -> Vector:
    """What a cue tells; nothing where it is unknown, or so large that it is no measure.

    A memory may have come from elsewhere.
    """
    vector = traits.get(cue, _NOTHING)
    return vector if np.abs(vector).max(initial=0) < _HUGE else _NOTHING


def _compared(
    views: Iterable[View], labels: Sequence[str]
) -> Mapping[str, Sequence[View]]:
    """The views of each word that are compared."""
    of: dict[str, list[View]] = {label: [] for label in labels}
    for view in views:
        of[view.label].append(view)
    most = int(np.clip(_EXAMPLES // max(len(labels), 1), _LEAST, _MOST))
    return {label: _chosen(some, most) for label, some in of.items()}


def _chosen(views: Sequence[View], most: int) -> Sequence[View]:
    """At most so many: half of them the newest, the others of any age."""
    if len(views) <= most:
        return views
    newest = views[len(views) - most // 2 :]
    older = sorted(views[: len(views) - most // 2], key=lambda it: _lot(it.key))
    return [*older[: most - most // 2], *newest]


def _lot(key: Key) -> bytes:
    """The place of a key in an order of chance that is the same everywhere."""
    return blake2b(repr(key).encode(), digest_size=8).digest()
