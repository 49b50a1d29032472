"""Salvage what can be read of a memory file that is damaged or not to be trusted.

Nothing of the old file is believed or executed: its rows are read from its pages and
put into the tables that kille makes, what belongs together is mended, and every lesson
that is whole then is learned by a new memory. The old file is only read.
"""

from __future__ import annotations

import os
import shutil
import sqlite3
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import closing, suppress
from dataclasses import dataclass
from mmap import ACCESS_READ, mmap
from pathlib import Path
from typing import NamedTuple

from kille.memory import reading, schema
from kille.memory.errors import ELSEWHERE, MemoryFileError, explain_failures
from kille.memory.lessons import (
    Dialogue,
    SeenLesson,
    Turn,
)
from kille.memory.memory import Memory
from kille.memory.merging import MergeResult
from kille.memory.sqlite_pages import SqliteRow, SqliteRows, Value, rows_in
from kille.safety.databases import has_strange_journal, printable_name, restrict

UNKNOWN = "unknown"
"""The time of a lost dialogue, and the speaker of a lost turn."""


class TableColumn(NamedTuple):
    """A column of a table of a memory."""

    kind: str
    is_key: bool
    """Is it the rowid, which is not stored in the record?"""
    is_required: bool


_NEW = "new.db"
_BESIDE = ("-wal", "-journal")


@dataclass(frozen=True)
class Salvage:
    """What was saved, and what was lost."""

    saved: MergeResult
    losses: tuple[str, ...]
    """What is lost, each as a line for people; rows that were not found do not
    count."""


def salvage(path: Path, target: Path) -> Salvage:
    """Make a new memory from what can be read of a file, which is left unchanged.

    Raises MemoryFileError if the target is taken, the file is changed meanwhile, or
    nothing of a memory is found in it.
    """
    if os.path.lexists(target):
        raise MemoryFileError(f"{target} is there already: name a new file")
    try:
        folder = tempfile.TemporaryDirectory(prefix=".kille-", dir=target.parent)
    except OSError as error:
        raise MemoryFileError(
            f"{target} cannot be made ({error.strerror}): name a file elsewhere"
        ) from error
    with folder as name:
        saved = _salvage_in(path, Path(name))
        os.rename(Path(name) / _NEW, target)
    return saved


def _salvage_in(path: Path, folder: Path) -> Salvage:
    """Make the new memory in this folder."""
    place = folder / "rows.db"
    with (
        explain_failures(str(path)),
        closing(sqlite3.connect(place, isolation_level=None)) as tables,
    ):
        losses = list(_fill(tables, _rows_of(_copy(path, folder))))
        kept = _SalvagedMemory(tables)
        if not (kept.dialogues or kept.turns or kept.keys):
            raise MemoryFileError(
                f"nothing of a kille memory can be found in {path}: "
                f"put back a copy, {ELSEWHERE}"
            )
        with Memory.open(folder / _NEW) as memory:
            saved = memory.merge(kept)
    Memory.open_to_read(folder / _NEW).close()  # it is one that can be trusted
    return Salvage(saved, (*losses, *kept.losses))


# --- the file ------------------------------------------------------------------------


def _copy(path: Path, folder: Path) -> Path:
    """Copy a file, with everything that was committed to it."""
    copy = folder / "copy.db"
    files = [Path(f"{path}{ending}") for ending in ("", *_BESIDE)]
    try:
        before = [_stamp(it) for it in files]
        for ending, file in zip(("", *_BESIDE), files, strict=True):
            if file.is_file() and not (
                ending == "-journal" and has_strange_journal(path)
            ):
                shutil.copyfile(file, f"{copy}{ending}")
        after = [_stamp(it) for it in files]
    except OSError as error:
        raise MemoryFileError(f"{path} cannot be read ({error.strerror})") from error
    if before != after:
        raise MemoryFileError(f"{path} is in use by another program: end that one")
    # What waits in a log beside the file belongs to it, as far as it can be put there.
    with suppress(sqlite3.Error), closing(sqlite3.connect(copy)) as connection:
        restrict(connection)
        connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    return copy


def _stamp(path: Path) -> tuple[int, int] | None:
    try:
        found = path.stat()
    except FileNotFoundError:
        return None
    return found.st_size, found.st_mtime_ns


def _rows_of(path: Path) -> SqliteRows:
    if not path.stat().st_size:
        return SqliteRows({}, (), 0)
    with path.open("rb") as file, mmap(file.fileno(), 0, access=ACCESS_READ) as pages:
        return rows_in(pages)


# --- its rows in tables of ours -------------------------------------------------------


def _fill(tables: sqlite3.Connection, found: SqliteRows) -> Iterator[str]:
    """Put rows into tables of the current version; yields what does not fit."""
    version = max(
        range(schema.VERSION, 0, -1), key=lambda it: _count_fitting(it, found)
    )
    with tables:
        tables.execute("BEGIN")
        schema.migrate(tables, schema.MIGRATIONS[:version])
        lost = found.unreadable + _insert(tables, found)
        if lost:
            yield f"{lost} row{'s' * (lost != 1)} or pages that cannot be read"
        yield from _mend(tables)
        schema.migrate(tables)


def _count_fitting(version: int, found: SqliteRows) -> int:
    """The number of rows that could belong to a memory of this version."""
    with closing(sqlite3.connect(":memory:")) as tables:
        schema.migrate(tables, schema.MIGRATIONS[:version])
        return sum(values is not None for _, values in _fitted_rows(tables, found))


def _fitted_rows(
    tables: sqlite3.Connection, found: SqliteRows
) -> list[tuple[str, tuple[Value, ...] | None]]:
    """The table and the values of every row; None if they do not fit in it."""
    columns = {it: _columns(tables, it) for it in _names(tables)}
    rows = [(name, it) for name in columns for it in found.tables.get(name, ())]
    rows += [(name, it) for it in found.strays if (name := _table_of(it, columns))]
    return [(name, _fit_row(row, columns[name])) for name, row in rows]


def _insert(tables: sqlite3.Connection, found: SqliteRows) -> int:
    """Insert all rows that fit; return how many do not."""
    lost = 0
    for name, values in _fitted_rows(tables, found):
        if values is None:
            lost += 1
            continue
        marks = ", ".join("?" * len(values))
        done = tables.execute(f"INSERT OR IGNORE INTO {name} VALUES ({marks})", values)
        lost += not done.rowcount
    return lost


def _names(tables: sqlite3.Connection) -> list[str]:
    names = "SELECT name FROM sqlite_master WHERE type = 'table' ORDER BY name"
    found = [name for (name,) in tables.execute(names)]
    return [it for it in found if not it.startswith("sqlite_")]


def _columns(tables: sqlite3.Connection, table: str) -> list[TableColumn]:
    found = tables.execute(f"PRAGMA table_info({table})")
    return [
        TableColumn(kind, bool(key), bool(required))
        for _, _, kind, required, _, key in found
    ]


def _table_of(row: SqliteRow, columns: dict[str, list[TableColumn]]) -> str:
    """The only table in which a row fits, or "": none, or one of several."""
    fitting = [it for it, kinds in columns.items() if _fit_row(row, kinds, strict=True)]
    return fitting[0] if len(fitting) == 1 else ""


def _fit_row(
    row: SqliteRow, columns: Sequence[TableColumn], *, strict: bool = False
) -> tuple[Value, ...] | None:
    """The values of a row for these columns; None if one has another type.

    Text that was stored as bytes is text, unless that is strictly looked at.
    """
    if len(row.values) != len(columns):
        return None
    values: list[Value] = []
    for column, value in zip(columns, row.values, strict=True):
        if value is None:
            if column.is_required:
                return None
            values.append(row.key if column.is_key else None)
        elif isinstance(value, _TYPES[column.kind]) and not column.is_key:
            values.append(value)
        elif column.kind == "TEXT" and isinstance(value, bytes) and not strict:
            values.append(value.decode("utf-8", "replace"))
        else:
            return None
    return tuple(values)


# A real number that is whole is stored as an integer.
_TYPES = {"INTEGER": int, "REAL": float | int, "TEXT": str, "BLOB": bytes}


# --- what belongs together ------------------------------------------------------------


def _mend(tables: sqlite3.Connection) -> Iterator[str]:
    """Complete every row, or remove it; yields what is lost."""
    numbers = (0, schema.LARGEST_KEY)
    outside = "FROM lessons WHERE id NOT BETWEEN ? AND ?"
    strange = tables.execute(f"SELECT id, name {outside}", numbers).fetchall()
    for key, name in strange:
        lesson = f"lesson {key} ({printable_name(name)})"
        yield f"{lesson} has a number that kille never gives"
    tables.execute(f"DELETE {outside}", numbers)
    tables.execute(
        "INSERT INTO dialogues SELECT DISTINCT dialogue, ? FROM turns "
        "WHERE dialogue NOT IN (SELECT id FROM dialogues)",
        (UNKNOWN,),
    )
    yield from _mend_turns(tables)
    tables.execute(
        "INSERT INTO sightings (lesson) SELECT id FROM lessons "
        "WHERE kind NOT IN ('relation', 'subkind', 'criterion') "
        "AND id NOT IN (SELECT lesson FROM sightings) "
        "AND id IN (SELECT lesson FROM scans)"
    )
    unkind, unknown = (
        f"id NOT IN (SELECT lesson FROM {it})" if it in _names(tables) else "1"
        for it in ("subsumptions", "criteria")
    )
    unseen = tables.execute(
        f"SELECT id, name FROM lessons WHERE CASE kind WHEN 'subkind' THEN {unkind} "
        f"WHEN 'criterion' THEN {unknown} "
        "WHEN 'relation' THEN id NOT IN (SELECT lesson FROM arrangements) "
        "ELSE id NOT IN (SELECT lesson FROM sightings) END ORDER BY id"
    ).fetchall()
    for key, name in unseen:
        lesson = f"lesson {key} ({printable_name(name)})"
        yield f"{lesson}: nothing is left of what was seen"
    tables.executemany("DELETE FROM lessons WHERE id = ?", [(it,) for it, _ in unseen])
    orphans: set[int] = set()
    for table in _OF_LESSONS:
        if table in _names(tables):
            gone = f"FROM {table} WHERE lesson NOT IN (SELECT id FROM lessons)"
            orphans |= {key for (key,) in tables.execute(f"SELECT lesson {gone}")}
            tables.execute(f"DELETE {gone}")
    for key in sorted(orphans - {key for key, _ in (*strange, *unseen)}):
        yield f"lesson {key}: what was seen is left, but not what word it taught"


_OF_LESSONS = (
    "crops",
    "pictures",
    "scans",
    "traits",
    "sightings",
    "arrangements",
    "subsumptions",
    "criteria",
)
"""The tables with what was seen in lessons."""


def _mend_turns(tables: sqlite3.Connection) -> Iterator[str]:
    """Give lessons whose turn is lost a turn in an unknown dialogue."""
    homeless = tables.execute(
        "SELECT turn, min(id), min(name) FROM lessons "
        "WHERE turn NOT IN (SELECT id FROM turns) GROUP BY turn ORDER BY turn"
    ).fetchall()
    if not homeless:
        return
    (dialogue,) = tables.execute("SELECT max(id) + 1 FROM dialogues").fetchone()
    dialogue = dialogue or 1
    tables.execute("INSERT INTO dialogues VALUES (?, ?)", (dialogue, UNKNOWN))
    for number, (turn, key, name) in enumerate(homeless, 1):
        tables.execute(
            "INSERT INTO turns VALUES (?, ?, ?, ?, '', '', ?)",
            (turn, dialogue, number, UNKNOWN, UNKNOWN),
        )
        lesson = f"lesson {key} ({printable_name(name)})"
        yield f"{lesson} is kept, but not who taught it when"


class _SalvagedMemory:
    """The memory in the tables, to be merged into another; collects `losses`."""

    def __init__(self, tables: sqlite3.Connection) -> None:
        self._tables = tables
        self.dialogues: tuple[Dialogue, ...] = reading.dialogues(tables)
        self.turns: tuple[Turn, ...] = reading.turns(tables)
        self.keys = [key for (key,) in tables.execute("SELECT id FROM lessons")]
        self.losses: list[str] = []

    def lessons(self) -> Iterator[SeenLesson]:
        """All lessons that are whole, oldest first."""
        for key in sorted(self.keys):
            try:
                lesson = reading.lesson(self._tables, key)
            except (ValueError, TypeError, KeyError, OverflowError) as error:
                self.losses.append(
                    f"lesson {key} is damaged: {printable_name(str(error))}"
                )
                continue
            if lesson is not None:
                yield lesson
