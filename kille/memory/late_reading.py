"""Read what was seen in single lessons when somebody asks for it.

A memory of 100,000 lessons is 2.5 GB, and of most of them a question needs nothing. So
of many lessons only what they are about is read when the robot starts, and what was
seen in one when it is compared.
"""

from __future__ import annotations

import sqlite3
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager

from kille.memory import reading
from kille.memory.errors import (
    MemoryClosedError,
    MemoryFileError,
    NoSuchLessonError,
    explain_content_failures,
    explain_failures,
)
from kille.memory.pictures import Picture
from kille.memory.reading import Descriptors
from kille.scene import Traits
from ttr.safety.closing import Closing


class LateReader(Closing):
    """Reads what was seen in the lessons of a file, in any thread.

    It reads what is committed, over a connection of its own, which it closes.
    Any method raises MemoryFileError when the file fails it, after `failed` was called,
    MemoryClosedError once it is closed, and NoSuchLessonError for a lesson that is not
    there.
    """

    def __init__(
        self,
        connection: sqlite3.Connection,
        place: str,
        failed: Callable[[], object],
    ) -> None:
        self._connection, self._place, self._failed = connection, place, failed
        self._lock = threading.Lock()
        self._is_open = True

    def close(self) -> None:
        """Close the connection; a second call does nothing."""
        with self._lock, explain_failures(self._place):
            self._is_open = False
            self._connection.close()

    def descriptors(self, keys: Sequence[int]) -> Sequence[Sequence[Descriptors]]:
        """The descriptors of each scan of the lessons of these keys, some hundreds."""
        with self._guard_reading(*keys):
            found = reading.descriptors_of(self._connection, keys)
        return [found.get(key, ()) for key in keys]

    def traits(self, keys: Sequence[int]) -> Sequence[Traits]:
        """The traits of what was seen in the lessons of these keys, some hundreds."""
        with self._guard_reading(*keys):
            found = reading.traits_of(self._connection, keys)
        return [found.get(key, {}) for key in keys]

    def picture(self, key: int) -> Picture | None:
        """The picture of the lesson of this key; None if none was kept."""
        with self._guard_reading(key):
            return reading.picture(self._connection, key)

    @contextmanager
    def _guard_reading(self, *keys: int) -> Iterator[None]:
        with self._lock:
            if not self._is_open:
                raise MemoryClosedError(f"{self._place} is closed")
            try:
                with explain_content_failures(self._place):
                    gone = reading.keys_of_no_lesson(self._connection, keys)
                    if not gone:
                        yield
            except MemoryFileError:
                self._failed()
                raise
            if gone:
                raise NoSuchLessonError(f"{self._place} has no lesson {gone[0]}")
