"""Lessons by what things of a kind are known, as a memory keeps them."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import pytest

from kille.memory import (
    Criterion,
    CriterionLesson,
    KindLesson,
    Memory,
    NoSuchLessonError,
    Sighting,
    Turn,
    Word,
    schema,
)
from kille.memory.checking import check
from kille.memory.exporting import export
from kille.memory.importing import open_package
from kille.memory.lessons import By, has_same_content
from kille.memory.salvaging import salvage

MUG = Word("mug", "mug", "object", "a")
CRITERIA: tuple[tuple[By, Word, float], ...] = (
    ("cue", Word("colour", "colour", "attribute"), 0.0),
    ("quality", Word("is_white", "white", "attribute"), 0.9),
    ("part", Word("handle", "handle", "object", "a"), 0.9),
)
Said = Callable[[int], Turn]


@pytest.fixture
def taught(path: Path, said: Said, seen: Sighting) -> Path:
    """A memory of a mug, and of a cue, a quality and a part of mugs."""
    with Memory.open(path) as memory:
        memory.begin_dialogue("2026-01-31T12:00")
        assert memory.learn_object(said(1), "mug", "mug", seen, article="a") == 1
        for by, word, degree in CRITERIA:
            memory.learn_criterion(said(2), MUG, by, word, degree)
    return path


def test_they_are_kept_for_good(taught: Path, said: Said) -> None:
    with Memory.open_to_read(taught) as memory:
        cue, quality, part = memory.criteria()
        assert cue.seen == Criterion("cue", "colour", "colour", 0.0)
        assert quality.seen == Criterion("quality", "is_white", "white", 0.9)
        assert part.seen == Criterion("part", "handle", "handle", 0.9, "a")
        assert part.word == Word("mug", "mug", "criterion", "a")
        assert part.turn == said(2)
        assert has_same_content(memory.lesson(4), part)
        assert [it.key for it in memory.lessons()] == [1, 2, 3, 4]
        assert memory.latest()[0].key == 4


def test_they_teach_no_word(taught: Path) -> None:
    with Memory.open_to_read(taught) as memory:
        assert [it.name for it in memory.words()] == ["mug"]
        assert memory.keys_of("object", "mug") == (1,)
        assert memory.counts()["object", "mug"] == 1
        assert [it.key for it in memory.objects()] == [1]
        assert memory.kinds() == ()


def test_one_is_forgotten(taught: Path) -> None:
    with Memory.open(taught) as memory:
        memory.forget(3)
        assert [it.seen.by for it in memory.criteria()] == ["cue", "part"]
        with pytest.raises(NoSuchLessonError):
            memory.lesson(3)
    with closing(sqlite3.connect(taught)) as connection:
        keys = connection.execute("SELECT lesson FROM criteria").fetchall()
    assert keys == [(2,), (4,)]


@pytest.mark.parametrize("name", ["package", "package.zip"])
def test_they_are_moved(taught: Path, tmp_path: Path, name: str) -> None:
    with Memory.open_to_read(taught) as memory:
        export(memory, tmp_path / name)
        expected = [memory.lesson(key) for key in (2, 3, 4)]
    with open_package(tmp_path / name) as package, Memory.transient() as other:
        assert len(other.merge(package).lessons) == 4
        assert other.merge(package).lessons == ()
        moved = [other.lesson(key) for key in (2, 3, 4)]
    assert all(map(has_same_content, moved, expected))


def test_they_are_salvaged(taught: Path, tmp_path: Path) -> None:
    done = salvage(taught, tmp_path / "new.db")
    assert done.losses == ()
    with Memory.open_to_read(tmp_path / "new.db") as memory:
        assert [it.seen.by for it in memory.criteria()] == ["cue", "quality", "part"]


def test_without_what_it_is_nothing_is_left(taught: Path, tmp_path: Path) -> None:
    with closing(sqlite3.connect(taught)) as connection:
        connection.execute("DELETE FROM criteria WHERE lesson = 3")
        connection.commit()
    assert check(taught).faults == (
        "it has lessons by what things are known without what that is",
    )
    done = salvage(taught, tmp_path / "new.db")
    assert done.losses == ("lesson 3 (mug): nothing is left of what was seen",)
    with Memory.open_to_read(tmp_path / "new.db") as memory:
        assert [it.key for it in memory.lessons()] == [1, 2, 4]


def test_a_file_of_the_fourth_version_keeps_everything(path: Path) -> None:
    path.parent.mkdir(parents=True)
    with closing(sqlite3.connect(path)) as connection:
        schema.migrate(connection, schema.MIGRATIONS[:4])
        connection.executescript("""
            INSERT INTO dialogues VALUES (1, '2026-01-31T12:00');
            INSERT INTO turns VALUES (4, 1, 1, 'tutor', 'Mugs are cups.', '', 'then');
            INSERT INTO lessons VALUES
                (2, 'subkind', 'mug', 'mug', 4, '', 0.0, 'a', 1);
            INSERT INTO subsumptions VALUES (2, 'cup', 'cup', 'a');
            UPDATE sqlite_sequence SET seq = 5 WHERE name = 'lessons';
            """)
        connection.commit()
    with Memory.open(path) as memory:
        assert isinstance(memory.lesson(2), KindLesson)
        turn = Turn(1, 2, "tutor", "Mugs are white.", "", "then")
        assert memory.learn_criterion(turn, MUG, *CRITERIA[1]) == 6
        assert isinstance(memory.lesson(6), CriterionLesson)
    assert check(path).faults == ()


@pytest.mark.parametrize("degree", [-0.1, 1.1, float("nan")])
def test_a_degree_is_from_0_to_1(degree: float) -> None:
    with pytest.raises(ValueError, match=r"0 to 1|finite"):
        Criterion("quality", "is_white", "white", degree)


def test_things_are_known_by_nothing_else() -> None:
    with pytest.raises(ValueError, match="not smell"):
        Criterion("smell", "fruity", "fruity", 1.0)  # type: ignore[arg-type]
