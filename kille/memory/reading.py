"""Read what a memory holds, as values, from its tables.

Lessons are read some hundred at a time, by one statement a table. No cursor stays open
between two answers: it would keep the file from being let go.
"""

from __future__ import annotations

import json
import sqlite3
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kille.memory.configurations import from_text
from kille.memory.lessons import (
    DESCRIPTOR_LENGTH,
    Arrangement,
    CheckedTraits,
    Criterion,
    CriterionLesson,
    Dialogue,
    Kind,
    KindLesson,
    Lesson,
    ObjectLesson,
    RelationLesson,
    Scan,
    SeenLesson,
    Sighting,
    Subsumption,
    Turn,
    Word,
    check_traits,
    with_picture,
)
from kille.memory.pictures import Crop, Picture
from kille.scene import Box, Intrinsics, Point, Traits, Vector

Descriptors = NDArray[np.uint8]
"""The descriptors (n, 128) of the features of a scan."""

_FLOAT = np.dtype("<f4")

BATCH = 250
"""How many lessons are read at once."""


class Outline(NamedTuple):
    """What a lesson in the name of a thing is about, without what was seen in it.

    `features` is how many features were kept of the thing.
    """

    key: int
    name: str
    holds: bool
    features: int


WORDS = """
    SELECT name, surface, kind, coalesce(
        (SELECT article FROM lessons AS other
         WHERE other.kind = first.kind AND other.name = first.name AND article != ''
         ORDER BY other.id LIMIT 1), '')
    FROM lessons AS first
    WHERE id IN (SELECT min(id) FROM lessons
                 WHERE holds AND kind NOT IN ('subkind', 'criterion')
                 GROUP BY kind, name)
    ORDER BY id
"""

DIALOGUES = "SELECT id, began FROM dialogues ORDER BY id"

TURNS = """
    SELECT dialogue, number, speaker, text, judgement, time FROM turns
    ORDER BY dialogue, number
"""

LESSON_COLUMNS = """
    lessons.id, holds, lessons.name, lessons.surface, kind, lessons.article,
    dialogue, number, speaker, text, judgement, turns.time
"""
LESSON_WIDTH = 12

LESSONS = f"""
    SELECT {LESSON_COLUMNS} FROM lessons JOIN turns ON turns.id = turn
    ORDER BY lessons.id
"""

LATEST = f"""
    SELECT {LESSON_COLUMNS} FROM lessons JOIN turns ON turns.id = turn
    ORDER BY lessons.id DESC LIMIT ?
"""

TOLD = f"""
    SELECT {LESSON_COLUMNS} FROM lessons JOIN turns ON turns.id = turn
    WHERE lessons.id = ?
"""

TURNS_BEFORE = """
    SELECT dialogue, number, speaker, text, judgement, time FROM turns
    WHERE dialogue = ? AND number < ? ORDER BY number DESC LIMIT ?
"""

COUNTS = "SELECT kind, name, count(*) FROM lessons WHERE holds GROUP BY kind, name"

FIRST_KEY = "SELECT min(id) FROM lessons WHERE kind = ? AND name = ? AND holds"

KEYS_OF_WORD = "SELECT id FROM lessons WHERE kind = ? AND name = ? ORDER BY id"

OBJECTS = f"""
    SELECT {LESSON_COLUMNS}, sensor, lessons.time, x, y, z
    FROM lessons JOIN turns ON turns.id = turn JOIN sightings ON lesson = lessons.id
    WHERE lessons.id BETWEEN ? AND ? AND kind IN (?, ?) ORDER BY lessons.id
"""

RELATIONS = f"""
    SELECT {LESSON_COLUMNS}, sensor, lessons.time, target, landmark, configuration
    FROM lessons JOIN turns ON turns.id = turn JOIN arrangements ON lesson = lessons.id
    WHERE lessons.id BETWEEN ? AND ? ORDER BY lessons.id
"""

SUBSUMPTIONS = f"""
    SELECT {LESSON_COLUMNS}, sensor, lessons.time,
           upper, upper_surface, upper_article
    FROM lessons JOIN turns ON turns.id = turn JOIN subsumptions ON lesson = lessons.id
    WHERE lessons.id BETWEEN ? AND ? ORDER BY lessons.id
"""

CRITERIA = f"""
    SELECT {LESSON_COLUMNS}, sensor, lessons.time,
           by, criteria.name, criteria.surface, degree, criteria.article
    FROM lessons JOIN turns ON turns.id = turn JOIN criteria ON lesson = lessons.id
    WHERE lessons.id BETWEEN ? AND ? ORDER BY lessons.id
"""

KEYS = "SELECT id FROM lessons WHERE kind = ? ORDER BY id"

COUNT = "SELECT count(*) FROM lessons WHERE kind = ?"

THERE = "SELECT id FROM lessons WHERE id IN ({})"

# SQLite finds the length of a value without reading the value.
OUTLINES = """
    SELECT id, name, holds,
           (SELECT total(length(descriptors)) FROM scans WHERE lesson = lessons.id)
    FROM lessons WHERE kind = 'object' ORDER BY id
"""

SCANS = """
    SELECT lesson, descriptors, points FROM scans
    WHERE lesson BETWEEN ? AND ?
    AND (SELECT kind FROM lessons WHERE lessons.id = lesson) IN (?, ?)
    ORDER BY lesson, id
"""

TRAITS = """
    SELECT lesson, cue, vector FROM traits
    WHERE lesson BETWEEN ? AND ?
    AND (SELECT kind FROM lessons WHERE lessons.id = lesson) IN (?, ?)
    ORDER BY lesson, id
"""

DESCRIPTORS_OF = """
    SELECT lesson, descriptors FROM scans WHERE lesson IN ({}) ORDER BY lesson, id
"""

TRAITS_OF = """
    SELECT lesson, cue, vector FROM traits WHERE lesson IN ({}) ORDER BY lesson, id
"""

PICTURE = """
    SELECT frame, boxes, colour, mask, depth, intrinsics
    FROM pictures LEFT JOIN crops ON crops.lesson = pictures.lesson
    WHERE pictures.lesson = ?
"""


@contextmanager
def at_one_moment(connection: sqlite3.Connection) -> Iterator[None]:
    """Read everything inside as of one moment, whoever writes meanwhile."""
    if connection.in_transaction:
        yield
        return
    connection.execute("BEGIN")
    try:
        yield
    finally:
        connection.rollback()


def words(connection: sqlite3.Connection) -> tuple[Word, ...]:
    """Every word that is known to apply to something, oldest first.

    It is as it was said when that was first taught, with the first article it had.
    """
    return tuple(Word(*row) for row in connection.execute(WORDS))


def counts(connection: sqlite3.Connection) -> dict[tuple[Kind, str], int]:
    """The number of lessons in which each word was said to apply, by kind and name."""
    rows = connection.execute(COUNTS)
    return {(kind, name): number for kind, name, number in rows}


def dialogues(connection: sqlite3.Connection) -> tuple[Dialogue, ...]:
    """All dialogues, in the order in which they began."""
    return tuple(Dialogue(*row) for row in connection.execute(DIALOGUES))


def turns(connection: sqlite3.Connection) -> tuple[Turn, ...]:
    """Everything that was said, dialogue by dialogue."""
    return tuple(Turn(*row) for row in connection.execute(TURNS))


def turns_before(
    connection: sqlite3.Connection, turn: Turn, count: int
) -> tuple[Turn, ...]:
    """The last `count` turns before one of the same dialogue, in order."""
    asked = turn.dialogue, turn.number, count
    found = connection.execute(TURNS_BEFORE, asked).fetchall()
    return tuple(Turn(*row) for row in reversed(found))


def lessons(connection: sqlite3.Connection) -> tuple[Lesson, ...]:
    """All lessons, oldest first, without what was seen in them."""
    return tuple(_lesson(row) for row in connection.execute(LESSONS))


def latest(connection: sqlite3.Connection, count: int) -> tuple[Lesson, ...]:
    """The newest `count` lessons, the newest last, without what was seen."""
    found = connection.execute(LATEST, (count,)).fetchall()
    return tuple(_lesson(row) for row in reversed(found))


def lesson_without_sight(connection: sqlite3.Connection, key: int) -> Lesson | None:
    """The lesson of this key without what was seen, or None."""
    row = connection.execute(TOLD, (key,)).fetchone()
    return None if row is None else _lesson(row)


def first_key_of(connection: sqlite3.Connection, kind: Kind, name: str) -> int | None:
    """The key of the oldest lesson in which a word was said to apply, or None."""
    (key,) = connection.execute(FIRST_KEY, (kind, name)).fetchone()
    return None if key is None else int(key)


def keys_of(connection: sqlite3.Connection, kind: Kind, name: str) -> tuple[int, ...]:
    """The keys of the lessons in a word, oldest first."""
    return tuple(key for (key,) in connection.execute(KEYS_OF_WORD, (kind, name)))


def objects(
    connection: sqlite3.Connection, kind: Kind = "object"
) -> Iterator[ObjectLesson]:
    """The lessons in names or attributes of objects, without their pictures.

    Oldest first. A batch is read when its first lesson is asked for: what was forgotten
    before is left out.
    """
    for first, last in _batches(connection, kind):
        with at_one_moment(connection):
            batch = objects_between(connection, first, last, (kind, kind))
        yield from batch


def relations(connection: sqlite3.Connection) -> Iterator[RelationLesson]:
    """The lessons about relations, oldest first, read like those about objects."""
    for first, last in _batches(connection, "relation"):
        with at_one_moment(connection):
            batch = relations_between(connection, first, last)
        yield from batch


def kinds(connection: sqlite3.Connection) -> tuple[KindLesson, ...]:
    """The lessons that say which kind of thing is a kind of which, oldest first."""
    return tuple(
        it
        for first, last in _batches(connection, "subkind")
        for it in kinds_between(connection, first, last)
    )


def criteria(connection: sqlite3.Connection) -> tuple[CriterionLesson, ...]:
    """The lessons that say by what things of a kind are known, oldest first."""
    return tuple(
        it
        for first, last in _batches(connection, "criterion")
        for it in criteria_between(connection, first, last)
    )


def lesson(connection: sqlite3.Connection, key: int) -> SeenLesson | None:
    """The lesson of this key with its picture, or None."""
    with at_one_moment(connection):
        found: list[SeenLesson] = [
            *objects_between(connection, key, key),
            *relations_between(connection, key, key),
            *kinds_between(connection, key, key),
            *criteria_between(connection, key, key),
        ]
        return with_picture(found[0], picture(connection, key)) if found else None


def picture(connection: sqlite3.Connection, key: int) -> Picture | None:
    """The picture of a lesson; None if it has none."""
    row = connection.execute(PICTURE, (key,)).fetchone()
    if row is None:
        return None
    frame, boxes, colour, mask, depth, intrinsics = row
    placed = tuple(Box(*box) for box in json.loads(boxes))
    if colour is None:
        return Picture(frame, placed)
    lens = None if intrinsics is None else Intrinsics(*json.loads(intrinsics))
    return Picture(frame, placed, Crop(colour, mask, depth, lens))


def objects_between(
    connection: sqlite3.Connection,
    first: int,
    last: int,
    kinds: tuple[Kind, Kind] = ("object", "attribute"),
) -> list[ObjectLesson]:
    """The lessons of these kinds with keys from `first` to `last`."""
    scans = _scans(connection, first, last, kinds)
    traits = _traits(connection, first, last, kinds)
    found = []
    for row in connection.execute(OBJECTS, (first, last, *kinds)).fetchall():
        key = row[0]
        sensor, time, x, y, z = row[LESSON_WIDTH:]
        place = None if x is None else Point(x, y, z)
        seen = Sighting(
            sensor, time, tuple(scans.get(key, ())), place, traits.get(key, {})
        )
        key, word, turn, holds = _lesson_fields(row)
        found.append(ObjectLesson(key, word, turn, seen, holds=holds))
    return found


def relations_between(
    connection: sqlite3.Connection, first: int, last: int
) -> list[RelationLesson]:
    """The lessons about relations with keys from `first` to `last`."""
    found = []
    for row in connection.execute(RELATIONS, (first, last)).fetchall():
        sensor, time, target, landmark, text = row[LESSON_WIDTH:]
        seen = Arrangement(sensor, time, target, landmark, from_text(text))
        known = _lesson(row)
        found.append(
            RelationLesson(known.key, known.word, known.turn, seen, holds=known.holds)
        )
    return found


def kinds_between(
    connection: sqlite3.Connection, first: int, last: int
) -> list[KindLesson]:
    """The lessons about kinds of things with keys from `first` to `last`."""
    found = []
    for row in connection.execute(SUBSUMPTIONS, (first, last)).fetchall():
        sensor, time, name, surface, article = row[LESSON_WIDTH:]
        seen = Subsumption(Word(name, surface, "object", article), sensor, time)
        known = _lesson(row)
        found.append(
            KindLesson(known.key, known.word, known.turn, seen, holds=known.holds)
        )
    return found


def criteria_between(
    connection: sqlite3.Connection, first: int, last: int
) -> list[CriterionLesson]:
    """The lessons by what things are known, with keys from `first` to `last`."""
    found = []
    for row in connection.execute(CRITERIA, (first, last)).fetchall():
        sensor, time, by, name, surface, degree, article = row[LESSON_WIDTH:]
        seen = Criterion(by, name, surface, degree, article, sensor, time)
        known = _lesson(row)
        found.append(
            CriterionLesson(known.key, known.word, known.turn, seen, holds=known.holds)
        )
    return found


def scan(descriptors: bytes, points: bytes) -> Scan:
    """Decode a scan from its arrays, which are stored row by row and little-endian."""
    return Scan(
        np.frombuffer(descriptors, np.uint8).reshape(-1, DESCRIPTOR_LENGTH),
        floats(points).reshape(-1, 3),
    )


def floats(blob: bytes) -> Vector:
    """Decode little-endian numbers (n,) without copying them."""
    numbers = np.frombuffer(blob, _FLOAT)
    return numbers if _FLOAT.isnative else numbers.astype(np.float32)


def keys_of_no_lesson(connection: sqlite3.Connection, keys: Sequence[int]) -> list[int]:
    """The keys, some hundreds at most, of which there is no lesson."""
    there = {key for (key,) in connection.execute(_for_each(THERE, keys), keys)}
    return [key for key in keys if key not in there]


def count(connection: sqlite3.Connection, kind: Kind) -> int:
    """How many lessons of a kind there are."""
    (found,) = connection.execute(COUNT, (kind,)).fetchone()
    return int(found)


def outlines(connection: sqlite3.Connection) -> list[Outline]:
    """What each lesson in the name of a thing is about, oldest first."""
    return [
        Outline(key, _word(name, name, "object", "").name, bool(holds), _rows_of(size))
        for key, name, holds, size in connection.execute(OUTLINES).fetchall()
    ]


def descriptors_of(
    connection: sqlite3.Connection, keys: Sequence[int]
) -> Mapping[int, Sequence[Descriptors]]:
    """The descriptors of the scans of some hundred lessons, by key."""
    found = defaultdict[int, list[Descriptors]](list)
    for key, rows in connection.execute(_for_each(DESCRIPTORS_OF, keys), keys):
        found[key].append(np.frombuffer(rows, np.uint8).reshape(-1, DESCRIPTOR_LENGTH))
    return found


def traits_of(
    connection: sqlite3.Connection, keys: Sequence[int]
) -> Mapping[int, Traits]:
    """The traits of some hundred lessons, by key, of those that have any."""
    rows = connection.execute(_for_each(TRAITS_OF, keys), keys).fetchall()
    found = _traits_in(rows)
    for traits in found.values():
        check_traits(traits)
    return found


def _for_each(statement: str, keys: Sequence[int]) -> str:
    """The statement with a place for each key."""
    return statement.format(", ".join("?" * len(keys)))


def _rows_of(size: float) -> int:
    """How many descriptors so many bytes are."""
    rows, rest = divmod(int(size), DESCRIPTOR_LENGTH)
    if rest:
        raise ValueError(f"{int(size)} bytes of descriptors")
    return rows


def _scans(
    connection: sqlite3.Connection, first: int, last: int, kinds: tuple[Kind, Kind]
) -> Mapping[int, list[Scan]]:
    found = defaultdict[int, list[Scan]](list)
    for key, *arrays in connection.execute(SCANS, (first, last, *kinds)):
        found[key].append(scan(*arrays))
    return found


def _traits(
    connection: sqlite3.Connection, first: int, last: int, kinds: tuple[Kind, Kind]
) -> Mapping[int, Traits]:
    """The traits of these lessons, by key, of those that have any."""
    rows = connection.execute(TRAITS, (first, last, *kinds)).fetchall()
    return _traits_in(rows)


def _traits_in(rows: Sequence[tuple[int, str, bytes]]) -> Mapping[int, Traits]:
    """The traits in rows, marked as checked if nothing is wrong with any.

    Otherwise each is checked by itself, and the one that is wrong is named.
    """
    right = _are_finite([blob for *_, blob in rows])
    found = defaultdict[int, dict[str, Vector]](CheckedTraits if right else dict)
    for key, cue, blob in rows:
        found[key][cue] = floats(blob)
    return found


def _are_finite(blobs: list[bytes]) -> bool:
    """Does each blob consist of finite numbers, as `floats` decodes them?"""
    if any(len(blob) % _FLOAT.itemsize for blob in blobs):
        return False
    return bool(np.isfinite(floats(b"".join(blobs))).all())


def _batches(connection: sqlite3.Connection, kind: Kind) -> Iterator[tuple[int, int]]:
    """The first and last key of each batch of lessons of a kind."""
    keys = [key for (key,) in connection.execute(KEYS, (kind,))]
    for at in range(0, len(keys), BATCH):
        batch = keys[at : at + BATCH]
        yield batch[0], batch[-1]


def _lesson(row: tuple[Any, ...]) -> Lesson:
    """The lesson in a row that begins with LESSON_COLUMNS."""
    key, word, turn, holds = _lesson_fields(row)
    return Lesson(key, word, turn, holds=holds)


def _lesson_fields(row: tuple[Any, ...]) -> tuple[int, Word, Turn, bool]:
    """The key, word, turn and polarity in a row that begins with LESSON_COLUMNS."""
    key, holds, name, surface, kind, article, *said = row[:LESSON_WIDTH]
    return key, _word(name, surface, kind, article), Turn(*said), bool(holds)


@lru_cache(maxsize=2**14)
def _word(name: str, surface: str, kind: Kind, article: str) -> Word:
    """The word, which is checked once: it may have been taught many times."""
    return Word(name, surface, kind, article)
