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
    """A word of the list: in how many lessons it was said to hold, or not to.

    The former is what the robot says when it is asked what it knows.
    """

    word: str
    kind: str
    lessons: int
    denied: int
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
        taught.setdefault((word.name, word.kind), []).append(lesson)
    return sorted(map(_entry, taught.values()), key=lambda it: (it.word, it.kind))


def _entry(lessons: Sequence[Lesson]) -> _Entry:
    """The entry of a word, as it was said when it was first said to hold."""
    holding = [it for it in lessons if it.holds]
    word = (holding or lessons)[0].word
    count = len(holding)
    last = lessons[-1].turn.time
    return _Entry(word.surface, word.kind, count, len(lessons) - count, last)


def _table(path: Path, entries: Sequence[_Entry]) -> Table:
    title = terminal_word(str(path))
    table = Table(title=title, title_justify="left", box=None, pad_edge=False)
    denied = ["denied"] if any(entry.denied for entry in entries) else []
    for heading in ("word", "kind", "lessons", *denied, "last taught"):
        counts = heading in ("lessons", "denied")
        side: Literal["left", "right"] = "right" if counts else "left"
        table.add_column(heading, justify=side, overflow="fold")
    for entry in entries:
        word, last = terminal_word(entry.word), terminal_word(when(entry.last_taught))
        numbers = [entry.lessons, entry.denied] if denied else [entry.lessons]
        table.add_row(word, entry.kind, *map(str, numbers), last)
    return table
