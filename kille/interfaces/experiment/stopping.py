"""Stop a study while it is played, by Ctrl-C or by the system."""

from __future__ import annotations

import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

SIGNALS = (signal.SIGINT, signal.SIGTERM)


class Stop:
    """The signal that asked to stop, if any did."""

    def __init__(self) -> None:
        self._heard: signal.Signals | None = None

    @property
    def code(self) -> int:
        """The exit code to end with."""
        return 128 + (self._heard or signal.SIGINT)

    def check(self) -> None:
        """Raise KeyboardInterrupt if a stop was heard but dropped."""
        if self._heard:
            raise KeyboardInterrupt

    def drop(self, found: sys.UnraisableHookArgs) -> None:
        """Ignore a stop that is heard while Python finalises an object.

        It drops what is raised there.
        """
        if found.exc_type is not KeyboardInterrupt:
            sys.__unraisablehook__(found)

    def hear(self, number: int, _: FrameType | None = None) -> None:
        """Raise KeyboardInterrupt, only once."""
        self._heard = signal.Signals(number)
        for it in SIGNALS:
            signal.signal(it, signal.SIG_IGN)
        raise KeyboardInterrupt


@contextmanager
def stoppable() -> Iterator[Stop]:
    """Turn Ctrl-C, and the system's request to end, into one KeyboardInterrupt."""
    stop = Stop()
    dropped, sys.unraisablehook = sys.unraisablehook, stop.drop
    before = {it: signal.signal(it, stop.hear) for it in SIGNALS}
    try:
        yield stop
    finally:
        sys.unraisablehook = dropped
        for it, handler in before.items():
            signal.signal(it, handler)
