"""Lessons that say which kind of thing is a kind of which, as a memory keeps them."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import pytest

from kille.memory import (
    KindLesson,
    Memory,
    NoSuchLessonError,
    ObjectLesson,
    Sighting,
    Subsumption,
    Turn,
    Word,
    schema,
)
from kille.memory.checking import check
from kille.memory.exporting import export
from kille.memory.importing import open_package
from kille.memory.lessons import has_same_content
from kille.memory.salvaging import salvage

MUG, CUP = Word("mug", "mug", "object", "a"), Word("cup", "cup", "object", "a")
Said = Callable[[int], Turn]


@pytest.fixture
def taught(path: Path, said: Said, seen: Sighting) -> Path:
    """A memory of a mug, and that a mug is a kind of cup."""
    with Memory.open(path) as memory:
        memory.begin_dialogue("2026-01-31T12:00")
        assert memory.learn_object(said(1), "mug", "mug", seen, article="a") == 1
        assert memory.learn_kind(said(2), MUG, CUP) == 2
    return path


def test_it_is_kept_for_good(taught: Path, said: Said) -> None:
    with Memory.open_to_read(taught) as memory:
        [kind] = memory.kinds()
        assert kind.seen == Subsumption(CUP)
        assert kind.word == Word("mug", "mug", "subkind", "a")
        assert kind.turn == said(2)
        assert has_same_content(memory.lesson(2), kind)
        assert [it.key for it in memory.lessons()] == [1, 2]
        assert memory.latest()[0].key == 2


def test_it_teaches_no_word(taught: Path) -> None:
    with Memory.open_to_read(taught) as memory:
        assert [it.name for it in memory.words()] == ["mug"]
        assert memory.keys_of("object", "mug") == (1,)
        assert memory.counts()["object", "mug"] == 1
        assert [it.key for it in memory.objects()] == [1]


def test_it_is_forgotten(taught: Path) -> None:
    with Memory.open(taught) as memory:
        memory.forget(2)
        assert memory.kinds() == ()
        assert [it.name for it in memory.words()] == ["mug"]
        with pytest.raises(NoSuchLessonError):
            memory.lesson(2)
    with closing(sqlite3.connect(taught)) as connection:
        assert connection.execute("SELECT * FROM subsumptions").fetchall() == []


@pytest.mark.parametrize("name", ["package", "package.zip"])
def test_it_is_moved(taught: Path, tmp_path: Path, name: str) -> None:
    with Memory.open_to_read(taught) as memory:
        export(memory, tmp_path / name)
        expected = memory.lesson(2)
    with open_package(tmp_path / name) as package, Memory.transient() as other:
        assert len(other.merge(package).lessons) == 2
        assert other.merge(package).lessons == ()
        assert has_same_content(other.lesson(2), expected)


def test_it_is_salvaged(taught: Path, tmp_path: Path) -> None:
    done = salvage(taught, tmp_path / "new.db")
    assert done.losses == ()
    with Memory.open_to_read(tmp_path / "new.db") as memory:
        assert [it.seen.upper for it in memory.kinds()] == [CUP]


def test_without_what_it_is_a_kind_of_nothing_is_left(
    taught: Path, tmp_path: Path
) -> None:
    with closing(sqlite3.connect(taught)) as connection:
        connection.execute("DELETE FROM subsumptions")
        connection.commit()
    assert check(taught).faults == (
        "it has lessons about kinds of things without what these are kinds of",
    )
    done = salvage(taught, tmp_path / "new.db")
    assert done.losses == ("lesson 2 (mug): nothing is left of what was seen",)
    with Memory.open_to_read(tmp_path / "new.db") as memory:
        assert [it.key for it in memory.lessons()] == [1]


def test_a_file_of_the_third_version_keeps_everything(path: Path) -> None:
    path.parent.mkdir(parents=True)
    with closing(sqlite3.connect(path)) as connection:
        schema.migrate(connection, schema.MIGRATIONS[:3])
        connection.executescript("""
            INSERT INTO dialogues VALUES (1, '2026-01-31T12:00');
            INSERT INTO turns VALUES (4, 1, 1, 'tutor', 'Not an axe.', '', 'then');
            INSERT INTO lessons VALUES
                (2, 'object', 'axe', 'axe', 4, 'photo', 0.5, 'an', 0);
            INSERT INTO sightings VALUES (2, NULL, NULL, NULL);
            UPDATE sqlite_sequence SET seq = 5 WHERE name = 'lessons';
            """)
        connection.commit()
    with Memory.open(path) as memory:
        axe = memory.lesson(2)
        assert isinstance(axe, ObjectLesson)
        assert (axe.word.article, axe.holds) == ("an", False)
        turn = Turn(1, 2, "tutor", "Mugs are cups.", "", "then")
        assert memory.learn_kind(turn, MUG, CUP) == 6
        assert isinstance(memory.lesson(6), KindLesson)
    assert check(path).faults == ()
