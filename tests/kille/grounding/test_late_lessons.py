"""What was seen in very many lessons is read when it is needed, and not before."""

from __future__ import annotations

import logging
import sqlite3
import threading
from collections.abc import Iterator
from contextlib import closing, suppress
from pathlib import Path

import pytest

from kille.grounding.lessons_and_learners import Knowledge, Learners, LessonSource
from kille.memory import Memory, MemoryFileError, Turn, memory
from kille.perception.descriptor_index import Background, View
from kille.perception.descriptor_index.views import GoneError, LateView
from kille.perception.objects import ObjectMemory
from kille.scene import Percept

from .test_lessons_and_learners import THINGS, percepts

ASKED = percepts(2)


def taught(path: Path) -> None:
    """A memory with two lessons in each word, and a denial."""
    with Memory.open(path) as kept:
        knowledge, dialogue = Knowledge(kept), kept.begin_dialogue("now")
        lessons = [
            (word, percept, True)
            for seed in (1, 3)
            for word, percept in percepts(seed).items()
        ]
        lessons.append(("cup", lessons[1][1], False))
        for number, (word, percept, holds) in enumerate(lessons):
            turn = Turn(dialogue, number, "tutor", f"{word} {number}", "", "now")
            source = LessonSource(turn, "synthetic", 0.0)
            knowledge.learn_noun(word, word, percept, source, holds=holds)


@pytest.fixture
def path(tmp_path: Path) -> Path:
    path = tmp_path / "memory.db"
    taught(path)
    return path


@pytest.fixture
def late(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(memory, "LATE", 0)


@pytest.fixture
def robot(path: Path, late: None) -> Iterator[Knowledge]:
    with Memory.open(path) as kept:
        yield Knowledge(kept)


def degrees(knowledge: Knowledge) -> list[dict[str, float]]:
    return [knowledge.objects.predict_proba_one(it) for it in ASKED.values()]


def unread(view: View) -> set[str]:
    assert isinstance(view, LateView)
    return {"descriptors", "traits"} - view.__dict__.keys()


def change(path: Path, statement: str, *values: object) -> None:
    with closing(sqlite3.connect(path)) as connection:
        connection.execute(statement, values)
        connection.commit()


def test_the_robot_judges_as_if_it_had_read_everything(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with Memory.open(path) as kept:
        at_once = Knowledge(kept)
        assert not any(isinstance(it, LateView) for it in at_once.objects.views)
        expected = degrees(at_once)
    monkeypatch.setattr(memory, "LATE", 0)
    with Memory.open(path) as kept:
        knowledge = Knowledge(kept)
        assert all(unread(it) for it in knowledge.objects.views)
        assert degrees(knowledge) == expected


def test_only_what_is_compared_is_read(robot: Knowledge) -> None:
    robot.objects.nearest(ASKED["cup"], "cup")
    assert [unread(it) for it in robot.objects.views] == [{"descriptors"}] * 6


def test_what_is_forgotten_and_undone_is_there_again(robot: Knowledge) -> None:
    before = degrees(robot)
    key = robot.objects.views[0].key
    assert isinstance(key, int)
    with suppress(RuntimeError), robot.together():
        robot.forget(key)
        raise RuntimeError
    assert degrees(robot) == before
    robot.forget(key)
    assert degrees(robot) != before


def test_who_holds_a_forgotten_lesson_still_has_it(robot: Knowledge) -> None:
    right = robot.hindsight("cup", 3)
    for view in (*robot.objects.views, *robot.objects.denied):
        assert isinstance(view.key, int)
        robot.forget(view.key)
    assert len(list(right)) == 3


def test_a_new_lesson_counts_beside_late_ones(robot: Knowledge) -> None:
    before = degrees(robot)
    turn = Turn(robot.memory.begin_dialogue("then"), 1, "tutor", "It's a lamp.", "", "")
    x: Percept = ASKED["book"]
    robot.learn_noun("lamp", "lamp", x, LessonSource(turn, "synthetic", 1.0))
    assert degrees(robot) != before
    assert robot.objects.labels == tuple(sorted([*THINGS, "lamp"]))


def test_a_value_that_is_damaged_is_told_of_when_it_is_read(
    path: Path, late: None
) -> None:
    change(path, "UPDATE traits SET vector = ? WHERE cue = 'size'", b"\xff" * 12)
    with Memory.open(path) as kept:
        knowledge = Knowledge(kept)
        with pytest.raises(MemoryFileError, match=r"is damaged .*kille memory check"):
            degrees(knowledge)


def test_a_length_that_no_features_have_is_told_of_at_the_start(
    path: Path, late: None
) -> None:
    change(path, "UPDATE scans SET descriptors = ? WHERE id = 1", b"\xff" * 12)
    with (
        Memory.open(path) as kept,
        pytest.raises(MemoryFileError, match="12 bytes of descriptors"),
    ):
        Knowledge(kept)


def test_nothing_can_be_read_after_the_end(path: Path, late: None) -> None:
    with Memory.open(path) as kept:
        view = Knowledge(kept).objects.views[0]
    with pytest.raises(GoneError, match="is closed"):
        view.load()
    assert [it.name for it in path.parent.iterdir()] == ["memory.db"]


def test_an_index_that_is_no_longer_needed_ends_without_a_word(
    path: Path, late: None, caplog: pytest.LogCaptureFixture
) -> None:
    change(path, "UPDATE scans SET descriptors = zeroblob(128 * 3000)")
    change(path, "UPDATE scans SET points = zeroblob(12 * 3000)")
    with Memory.open(path) as kept:
        index = Knowledge(kept, Learners(ObjectMemory)).objects._index
    with caplog.at_level(logging.ERROR):
        Background().begin(index._wanted)
        for thread in threading.enumerate():
            if thread.name == "kille-index":
                thread.join(20)
    assert isinstance(index._wanted[0].failure, GoneError)
    assert not caplog.records
