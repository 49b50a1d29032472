"""How values get into the tables of a memory, inside the transaction of the caller."""

from __future__ import annotations

import sqlite3
from dataclasses import astuple

from kille.memory.lessons import Arrangement, Kind, Scan, Sighting, Turn


def add_dialogue(connection: sqlite3.Connection, began: str) -> int:
    """The number of a new dialogue."""
    return _insert(connection, "INSERT INTO dialogues (began) VALUES (?)", began)


def add_turn(connection: sqlite3.Connection, turn: Turn) -> int:
    """The id of this turn, which is kept once however often it is added.

    Raises ValueError if its dialogue never began, or if something else is on record
    as that turn.
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
    if Turn(*fields) != turn:
        raise ValueError(f"{Turn(*fields)} is on record, it cannot become {turn}")
    return int(found)


def add_object_lesson(
    connection: sqlite3.Connection, turn: Turn, name: str, surface: str, seen: Sighting
) -> int:
    """The key of a new lesson, with its turn and every scan."""
    key = _add_lesson(connection, "object", turn, name, surface, seen)
    place = seen.place or (None, None, None)
    _insert(
        connection,
        "INSERT INTO sightings (lesson, x, y, z, colour, length, breadth, thickness) "
        "VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
        key,
        *place,
        None if seen.colour is None else seen.colour.astype("<f4").tobytes(),
        *(seen.size or (None, None, None)),
    )
    for scan in seen.scans:
        _insert(
            connection,
            "INSERT INTO scans (lesson, descriptors, points) VALUES (?, ?, ?)",
            key,
            *scan_bytes(scan),
        )
    return key


def add_relation_lesson(
    connection: sqlite3.Connection,
    turn: Turn,
    name: str,
    surface: str,
    seen: Arrangement,
) -> int:
    """The key of a new lesson, with its turn."""
    key = _add_lesson(connection, "relation", turn, name, surface, seen)
    _insert(
        connection,
        "INSERT INTO arrangements VALUES (?, ?, ?, ?, ?, ?)",
        key,
        seen.target,
        seen.landmark,
        *seen.offset,
    )
    return key


def delete_lesson(connection: sqlite3.Connection, key: int) -> bool:
    """Take a lesson away with all that was seen in it; was there one?"""
    return connection.execute("DELETE FROM lessons WHERE id = ?", (key,)).rowcount == 1


def scan_bytes(scan: Scan) -> tuple[bytes, bytes]:
    """The arrays row by row, little-endian on every machine."""
    return scan.descriptors.tobytes(), scan.points.astype("<f4").tobytes()


def _add_lesson(
    connection: sqlite3.Connection,
    kind: Kind,
    turn: Turn,
    name: str,
    surface: str,
    seen: Sighting | Arrangement,
) -> int:
    return _insert(
        connection,
        "INSERT INTO lessons (kind, name, surface, turn, sensor, time) "
        "VALUES (?, ?, ?, ?, ?, ?)",
        kind,
        name,
        surface,
        add_turn(connection, turn),
        seen.sensor,
        seen.time,
    )


def _require_dialogue(connection: sqlite3.Connection, turn: Turn) -> None:
    known = "SELECT 1 FROM dialogues WHERE id = ?"
    if connection.execute(known, (turn.dialogue,)).fetchone() is None:
        raise ValueError(f"dialogue {turn.dialogue} never began, it can have no {turn}")


def _insert(
    connection: sqlite3.Connection,
    statement: str,
    *values: str | int | float | bytes | None,
) -> int:
    """Insert one row; its id."""
    key = connection.execute(statement, values).lastrowid
    assert key is not None  # an INSERT has just been done
    return key
