"""SQLite files of our own: nothing in them is trusted that kille did not write.

A database carries code: triggers, views, defaults and checks run with the statements of
whoever opens it. So a file is used only if its schema is, to the word, the one that
kille makes, and if its values are of the types that kille writes.
"""

from __future__ import annotations

import os
import re
import sqlite3
import sys
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from contextlib import closing, suppress
from pathlib import Path

LARGEST_VALUE = 2**27
"""Bytes of the largest text, blob or row that is read or written: 128 MiB."""

Schema = Mapping[tuple[str, str, str], int]
"""The parts of a database, by kind, name and the statement that makes them; a part that
is there twice counts twice, since SQLite reads statements whatever they are called."""

_SUPER_JOURNAL = bytes.fromhex("d9d505f920a163d7")
_LONGEST_NAME = 60


def restrict(connection: sqlite3.Connection) -> None:
    """Disable what a database could do just by being opened, before it is read.

    Its schema may call no function with effects, its pages are checked as they are
    read, and no value is larger than LARGEST_VALUE. From Python 3.12 on its triggers
    and views are off, too, and its schema cannot be written.
    """
    connection.execute("PRAGMA trusted_schema = OFF")
    connection.execute("PRAGMA cell_size_check = ON")
    connection.setlimit(sqlite3.SQLITE_LIMIT_LENGTH, LARGEST_VALUE)
    if sys.version_info >= (3, 12):
        connection.setconfig(sqlite3.SQLITE_DBCONFIG_DEFENSIVE, True)
        connection.setconfig(sqlite3.SQLITE_DBCONFIG_ENABLE_TRIGGER, False)
        connection.setconfig(sqlite3.SQLITE_DBCONFIG_ENABLE_VIEW, False)


def has_strange_journal(path: Path) -> bool:
    """Is there a journal beside the file that kille never has?

    SQLite waits for a pipe without end, and deletes the file that a journal names. Only
    journals that were written for several databases at once name one.
    """
    journal = Path(f"{path}-journal")
    if os.path.lexists(journal) and not journal.is_file():
        return True
    end = b""
    with suppress(OSError), journal.open("rb") as file:
        file.seek(-len(_SUPER_JOURNAL), os.SEEK_END)
        end = file.read()
    return end == _SUPER_JOURNAL


def schema_of(connection: sqlite3.Connection) -> Schema:
    """The schema of a database; the layout of its statements does not count."""
    rows = connection.execute("SELECT type, name, tbl_name, sql FROM sqlite_master")
    return Counter(
        (str(kind), str(name), f"on {table}: {_plain(sql)}")
        for kind, name, table, sql in rows
    )


def schema_made_by(make: Callable[[sqlite3.Connection], object]) -> Schema:
    """The schema of a database whose tables `make` has made.

    >>> schema_made_by(lambda it: it.execute('CREATE TABLE "words"  (name TEXT)'))
    Counter({('table', 'words', 'on words: CREATE TABLE words (name TEXT)'): 1})
    """
    with closing(sqlite3.connect(":memory:")) as connection:
        make(connection)
        return schema_of(connection)


def schema_faults(connection: sqlite3.Connection, expected: Schema) -> Iterator[str]:
    """The differences from the expected schema, each as the end of "It has …".

    >>> with closing(sqlite3.connect(":memory:")) as connection:
    ...     _ = connection.execute("CREATE VIEW words AS SELECT 'cup' AS name")
    ...     list(schema_faults(connection, {("table", "turns", "on turns: …"): 1}))
    ['no table turns', 'a view that kille never makes, words']
    """
    (encoding,) = connection.execute("PRAGMA encoding").fetchone()
    if encoding != "UTF-8":
        yield f"text in {encoding}, where kille writes UTF-8"
    found = schema_of(connection)
    ours, theirs = Counter(expected), Counter(found)
    missing = {part[:2] for part in ours - theirs}
    strange = {part[:2] for part in theirs - ours}
    for kind, name in sorted(missing - strange):
        yield f"no {kind} {name}"
    for kind, name in sorted(missing & strange):
        yield f"{_with_article(kind)} {name} that is not as kille makes it"
    for kind, name in sorted(strange - missing):
        part = _with_article(printable_name(kind))
        yield f"{part} that kille never makes, {printable_name(name)}"


def row_faults(connection: sqlite3.Connection) -> Iterator[str]:
    """Values of other types than their columns, and rows without their parent.

    Each is the end of "It has …". The schema must be the expected one.
    """
    tables = "SELECT name FROM sqlite_master WHERE type = 'table' ORDER BY name"
    for (table,) in connection.execute(tables).fetchall():
        yield from _type_faults(connection, table)
    orphans = connection.execute("PRAGMA foreign_key_check").fetchall()
    for table, parent in sorted({(table, parent) for table, _, parent, _ in orphans}):
        yield f"rows in {table} whose {parent} are missing"


def printable_name(name: str) -> str:
    """A name from a file, made printable for a line to people."""
    text = name if name.isprintable() else ascii(name)[1:-1]
    return text if len(text) <= _LONGEST_NAME else f"{text[:_LONGEST_NAME]}..."


def _with_article(kind: str) -> str:
    return f"an {kind}" if kind == "index" else f"a {kind}"


def _type_faults(connection: sqlite3.Connection, table: str) -> Iterator[str]:
    columns = connection.execute(f'PRAGMA table_info("{table}")').fetchall()
    allowed = {
        name: {kind.lower()} | ({"null"} if not (required or key) else set())
        for _, name, kind, required, _, key in columns
        if kind
    }
    if not allowed:
        return
    kinds = ", ".join(f'typeof("{name}")' for name in allowed)
    wrong = " OR ".join(
        f"""typeof("{name}") NOT IN ({", ".join(f"'{it}'" for it in sorted(types))})"""
        for name, types in allowed.items()
    )
    found = connection.execute(f'SELECT {kinds} FROM "{table}" WHERE {wrong} LIMIT 1')
    for row in found.fetchall():
        for (name, types), kind in zip(allowed.items(), row, strict=True):
            if kind not in types:
                wanted = " or ".join(sorted(types))
                yield f"{kind} as {name} in {table}, where kille writes {wanted}"


def _plain(sql: str | None) -> str:
    """A statement without line breaks and the quotes that SQLite adds to names."""
    return re.sub(r'"(\w+)"', r"\1", " ".join((sql or "").split()))
