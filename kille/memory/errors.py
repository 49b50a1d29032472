"""How remembering fails: one line that says what, where and what to do."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager


class MemoryFileError(Exception):
    """A memory file that cannot be opened, read or written."""


class NoSuchLessonError(LookupError):
    """A lesson was named that the memory does not hold."""


ELSEWHERE = "or name another file with --memory"

# By primary result code, https://www.sqlite.org/rescode.html.
EXPLANATIONS = {
    sqlite3.SQLITE_NOTADB: f"is not a kille memory: move it away, {ELSEWHERE}",
    sqlite3.SQLITE_CORRUPT: f"is damaged: put back a copy of it, {ELSEWHERE}",
    sqlite3.SQLITE_BUSY: f"is in use by another program: end that one, {ELSEWHERE}",
    sqlite3.SQLITE_READONLY: (
        f"is read-only, or its folder is: make both writable, {ELSEWHERE}"
    ),
    sqlite3.SQLITE_PERM: f"may not be opened: change its permissions, {ELSEWHERE}",
    sqlite3.SQLITE_CANTOPEN: (
        "cannot be opened, or its folder not written: "
        f"change their permissions, {ELSEWHERE}"
    ),
    sqlite3.SQLITE_FULL: (
        "cannot grow, the disk is full: nothing of this lesson was kept; "
        "free some space and teach it again"
    ),
    sqlite3.SQLITE_IOERR: f"cannot be read or written: check its disk, {ELSEWHERE}",
}


@contextmanager
def explained(place: str) -> Iterator[None]:
    """Turn what SQLite says of the file at `place` into a line for a person.

    Mistakes of the program itself, such as a broken constraint, pass unchanged.

    >>> with explained("notes.txt"):
    ...     _ = sqlite3.connect("/").execute("SELECT 1")
    Traceback (most recent call last):
    ...
    kille.memory.errors.MemoryFileError: notes.txt cannot be opened, ...
    """
    try:
        yield
    except sqlite3.Error as error:
        explanation = EXPLANATIONS.get(primary_code(error))
        if explanation is None:
            raise
        raise MemoryFileError(f"{place} {explanation}") from error


@contextmanager
def content_explained(place: str) -> Iterator[None]:
    """The same where lessons are read: what is none was damaged on its disk."""
    try:
        with explained(place):
            yield
    except (ValueError, TypeError, KeyError) as error:
        damage = EXPLANATIONS[sqlite3.SQLITE_CORRUPT]
        raise MemoryFileError(f"{place} {damage}") from error


def primary_code(error: sqlite3.Error) -> int:
    """The primary result code of an error: the low byte of the extended one.

    It is 0 (SQLITE_OK) for errors that do not come from the SQLite library.
    """
    code: int = getattr(error, "sqlite_errorcode", sqlite3.SQLITE_OK)
    return code & 0xFF
