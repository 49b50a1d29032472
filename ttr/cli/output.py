"""What all commands share: exit codes, printing and complaining.

All that `ttr` prints passes here, so that no file can send escape codes to a terminal.
"""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING, Any

from ttr.cli.command_line import WRONG_USE
from ttr.escapes import json_text, terminal_line, terminal_text

if TYPE_CHECKING:
    from ttr.errors import Span


FINE, FAILED, INTERRUPTED, PIPE_CLOSED = 0, 1, 130, 141

if TYPE_CHECKING:
    #: The collection that a command adds itself to.
    Commands = argparse._SubParsersAction[argparse.ArgumentParser]
else:
    Commands = Any


def say(text: str) -> None:
    """Prints lines; characters that cannot be seen are made visible."""
    sys.stdout.write(f"{terminal_text(text)}\n")
    sys.stdout.flush()


def say_json(value: Any) -> None:
    """Prints a value as JSON."""
    say(json_text(value, indent=2))


def remark(text: str) -> None:
    """Prints to the error stream what is no part of the result."""
    sys.stderr.write(f"ttr: {terminal_text(text)}\n")
    sys.stderr.flush()


def complain(text: str) -> int:
    """Prints to the error stream what was wrong, and gives the exit code."""
    remark(text)
    return WRONG_USE


def ask(prompt: str) -> str:
    """The line that is typed after a prompt; `EOFError` at the end."""
    return input(terminal_text(prompt))


class LiveLine:
    """A line at a terminal that shows progress."""

    def __init__(self) -> None:
        self._shows = False

    def show(self, text: str) -> None:
        """Replaces the line; prints nothing if this is no terminal."""
        if sys.stderr.isatty():
            self._shows = True
            sys.stderr.write(f"\r{terminal_line(text)}")
            sys.stderr.flush()

    def clear(self) -> None:
        """Removes the line."""
        if self._shows:
            sys.stderr.write("\r\x1b[K")
            self._shows = False


def json_place(span: Span | None) -> dict[str, Any]:
    """The place of a span, for JSON."""
    if span is None:
        return {}
    return {"file": span.source, "line": span.line, "column": span.column}


def step_count(text: str) -> int:
    """The number of steps in an option; refuses all else."""
    try:
        found = int(text.replace("_", "").replace(",", ""))
    except ValueError:
        found = 0
    if found < 1:
        raise argparse.ArgumentTypeError(f"a whole number from 1, found {text!r}")
    return found
