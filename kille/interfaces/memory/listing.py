"""`kille memory list`: list the words of a memory, and how often each was taught."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Literal

from rich.table import Table

from kille.interfaces.memory.describing import when
from kille.interfaces.terminal import FINE, complain, console, memory_path, print_json
from kille.memory import Lesson, Memory, MemoryFileError
from ttr.escapes import terminal_word


@dataclass(frozen=True)
class _Entry:
    """A word of the list."""

    word: str
    kind: str
    lessons: int
    last_taught: str


Report = Callable[[Path, Sequence[_Entry]], None]
"""How a list of words is printed."""


def list_words(given: Path | None, report: Report) -> int:
    """Print the words of the memory; returns the exit code."""
    path = memory_path(given)
    try:
        with Memory.open_to_read(path) as memory:
            entries = _entries(memory.lessons())
    except MemoryFileError as error:
        return complain(error)
    report(path, entries)
    return FINE


def as_json(_: Path, entries: Sequence[_Entry]) -> None:
    """Print the words as a list of objects, for machines."""
    print_json([asdict(entry) for entry in entries])


def as_table(path: Path, entries: Sequence[_Entry]) -> None:
    """Print the words in a table, for people."""
    if not entries:
        console().print(
            f"{path} holds no words yet: teach some with kille talk", markup=False
        )
        return
    console().print(_table(path, entries))


def _entries(lessons: Sequence[Lesson]) -> list[_Entry]:
    taught: dict[tuple[str, str], list[Lesson]] = {}
    for lesson in lessons:
        word = lesson.word
        taught.setdefault((word.surface, word.kind), []).append(lesson)
    return [
        _Entry(word, kind, len(some), some[-1].turn.time)
        for (word, kind), some in sorted(taught.items())
    ]


def _table(path: Path, entries: Sequence[_Entry]) -> Table:
    title = terminal_word(str(path))
    table = Table(title=title, title_justify="left", box=None, pad_edge=False)
    for heading in ("word", "kind", "lessons", "last taught"):
        side: Literal["left", "right"] = "right" if heading == "lessons" else "left"
        table.add_column(heading, justify=side, overflow="fold")
    for entry in entries:
        word, last = terminal_word(entry.word), terminal_word(when(entry.last_taught))
        table.add_row(word, entry.kind, str(entry.lessons), last)
    return table
