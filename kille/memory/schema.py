"""The tables of a memory file, and how older files are brought up to date.

A word has no row of its own: it is known exactly as long as a lesson teaches it, so
that forgetting a lesson leaves nothing behind.
"""

from __future__ import annotations

import json
import math
import sqlite3
import struct
from collections.abc import Callable, Sequence

# "KILL" in ASCII: tells our files from any other SQLite database.
APPLICATION_ID = 0x4B494C4C

Migration = tuple[str | Callable[[sqlite3.Connection], None], ...]
"""Statements, and what no statement can say."""

TABLES: Migration = (
    """
    CREATE TABLE dialogues (
        id INTEGER PRIMARY KEY,
        began TEXT NOT NULL
    )
    """,
    """
    CREATE TABLE turns (
        id INTEGER PRIMARY KEY,
        dialogue INTEGER NOT NULL REFERENCES dialogues,
        number INTEGER NOT NULL,
        speaker TEXT NOT NULL,
        text TEXT NOT NULL,
        judgement TEXT NOT NULL,
        time TEXT NOT NULL,
        UNIQUE (dialogue, number)
    )
    """,
    # AUTOINCREMENT: the key of a forgotten lesson is never given to another.
    """
    CREATE TABLE lessons (
        id INTEGER PRIMARY KEY AUTOINCREMENT,
        kind TEXT NOT NULL CHECK (kind IN ('object', 'relation')),
        name TEXT NOT NULL,
        surface TEXT NOT NULL,
        turn INTEGER NOT NULL REFERENCES turns,
        sensor TEXT NOT NULL,
        time REAL NOT NULL
    )
    """,
    "CREATE INDEX lessons_by_word ON lessons (kind, name)",
    """
    CREATE TABLE sightings (
        lesson INTEGER PRIMARY KEY REFERENCES lessons ON DELETE CASCADE,
        x REAL, y REAL, z REAL,
        colour BLOB,
        length REAL, breadth REAL, thickness REAL
    )
    """,
    """
    CREATE TABLE scans (
        id INTEGER PRIMARY KEY,
        lesson INTEGER NOT NULL REFERENCES lessons ON DELETE CASCADE,
        descriptors BLOB NOT NULL,
        points BLOB NOT NULL
    )
    """,
    "CREATE INDEX scans_by_lesson ON scans (lesson)",
    """
    CREATE TABLE arrangements (
        lesson INTEGER PRIMARY KEY REFERENCES lessons ON DELETE CASCADE,
        target TEXT NOT NULL,
        landmark TEXT NOT NULL,
        x REAL NOT NULL, y REAL NOT NULL, z REAL NOT NULL
    )
    """,
)

# Version 1 kept a histogram of colours and three lengths in metres of every sighting.
NEARLY_NOTHING = 0.01  # metres added to a length before its logarithm is taken


def move_traits(connection: sqlite3.Connection) -> None:
    """What version 1 knew of things as a whole, as vectors of the cues it became."""
    looks = connection.execute(
        "SELECT lesson, colour, length, breadth, thickness FROM older_sightings "
        "ORDER BY lesson"
    ).fetchall()
    for lesson, colour, *lengths in looks:
        if colour is not None:
            _add_trait(connection, lesson, "colour", colour)
        if None not in lengths and all(x > -NEARLY_NOTHING for x in lengths):
            longest_first = sorted(lengths, reverse=True)
            size = [math.log(x + NEARLY_NOTHING) for x in longest_first]
            _add_trait(connection, lesson, "size", struct.pack("<3f", *size))


def move_offsets(connection: sqlite3.Connection) -> None:
    """Offsets as configurations of which nothing else is known."""
    offsets = connection.execute(
        "SELECT lesson, target, landmark, x, y, z FROM older_arrangements "
        "ORDER BY lesson"
    ).fetchall()
    for lesson, target, landmark, *offset in offsets:
        connection.execute(
            "INSERT INTO arrangements VALUES (?, ?, ?, ?)",
            (lesson, target, landmark, json.dumps({"offset": offset})),
        )


def _add_trait(
    connection: sqlite3.Connection, lesson: int, cue: str, vector: bytes
) -> None:
    connection.execute(
        "INSERT INTO traits (lesson, cue, vector) VALUES (?, ?, ?)",
        (lesson, cue, vector),
    )


EVIDENCE: Migration = (
    """
    CREATE TABLE traits (
        id INTEGER PRIMARY KEY,
        lesson INTEGER NOT NULL REFERENCES lessons ON DELETE CASCADE,
        cue TEXT NOT NULL,
        vector BLOB NOT NULL,
        UNIQUE (lesson, cue)
    )
    """,
    "ALTER TABLE sightings RENAME TO older_sightings",
    """
    CREATE TABLE sightings (
        lesson INTEGER PRIMARY KEY REFERENCES lessons ON DELETE CASCADE,
        x REAL, y REAL, z REAL
    )
    """,
    "INSERT INTO sightings SELECT lesson, x, y, z FROM older_sightings",
    move_traits,
    "DROP TABLE older_sightings",
    "ALTER TABLE arrangements RENAME TO older_arrangements",
    """
    CREATE TABLE arrangements (
        lesson INTEGER PRIMARY KEY REFERENCES lessons ON DELETE CASCADE,
        target TEXT NOT NULL,
        landmark TEXT NOT NULL,
        configuration TEXT NOT NULL
    )
    """,
    move_offsets,
    "DROP TABLE older_arrangements",
    # Boxes and intrinsics are JSON; the rest are files of pictures.
    """
    CREATE TABLE pictures (
        lesson INTEGER PRIMARY KEY REFERENCES lessons ON DELETE CASCADE,
        frame BLOB NOT NULL,
        boxes TEXT NOT NULL
    )
    """,
    """
    CREATE TABLE crops (
        lesson INTEGER PRIMARY KEY REFERENCES pictures ON DELETE CASCADE,
        colour BLOB NOT NULL,
        mask BLOB NOT NULL,
        depth BLOB,
        intrinsics TEXT
    )
    """,
)

# The kinds of lessons are checked by their table, and SQLite changes no check: another
# table takes its place. Nothing may look after foreign keys meanwhile, or what was seen
# would go with the old table. The count of keys ever given is kept.
POLARITY: Migration = (
    """
    CREATE TABLE newer_lessons (
        id INTEGER PRIMARY KEY AUTOINCREMENT,
        kind TEXT NOT NULL CHECK (kind IN ('object', 'attribute', 'relation')),
        name TEXT NOT NULL,
        surface TEXT NOT NULL,
        turn INTEGER NOT NULL REFERENCES turns,
        sensor TEXT NOT NULL,
        time REAL NOT NULL,
        article TEXT NOT NULL DEFAULT '',
        holds INTEGER NOT NULL DEFAULT 1 CHECK (holds IN (0, 1))
    )
    """,
    """
    INSERT INTO newer_lessons (id, kind, name, surface, turn, sensor, time)
    SELECT id, kind, name, surface, turn, sensor, time FROM lessons ORDER BY id
    """,
    "DELETE FROM sqlite_sequence WHERE name = 'newer_lessons'",
    """
    INSERT INTO sqlite_sequence (name, seq)
    SELECT 'newer_lessons', seq FROM sqlite_sequence WHERE name = 'lessons'
    """,
    "DROP TABLE lessons",
    "ALTER TABLE newer_lessons RENAME TO lessons",
    "CREATE INDEX lessons_by_word ON lessons (kind, name)",
)

# The n-th makes a file of version n out of one of version n - 1. Append, never edit:
# files of every version are out there.
MIGRATIONS: tuple[Migration, ...] = (TABLES, EVIDENCE, POLARITY)
VERSION = len(MIGRATIONS)


def version(connection: sqlite3.Connection) -> int:
    """The version of the tables in a file; 0 before there are any."""
    return _pragma(connection, "user_version")


def is_memory(connection: sqlite3.Connection) -> bool:
    """Is this a memory, or a file with nothing in it that may become one?"""
    return (
        _pragma(connection, "application_id") == APPLICATION_ID
        or _pragma(connection, "schema_version") == 0
    )


def migrate(
    connection: sqlite3.Connection, migrations: Sequence[Migration] = MIGRATIONS
) -> None:
    """Bring the tables up to date, in the transaction that is open.

    SQLite must not be looking after foreign keys, as it does not unless it is told to.

    The mark of the version is written in any case: SQLite opens a file that may not
    be written without a word, and this shows it before anything is lost.

    >>> from contextlib import closing
    >>> with closing(sqlite3.connect(":memory:")) as connection:
    ...     migrate(connection)
    ...     version(connection) == VERSION
    True
    """
    for migration in migrations[version(connection) :]:
        for step in migration:
            if isinstance(step, str):
                connection.execute(step)
            else:
                step(connection)
    connection.execute(f"PRAGMA application_id = {APPLICATION_ID}")
    connection.execute(f"PRAGMA user_version = {len(migrations)}")


def _pragma(connection: sqlite3.Connection, name: str) -> int:
    value: int = connection.execute(f"PRAGMA {name}").fetchone()[0]
    return value
