"""Check a memory file: all faults for which opening it would fail, and more."""

from __future__ import annotations

import os
import sqlite3
import stat
from collections.abc import Iterator
from contextlib import closing
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

from kille.memory import files, reading, schema
from kille.memory.errors import DAMAGE, STRANGE_JOURNAL, explain_failures, primary_code
from kille.memory.exporting import MemorySize
from kille.safety.databases import has_strange_journal, printable_name

MOST_FAULTS = 20
"""How many faults of one sort are reported."""


@dataclass(frozen=True)
class MemoryCheck:
    """The result of checking a memory file."""

    faults: tuple[str, ...]
    """What is wrong with it, each as a line for people."""
    notes: tuple[str, ...]
    """What its user should know, although it is no fault."""
    amount: MemorySize | None
    """How much is in it; None if that is unknown."""


def check(path: Path) -> MemoryCheck:
    """Check all of a memory file and change nothing.

    Raises MemoryFileError if there is no file, or it is not a memory of this or an
    earlier kille.
    """
    if path.is_file() and has_strange_journal(path):
        return MemoryCheck((f"it has {STRANGE_JOURNAL}",), tuple(_notes(path)), None)
    amount: MemorySize | None = None
    faults: list[str] = []
    with explain_failures(str(path)):
        try:
            with closing(files.connect_to_read(path)) as connection:
                files.check_identity(connection, path)
                faults += _faults(connection)
                amount = None if faults else _amount(connection)
        except sqlite3.Error as error:
            if primary_code(error) not in DAMAGE:
                raise
            faults.append(f"it is damaged: {printable_name(str(error))}")
    return MemoryCheck(tuple(dict.fromkeys(faults)), tuple(_notes(path)), amount)


def _faults(connection: sqlite3.Connection) -> Iterator[str]:
    parts = [f"it has {fault}" for fault in schema.part_faults(connection)]
    yield from parts[:MOST_FAULTS]
    damage = f"PRAGMA integrity_check({MOST_FAULTS})"
    pages = [it for (it,) in connection.execute(damage) if it != "ok"]
    yield from (f"its pages: {_in_short(it)}" for it in pages)
    if parts or pages:
        return
    yield from (f"it has {fault}" for fault in schema.content_faults(connection))
    if schema.version(connection) == schema.VERSION:
        yield from islice(_lesson_faults(connection), MOST_FAULTS)
        return
    with closing(files.up_to_date_copy(connection)) as copy:
        yield from islice(_lesson_faults(copy), MOST_FAULTS)


def _in_short(damage: str) -> str:
    """The first line of SQLite's report of damage, without its heading."""
    lines = [it for it in damage.splitlines() if not it.startswith("***")]
    return printable_name(" ".join(" ".join(lines).split()))


def _lesson_faults(connection: sqlite3.Connection) -> Iterator[str]:
    keys = connection.execute("SELECT id FROM lessons ORDER BY id").fetchall()
    for (key,) in keys:
        try:
            reading.lesson(connection, key)
        except (ValueError, TypeError, KeyError, OverflowError, sqlite3.Error) as error:
            yield f"lesson {key} cannot be read: {printable_name(str(error))}"


def _amount(connection: sqlite3.Connection) -> MemorySize:
    if not schema.version(connection):
        return MemorySize(0, 0, 0)
    counts = [
        connection.execute(f"SELECT count(*) FROM {table}").fetchone()[0]
        for table in ("dialogues", "turns", "lessons")
    ]
    return MemorySize(*counts)


def _notes(path: Path) -> Iterator[str]:
    mode = stat.S_IMODE(os.stat(path).st_mode)
    if os.name == "posix" and mode & 0o077:
        yield (
            f"others on this machine may open it (mode {mode:o}): "
            "chmod 600 makes it yours alone"
        )
