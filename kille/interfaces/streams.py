"""The streams of a command, as it is started and when nobody takes what it writes."""

from __future__ import annotations

import os
import sys
from io import StringIO, TextIOWrapper

__all__ = ["drop_output", "prepare_streams"]


def prepare_streams() -> None:
    """Have something to read and write even where a caller has closed it.

    Bytes that are no characters, and characters that cannot be shown, are replaced.
    """
    for name in ("stdin", "stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            setattr(sys, name, StringIO())
        elif isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="replace")


def drop_output() -> None:
    """Let go of what was not written: Python would complain when it flushes at exit."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
