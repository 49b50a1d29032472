"""Export a whole memory as a package that other programs can read.

    memory.json          the format, its version, and the SHA-256 of each .jsonl file
    dialogues.jsonl      a line for each dialogue
    turns.jsonl          a line for all that was said
    lessons.jsonl        a line for each lesson, with the SHA-256 of its files
    lessons/7/…          the files of lesson 7

The same memory gives the same bytes.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Any

from kille.memory.memory import MemoryReader
from kille.memory.packages import MANIFEST, PackageWriter, open_to_write
from kille.memory.packing import Line, pack_dialogue, pack_lesson, pack_turn

FORMAT, VERSION = "kille memory", 4
DIALOGUES, TURNS, LESSONS = "dialogues.jsonl", "turns.jsonl", "lessons.jsonl"


@dataclass(frozen=True)
class MemorySize:
    """The number of dialogues, turns and lessons."""

    dialogues: int
    turns: int
    lessons: int


def export(memory: MemoryReader, path: Path) -> MemorySize:
    """Write all that the memory holds, as a zip if the path ends in .zip, or a folder.

    An older zip of ours is replaced. Raises PackageError, and leaves what was there,
    if it cannot be written or the path is taken by something else.
    """
    with open_to_write(path) as package, memory.at_one_moment():
        dialogues, turns = memory.dialogues(), memory.turns()
        keys = [lesson.key for lesson in memory.lessons()]
        files = {
            DIALOGUES: _lines(map(pack_dialogue, dialogues)),
            TURNS: _lines(map(pack_turn, turns)),
            LESSONS: _lines(_write_lesson(package, memory, key) for key in keys),
        }
        for name, content in files.items():
            package.write(name, content)
        sums = {name: checksum(content) for name, content in files.items()}
        manifest = {"format": FORMAT, "version": VERSION, "files": sums}
        package.write(MANIFEST, _json(manifest, indent=1))
    return MemorySize(len(dialogues), len(turns), len(keys))


def checksum(content: bytes) -> str:
    """The SHA-256 of the bytes, in hexadecimal."""
    return sha256(content).hexdigest()


def place(key: int, name: str) -> str:
    """The path of a lesson's file in a package."""
    return f"lessons/{key}/{name}"


def _write_lesson(package: PackageWriter, memory: MemoryReader, key: int) -> Line:
    """Write the files of a lesson; returns its line."""
    line, files = pack_lesson(memory.lesson(key))
    for name, content in files.items():
        package.write(place(key, name), content)
    return line | {"files": {name: checksum(it) for name, it in files.items()}}


def _lines(values: Iterable[Line]) -> bytes:
    return b"".join(_json(value) for value in values)


def _json(value: Line, **layout: Any) -> bytes:
    text = json.dumps(value, ensure_ascii=False, allow_nan=False, **layout)
    return f"{text}\n".encode()
