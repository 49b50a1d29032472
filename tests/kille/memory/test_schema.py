from __future__ import annotations

import sqlite3
from contextlib import closing
from pathlib import Path

import pytest

from kille.memory import Memory, MemoryFileError, schema

NEXT = (*schema.MIGRATIONS, ("ALTER TABLE dialogues ADD COLUMN tutor TEXT",))


def test_a_file_of_an_older_version_is_brought_up_to_date(path: Path) -> None:
    with Memory.open(path) as memory:
        memory.begin_dialogue("now")
    with closing(sqlite3.connect(path)) as connection:
        schema.migrate(connection, NEXT)
        schema.migrate(connection, NEXT)
        assert schema.version(connection) == len(NEXT)
        rows = connection.execute("SELECT id, began, tutor FROM dialogues").fetchall()
        assert rows == [(1, "now", None)]


def test_a_migration_that_fails_leaves_the_file_as_it_was(path: Path) -> None:
    Memory.open(path).close()
    broken = (*schema.MIGRATIONS, (*NEXT[-1], "ALTER TABLE missing ADD COLUMN x"))
    with closing(sqlite3.connect(path, isolation_level=None)) as connection:
        connection.execute("BEGIN IMMEDIATE")
        with pytest.raises(sqlite3.OperationalError, match="no such table"):
            schema.migrate(connection, broken)
        connection.rollback()
        assert schema.version(connection) == schema.VERSION
    Memory.open(path).close()


def test_a_file_of_a_newer_version_is_refused_and_left_alone(path: Path) -> None:
    Memory.open(path).close()
    with closing(sqlite3.connect(path)) as connection:
        schema.migrate(connection, NEXT)
        connection.commit()
    before = path.read_bytes()
    for opening in (Memory.open, Memory.reading):
        with pytest.raises(MemoryFileError, match=r"newer kille.*update kille"):
            opening(path)
    assert path.read_bytes() == before


def test_a_file_of_an_older_version_is_not_read_without_being_brought_up_to_date(
    path: Path,
) -> None:
    path.parent.mkdir()
    path.touch()
    with pytest.raises(MemoryFileError, match="not up to date"):
        Memory.reading(path)
    Memory.open(path).close()
    Memory.reading(path).close()
