"""Progress of a protocol, which counts its steps and says what it does."""

from __future__ import annotations

from kille.lab.results import Progress


class Steps:
    """The steps of a part [start, end] of the whole, each reported when it is done.

    >>> told = []
    >>> steps = Steps(lambda share, doing: told.append((share, doing)), 2)
    >>> steps("cup"); steps("car")
    >>> told
    [(0.5, 'cup'), (1.0, 'car')]
    """

    def __init__(
        self, progress: Progress, count: int, start: float = 0.0, end: float = 1.0
    ) -> None:
        self._progress = progress
        self._count = max(count, 1)
        self._start, self._end = start, end
        self._done = 0

    def __call__(self, doing: str) -> None:
        """Report that one more step is done."""
        self._done = min(self._done + 1, self._count)
        share = self._start + (self._end - self._start) * self._done / self._count
        self._progress(share, doing)
