"""Votes: each SIFT feature speaks for the word of the nearest learned descriptor.

At distance d, with the weight 1 - d / d', where d' is the distance to the nearest of
any other word, or that to the things nobody taught, whichever is less. Votes are
averaged over the scans and divided by the square root of the word's share of the
memory, since a word with many descriptors collects chance votes. With V the votes of a
word and n the features of a scan, V / C is how many times the votes of chance they are,
C = a n^b. The numbers were fitted to rendered objects and real captures, among which
most things asked about had not been taught.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from kille.perception.descriptor_index import (
    NOBODY,
    Neighbours,
    Rows,
    View,
    distances,
    rooted,
)
from kille.perception.descriptor_index.views import thin_views
from kille.perception.features import descriptors_of
from kille.scene import Features

UNTAUGHT = 0.45
"""The RootSIFT distance to expect to the descriptor of an untaught thing."""

_CHANCE, _CHANCE_POWER = 0.23, 0.65  # a and b
_SIZE_POWER = 0.5
_DENIED = 2000  # descriptors of what was denied of a word that are compared


def votes(
    found: Neighbours, words: int, scans: int, rivalling: Rows | None = None
) -> NDArray[np.float64]:
    """The votes for each of `words` words, from the neighbours of all features.

    The same picture under two words: both distances are 0, and so is the weight.
    `rivalling` (n,) are distances that count as if another word had such a descriptor.
    """
    if not found.words.shape[1]:
        return np.zeros(words)
    winner, first = found.nearest()
    _, other = found.without(winner).nearest()
    second = np.minimum(other, UNTAUGHT)
    if rivalling is not None:
        second = np.minimum(second, rivalling)
    weights = np.where(first < second, 1 - first / np.maximum(second, 1e-9), 0)
    someone = winner != NOBODY
    cast = np.bincount(winner[someone], weights[someone], minlength=words)
    return np.asarray(cast / scans, np.float64)


def rivals(
    found: Neighbours,
    scans: Sequence[Features],
    labels: Sequence[str],
    denied: Sequence[View],
) -> Rows | None:
    """The distance (n,) from each feature of some scans to the nearest denied view of
    its word.

    It is infinite where nothing was; None if nothing was denied of any of the words.
    """
    opposed = sorted({it.label for it in denied} & set(labels))
    if not opposed or not found.words.shape[1]:
        return None
    winner, _ = found.nearest()
    query = descriptors_of(scans)
    apart = np.full(len(query), np.inf, np.float32)
    for label in opposed:
        voting = np.flatnonzero(winner == labels.index(label))
        against = thin_views([it for it in denied if it.label == label], _DENIED)
        others = rooted(np.concatenate([it.descriptors for it in against]))
        if len(voting) and len(others):
            apart[voting] = distances(rooted(query[voting]), others).min(axis=1)
    return apart


def count_votes(found: Neighbours, words: int) -> NDArray[np.intp]:
    """How many features have their nearest neighbour in each of `words` words."""
    if not found.words.shape[1]:
        return np.zeros(words, np.intp)
    winner, _ = found.nearest()
    return np.bincount(winner[winner != NOBODY], minlength=words)


def beyond_chance(
    cast: NDArray[np.float64], sizes: NDArray[np.intp], features: float
) -> NDArray[np.float64]:
    """The votes for each word divided by the votes expected by chance.

    `sizes` are the descriptors that each word has in the memory, `features` those of
    one scan.

    >>> beyond_chance(np.array([4.0, 0.0]), np.array([300, 300]), 100).round(2)
    array([0.87, 0.  ])
    """
    counts = np.maximum(sizes, 1).astype(np.float64)
    shares = (counts / counts.mean()) ** _SIZE_POWER
    chance = _CHANCE * max(features, 1) ** _CHANCE_POWER
    return np.asarray(cast / shares / chance, np.float64)
