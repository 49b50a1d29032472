"""What the commands have in common: saying something, complaining, choosing a file."""

from __future__ import annotations

import re
import shutil
import sys
import textwrap
from pathlib import Path

from rich.console import Console

__all__ = [
    "FAILED",
    "FINE",
    "WRONG_USE",
    "complain",
    "console",
    "hanging",
    "hanging_type",
    "memory_path",
]

FINE, FAILED, WRONG_USE = 0, 1, 2

_COLUMNS_OF_A_PIPE = 100
_FIRM = "\N{NO-BREAK SPACE}"


class _Console(Console):
    """A console that leaves it to `main` what a closed pipe comes to."""

    def on_broken_pipe(self) -> None:
        self.quiet = True
        raise BrokenPipeError


def console() -> Console:
    """Where output goes: plain text in a pipe, colours in a terminal."""
    return _Console(highlight=False, soft_wrap=True)


def complain(problem: object, code: int = WRONG_USE) -> int:
    """Says in one line what is wrong, after all that was said before; the exit code."""
    sys.stdout.flush()
    line = " ".join(str(problem).split())
    sys.stderr.write(f"kille: {line}\n")
    sys.stderr.flush()
    return code


def memory_path(given: Path | None) -> Path:
    """The memory file to use: the one that was named, else the user's own."""
    from kille.memory import default_path

    return default_path() if given is None else given


def hanging(mark: str, text: str) -> str:
    """The text after a mark, wrapped to the terminal, further lines under the first.

    A pipe counts as 100 columns wide.
    """
    return textwrap.fill(
        text,
        max(_columns(), len(mark) + 20),
        initial_indent=mark,
        subsequent_indent=" " * len(mark),
        break_long_words=False,
        break_on_hyphens=False,
    )


def hanging_type(mark: str, text: str) -> str:
    """The same for a type or a record: it is broken only between its parts."""
    whole = re.sub(r"(?<!,) ", _FIRM, text)
    return hanging(mark, whole).replace(_FIRM, " ")


def _columns() -> int:
    if not sys.stdout.isatty():
        return _COLUMNS_OF_A_PIPE
    return shutil.get_terminal_size().columns
