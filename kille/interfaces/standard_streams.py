"""The standard streams of a command: prepare them, write to them, and drop output."""

from __future__ import annotations

import logging
import os
import sys
from io import StringIO, TextIOWrapper

from ttr.escapes import terminal_text


def prepare_streams() -> None:
    """Make sure that there are streams, even if the caller has closed them.

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
    """Formats log records of the program with invisible characters made visible."""

    def format(self, record: logging.LogRecord) -> str:
        return _as_shown(super().format(record))


def write(text: str) -> None:
    """Print a line; invisible characters are made visible."""
    sys.stdout.write(f"{_as_shown(text)}\n")


def write_error(text: str) -> None:
    """Print a line on the error stream, at once."""
    sys.stderr.write(f"{_as_shown(text)}\n")
    sys.stderr.flush()


def end_line() -> None:
    """Begin a new line on the error stream, as after a Ctrl-C that is echoed."""
    write_error("")


def _as_shown(text: str) -> str:
    if text.isascii() and text.isprintable():
        return text
    return terminal_text(text)


def drop_output() -> None:
    """Discard what was not written: Python would complain when it flushes at exit."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
