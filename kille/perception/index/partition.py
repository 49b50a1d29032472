"""How views are parted: into runs of falling size, and the newest, which are few.

A run is searched by trees, which cannot grow, so that now and then some runs become
one. Each is at least 64 times as large as the next, so that there are two or three: a
question is put to each of them, while merging is done when nobody waits for it. Ten
thousand views learned one by one cost .03 s each of merging.
The parting depends on nothing but the sizes and the order of the views, so the parts
of an index that forgot a view are those of the one that never had it.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple

TAIL = 4000
"""Descriptors; up to here exact search is the quicker one."""

FACTOR = 64
"""Between the sizes of neighbouring runs."""


class Run(NamedTuple):
    """Some views in a row: the first, the one after the last, their descriptors."""

    start: int
    stop: int
    size: int


@dataclass(frozen=True)
class Parting:
    """The runs, how many views there are, and the descriptors of those in no run."""

    runs: tuple[Run, ...] = ()
    views: int = 0
    tail: int = 0

    @property
    def tail_start(self) -> int:
        """The first view of the tail."""
        return self.runs[-1].stop if self.runs else 0

    def grown(self, size: int) -> Parting:
        """The parting with one view more, of so many descriptors.

        >>> [run.size for run in parting_of([5000, 5000, 100]).runs]
        [10000]
        """
        tail, views = self.tail + size, self.views + 1
        if tail <= TAIL:
            return Parting(self.runs, views, tail)
        runs, start = list(self.runs), self.tail_start
        while runs and runs[-1].size < FACTOR * tail:
            start, _, older = runs.pop()
            tail += older
        return Parting((*runs, Run(start, views, tail)), views, 0)


def parting_of(sizes: Iterable[int]) -> Parting:
    """The parting of views of these sizes."""
    parting = Parting()
    for size in sizes:
        parting = parting.grown(size)
    return parting
