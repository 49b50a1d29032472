"""Partition views into runs of decreasing size and a short tail of the newest ones.

A run is searched by trees, which cannot grow, so that now and then some runs become
one. Each is at least 64 times as large as the next, so that there are two or three: a
question is put to each of them, while merging is done when nobody waits for it. Ten
thousand views learned one by one cost .03 s each of merging.
The partition depends only on the sizes and the order of the views, so the parts
of an index that forgot a view are those of the one that never had it.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple

TAIL = 4000
"""Descriptors; exact search is faster up to this number."""

FACTOR = 64
"""The least ratio of the sizes of neighbouring runs."""


class Run(NamedTuple):
    """Consecutive views: the first, the one after the last, and their descriptors."""

    start: int
    stop: int
    size: int


@dataclass(frozen=True)
class Partition:
    """The runs, the number of views, and that of the descriptors in the tail."""

    runs: tuple[Run, ...] = ()
    views: int = 0
    tail: int = 0

    @property
    def tail_start(self) -> int:
        """The number of the first view in the tail."""
        return self.runs[-1].stop if self.runs else 0

    def with_view(self, size: int) -> Partition:
        """The partition after one more view with `size` descriptors.

        >>> [run.size for run in partition_views([5000, 5000, 100]).runs]
        [10000]
        """
        tail, views = self.tail + size, self.views + 1
        if tail <= TAIL:
            return Partition(self.runs, views, tail)
        runs, start = list(self.runs), self.tail_start
        while runs and runs[-1].size < FACTOR * tail:
            start, _, older = runs.pop()
            tail += older
        return Partition((*runs, Run(start, views, tail)), views, 0)


def partition_views(sizes: Iterable[int]) -> Partition:
    """Partition views of these sizes."""
    partition = Partition()
    for size in sizes:
        partition = partition.with_view(size)
    return partition
