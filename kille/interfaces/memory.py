"""`kille memory list`: the words of a memory, and how often each was taught."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from rich.table import Table

from kille.interfaces.terminal import FINE, complain, console, memory_path
from kille.memory import Lesson, Memory, MemoryFileError

__all__ = ["list_words"]


@dataclass(frozen=True)
class _Entry:
    """A word of the list."""

    word: str
    kind: str
    lessons: int
    last_taught: str


def list_words(given: Path | None, *, as_json: bool) -> int:
    """Prints the words of the memory; the exit code."""
    path = memory_path(given)
    try:
        with Memory.reading(path) as memory:
            entries = _entries(memory.lessons())
    except MemoryFileError as error:
        return complain(error)
    out = console()
    if as_json:
        out.print_json(json.dumps([asdict(entry) for entry in entries]))
        return FINE
    if not entries:
        out.print(f"{path} holds no words yet: teach some with kille talk")
        return FINE
    out.print(_table(path, entries))
    return FINE


def _entries(lessons: Sequence[Lesson]) -> list[_Entry]:
    taught: dict[str, list[Lesson]] = {}
    for lesson in lessons:
        taught.setdefault(lesson.word.surface, []).append(lesson)
    return [
        _Entry(word, some[0].word.kind, len(some), some[-1].turn.time)
        for word, some in sorted(taught.items())
    ]


def _table(path: Path, entries: Sequence[_Entry]) -> Table:
    table = Table(title=str(path), title_justify="left", box=None, pad_edge=False)
    for heading in ("word", "kind", "lessons", "last taught"):
        table.add_column(heading, justify="right" if heading == "lessons" else "left")
    for entry in entries:
        day = entry.last_taught.replace("T", " ")[:16]
        table.add_row(entry.word, entry.kind, str(entry.lessons), day)
    return table
