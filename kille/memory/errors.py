"""The failures of a memory, each a line that says what is wrong, where, and what to
do."""

from __future__ import annotations

import shlex
import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager

from kille.safety.databases import printable_name


class MemoryFileError(Exception):
    """A memory file that cannot be opened, read or written.

    >>> import tempfile
    >>> from pathlib import Path
    >>> from kille.memory import Memory
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder, "memory.db")
    ...     _ = file.write_text("no memory at all")
    ...     Memory.open(file)
    Traceback (most recent call last):
        ...
    kille.memory.errors.MemoryFileError: .../memory.db is not a kille memory: move it
    away, or name another file with --memory; if it was one, kille memory check
    .../memory.db --salvage NEW may save the rest
    """


class MemoryClosedError(MemoryFileError):
    """A memory file that was closed before something was read from it."""


class NoSuchLessonError(LookupError):
    """The memory has no lesson of this number or word.

    >>> from kille.memory import Memory
    >>> with Memory.transient() as memory:
    ...     memory.lesson(7)
    Traceback (most recent call last):
        ...
    kille.memory.errors.NoSuchLessonError: the memory of this session has no lesson 7:
    kille memory show WORD lists those in a word
    """


class NotKeptError(Exception):
    """A lesson that reads back from the file differently from how it was written."""


ELSEWHERE = "or name another file with --memory"
CHECK = "kille memory check {file} says what is wrong and can save the rest"

# By primary result code, https://www.sqlite.org/rescode.html.
EXPLANATIONS = {
    sqlite3.SQLITE_NOTADB: (
        f"is not a kille memory: move it away, {ELSEWHERE}; if it was one, "
        "kille memory check {file} --salvage NEW may save the rest"
    ),
    sqlite3.SQLITE_CORRUPT: f"is damaged: {CHECK}; put back a copy, {ELSEWHERE}",
    sqlite3.SQLITE_TOOBIG: f"has a value larger than any that kille keeps: {CHECK}",
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


def explanation(place: str, code: int) -> str:
    """The line for people that explains this result code of SQLite."""
    return f"{place} {EXPLANATIONS[code].format(file=shlex.quote(place))}"


def _check(place: str) -> str:
    return CHECK.format(file=shlex.quote(place))


def untrusted_file_error(place: str, fault: str) -> MemoryFileError:
    """The error for a file with something that kille would not have written."""
    return MemoryFileError(f"{place} has {fault}: {_check(place)}")


DAMAGE = (
    sqlite3.SQLITE_CORRUPT,
    sqlite3.SQLITE_TOOBIG,
    sqlite3.SQLITE_OK,  # text that is not UTF-8
    sqlite3.SQLITE_ERROR,  # a format that SQLite does not know
)
STRANGE_JOURNAL = "a journal beside it that kille never writes"


@contextmanager
def explain_failures(place: str) -> Iterator[None]:
    """Turn any failure in the file at `place` into a line for people.

    Values that no lesson can have were damaged on their disk. Mistakes of the program
    itself, such as a broken constraint, pass unchanged.

    >>> with explain_failures("notes.txt"):
    ...     _ = sqlite3.connect("/").execute("SELECT 1")
    Traceback (most recent call last):
    ...
    kille.memory.errors.MemoryFileError: notes.txt cannot be opened, ...
    """
    try:
        yield
    except sqlite3.Error as error:
        code = primary_code(error)
        if code not in EXPLANATIONS:
            if code not in DAMAGE or not isinstance(error, sqlite3.OperationalError):
                raise
            code = sqlite3.SQLITE_CORRUPT
        raise MemoryFileError(explanation(place, code)) from error
    except NotKeptError as error:
        raise MemoryFileError(
            f"{place} did not keep {error} as it was taught, so nothing was learned: "
            f"{_check(place)}"
        ) from error


@contextmanager
def explain_content_failures(place: str) -> Iterator[None]:
    """Likewise where values are read: an invalid value was damaged on disk."""
    try:
        with explain_failures(place):
            yield
    except (ValueError, TypeError, KeyError, OverflowError, RecursionError) as error:
        raise MemoryFileError(
            f"{place} is damaged ({printable_name(str(error))}): {_check(place)}"
        ) from error


def primary_code(error: sqlite3.Error) -> int:
    """The primary result code of an error: the low byte of the extended one.

    It is 0 (SQLITE_OK) for errors that do not come from the SQLite library.
    """
    code: int = getattr(error, "sqlite_errorcode", sqlite3.SQLITE_OK)
    return code & 0xFF
