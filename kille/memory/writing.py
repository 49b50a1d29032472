"""Write values to the tables of a memory, inside the caller's transaction."""

from __future__ import annotations

import json
import sqlite3
from dataclasses import astuple, replace

from kille.memory import reading
from kille.memory.configurations import to_text
from kille.memory.errors import NotKeptError
from kille.memory.lessons import (
    Arrangement,
    Criterion,
    Scan,
    Seen,
    SeenLesson,
    Sighting,
    Subsumption,
    Turn,
    Word,
    has_same_content,
    lesson_of,
)
from kille.memory.pictures import Crop, Picture
from kille.scene import Vector


def add_dialogue(
    connection: sqlite3.Connection, began: str, number: int | None = None
) -> int:
    """Add a dialogue; returns its number, which is the given one if there is one."""
    new = "INSERT INTO dialogues (id, began) VALUES (?, ?)"
    return _insert(connection, new, number, began)


def add_turn(connection: sqlite3.Connection, turn: Turn) -> int:
    """Add a turn, once only; returns its id.

    What it was understood to be may be added when it is known. Raises ValueError if
    its dialogue never began, or if something else is on record as that turn.
    """
    _require_dialogue(connection, turn)
    recorded = connection.execute(
        "SELECT dialogue, number, speaker, text, judgement, time, id FROM turns "
        "WHERE dialogue = ? AND number = ?",
        (turn.dialogue, turn.number),
    ).fetchone()
    if recorded is None:
        return _insert(
            connection,
            "INSERT INTO turns (dialogue, number, speaker, text, judgement, time) "
            "VALUES (?, ?, ?, ?, ?, ?)",
            *astuple(turn),
        )
    *fields, found = recorded
    known = Turn(*fields)
    if known == replace(turn, judgement=""):
        judging = "UPDATE turns SET judgement = ? WHERE id = ?"
        connection.execute(judging, (turn.judgement, found))
    elif known != turn:
        raise ValueError(f"{known} is on record, it cannot become {turn}")
    return int(found)


def add_lesson(
    connection: sqlite3.Connection,
    turn: Turn,
    word: Word,
    seen: Seen,
    *,
    holds: bool = True,
    key: int | None = None,
) -> int:
    """Add a lesson with its turn and all that was seen; returns its key.

    A given key is used. The lesson is read back: raises NotKeptError if it
    is not on file as it was given.
    """
    key = _insert(
        connection,
        "INSERT INTO lessons "
        "(id, kind, name, surface, article, holds, turn, sensor, time) "
        "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)",
        key,
        word.kind,
        word.name,
        word.surface,
        word.article,
        holds,
        add_turn(connection, turn),
        seen.sensor,
        seen.time,
    )
    match seen:
        case Sighting():
            _add_sighting(connection, key, seen)
        case Arrangement():
            _add_arrangement(connection, key, seen)
        case Subsumption():
            _add_subsumption(connection, key, seen)
        case Criterion():
            _add_criterion(connection, key, seen)
    if seen.picture is not None:
        _add_picture(connection, key, seen.picture)
    _check_kept(connection, lesson_of(key, word, turn, seen, holds=holds))
    return key


def never_taught(connection: sqlite3.Connection) -> bool:
    """Has there never been a lesson, not even one that was forgotten?"""
    given = "SELECT 1 FROM sqlite_sequence WHERE name = 'lessons'"
    return connection.execute(given).fetchone() is None


def delete_lesson(connection: sqlite3.Connection, key: int) -> bool:
    """Delete a lesson with all that was seen in it; was there one?"""
    return connection.execute("DELETE FROM lessons WHERE id = ?", (key,)).rowcount == 1


def scan_bytes(scan: Scan) -> tuple[bytes, bytes]:
    """Encode the arrays row by row, little-endian on every machine."""
    points = scan.points.astype("<f4")
    return scan.descriptors.tobytes(), points.tobytes()


def vector_bytes(vector: Vector) -> bytes:
    """Encode the numbers, little-endian on every machine."""
    return vector.astype("<f4").tobytes()


def _add_sighting(connection: sqlite3.Connection, key: int, seen: Sighting) -> None:
    place = seen.place or (None, None, None)
    _insert(
        connection,
        "INSERT INTO sightings (lesson, x, y, z) VALUES (?, ?, ?, ?)",
        key,
        *place,
    )
    for scan in seen.scans:
        _insert(
            connection,
            "INSERT INTO scans (lesson, descriptors, points) VALUES (?, ?, ?)",
            key,
            *scan_bytes(scan),
        )
    for cue, vector in seen.traits.items():
        _insert(
            connection,
            "INSERT INTO traits (lesson, cue, vector) VALUES (?, ?, ?)",
            key,
            cue,
            vector_bytes(vector),
        )


def _add_arrangement(
    connection: sqlite3.Connection, key: int, seen: Arrangement
) -> None:
    _insert(
        connection,
        "INSERT INTO arrangements VALUES (?, ?, ?, ?)",
        key,
        seen.target,
        seen.landmark,
        to_text(seen.configuration),
    )


def _add_subsumption(
    connection: sqlite3.Connection, key: int, seen: Subsumption
) -> None:
    upper = seen.upper
    _insert(
        connection,
        "INSERT INTO subsumptions VALUES (?, ?, ?, ?)",
        key,
        upper.name,
        upper.surface,
        upper.article,
    )


def _add_criterion(connection: sqlite3.Connection, key: int, seen: Criterion) -> None:
    _insert(
        connection,
        "INSERT INTO criteria VALUES (?, ?, ?, ?, ?, ?)",
        key,
        seen.by,
        seen.name,
        seen.surface,
        seen.article,
        seen.degree,
    )


def _add_picture(connection: sqlite3.Connection, key: int, picture: Picture) -> None:
    _insert(
        connection,
        "INSERT INTO pictures (lesson, frame, boxes) VALUES (?, ?, ?)",
        key,
        picture.frame,
        json.dumps(picture.boxes),
    )
    if picture.crop is not None:
        _add_crop(connection, key, picture.crop)


def _add_crop(connection: sqlite3.Connection, key: int, crop: Crop) -> None:
    lens = crop.intrinsics
    _insert(
        connection,
        "INSERT INTO crops (lesson, colour, mask, depth, intrinsics) "
        "VALUES (?, ?, ?, ?, ?)",
        key,
        crop.colour,
        crop.mask,
        crop.depth,
        None if lens is None else json.dumps(astuple(lens)),
    )


def _check_kept(connection: sqlite3.Connection, lesson: SeenLesson) -> None:
    """Read the lesson back: the robot may say that it has learned only if it has."""
    try:
        kept = reading.lesson(connection, lesson.key)
    except (ValueError, TypeError) as error:
        raise NotKeptError(f"lesson {lesson.key}") from error
    if kept is None or not has_same_content(kept, lesson):
        raise NotKeptError(f"lesson {lesson.key}")


def _require_dialogue(connection: sqlite3.Connection, turn: Turn) -> None:
    known = "SELECT 1 FROM dialogues WHERE id = ?"
    if connection.execute(known, (turn.dialogue,)).fetchone() is None:
        raise ValueError(f"dialogue {turn.dialogue} never began, it can have no {turn}")


def _insert(
    connection: sqlite3.Connection,
    statement: str,
    *values: str | int | float | bytes | None,
) -> int:
    """Insert one row; returns its id."""
    key = connection.execute(statement, values).lastrowid
    assert key is not None  # an INSERT has just been done
    return key
