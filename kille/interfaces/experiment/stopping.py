"""Being stopped while a study is played: by Ctrl-C, or by the system."""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

__all__ = ["stoppable"]

SIGNALS = (signal.SIGINT, signal.SIGTERM)


@contextmanager
def stoppable() -> Iterator[Callable[[], int]]:
    """Ctrl-C and the system's wish to end are a KeyboardInterrupt, but the first alone.

    What is given says with which exit code to end.
    """
    heard = [signal.SIGINT]

    def stop(number: int, _: FrameType | None) -> None:
        heard[:] = [signal.Signals(number)]
        for it in SIGNALS:
            signal.signal(it, signal.SIG_IGN)
        raise KeyboardInterrupt

    before = {it: signal.signal(it, stop) for it in SIGNALS}
    try:
        yield lambda: 128 + heard[0]
    finally:
        for it, handler in before.items():
            signal.signal(it, handler)
