"""What a memory holds, as values: the questions asked of its tables.

No cursor stays open between two answers: it would keep the file from being let go.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kille.memory.lessons import (
    DESCRIPTOR_LENGTH,
    Arrangement,
    Kind,
    Lesson,
    ObjectLesson,
    RelationLesson,
    Scan,
    Sighting,
    Turn,
    Word,
)
from kille.scene import Point

WORDS = """
    SELECT name, surface, kind FROM lessons
    WHERE id IN (SELECT min(id) FROM lessons GROUP BY kind, name) ORDER BY id
"""

TURNS = """
    SELECT dialogue, number, speaker, text, judgement, time FROM turns
    ORDER BY dialogue, number
"""

LESSON_COLUMNS = """
    lessons.id, name, surface, kind,
    dialogue, number, speaker, text, judgement, turns.time
"""
LESSON_WIDTH = 10

LESSONS = f"""
    SELECT {LESSON_COLUMNS} FROM lessons JOIN turns ON turns.id = turn
    ORDER BY lessons.id
"""

OBJECT_LESSON = f"""
    SELECT {LESSON_COLUMNS}, sensor, lessons.time, x, y, z,
        colour, length, breadth, thickness
    FROM lessons JOIN turns ON turns.id = turn JOIN sightings ON lesson = lessons.id
    WHERE lessons.id = ?
"""

RELATION_LESSON = f"""
    SELECT {LESSON_COLUMNS}, sensor, lessons.time, target, landmark, x, y, z
    FROM lessons JOIN turns ON turns.id = turn JOIN arrangements ON lesson = lessons.id
    WHERE lessons.id = ?
"""

KEYS = "SELECT id FROM lessons WHERE kind = ? ORDER BY id"

SCANS = "SELECT descriptors, points FROM scans WHERE lesson = ? ORDER BY id"


def words(connection: sqlite3.Connection) -> tuple[Word, ...]:
    """Every word that a lesson teaches, as it was said first, oldest first."""
    return tuple(Word(*row) for row in connection.execute(WORDS))


def turns(connection: sqlite3.Connection) -> tuple[Turn, ...]:
    """All that was said, dialogue by dialogue."""
    return tuple(Turn(*row) for row in connection.execute(TURNS))


def lessons(connection: sqlite3.Connection) -> tuple[Lesson, ...]:
    """All lessons, oldest first, without what was seen in them."""
    return tuple(Lesson(*_lesson_fields(row)) for row in connection.execute(LESSONS))


def objects(connection: sqlite3.Connection) -> Iterator[ObjectLesson]:
    """The lessons about objects, oldest first.

    Each is read as it is asked for: one forgotten meanwhile is left out.
    """
    for key in _keys(connection, "object"):
        for row in connection.execute(OBJECT_LESSON, (key,)).fetchall():
            sensor, time, x, y, z, blob, *lengths = row[LESSON_WIDTH:]
            place = None if x is None else Point(x, y, z)
            colour = None if blob is None else floats(blob)
            size = None if lengths[0] is None else (lengths[0], lengths[1], lengths[2])
            scans = _scans(connection, key)
            seen = Sighting(sensor, time, scans, place, colour, size)
            yield ObjectLesson(*_lesson_fields(row), seen)


def relations(connection: sqlite3.Connection) -> Iterator[RelationLesson]:
    """The lessons about relations, oldest first, read like those about objects."""
    for key in _keys(connection, "relation"):
        for row in connection.execute(RELATION_LESSON, (key,)).fetchall():
            sensor, time, target, landmark, *offset = row[LESSON_WIDTH:]
            seen = Arrangement(sensor, time, target, landmark, Point(*offset))
            yield RelationLesson(*_lesson_fields(row), seen)


def scan(descriptors: bytes, points: bytes) -> Scan:
    """The scan whose arrays, row by row and little-endian, are these bytes."""
    return Scan(
        np.frombuffer(descriptors, np.uint8).reshape(-1, DESCRIPTOR_LENGTH),
        floats(points).reshape(-1, 3),
    )


def floats(blob: bytes) -> NDArray[np.float32]:
    """The numbers (n,) whose little-endian bytes these are."""
    return np.frombuffer(blob, "<f4").astype(np.float32, copy=False)


def _scans(connection: sqlite3.Connection, key: int) -> tuple[Scan, ...]:
    return tuple(scan(*row) for row in connection.execute(SCANS, (key,)))


def _keys(connection: sqlite3.Connection, kind: Kind) -> list[int]:
    return [key for (key,) in connection.execute(KEYS, (kind,))]


def _lesson_fields(row: tuple[Any, ...]) -> tuple[int, Word, Turn]:
    """The fields of a lesson, from a row that begins with LESSON_COLUMNS."""
    return row[0], Word(*row[1:4]), Turn(*row[4:LESSON_WIDTH])
