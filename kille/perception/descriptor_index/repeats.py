"""Repeated features: in a still scene most of them are seen in scan after scan.

A feature nearer than AGAIN to one of an earlier scan is that feature seen again. The
first of them is searched for in the index; for the others only the distances to what it
found are measured. Ten scans of a still thing have about a sixth as many different
features as they have features.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kille.perception.descriptor_index.views import LENGTH, Rows, apart
from kille.scene import Features

AGAIN = 0.25
"""RootSIFT distance; what is nearer was seen in an earlier scan.

>>> from kille.perception.descriptor_index import AGAIN
>>> AGAIN
0.25
"""

_NEAR = 8.0  # pixels: what is higher or lower by more is not compared in any case
_AT_ONCE = 256  # features that are compared with those as high up as any of them

Numbers = NDArray[np.intp]


class Repeats(NamedTuple):
    """Which features of some scans are the same ones.

    `firsts` (m,) are the numbers of those not seen before, in the order of how often
    they are seen; `same` (n,) says for each feature which of these m it is, and `far`
    (n,) how far from that it is.

    >>> far = np.float32([0, 0, 0.5])
    >>> found = Repeats(firsts=np.array([1, 0]), same=np.array([1, 0, 1]), far=far)
    >>> found.reach().tolist()
    [0.0, 0.5]
    """

    firsts: Numbers
    same: Numbers
    far: Rows

    def in_order(self) -> tuple[Numbers, Repeats]:
        """An order (n,) of the features in which those that are the same stand
        together, and the repeats of the features that are put in it."""
        order = np.argsort(self.same, kind="stable")
        places = np.empty_like(order)
        places[order] = np.arange(len(order))
        return order, Repeats(places[self.firsts], self.same[order], self.far[order])

    def reach(self) -> Rows:
        """How far from each of the m features those that repeat it are at most."""
        reach = np.zeros(len(self.firsts), np.float32)
        np.maximum.at(reach, self.same, self.far)
        return reach


def find_repeats(query: Rows, scans: Sequence[Features]) -> Repeats:
    """Find which features of these scans were seen before.

    `query` (n, 128) are the descriptors of all of them as RootSIFT. Features of one
    scan are different ones.

    >>> scan = Features(np.eye(1, 128, dtype=np.uint8), *np.zeros((2, 1, 2)))
    >>> found = find_repeats(np.eye(9, 128, dtype=np.float32)[[4, 5, 4]], [scan] * 3)
    >>> found.firsts, found.same
    (array([1, 0]), array([1, 0, 1]))
    """
    heights = np.concatenate([it.pixels[:, 1] for it in scans])
    first = np.arange(len(query))
    far = np.zeros(len(query), np.float32)
    new = np.arange(len(query))
    for start, stop in pairwise(np.cumsum([0, *(len(it.pixels) for it in scans)])):
        begin, end = np.searchsorted(new, (start, stop))
        later, which, alike = _seen_again(query, heights, new[begin:end], new[end:])
        first[later], far[later] = which, apart(alike)
        new = new[first[new] == new]
    times = np.bincount(first, minlength=len(query))
    firsts = np.flatnonzero(times)
    firsts = firsts[np.argsort(times[firsts], kind="stable")]
    numbers = np.empty_like(first)
    numbers[firsts] = np.arange(len(firsts))
    return Repeats(firsts, numbers[first], far)


def products_with_found(found: Rows, query: Rows, same: Numbers) -> Rows:
    """The dot products (n, k) of features with the descriptors found for the first of
    each.

    `found` (m, k, 128) are the descriptors, `query` (n, 128) the features, and `same`
    (n,) says which of the m each is, in the order of `Repeats`; it must not fall.
    """
    products = np.empty((len(query), found.shape[1]), np.float32)
    first, member = 0, 0
    often = np.bincount(np.bincount(same))
    for times in np.flatnonzero(often).tolist():
        these = slice(first, first := first + int(often[times]))
        those = slice(member, member := member + int(often[times]) * times)
        some = query[those].reshape(-1, times, LENGTH)
        into = products[those].reshape(-1, times, found.shape[1])
        np.matmul(some, found[these].transpose(0, 2, 1), out=into)
    return products


def _seen_again(
    query: Rows, heights: NDArray[np.float32], earlier: Numbers, later: Numbers
) -> tuple[Numbers, Numbers, Rows]:
    """Those of the later features that are among the earlier ones, which they are, and
    their dot products with these.

    Both are put in order from top to bottom, so that few need to be compared.
    """
    earlier = earlier[np.argsort(heights[earlier], kind="stable")]
    later = later[np.argsort(heights[later], kind="stable")]
    rows, tops = query.take(earlier, axis=0), heights[earlier]
    again, which, alike = [later[:0]], [later[:0]], [heights[:0]]
    for start in range(0, len(later), _AT_ONCE):
        some = later[start : start + _AT_ONCE]
        low = np.searchsorted(tops, heights[some[0]] - _NEAR)
        high = np.searchsorted(tops, heights[some[-1]] + _NEAR, side="right")
        if low == high:
            continue
        products = query.take(some, axis=0) @ rows[low:high].T
        nearest = products.argmax(axis=1)
        most = products[np.arange(len(some)), nearest]
        same = most > 1 - AGAIN**2 / 2
        again.append(some[same])
        which.append(earlier[low + nearest[same]])
        alike.append(most[same])
    return np.concatenate(again), np.concatenate(which), np.concatenate(alike)
