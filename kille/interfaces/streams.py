"""The streams of a command, as it is started and when nobody takes what it writes."""

from __future__ import annotations

import logging
import os
import sys
from io import StringIO, TextIOWrapper

from ttr.escapes import terminal_text


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
    if logging.lastResort is not None:
        logging.lastResort.setFormatter(_Visible())


class _Visible(logging.Formatter):
    """What a part of the program logs, and nobody else takes, as it may be printed."""

    def format(self, record: logging.LogRecord) -> str:
        return _as_shown(super().format(record))


def write(text: str) -> None:
    """Prints a line on the output; what cannot be seen is made visible."""
    sys.stdout.write(f"{_as_shown(text)}\n")


def write_error(text: str) -> None:
    """Prints a line on the error stream, at once."""
    sys.stderr.write(f"{_as_shown(text)}\n")
    sys.stderr.flush()


def end_line() -> None:
    """Begins a new line on the error stream, as after a Ctrl-C that is echoed."""
    write_error("")


def _as_shown(text: str) -> str:
    if text.isascii() and text.isprintable():
        return text
    return terminal_text(text)


def drop_output() -> None:
    """Let go of what was not written: Python would complain when it flushes at exit."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
