"""What the commands have in common: saying something, complaining, choosing a file."""

from __future__ import annotations

import sys
from pathlib import Path

from rich.console import Console

__all__ = ["FAILED", "FINE", "WRONG_USE", "complain", "console", "memory_path"]

FINE, FAILED, WRONG_USE = 0, 1, 2


def console() -> Console:
    """Where output goes: plain text in a pipe, colours in a terminal."""
    return Console(highlight=False, soft_wrap=True)


def complain(problem: object, code: int = WRONG_USE) -> int:
    """Says in one line what is wrong; the exit code."""
    line = " ".join(str(problem).split())
    sys.stderr.write(f"kille: {line}\n")
    return code


def memory_path(given: Path | None) -> Path:
    """The memory file to use: the one that was named, else the user's own."""
    from kille.memory import default_path

    return default_path() if given is None else given
