"""What all the commands share: exit codes, and one way to say a thing or complain.

Nothing else in `ttr` writes to a terminal; so no file can speak to it in escape codes.
"""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING, Any

from ttr.cli.parser import WRONG_USE
from ttr.escapes import json_text, terminal_line, terminal_text

if TYPE_CHECKING:
    from ttr.errors import Span

__all__ = [
    "FINE",
    "FAILED",
    "WRONG_USE",
    "INTERRUPTED",
    "PIPE_CLOSED",
    "LiveLine",
    "Commands",
    "ask",
    "say",
    "say_json",
    "complain",
    "json_place",
    "step_count",
]

FINE, FAILED, INTERRUPTED, PIPE_CLOSED = 0, 1, 130, 141

if TYPE_CHECKING:
    #: What a command is added to.
    Commands = argparse._SubParsersAction[argparse.ArgumentParser]
else:
    Commands = Any


def say(text: str) -> None:
    """Prints a line, or several; what cannot be seen is made visible."""
    sys.stdout.write(f"{terminal_text(text)}\n")
    sys.stdout.flush()


def say_json(value: Any) -> None:
    """Prints a value for machines."""
    say(json_text(value, indent=2))


def complain(text: str) -> int:
    """Says on the error stream what was wrong with the use; gives the exit code."""
    sys.stderr.write(f"ttr: {terminal_text(text)}\n")
    return WRONG_USE


def ask(prompt: str) -> str:
    """A line that is typed after a prompt; raises `EOFError` where there is none."""
    return input(terminal_text(prompt))


class LiveLine:
    """A line at a terminal that shows how far something has come."""

    def __init__(self) -> None:
        self._shows = False

    def show(self, text: str) -> None:
        """Shows it in the place of what was shown; elsewhere nothing is."""
        if sys.stderr.isatty():
            self._shows = True
            sys.stderr.write(f"\r{terminal_line(text)}")
            sys.stderr.flush()

    def clear(self) -> None:
        """Takes the line away."""
        if self._shows:
            sys.stderr.write("\r\x1b[K")
            self._shows = False


def json_place(span: Span | None) -> dict[str, Any]:
    """Where something is written, for machines."""
    if span is None:
        return {}
    return {"file": span.source, "line": span.line, "column": span.column}


def step_count(text: str) -> int:
    """A number of steps that was given as an option; refuses what is none."""
    try:
        found = int(text.replace("_", "").replace(",", ""))
    except ValueError:
        found = 0
    if found < 1:
        raise argparse.ArgumentTypeError(f"a whole number from 1, found {text!r}")
    return found
