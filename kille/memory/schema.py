"""The tables of a memory file, and the migration of older files.

A word has no row of its own: it is known exactly as long as a lesson teaches it, so
that forgetting a lesson leaves nothing behind.
"""

from __future__ import annotations

import json
import math
import sqlite3
import struct
from collections.abc import Callable, Iterator, Sequence
from functools import cache

from kille.safety.databases import (
    Schema,
    row_faults,
    schema_faults,
    schema_made_by,
    schema_of,
)

# "KILL" in ASCII: tells our files from any other SQLite database.
APPLICATION_ID = 0x4B494C4C

Migration = tuple[str | Callable[[sqlite3.Connection], None], ...]
"""Statements, and functions for what no statement can do."""

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
    """Convert what version 1 knew of whole things to vectors of the present cues."""
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
    """Convert offsets to configurations in which nothing else is known."""
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

# What a kind of thing is a kind of. The table of lessons takes another kind: it is made
# anew, as above.
KINDS: Migration = (
    """
    CREATE TABLE newer_lessons (
        id INTEGER PRIMARY KEY AUTOINCREMENT,
        kind TEXT NOT NULL
            CHECK (kind IN ('object', 'attribute', 'relation', 'subkind')),
        name TEXT NOT NULL,
        surface TEXT NOT NULL,
        turn INTEGER NOT NULL REFERENCES turns,
        sensor TEXT NOT NULL,
        time REAL NOT NULL,
        article TEXT NOT NULL DEFAULT '',
        holds INTEGER NOT NULL DEFAULT 1 CHECK (holds IN (0, 1))
    )
    """,
    "INSERT INTO newer_lessons SELECT * FROM lessons ORDER BY id",
    "DELETE FROM sqlite_sequence WHERE name = 'newer_lessons'",
    """
    INSERT INTO sqlite_sequence (name, seq)
    SELECT 'newer_lessons', seq FROM sqlite_sequence WHERE name = 'lessons'
    """,
    "DROP TABLE lessons",
    "ALTER TABLE newer_lessons RENAME TO lessons",
    "CREATE INDEX lessons_by_word ON lessons (kind, name)",
    """
    CREATE TABLE subsumptions (
        lesson INTEGER PRIMARY KEY REFERENCES lessons ON DELETE CASCADE,
        upper TEXT NOT NULL,
        upper_surface TEXT NOT NULL,
        upper_article TEXT NOT NULL
    )
    """,
)


def _lessons_of(*kinds: str) -> str:
    """The statement that makes the table that replaces that of lessons."""
    return f"""
    CREATE TABLE newer_lessons (
        id INTEGER PRIMARY KEY AUTOINCREMENT,
        kind TEXT NOT NULL CHECK (kind IN ({", ".join(map(repr, kinds))})),
        name TEXT NOT NULL,
        surface TEXT NOT NULL,
        turn INTEGER NOT NULL REFERENCES turns,
        sensor TEXT NOT NULL,
        time REAL NOT NULL,
        article TEXT NOT NULL DEFAULT '',
        holds INTEGER NOT NULL DEFAULT 1 CHECK (holds IN (0, 1))
    )
    """


# By what things of a kind are known. The table of lessons takes another kind.
CRITERIA: Migration = (
    _lessons_of("object", "attribute", "relation", "subkind", "criterion"),
    *KINDS[1:7],
    """
    CREATE TABLE criteria (
        lesson INTEGER PRIMARY KEY REFERENCES lessons ON DELETE CASCADE,
        by TEXT NOT NULL CHECK (by IN ('cue', 'quality', 'part')),
        name TEXT NOT NULL,
        surface TEXT NOT NULL,
        article TEXT NOT NULL,
        degree REAL NOT NULL CHECK (degree BETWEEN 0 AND 1)
    )
    """,
)

# The n-th makes a file of version n out of one of version n - 1. Append, never edit:
# files of every version are out there.
MIGRATIONS: tuple[Migration, ...] = (TABLES, EVIDENCE, POLARITY, KINDS, CRITERIA)
VERSION = len(MIGRATIONS)


def version(connection: sqlite3.Connection) -> int:
    """The version of the tables in a file; 0 before there are any."""
    return _pragma(connection, "user_version")


def is_memory(connection: sqlite3.Connection) -> bool:
    """Is this a memory, or a file with nothing in it that may become one?"""
    marks = [_pragma(connection, it) for it in ("application_id", "user_version")]
    return marks[0] == APPLICATION_ID or (marks == [0, 0] and not schema_of(connection))


def part_faults(connection: sqlite3.Connection) -> Iterator[str]:
    """The differences between the parts of a memory and its version, as ends of "It has
    …".

    >>> from contextlib import closing
    >>> with closing(sqlite3.connect(":memory:")) as connection:
    ...     migrate(connection)
    ...     _ = connection.execute("DROP INDEX scans_by_lesson")
    ...     list(part_faults(connection))
    ['no index scans_by_lesson']
    """
    found = version(connection)
    is_marked = _pragma(connection, "application_id") == APPLICATION_ID
    if is_marked and found not in range(1, VERSION + 1):
        yield f"the version {found}, which no kille writes"
        return
    yield from schema_faults(connection, _parts(found))


def content_faults(connection: sqlite3.Connection) -> Iterator[str]:
    """Contents of the tables that kille never writes, likewise as ends of "It has …".

    The tables must be those of its version.
    """
    yield from row_faults(connection)
    for since, query, fault in _NEVER:
        if version(connection) >= since and _any(connection, query):
            yield fault


LARGEST_KEY = 2**62
"""The largest number that a lesson may have, so that later ones can get numbers too."""

# Each since a version. A lesson without what was seen would be passed over wherever
# lessons are read; and SQLite does not look at checks in a file that is only read.
_NEVER = (
    (
        1,
        "SELECT count(*) FROM lessons "
        "WHERE kind NOT IN "
        "('object', 'attribute', 'relation', 'subkind', 'criterion')",
        "lessons of other kinds than kille has",
    ),
    (
        3,
        "SELECT count(*) FROM lessons WHERE holds NOT IN (0, 1)",
        "lessons that neither hold nor are denied",
    ),
    (
        1,
        "SELECT count(*) FROM lessons WHERE kind NOT IN ('subkind', 'criterion') AND "
        "iif(kind = 'relation', "
        "NOT EXISTS (SELECT 1 FROM arrangements WHERE lesson = lessons.id), "
        "NOT EXISTS (SELECT 1 FROM sightings WHERE lesson = lessons.id))",
        "lessons without what was seen in them",
    ),
    (
        4,
        "SELECT count(*) FROM lessons WHERE kind = 'subkind' AND "
        "NOT EXISTS (SELECT 1 FROM subsumptions WHERE lesson = lessons.id)",
        "lessons about kinds of things without what these are kinds of",
    ),
    (
        5,
        "SELECT count(*) FROM lessons WHERE kind = 'criterion' AND "
        "NOT EXISTS (SELECT 1 FROM criteria WHERE lesson = lessons.id)",
        "lessons by what things are known without what that is",
    ),
    (
        1,
        "SELECT count(*) FROM sqlite_sequence WHERE name IS NOT 'lessons' "
        f"OR typeof(seq) != 'integer' OR seq NOT BETWEEN 0 AND {LARGEST_KEY} "
        "OR seq < (SELECT max(id) FROM lessons)",
        "a wrong count of all lessons ever",
    ),
    (
        1,
        "SELECT count(*) > count(DISTINCT name) FROM sqlite_sequence",
        "two counts of all lessons ever",
    ),
    (
        1,
        "SELECT EXISTS (SELECT 1 FROM lessons) "
        "AND NOT EXISTS (SELECT 1 FROM sqlite_sequence)",
        "no count of all lessons ever",
    ),
    (
        1,
        f"SELECT count(*) FROM lessons WHERE id NOT BETWEEN 0 AND {LARGEST_KEY}",
        "lessons with numbers that kille never gives",
    ),
)


def _any(connection: sqlite3.Connection, query: str) -> bool:
    """Does a query count anything?"""
    (count,) = connection.execute(query).fetchone()
    return bool(count)


@cache
def _parts(version: int) -> Schema:
    """The parts of an empty memory of this version."""
    return schema_made_by(lambda it: migrate(it, MIGRATIONS[:version]))


def migrate(
    connection: sqlite3.Connection, migrations: Sequence[Migration] = MIGRATIONS
) -> None:
    """Bring the tables up to date, within the open transaction.

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
