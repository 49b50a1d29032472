"""The folder of a log: who may write in it, and what the system says of it in one line.

Whoever writes holds a lock of the system's, which a killed program loses.
"""

from __future__ import annotations

import fcntl
import os
import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from errno import ENOSPC
from pathlib import Path

from kille.lab.log.outcomes import RunError
from kille.safety.databases import has_strange_journal, restrict
from kille.safety.private_files import open_private

FILE, LOCK = "log.db", ".lock"


@contextmanager
def lock_folder(folder: Path) -> Iterator[None]:
    """Make a folder, and keep all other writers out of it."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        file = open(folder / LOCK, "a+", opener=open_private)  # noqa: SIM115
    except OSError as error:
        raise _why_unwritten(folder, error) from error
    with file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            file.seek(0)
            raise RunError(
                f"{folder} is being written by another run (process "
                f"{file.read().strip() or 'unknown'}): wait for it, or name another "
                f"folder with --out"
            ) from None
        with explain_errors(folder):
            file.truncate(0)
            file.write(f"{os.getpid()}\n")
            file.flush()
        yield


def connect(path: Path, mode: str = "mode=rw") -> sqlite3.Connection:
    """Connect to a database. RunError for a journal that kille never writes."""
    if has_strange_journal(path):
        raise RunError(
            f"{path} has a journal beside it that kille never writes: take it away"
        )
    uri = f"{path.absolute().as_uri()}?{mode}"
    connection = sqlite3.connect(uri, uri=True, timeout=5)
    restrict(connection)
    return connection


def reading_mode(path: Path) -> str:
    """How to open a log for reading, also in a folder that cannot be written.

    SQLite wants to keep a file beside it. Where it cannot, and none waits there to be
    read, the log alone is all there is.
    """
    waits = path.with_name(f"{path.name}-wal").exists()
    may = waits or os.access(path.parent, os.W_OK)
    return "mode=ro" if may else "mode=ro&immutable=1"


@contextmanager
def explain_errors(folder: Path) -> Iterator[None]:
    """Turn errors of the system into one line for people, a RunError."""
    try:
        yield
    except sqlite3.Error as error:
        code: int = getattr(error, "sqlite_errorcode", 0) & 0xFF
        told = _TOLD.get(code)
        if told is None:
            raise
        raise RunError(told.format(folder, folder / FILE)) from error
    except OSError as error:
        raise _why_unwritten(folder, error) from error


def _why_unwritten(folder: Path, error: OSError) -> RunError:
    if error.errno == ENOSPC:
        return RunError(_FULL.format(folder))
    why = (error.strerror or str(error)).lower()
    return RunError(f"{folder} cannot be written: {why}; name another with --out")


_FULL = (
    "the disk of {0} is full: all dialogues that were over are kept; make room and run "
    "it again to go on"
)
_TOLD = {
    sqlite3.SQLITE_FULL: _FULL,
    sqlite3.SQLITE_IOERR: "{1} cannot be read or written: is its disk full or broken?",
    sqlite3.SQLITE_NOTADB: "{1} is no log of a study: name another folder",
    sqlite3.SQLITE_CORRUPT: "{1} is damaged: put back a copy, or name another folder",
    sqlite3.SQLITE_CANTOPEN: "{1} cannot be opened: change its permissions",
    sqlite3.SQLITE_READONLY: "{1} is read-only: make it and its folder writable",
    sqlite3.SQLITE_BUSY: "{1} is in use by another program: end that one first",
}
