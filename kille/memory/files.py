"""Where a memory is, and how its file is opened: checked, and by one writer at most.

A writer holds SQLite's write lock from opening to closing, so a second one is refused
at once while readers go on reading. The lock is the system's: a killed program loses
it, and the write-ahead log then undoes what it had not committed.
"""

from __future__ import annotations

import os
import sqlite3
from pathlib import Path
from typing import Literal

from platformdirs import user_data_dir

from kille.memory import believed_files, schema
from kille.memory.errors import (
    ELSEWHERE,
    STRANGE_JOURNAL,
    MemoryFileError,
    explain_failures,
    explanation,
    primary_code,
    untrusted_file_error,
)
from kille.safety.databases import has_strange_journal, restrict
from kille.safety.private_files import create_private_file

# A reader that comes or goes locks the file for an instant; an owner stays.
PATIENCE_SECONDS = 0.2

# Of new files. A lesson is some 80 kB, which larger pages hold in fewer pieces: 10,000
# of them are checked and read in three quarters of the time of pages of 4 kB.
PAGE_BYTES = 16_384

# SQLite takes a file of one byte for an empty one and would write over it.
SMALLEST_DATABASE_BYTES = 512

CANNOT_LOG = (sqlite3.SQLITE_CANTOPEN, sqlite3.SQLITE_READONLY)

Mode = Literal["mode=rw", "mode=ro", "mode=ro&immutable=1"]


def default_path() -> Path:
    """The memory of this user: `KILLE_MEMORY`, or `memory.db` in the data folder.

    >>> from unittest.mock import patch
    >>> with patch.dict(os.environ, KILLE_MEMORY="words.db"):
    ...     default_path().name
    'words.db'
    """
    chosen = os.environ.get("KILLE_MEMORY")
    if chosen:
        return Path(chosen).expanduser()
    return Path(user_data_dir("kille", appauthor=False)) / "memory.db"


def open_to_write(path: Path) -> sqlite3.Connection:
    """Open a connection that owns the file, which is made if missing.

    Only its user can read a new file, and what SQLite writes beside it. Raises
    MemoryFileError if the file is no memory, damaged, too new, not writable, has what
    kille did not write, or is owned by another.
    """
    _make_folder(path)
    _make_file(path)
    with explain_failures(str(path)):
        connection = _connect(path, "mode=rw")
        try:
            _check_ours(connection, path)
            connection.execute(f"PRAGMA page_size = {PAGE_BYTES}")
            connection.execute("PRAGMA journal_mode = WAL")
            _own(connection)
        except BaseException:
            connection.close()
            raise
    return connection


def open_to_read(path: Path) -> sqlite3.Connection:
    """Open a connection that only reads, beside a writer if there is one.

    A file of an older version is left as it is: a copy of it in the working memory is
    brought up to date and read. Raises MemoryFileError if there is no file, or it is
    no memory, damaged, of a newer version, or has what kille did not write.
    """
    with explain_failures(str(path)):
        connection = connect_to_read(path)
        try:
            _check_ours(connection, path)
            if schema.version(connection) == schema.VERSION:
                return connection
            copy = up_to_date_copy(connection)
        except BaseException:
            connection.close()
            raise
        connection.close()
    return copy


def connect_to_read(path: Path) -> sqlite3.Connection:
    """Open a connection to an existing file, whose content is not checked.

    Raises MemoryFileError if there is none, and sqlite3.Error as SQLite does.
    """
    if not os.path.exists(path):
        raise MemoryFileError(
            f"{path} does not exist: teach a word first with kille talk, {ELSEWHERE}"
        )
    return _connect(path, _reading_mode(path))


def connect_beside(path: Path) -> sqlite3.Connection:
    """Open one more connection to a file that was opened, to read in any thread."""
    return _connect(path, "mode=ro", any_thread=True)


def open_transient() -> sqlite3.Connection:
    """Open a connection to a memory without a file."""
    connection = sqlite3.connect(":memory:", isolation_level=None)
    _own(connection)
    return connection


def open_copy(path: Path) -> sqlite3.Connection:
    """Open a connection to a copy, without a file, of what is in this memory."""
    original = open_to_read(path)
    copy = sqlite3.connect(":memory:", isolation_level=None)
    try:
        with explain_failures(str(path)):
            original.backup(copy)
    finally:
        original.close()
    _own(copy)
    return copy


def copy_to_file(connection: sqlite3.Connection, path: Path) -> None:
    """Write all that a memory holds to a file, over what is there.

    Only its user can read a new file.
    """
    _make_folder(path)
    path.unlink(missing_ok=True)
    create_private_file(path)
    copy = sqlite3.connect(path)
    try:
        with explain_failures(str(path)):
            connection.backup(copy)
            copy.execute("PRAGMA journal_mode = DELETE")  # so that it is one file
    finally:
        copy.close()


def hold(connection: sqlite3.Connection) -> None:
    """Begin a transaction unless one is open, which keeps every other writer out."""
    if not connection.in_transaction:
        connection.execute("BEGIN IMMEDIATE")


def _make_folder(path: Path) -> None:
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise MemoryFileError(
            f"{path} cannot be made, since {path.parent} is no folder and cannot "
            f"become one ({error.strerror}): name a file elsewhere with --memory"
        ) from error
    except ValueError as error:
        raise _no_path(path) from error


def _make_file(path: Path) -> None:
    try:
        create_private_file(Path(os.path.realpath(path)))
    except OSError as error:
        line = explanation(str(path), sqlite3.SQLITE_CANTOPEN)
        raise MemoryFileError(line) from error
    except ValueError as error:
        raise _no_path(path) from error


def _no_path(path: Path) -> MemoryFileError:
    """The error for a name that no file can have, such as one with a NUL."""
    return MemoryFileError(
        f"{str(path)!r} is no path of a file: name another with --memory"
    )


def _connect(path: Path, mode: Mode, any_thread: bool = False) -> sqlite3.Connection:
    if not os.path.isfile(path):
        raise MemoryFileError(
            f"{path} is a folder or a device: name a file with --memory"
        )
    if 0 < os.path.getsize(path) < SMALLEST_DATABASE_BYTES:
        raise MemoryFileError(explanation(str(path), sqlite3.SQLITE_NOTADB))
    if has_strange_journal(path):
        raise untrusted_file_error(str(path), STRANGE_JOURNAL)
    connection = sqlite3.connect(
        f"{path.absolute().as_uri()}?{mode}",
        uri=True,
        timeout=PATIENCE_SECONDS,
        isolation_level=None,
        check_same_thread=not any_thread,
    )
    restrict(connection)
    return connection


def _own(connection: sqlite3.Connection) -> None:
    """Become the only writer, with durable commits and tables up to date."""
    connection.execute("PRAGMA synchronous = FULL")
    # What is forgotten is overwritten, not only passed over.
    connection.execute("PRAGMA secure_delete = ON")
    hold(connection)
    schema.migrate(connection)
    connection.execute("COMMIT")
    connection.execute("PRAGMA foreign_keys = ON")  # not while tables are replaced
    hold(connection)


def _check_ours(connection: sqlite3.Connection, path: Path) -> None:
    """Refuse a file that is not a kille memory before anything in it is changed.

    The pages of a large file that was right and has not changed are not read again.
    """
    check_identity(connection, path)
    for fault in schema.part_faults(connection):
        raise untrusted_file_error(str(path), fault)
    before = believed_files.fingerprint(path)
    if believed_files.is_believed(path, before):
        return
    if connection.execute("PRAGMA quick_check(1)").fetchone() != ("ok",):
        raise MemoryFileError(explanation(str(path), sqlite3.SQLITE_CORRUPT))
    for fault in schema.content_faults(connection):
        raise untrusted_file_error(str(path), fault)
    if before == believed_files.fingerprint(path):
        believed_files.believe(path, before)


def check_identity(connection: sqlite3.Connection, path: Path) -> None:
    """Refuse the database of another program, or of a newer kille."""
    if not schema.is_memory(connection):
        raise MemoryFileError(
            f"{path} is the database of another program, not a kille memory: "
            f"move it away, {ELSEWHERE}"
        )
    found = schema.version(connection)
    if found > schema.VERSION:
        raise MemoryFileError(
            f"{path} was written by a newer kille (version {found} of the file, this "
            f"program knows {schema.VERSION}): update kille, {ELSEWHERE}"
        )


def up_to_date_copy(connection: sqlite3.Connection) -> sqlite3.Connection:
    """A copy of a memory, without a file and with the tables up to date."""
    copy = sqlite3.connect(":memory:", isolation_level=None)
    connection.backup(copy)
    with copy:
        schema.migrate(copy)
    return copy


def _reading_mode(path: Path) -> Mode:
    """How to open a file for reading, which may lie where nothing can be written.

    SQLite wants to keep its log beside the file. Where it cannot, and no log waits
    there to be read, the file alone is the whole memory.
    """
    connection = _connect(path, "mode=ro")
    try:
        schema.version(connection)
    except sqlite3.OperationalError as error:
        log = path.with_name(f"{path.name}-wal")
        if primary_code(error) not in CANNOT_LOG or log.exists():
            raise
        return "mode=ro&immutable=1"
    finally:
        connection.close()
    return "mode=ro"
