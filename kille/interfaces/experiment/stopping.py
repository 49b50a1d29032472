"""Being stopped while a study is played: by Ctrl-C, or by the system."""

from __future__ import annotations

import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

SIGNALS = (signal.SIGINT, signal.SIGTERM)


class Stop:
    """What said to stop, if anything did."""

    def __init__(self) -> None:
        self._heard: signal.Signals | None = None

    @property
    def code(self) -> int:
        """The exit code to end with."""
        return 128 + (self._heard or signal.SIGINT)

    def check(self) -> None:
        """KeyboardInterrupt where a stop was heard, but dropped."""
        if self._heard:
            raise KeyboardInterrupt

    def drop(self, found: sys.UnraisableHookArgs) -> None:
        """Says nothing of a stop that is heard while Python clears an object away.

        It drops what is raised there.
        """
        if found.exc_type is not KeyboardInterrupt:
            sys.__unraisablehook__(found)

    def hear(self, number: int, _: FrameType | None = None) -> None:
        """KeyboardInterrupt, and from now on no other."""
        self._heard = signal.Signals(number)
        for it in SIGNALS:
            signal.signal(it, signal.SIG_IGN)
        raise KeyboardInterrupt


@contextmanager
def stoppable() -> Iterator[Stop]:
    """Ctrl-C and the system's wish to end are a KeyboardInterrupt, once."""
    stop = Stop()
    dropped, sys.unraisablehook = sys.unraisablehook, stop.drop
    before = {it: signal.signal(it, stop.hear) for it in SIGNALS}
    try:
        yield stop
    finally:
        sys.unraisablehook = dropped
        for it, handler in before.items():
            signal.signal(it, handler)
