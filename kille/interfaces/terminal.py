"""Common to all commands: printing, complaining, choosing a memory file.

All that they print goes through here, where invisible characters are made visible: no
word, file or device can send escape codes or rich's markup to the terminal.
"""

from __future__ import annotations

import math
import re
import shutil
import sys
import textwrap
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from rich.console import Console, ConsoleOptions, RenderableType
from rich.highlighter import JSONHighlighter
from rich.progress import (
    BarColumn,
    Progress,
    ProgressColumn,
    TextColumn,
    TimeRemainingColumn,
)
from rich.segment import Segment
from rich.text import Text

from kille.interfaces.standard_streams import write_error
from ttr.escapes import json_text, terminal_line, terminal_text

FINE, FAILED, WRONG_USE = 0, 1, 2

COLUMNS_OF_A_PIPE = 100
_FIRM = "\N{NO-BREAK SPACE}"


class _Console(Console):
    """A console that prints words as they are, and makes invisible characters visible.

    It leaves it to `main` what a closed pipe comes to.
    """

    def render_str(self, text: str, **settings: Any) -> Text:
        """A text with its style, of which the width is known."""
        return super().render_str(terminal_text(text), **settings)

    def render(
        self, renderable: RenderableType, options: ConsoleOptions | None = None
    ) -> Iterator[Segment]:
        """The pieces to be printed; only a console's own may be escape codes."""
        for piece in super().render(renderable, options):
            safe = Segment(terminal_text(piece.text), piece.style)
            yield piece if piece.control else safe

    def on_broken_pipe(self) -> None:
        self.quiet = True
        raise BrokenPipeError


def console(*, stderr: bool = False) -> Console:
    """A console for output: plain text in a pipe, colours in a terminal."""
    return _Console(
        stderr=stderr, markup=False, emoji=False, highlight=False, soft_wrap=True
    )


def print_json(value: Any) -> None:
    """Print a value for machines, which have null for what is no finite number."""
    text = Text(json_text(_plain_value(value), indent=2, allow_nan=False))
    console().print(JSONHighlighter()(text))


def _plain_value(value: Any) -> Any:
    """The value as JSON has it; NaN and infinity become null."""
    match value:
        case None | str() | bool() | int():
            return value
        case float():
            return value if math.isfinite(value) else None
        case Mapping():
            return {str(key): _plain_value(it) for key, it in value.items()}
        case Iterable():
            return [_plain_value(it) for it in value]
    return _plain_value(value.item()) if hasattr(value, "item") else str(value)


def transient_bar(out: Console, *columns: ProgressColumn, **settings: Any) -> Progress:
    """A bar of these columns on a terminal, which is gone at the end; else nothing.

    The settings are those of rich's `Progress`.
    """
    return Progress(
        *columns, console=out, transient=True, disable=not out.is_terminal, **settings
    )


def labelled_bar(out: Console) -> Progress:
    """A bar on a terminal, with its label in front and the time left behind."""
    return transient_bar(
        out,
        TextColumn("{task.description}", style="progress.description", markup=False),
        BarColumn(),
        TextColumn("{task.percentage:>3.0f}%", style="progress.percentage"),
        TimeRemainingColumn(),
    )


def ask(prompt: str) -> str:
    """Read a line after a prompt; raises `EOFError` if there is none."""
    return input(terminal_line(prompt))


def complain(problem: object, code: int = WRONG_USE) -> int:
    """Print in one line what is wrong, after earlier output; the exit code."""
    sys.stdout.flush()
    write_error(f"kille: {' '.join(str(problem).split())}")
    return code


def complain_all(error: Exception) -> int:
    """Print all `faults` of an error, each in a line, or the error; the exit code."""
    for fault in getattr(error, "faults", [error]):
        complain(fault)
    return WRONG_USE


def memory_path(given: Path | None) -> Path:
    """The memory file to use: the one named, or else the user's own."""
    from kille.memory import default_path

    return default_path() if given is None else given


def hang_text(mark: str, text: str) -> str:
    """Wrap text to the terminal, with a mark before the first line and others indented.

    A pipe counts as 100 columns wide.
    """
    return _fill(terminal_line(mark), terminal_text(text))


def hanging_type(mark: str, text: str) -> str:
    """Wrap a type or a record likewise, breaking it only between its parts."""
    whole = re.sub(r"(?<!,) ", _FIRM, terminal_text(text))
    return _fill(terminal_line(mark), whole).replace(_FIRM, " ")


def cut_line(mark: str, text: str) -> str:
    """The mark and the text on one line, cut off with … where the terminal ends."""
    line = terminal_line(f"{mark}{text}")
    width = _columns()
    return line if len(line) <= width else line[: width - 1].rstrip() + "…"


def _fill(mark: str, text: str) -> str:
    return textwrap.fill(
        text,
        max(_columns(), len(mark) + 20),
        initial_indent=mark,
        subsequent_indent=" " * len(mark),
        break_long_words=False,
        break_on_hyphens=False,
    )


def _columns() -> int:
    if not sys.stdout.isatty():
        return COLUMNS_OF_A_PIPE
    return shutil.get_terminal_size().columns
