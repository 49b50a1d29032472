"""What all the commands share: exit codes, and one way to say a thing or complain."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ttr.errors import Span

__all__ = [
    "FINE",
    "FAILED",
    "WRONG_USE",
    "INTERRUPTED",
    "PIPE_CLOSED",
    "Commands",
    "say",
    "complain",
    "place",
]

FINE, FAILED, WRONG_USE, INTERRUPTED, PIPE_CLOSED = 0, 1, 2, 130, 141

if TYPE_CHECKING:
    #: What a command is added to.
    Commands = argparse._SubParsersAction[argparse.ArgumentParser]
else:
    Commands = Any


def say(text: str) -> None:
    """Prints a line, or several."""
    sys.stdout.write(f"{text}\n")


def complain(text: str) -> int:
    """Says on the error stream what was wrong with the use; gives the exit code."""
    sys.stderr.write(f"ttr: {text}\n")
    return WRONG_USE


def place(span: Span | None) -> dict[str, Any]:
    """Where something is written, for machines."""
    if span is None:
        return {}
    return {"file": span.source, "line": span.line, "column": span.column}
