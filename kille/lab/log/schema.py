"""The tables of a log: columns of turns and answers follow from what these are."""

from __future__ import annotations

import sqlite3
from functools import cache
from pathlib import Path

from kille.lab.dialogues import Answer, Turn
from kille.lab.log.cells import columns
from kille.lab.log.folders import FILE
from kille.lab.log.outcomes import RunError
from kille.safety.databases import Schema, row_faults, schema_faults, schema_made_by

APPLICATION_ID = 0x4B535455
"""KSTU in ASCII: tells these files from any other SQLite database."""
VERSION = 1


def table(of: type) -> str:
    """The name of the table of turns, or of answers."""
    return f"{of.__name__.lower()}s"


def marks(values: tuple[object, ...]) -> str:
    """Placeholders of SQL, one for each value.

    >>> marks((1, "a"))
    '?, ?'
    """
    return ", ".join("?" * len(values))


def _create_table(of: type) -> str:
    """The statement that creates the table of turns or of answers."""
    kinds = ", ".join(f'"{it.name}" {it.kind}' for it in columns(of))
    return f"""
        CREATE TABLE {table(of)} (
            run INTEGER NOT NULL REFERENCES runs ON DELETE CASCADE,
            line INTEGER NOT NULL,
            {kinds},
            PRIMARY KEY (run, line)
        ) WITHOUT ROWID
    """


TABLES = (
    "CREATE TABLE about (name TEXT PRIMARY KEY, value TEXT NOT NULL)",
    """
    CREATE TABLE runs (
        place INTEGER PRIMARY KEY,
        theory TEXT NOT NULL,
        tutor TEXT NOT NULL,
        scene TEXT NOT NULL,
        seed INTEGER NOT NULL,
        seconds REAL NOT NULL,
        lessons INTEGER NOT NULL,
        facts TEXT NOT NULL,
        reason TEXT NOT NULL,
        trace TEXT NOT NULL,
        UNIQUE (theory, tutor, scene, seed)
    )
    """,
    _create_table(Turn),
    _create_table(Answer),
    f"PRAGMA user_version = {VERSION}",
    f"PRAGMA application_id = {APPLICATION_ID}",
)


def is_empty(connection: sqlite3.Connection) -> bool:
    """Whether there are no tables yet."""
    (found,) = connection.execute("SELECT count(*) FROM sqlite_master").fetchone()
    return not found


def check_ours(connection: sqlite3.Connection, folder: Path) -> None:
    """RunError for another program's file, another version, or a foreign schema."""
    (found,) = connection.execute("PRAGMA application_id").fetchone()
    if found != APPLICATION_ID:
        raise RunError(f"{folder / FILE} is no log of a study: name another folder")
    (found,) = connection.execute("PRAGMA user_version").fetchone()
    if found != VERSION:
        raise RunError(
            f"{folder / FILE} is of version {found}, and this kille knows {VERSION}: "
            f"take the kille that wrote it"
        )
    for of in (Turn, Answer):
        told = connection.execute(f"PRAGMA table_info({table(of)})")
        if [row[1] for row in told][2:] != [it.name for it in columns(of)]:
            raise RunError(
                f"{folder / FILE} has other {table(of)} than this kille: "
                f"take the kille that wrote it, or name another folder"
            )
    for fault in schema_faults(connection, _parts()):
        raise _untrusted_error(folder, fault)


def check_rows(connection: sqlite3.Connection, folder: Path) -> None:
    """RunError for rows that kille never writes."""
    for fault in row_faults(connection):
        raise _untrusted_error(folder, fault)


def _untrusted_error(folder: Path, fault: str) -> RunError:
    return RunError(
        f"{folder / FILE} has {fault}: put back a copy, or name another folder"
    )


@cache
def _parts() -> Schema:
    """The schema of an empty log."""
    return schema_made_by(make)


def make(connection: sqlite3.Connection) -> None:
    """Make the tables of a new log, in the transaction that is open."""
    for statement in TABLES:
        connection.execute(statement)
