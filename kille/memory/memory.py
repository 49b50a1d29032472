"""The durable memory: what was said, seen and learned, in one file."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager
from pathlib import Path
from typing import Self

from kille.memory import believed_files, files, merging, reading, writing
from kille.memory.errors import (
    MemoryFileError,
    NoSuchLessonError,
    explain_content_failures,
    explain_failures,
)
from kille.memory.late_reading import LateReader
from kille.memory.lessons import (
    Arrangement,
    By,
    Criterion,
    CriterionLesson,
    Dialogue,
    Kind,
    KindLesson,
    Lesson,
    ObjectLesson,
    RelationLesson,
    Seen,
    SeenLesson,
    Sighting,
    Subsumption,
    Turn,
    Word,
)
from kille.memory.merging import MergeResult, MergeSource
from kille.memory.pictures import Picture
from kille.memory.reading import Outline
from ttr.aliases import Alias
from ttr.safety.closing import Closing

LATE = 2_000
"""Of more lessons in nouns than that, what was seen is read when it is needed."""

Scope = Callable[[sqlite3.Connection], AbstractContextManager[None]]
"""A transaction: what happens in it is kept as a whole or undone."""


class MemoryReader(Closing):
    """The content of a memory file, to read only; another program may be writing.

    Made by `Memory.open_to_read`; it is its own context manager. `place` says in words
    where the memory is. Any method raises MemoryFileError when the file fails it.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder, "memory.db")
    ...     Memory.open(file).close()
    ...     with Memory.open_to_read(file) as reader:
    ...         reader.words()
    ()
    """

    def __init__(
        self, connection: sqlite3.Connection, place: str, path: Path | None = None
    ) -> None:
        self._connection = connection
        self._path = path
        self.place = place

    def close(self) -> None:
        """Close the file; a second call does nothing."""
        with explain_failures(self.place):
            self._connection.close()

    @contextmanager
    def _guard_reading(self) -> Iterator[None]:
        """What is done while the content is read, whose failures are explained.

        A file that failed is checked as a whole when it is next opened.
        """
        try:
            with explain_content_failures(self.place):
                yield
        except MemoryFileError:
            self._doubt()
            raise

    def _doubt(self) -> None:
        if self._path is not None:
            believed_files.doubt(self._path)

    def words(self) -> tuple[Word, ...]:
        """Every word that is known to apply to something, oldest first.

        It is as it was said when that was first taught, with the first article it had.
        """
        with self._guard_reading():
            return reading.words(self._connection)

    def copy_to(self, path: Path) -> None:
        """Write all that it holds to another file, over what is there.

        Raises MemoryFileError, and OSError where there can be no such file.
        """
        files.copy_to_file(self._connection, path)

    def counts(self) -> dict[tuple[Kind, str], int]:
        """The number of lessons in which each word was said to apply, by kind and
        name."""
        with self._guard_reading():
            return reading.counts(self._connection)

    def dialogues(self) -> tuple[Dialogue, ...]:
        """All dialogues, in the order in which they began."""
        with self._guard_reading():
            return reading.dialogues(self._connection)

    def turns(self) -> tuple[Turn, ...]:
        """Everything that was said, dialogue by dialogue."""
        with self._guard_reading():
            return reading.turns(self._connection)

    def turns_before(self, turn: Turn, count: int) -> tuple[Turn, ...]:
        """The last `count` turns before one of the same dialogue, in order."""
        with self._guard_reading():
            return reading.turns_before(self._connection, turn, count)

    def lessons(self) -> tuple[Lesson, ...]:
        """All lessons, oldest first, without what was seen in them."""
        with self._guard_reading():
            return reading.lessons(self._connection)

    def latest(self, count: int = 1) -> tuple[Lesson, ...]:
        """The newest `count` lessons, the newest last, without what was seen."""
        with self._guard_reading():
            return reading.latest(self._connection, count)

    def lesson_without_sight(self, key: int) -> Lesson:
        """The lesson of this key without what was seen. Raises NoSuchLessonError."""
        with self._guard_reading():
            found = reading.lesson_without_sight(self._connection, key)
        if found is None:
            raise _no_such(self.place, key)
        return found

    told = Alias("lesson_without_sight")

    def first_key_of(self, kind: Kind, name: str) -> int | None:
        """The key of the oldest lesson in which a word was said to apply.

        None for a word that is not known.
        """
        with self._guard_reading():
            return reading.first_key_of(self._connection, kind, name)

    def keys_of(self, kind: Kind, name: str) -> tuple[int, ...]:
        """The keys of the lessons in a word, oldest first."""
        with self._guard_reading():
            return reading.keys_of(self._connection, kind, name)

    def objects(self) -> Iterator[ObjectLesson]:
        """The lessons in what objects are called, oldest first, without their pictures.

        They are read some hundred at a time, as they are asked for.
        """
        with self._guard_reading():
            yield from reading.objects(self._connection)

    def outlines(self) -> list[Outline]:
        """What the lessons in names of objects are about, oldest first."""
        with self._guard_reading():
            return reading.outlines(self._connection)

    def attributes(self) -> Iterator[ObjectLesson]:
        """The lessons in attributes of objects, read like those in their names."""
        with self._guard_reading():
            yield from reading.objects(self._connection, "attribute")

    def relations(self) -> Iterator[RelationLesson]:
        """The lessons about relations, read like those about objects."""
        with self._guard_reading():
            yield from reading.relations(self._connection)

    def kinds(self) -> tuple[KindLesson, ...]:
        """The lessons that say which kind of thing is a kind of which, oldest
        first."""
        with self._guard_reading():
            return reading.kinds(self._connection)

    def criteria(self) -> tuple[CriterionLesson, ...]:
        """The lessons that say by what things of a kind are known, oldest first."""
        with self._guard_reading():
            return reading.criteria(self._connection)

    def lesson(self, key: int) -> SeenLesson:
        """The lesson of this key with its picture. Raises NoSuchLessonError."""
        with self._guard_reading():
            found = reading.lesson(self._connection, key)
        if found is None:
            raise _no_such(self.place, key)
        return found

    def picture(self, key: int) -> Picture | None:
        """The picture of a lesson; None if none was kept or there is no such lesson."""
        with self._guard_reading():
            return reading.picture(self._connection, key)

    @contextmanager
    def at_one_moment(self) -> Iterator[Self]:
        """Answer all questions asked inside as of one moment."""
        with explain_failures(self.place), reading.at_one_moment(self._connection):
            yield self


class Memory(MemoryReader):
    """Lessons and the turns they came from, on disk before a method returns.

    Inside `together` they are on disk when that ends. Made by `open` or `transient`;
    it is its own context manager. Any method raises MemoryFileError when the file fails
    it, and leaves what was there.

    >>> from kille.scene import Point
    >>> with Memory.transient() as memory:
    ...     dialogue = memory.begin_dialogue("2026-01-31T12:00:00")
    ...     said = Turn(dialogue, 1, "tutor", "This is a cup.", "", "2026-01-31T12:01")
    ...     seen = Sighting("synthetic", 0.0, scans=(), place=Point(0.0, 0.1, 0.8))
    ...     key = memory.learn_object(said, "cup", "cup", seen)
    ...     print(memory.words())
    (Word(name='cup', surface='cup', kind='object', article=''),)
    """

    def __init__(
        self, connection: sqlite3.Connection, place: str, path: Path | None = None
    ) -> None:
        super().__init__(connection, place, path)
        self._scope: Scope = _commit_durably
        self._late: LateReader | None = None

    @classmethod
    def open(cls, path: Path) -> Self:
        """Open the memory in this file, made if missing, to read and to write.

        One program at a time may hold it so. Raises MemoryFileError.
        """
        return cls(files.open_to_write(path), str(path), path)

    def close(self) -> None:
        """Close the file; a second call does nothing.

        A large file that was right is believed when it is next opened.
        """
        path, self._path = self._path, None
        with ExitStack() as closing:
            closing.callback(super().close)
            if self._late is not None:
                closing.callback(self._late.close)  # first, or SQLite's log would stay
        if path is not None:
            believed_files.believe(path, believed_files.fingerprint(path))

    def late_reader(self) -> LateReader | None:
        """A reader of what was seen in lessons in names of objects, until this closes.

        None where they are few, or in no file: then all can be read at once.
        """
        if self._late is None and self._path is not None:
            with self._guard_reading():
                if reading.count(self._connection, "object") <= LATE:
                    return None
                beside = files.connect_beside(self._path)
            self._late = LateReader(beside, self.place, self._doubt)
        return self._late

    def _doubt(self) -> None:
        super()._doubt()
        self._path = None

    @staticmethod
    def open_to_read(path: Path) -> MemoryReader:
        """Open the memory in this file, only to read. Raises MemoryFileError."""
        return MemoryReader(files.open_to_read(path), str(path), path)

    reading = Alias("open_to_read")

    @classmethod
    def transient(cls) -> Self:
        """A memory that is deleted when it is closed."""
        return cls(files.open_transient(), "the memory of this session")

    @classmethod
    def copy_of(cls, path: Path) -> Self:
        """A memory with what is in this file, which stays as it is.

        It is deleted when it is closed. Raises MemoryFileError.
        """
        return cls(files.open_copy(path), f"a copy of {path}")

    def begin_dialogue(self, time: str) -> int:
        """Begin a dialogue at this time (ISO 8601); returns its number."""
        with self._transaction() as connection:
            return writing.add_dialogue(connection, time)

    def record_turn(self, turn: Turn) -> int:
        """Record a turn; returns its id, the same however often it is recorded.

        What it was understood to be, "" at first, may be added when it is known.
        Raises ValueError if its dialogue never began, or if something else is on
        record as that turn.
        """
        with self._transaction() as connection:
            return writing.add_turn(connection, turn)

    def learn_object(
        self,
        turn: Turn,
        name: str,
        surface: str,
        seen: Sighting,
        *,
        article: str = "",
        holds: bool = True,
    ) -> int:
        """Record the turn, the word it taught, and what was seen, all or nothing.

        The key of the lesson, which `holds`, or is one in what the word does not hold
        of. Raises ValueError as `record_turn` does.
        """
        word = Word(name, surface, "object", article)
        return self._learn(turn, word, seen, holds)

    def learn_attribute(
        self,
        turn: Turn,
        name: str,
        surface: str,
        seen: Sighting,
        *,
        article: str = "",
        holds: bool = True,
    ) -> int:
        """Learn a word for an attribute, such as "red", in the same way."""
        word = Word(name, surface, "attribute", article)
        return self._learn(turn, word, seen, holds)

    def learn_relation(
        self,
        turn: Turn,
        name: str,
        surface: str,
        seen: Arrangement,
        *,
        article: str = "",
        holds: bool = True,
    ) -> int:
        """Learn a word for a spatial relation, such as "left of", in the same way."""
        word = Word(name, surface, "relation", article)
        return self._learn(turn, word, seen, holds)

    def learn_kind(self, turn: Turn, lower: Word, upper: Word) -> int:
        """Learn that a kind of thing is a kind of another, in the same way."""
        word = Word(lower.name, lower.surface, "subkind", lower.article)
        return self._learn(turn, word, Subsumption(upper), holds=True)

    def learn_criterion(
        self,
        turn: Turn,
        of: Word,
        by: By,
        criterion: Word,
        degree: float,
    ) -> int:
        """Learn by what things of a kind are known, in the same way.

        The criterion is named as a word is, by its name, surface and article.
        """
        word = Word(of.name, of.surface, "criterion", of.article)
        seen = Criterion(
            by, criterion.name, criterion.surface, degree, criterion.article
        )
        return self._learn(turn, word, seen, holds=True)

    def _learn(self, turn: Turn, word: Word, seen: Seen, holds: bool) -> int:
        with self._transaction() as connection:
            return writing.add_lesson(connection, turn, word, seen, holds=holds)

    def forget(self, key: int) -> None:
        """Forget one lesson; what was said stays on record.

        A word goes with its last lesson. Raises NoSuchLessonError.
        """
        with self._transaction() as connection:
            found = writing.delete_lesson(connection, key)
        if not found:
            raise _no_such(self.place, key)

    def forget_word(self, kind: Kind, name: str) -> tuple[int, ...]:
        """Forget all lessons in a word, all or nothing; returns their keys, oldest
        first.

        Raises NoSuchLessonError if there are none.
        """
        with self._transaction() as connection:
            keys = reading.keys_of(connection, kind, name)
            for key in keys:
                writing.delete_lesson(connection, key)
        if not keys:
            raise NoSuchLessonError(f"{self.place} has no lesson in the {kind} {name}")
        return keys

    def merge(self, other: MergeSource) -> MergeResult:
        """Add what is new in another memory, all or nothing; returns what was added.

        A lesson is known if it teaches the same, in the same word, from the same turn
        of the same dialogue. An empty memory becomes equal to the other.
        """
        with self._transaction() as connection:
            return merging.merge(connection, other)

    @contextmanager
    def together(self) -> Iterator[None]:
        """Keep all changes made inside, or none of them."""
        with self._transaction():
            outer, self._scope = self._scope, _savepoint
            try:
                yield
            finally:
                self._scope = outer

    @contextmanager
    def _transaction(self) -> Iterator[sqlite3.Connection]:
        """A transaction on the connection, whose failures are explained."""
        with explain_failures(self.place), self._scope(self._connection):
            yield self._connection


def _no_such(place: str, key: int) -> NoSuchLessonError:
    return NoSuchLessonError(
        f"{place} has no lesson {key}: kille memory show WORD lists those in a word"
    )


@contextmanager
def _commit_durably(connection: sqlite3.Connection) -> Iterator[None]:
    """A transaction that is on disk when it ends.

    The next one begins at once: it holds the lock that makes this the one writer of
    the file.
    """
    files.hold(connection)
    try:
        yield
        connection.execute("COMMIT")
    except BaseException:
        connection.rollback()
        raise
    finally:
        files.hold(connection)


@contextmanager
def _savepoint(connection: sqlite3.Connection) -> Iterator[None]:
    """A part of a larger transaction; it is on disk when the whole is."""
    connection.execute("SAVEPOINT part")
    try:
        yield
    except BaseException:
        # Some failures, such as a full disk, have undone the whole by themselves.
        if connection.in_transaction:
            connection.execute("ROLLBACK TO part")
        raise
    finally:
        if connection.in_transaction:
            connection.execute("RELEASE part")
