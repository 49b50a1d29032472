"""The values of a database are those that kille writes, or they are faults."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing

import pytest

from kille.safety.databases import printable_name, row_faults

TABLES = """
    CREATE TABLE about (name TEXT PRIMARY KEY, value TEXT NOT NULL);
    CREATE TABLE words (id INTEGER PRIMARY KEY, name TEXT NOT NULL, place REAL);
    CREATE TABLE any (anything);
    INSERT INTO about VALUES ('sensor', 'photo');
    INSERT INTO words VALUES (1, 'cup', 0.5), (2, 'mug', NULL);
    INSERT INTO any VALUES (1), ('one'), (NULL);
"""


@pytest.fixture
def database() -> Iterator[sqlite3.Connection]:
    with closing(sqlite3.connect(":memory:")) as connection:
        connection.executescript(TABLES)
        yield connection


def test_what_a_column_need_not_have_may_be_missing(
    database: sqlite3.Connection,
) -> None:
    assert list(row_faults(database)) == []


@pytest.mark.parametrize(
    ("harm", "fault"),
    [
        (
            "INSERT INTO about VALUES (NULL, 'photo')",
            "null as name in about, where kille writes text",
        ),
        (
            "UPDATE words SET place = x'00'",
            "blob as place in words, where kille writes null or real",
        ),
        (
            "PRAGMA writable_schema = ON;"
            "UPDATE sqlite_master SET sql = replace(sql, 'REAL', 'REAL NOT NULL');"
            "PRAGMA writable_schema = RESET",
            "null as place in words, where kille writes real",
        ),
    ],
    ids=["a missing key", "another type", "a missing value"],
)
def test_a_value_that_kille_never_writes_is_a_fault(
    harm: str, fault: str, database: sqlite3.Connection
) -> None:
    database.executescript(harm)
    assert list(row_faults(database)) == [fault]


def test_a_name_is_shown_on_a_line_of_its_size() -> None:
    for name in ("", "cup", "boîte", 60 * "a"):
        assert printable_name(name) == name
    assert printable_name(61 * "a") == 60 * "a" + "..."
    assert printable_name("cup\n\x1b[31m") == r"cup\n\x1b[31m"
