"""Ctrl-C that is not lost.

Python drops whatever is raised while an object is finalised, or in the callback of a
weak reference; nodes have such callbacks, as they are interned. A Ctrl-C that arrives
just there would be reported as ignored, and the program would go on.
"""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Timer

_SOON = 0.2  # seconds, in which even a busy machine has left what dropped it


@contextmanager
def keep_interruptions() -> Iterator[None]:
    """Have a Ctrl-C that Python has dropped arrive again, meanwhile.

    >>> import time
    >>> class Late:
    ...     def __del__(self):
    ...         signal.raise_signal(signal.SIGINT)
    >>> try:
    ...     with keep_interruptions():
    ...         late = Late()
    ...         del late
    ...         time.sleep(10)
    ... except KeyboardInterrupt:
    ...     print("It arrived.")
    It arrived.
    """
    usual = sys.unraisablehook

    def raise_again() -> None:
        os.kill(os.getpid(), signal.SIGINT)

    def interrupt_again(dropped: sys.UnraisableHookArgs) -> None:
        if isinstance(dropped.exc_value, KeyboardInterrupt):
            again = Timer(_SOON, raise_again)  # not here, where it would be dropped too
            again.daemon = True
            again.start()
        else:
            usual(dropped)

    sys.unraisablehook = interrupt_again
    try:
        yield
    finally:
        sys.unraisablehook = usual
