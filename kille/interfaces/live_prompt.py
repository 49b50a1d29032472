"""Keys as they are pressed: a prompt at which the robot may speak until there is one.

Until then the terminal neither echoes nor waits for whole lines; what is typed waits in
its queue. With the first key the line belongs to the tutor, and to readline, which
reads that key first: the robot does nothing until Enter is pressed.
"""

from __future__ import annotations

import select
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

_PAUSE = 0.5
"""Seconds between two looks."""

_ERASE_LINE = "\r\x1b[K"


Show = Callable[[], object]
"""Prints something."""


def wait_for_key(prompt: str, watch: Callable[[], Show | None]) -> None:
    """Watch until a key is pressed, which is left to be read.

    What `watch` has to show is printed in the place of the prompt, which comes again.
    """
    with keys_at_once():
        _write(prompt)
        try:
            while not is_key_pressed(_PAUSE):
                show = watch()
                if show is not None:
                    _write(_ERASE_LINE)
                    show()
                    _write(prompt)
        finally:
            _write(_ERASE_LINE)


def is_key_pressed(seconds: float = 0.0) -> bool:
    """Whether a key has been pressed that was not read, or is within some seconds."""
    return bool(select.select([sys.stdin], [], [], seconds)[0])


def can_watch() -> bool:
    """Whether there is a terminal to type at that can be watched for keys."""
    try:
        import termios  # noqa: F401
    except ImportError:
        return False
    return sys.stdin.isatty() and sys.stdout.isatty()


@contextmanager
def keys_at_once(*, echo: bool = False) -> Iterator[None]:
    """Have keys given one by one, with an echo or without; Ctrl-C interrupts as ever.

    readline echoes what it reads only where the terminal does so before it.
    """
    import termios

    before = termios.tcgetattr(sys.stdin)
    now = list(before)
    now[3] &= ~(termios.ICANON if echo else termios.ICANON | termios.ECHO)
    termios.tcsetattr(sys.stdin, termios.TCSADRAIN, now)
    try:
        yield
    finally:
        termios.tcsetattr(sys.stdin, termios.TCSADRAIN, before)


def _write(text: str) -> None:
    sys.stdout.write(text)
    sys.stdout.flush()
