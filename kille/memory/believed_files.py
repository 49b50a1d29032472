"""Which memory files were checked and have not changed since.

To check a memory of 100,000 lessons takes seconds, since all of its 2.5 GB are read. So
a large file is checked once, and a mark in the user's cache says how the system
describes it: its number, its size, and when it and its description last changed. While
all of that is so, and no log of SQLite waits beside the file, its pages are not checked
again. The mark is not in the file: who sends a memory cannot send its mark, and a copy
is checked anew. The time at which the description of a file last changed cannot be set
by a program.

What such a description does not show, as a disk that forgets, is found when a page is
read: then the mark is deleted. Where the system keeps no such time, as on Windows,
nothing is believed.
"""

from __future__ import annotations

import os
import sqlite3
from contextlib import suppress
from hashlib import sha256
from pathlib import Path

from platformdirs import user_cache_dir

from kille.memory import schema
from ttr import TTRError
from ttr.safety.files import write_whole

SMALLEST = 2**24
"""Bytes of a file for which a mark is kept: a smaller one is checked in an instant."""

CHECKS = 1
"""Counts the changes of what is checked: what former checks let pass is not believed.
"""

MOST = 30
"""How many marks are kept: those that were written last."""


def fingerprint(path: Path) -> str | None:
    """What the system says of a file; None if it is small, or that is not enough.

    >>> fingerprint(Path("no such file")) is None
    True
    """
    if os.name != "posix":
        return None
    try:
        found = os.stat(path)
        if found.st_size < SMALLEST or _has_log(path):
            return None
    except (OSError, ValueError):
        return None
    numbers = (
        CHECKS,
        schema.VERSION,
        found.st_dev,
        found.st_ino,
        found.st_size,
        found.st_mtime_ns,
        found.st_ctime_ns,
    )
    return f"{sqlite3.sqlite_version} {' '.join(map(str, numbers))}"


def is_believed(path: Path, state: str | None) -> bool:
    """Was a file of this fingerprint found right at this place?"""
    if state is None:
        return False
    try:
        return _mark(path).read_text("utf-8") == state
    except (OSError, ValueError):
        return False


def believe(path: Path, state: str | None) -> None:
    """Keep that the file of this fingerprint is right, if that can be kept."""
    if state is None:
        return
    mark = _mark(path)
    with suppress(OSError, TTRError):
        mark.parent.mkdir(parents=True, exist_ok=True)
        write_whole(mark, state)
        kept = sorted(mark.parent.iterdir(), key=lambda it: it.stat().st_mtime)
        for old in kept[:-MOST]:
            old.unlink()


def doubt(path: Path) -> None:
    """Forget that the file was right: it is checked when it is next opened."""
    with suppress(OSError, ValueError):
        _mark(path).unlink()


def _has_log(path: Path) -> bool:
    """Does SQLite have to bring the file up to date when it is opened?"""
    beside = (Path(f"{path}{end}") for end in ("-wal", "-journal"))
    return any(os.path.lexists(it) and os.path.getsize(it) for it in beside)


def _mark(path: Path) -> Path:
    name = sha256(os.fsencode(os.path.realpath(path))).hexdigest()
    return Path(user_cache_dir("kille", appauthor=False)) / "checked-memories" / name
