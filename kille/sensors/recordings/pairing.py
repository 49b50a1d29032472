"""Pair colour and depth that were taken together, by their times."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

WITHIN = 0.02
"""Seconds between a colour picture and the depth that goes with it, at most.

That of the tool that comes with the TUM recordings; less than a frame's time.
"""


def pair_times(
    first: Sequence[float], second: Sequence[float], within: float = WITHIN
) -> Iterator[tuple[int, int]]:
    """The indices of pairs, in two ascending rows of times.

    Pairs are in order of time. Each time is in one pair at most, and they are never
    further apart than `within`. Of two candidates for one partner the nearer has it.

    >>> list(pair_times([0.0, 0.033, 0.066], [0.001, 0.065, 0.5]))
    [(0, 0), (2, 1)]
    """
    i = j = 0
    while i < len(first) and j < len(second):
        gap = abs(first[i] - second[j])
        if j + 1 < len(second) and abs(first[i] - second[j + 1]) < gap:
            j += 1
        elif i + 1 < len(first) and abs(first[i + 1] - second[j]) < gap:
            i += 1
        elif gap <= within:
            yield i, j
            i, j = i + 1, j + 1
        elif first[i] < second[j]:
            i += 1
        else:
            j += 1
