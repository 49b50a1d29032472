from __future__ import annotations

import shutil
import sqlite3
from contextlib import closing
from pathlib import Path

import numpy as np
import pytest

from kille.memory import (
    Arrangement,
    Dialogue,
    Memory,
    MemoryFileError,
    MemoryReader,
    Sighting,
    Turn,
    Word,
    schema,
)
from kille.memory.configurations import from_text, to_text
from kille.scene import Configuration, Point

NEXT = (*schema.MIGRATIONS, ("ALTER TABLE dialogues ADD COLUMN tutor TEXT",))


def test_a_file_of_an_older_version_is_brought_up_to_date(path: Path) -> None:
    with Memory.open(path) as memory:
        memory.begin_dialogue("now")
    with closing(sqlite3.connect(path)) as connection:
        schema.migrate(connection, NEXT)
        schema.migrate(connection, NEXT)
        assert schema.version(connection) == len(NEXT)
        rows = connection.execute("SELECT id, began, tutor FROM dialogues").fetchall()
        assert rows == [(1, "now", None)]


def test_a_migration_that_fails_leaves_the_file_as_it_was(path: Path) -> None:
    Memory.open(path).close()
    broken = (*schema.MIGRATIONS, (*NEXT[-1], "ALTER TABLE missing ADD COLUMN x"))
    with closing(sqlite3.connect(path, isolation_level=None)) as connection:
        connection.execute("BEGIN IMMEDIATE")
        with pytest.raises(sqlite3.OperationalError, match="no such table"):
            schema.migrate(connection, broken)
        connection.rollback()
        assert schema.version(connection) == schema.VERSION
    Memory.open(path).close()


def test_a_file_of_a_newer_version_is_refused_and_left_alone(path: Path) -> None:
    Memory.open(path).close()
    with closing(sqlite3.connect(path)) as connection:
        schema.migrate(connection, NEXT)
        connection.commit()
    before = path.read_bytes()
    for opening in (Memory.open, Memory.open_to_read):
        with pytest.raises(MemoryFileError, match=r"newer kille.*update kille"):
            opening(path)
    assert path.read_bytes() == before


FIRST = """
INSERT INTO dialogues VALUES (1, '2026-01-31T12:00');
INSERT INTO turns VALUES (4, 1, 1, 'tutor', 'This is a cup.', 's : Naming', 'then'),
    (5, 1, 2, 'tutor', 'This is a box.', '', 'then'),
    (6, 1, 3, 'tutor', 'The cup is left of the box.', '', 'then');
INSERT INTO lessons VALUES (2, 'object', 'cup', 'cup', 4, 'synthetic', 0.5),
    (3, 'object', 'box', 'box', 5, 'photo', 0.0),
    (7, 'relation', 'left_of', 'left of', 6, 'synthetic', 1.5);
INSERT INTO sightings VALUES (2, 0.1, -0.2, 0.9, x'0000803e0000003f', 0.05, 0.2, 0.1),
    (3, NULL, NULL, NULL, NULL, NULL, NULL, NULL);
INSERT INTO scans VALUES (1, 2, x'{descriptor}', x'0000803f0000004000004040');
INSERT INTO arrangements VALUES (7, 'cup', 'box', -0.1, 0.30000000000000004, 0.0);
"""


def of_version_1(path: Path) -> None:
    """Makes a file as the first version of the tables has it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with closing(sqlite3.connect(path)) as connection:
        schema.migrate(connection, schema.MIGRATIONS[:1])
        connection.executescript(FIRST.format(descriptor="07" * 128))
        connection.commit()


SECOND = """
INSERT INTO dialogues VALUES (1, '2026-01-31T12:00');
INSERT INTO turns VALUES (4, 1, 1, 'tutor', 'This is a cup.', '', 'then'),
    (6, 1, 2, 'tutor', 'It is left of the box.', '', 'then');
INSERT INTO lessons VALUES (2, 'object', 'cup', 'cup', 4, 'synthetic', 0.5),
    (7, 'relation', 'left_of', 'left of', 6, 'synthetic', 1.5);
UPDATE sqlite_sequence SET seq = 9 WHERE name = 'lessons';
INSERT INTO sightings VALUES (2, 0.1, -0.2, 0.9);
INSERT INTO scans VALUES (1, 2, x'{descriptor}', x'0000803f0000004000004040');
INSERT INTO traits VALUES (1, 2, 'colour', x'0000803e0000003f');
INSERT INTO pictures VALUES (2, x'ffd8ff01', '[[1, 2, 3, 4]]');
INSERT INTO arrangements VALUES (7, 'cup', 'box', '{{"offset": [-0.1, 0.3, 0.0]}}');
"""


def of_version_2(path: Path) -> None:
    """Makes a file as the second version of the tables has it; 9 was forgotten."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with closing(sqlite3.connect(path)) as connection:
        schema.migrate(connection, schema.MIGRATIONS[:2])
        connection.executescript(SECOND.format(descriptor="07" * 128))
        connection.commit()


def test_a_file_of_the_second_version_keeps_everything(path: Path) -> None:
    of_version_2(path)
    for _ in range(2):
        with Memory.open(path) as memory:
            cup, left = memory.lesson(2), memory.lesson(7)
            assert (cup.word, cup.holds) == (Word("cup", "cup", "object", ""), True)
            assert isinstance(cup.seen, Sighting)
            assert len(cup.seen.scans) == 1
            assert cup.seen.traits["colour"].tolist() == [0.25, 0.5]
            assert cup.seen.picture is not None
            assert (left.word.name, left.holds) == ("left_of", True)
            assert isinstance(left.seen, Arrangement)
            assert left.seen.configuration == Configuration((-0.1, 0.3, 0.0))
    with Memory.open(path) as memory:
        turn = Turn(memory.begin_dialogue("later"), 1, "tutor", "", "", "later")
        seen = Sighting("synthetic", 0.0, (), None)
        assert memory.learn_attribute(turn, "is_red", "red", seen, holds=False) == 10
        memory.forget(2)
    with closing(sqlite3.connect(path)) as connection:
        assert connection.execute("SELECT count(*) FROM scans").fetchone() == (0,)
        assert connection.execute("PRAGMA foreign_key_check").fetchall() == []


def test_a_second_version_in_which_nothing_was_ever_taught(path: Path) -> None:
    path.parent.mkdir()
    with closing(sqlite3.connect(path)) as connection:
        schema.migrate(connection, schema.MIGRATIONS[:2])
        connection.commit()
    with Memory.open(path) as memory:
        assert memory.lessons() == ()
        turn = Turn(memory.begin_dialogue("later"), 1, "tutor", "", "", "later")
        seen = Sighting("synthetic", 0.0, (), None)
        assert memory.learn_object(turn, "cup", "cup", seen) == 1


def assert_kept(memory: MemoryReader) -> None:
    """Is all of the file of version 1 there?"""
    cup, box = memory.objects()
    (left,) = memory.relations()
    assert (cup.key, box.key, left.key) == (2, 3, 7)
    assert cup.turn == Turn(1, 1, "tutor", "This is a cup.", "s : Naming", "then")
    assert cup.word == Word("cup", "cup", "object")
    assert (cup.seen.sensor, cup.seen.time) == ("synthetic", 0.5)
    assert cup.seen.place == Point(0.1, -0.2, 0.9)
    (scan,) = cup.seen.scans
    assert (scan.descriptors == 7).all()
    assert scan.points.tolist() == [[1, 2, 3]]
    assert cup.seen.traits["colour"].tolist() == [0.25, 0.5]
    longest_first = np.exp(cup.seen.traits["size"]) - 0.01
    assert longest_first == pytest.approx([0.2, 0.1, 0.05], abs=1e-6)
    assert (box.seen.place, box.seen.scans, dict(box.seen.traits)) == (None, (), {})
    offset = -0.1, 0.30000000000000004, 0.0
    stand = Configuration(offset)
    assert left.seen == Arrangement("synthetic", 1.5, "cup", "box", stand)
    assert left.word == Word("left_of", "left of", "relation")
    assert [memory.picture(it.key) for it in memory.lessons()] == [None] * 3
    assert memory.dialogues() == (Dialogue(1, "2026-01-31T12:00"),)
    assert len(memory.turns()) == 3


def test_a_file_of_the_first_version_keeps_everything(path: Path) -> None:
    of_version_1(path)
    for _ in range(2):
        with Memory.open(path) as memory:
            assert_kept(memory)
    with Memory.open(path) as memory:
        turn = Turn(memory.begin_dialogue("later"), 1, "tutor", "", "", "later")
        seen = Sighting("synthetic", 0.0, (), None)
        assert memory.learn_object(turn, "cup", "cup", seen) == 8


@pytest.mark.parametrize("length", [-0.01, -0.02])
def test_a_length_that_no_thing_has_is_not_brought_up_to_date(
    path: Path, length: float
) -> None:
    of_version_1(path)
    with closing(sqlite3.connect(path)) as connection:
        connection.execute("UPDATE sightings SET breadth = ?", (length,))
        connection.commit()
    with Memory.open(path) as memory:
        assert [set(it.seen.traits) for it in memory.objects()] == [{"colour"}, set()]


def test_a_file_of_an_older_version_is_read_without_being_changed(path: Path) -> None:
    of_version_1(path)
    before = path.read_bytes()
    with Memory.open_to_read(path) as memory:
        assert_kept(memory)
    assert path.read_bytes() == before
    assert [it.name for it in path.parent.iterdir()] == [path.name]


def test_a_migration_killed_half_way_leaves_the_first_version(path: Path) -> None:
    of_version_1(path)
    with closing(sqlite3.connect(path, isolation_level=None)) as connection:
        connection.execute("PRAGMA journal_mode = WAL")
        connection.execute("BEGIN IMMEDIATE")
        schema.migrate(connection)
        for file in (path, path.with_name(f"{path.name}-wal")):
            shutil.copy(file, path.with_name(f"killed{file.name}"))
    with Memory.open(path.with_name(f"killed{path.name}")) as memory:
        assert_kept(memory)


def test_an_empty_file_is_an_empty_memory(path: Path) -> None:
    path.parent.mkdir()
    path.touch()
    with Memory.open_to_read(path) as memory:
        assert (memory.words(), memory.turns(), memory.lessons()) == ((), (), ())
    assert path.read_bytes() == b""


def test_fields_of_a_later_version_are_passed_over() -> None:
    known = '{"offset": [0, 1, 2], "others": [[1, 2, 3]], "weather": [4, [5]]}'
    stand = Configuration((0, 1, 2), others=((1, 2, 3),))
    assert from_text(known) == stand
    assert from_text(to_text(stand)) == stand
