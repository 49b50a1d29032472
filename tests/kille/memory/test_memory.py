"""A memory gives back what it was given, and nothing else: against a plain list."""

from __future__ import annotations

import sqlite3
import tempfile
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import hypothesis.extra.numpy as arrays
import numpy as np
import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, precondition, rule

from kille.memory import (
    Arrangement,
    Memory,
    NoSuchLessonError,
    Scan,
    Sighting,
    Turn,
    Word,
)
from kille.scene import Point

NAMES = st.sampled_from(["cup", "can_of_paint", "left", "boîte"])
NUMBERS = st.floats(allow_nan=False, allow_infinity=False)
PLACES = st.builds(Point, NUMBERS, NUMBERS, NUMBERS)
ARRANGEMENTS = st.builds(Arrangement, st.text(), NUMBERS, NAMES, NAMES, PLACES)


@st.composite
def scans(draw: st.DrawFn) -> Scan:
    n = draw(st.integers(0, 3))
    return Scan(
        draw(arrays.arrays(np.uint8, (n, 128), elements=st.integers(0, 255))),
        draw(arrays.arrays(np.float32, (n, 3), elements=st.floats(width=32))),
    )


SIGHTINGS = st.builds(
    Sighting,
    st.text(),
    NUMBERS,
    st.lists(scans(), max_size=3).map(tuple),
    st.none() | PLACES,
    st.none()
    | arrays.arrays(
        np.float32,
        st.integers(0, 5),
        elements=st.floats(allow_nan=False, allow_infinity=False, width=32),
    ),
    st.none() | st.tuples(NUMBERS, NUMBERS, NUMBERS),
)


def plain(seen: Sighting) -> tuple[object, ...]:
    """A sighting that can be compared; the bits of NaNs count too."""
    pairs = [(s.descriptors.tobytes(), s.points.tobytes()) for s in seen.scans]
    colour = None if seen.colour is None else seen.colour.tobytes()
    return seen.sensor, seen.time, pairs, seen.place, colour, seen.size


class Remembering(RuleBasedStateMachine):
    """A memory in a file, beside plain lists of what it should hold."""

    def __init__(self) -> None:
        super().__init__()
        self.folder = tempfile.TemporaryDirectory()
        self.path = Path(self.folder.name) / "memory.db"
        self.memory = Memory.open(self.path)
        self.dialogue = self.memory.begin_dialogue("now")
        self.turns: list[Turn] = []
        self.objects: dict[int, tuple[Word, Turn, Sighting]] = {}
        self.relations: dict[int, tuple[Word, Turn, Arrangement]] = {}
        self.keys: set[int] = set()

    def teardown(self) -> None:
        self.memory.close()
        self.folder.cleanup()

    def say(self, text: str) -> Turn:
        turn = Turn(self.dialogue, len(self.turns), "tutor", text, f"s : {text}", "now")
        self.turns.append(turn)
        return turn

    def keep_new(self, key: int) -> None:
        """No key is used twice, not even that of a forgotten lesson."""
        assert key not in self.keys
        self.keys.add(key)

    @rule(text=st.text())
    def record(self, text: str) -> None:
        turn = self.say(text)
        assert self.memory.record_turn(turn) == self.memory.record_turn(turn)

    @rule(name=NAMES, surface=st.text(), seen=SIGHTINGS)
    def learn_object(self, name: str, surface: str, seen: Sighting) -> None:
        turn = self.say("This is it.")
        key = self.memory.learn_object(turn, name, surface, seen)
        self.keep_new(key)
        self.objects[key] = Word(name, surface, "object"), turn, seen

    @rule(name=NAMES, surface=st.text(), seen=ARRANGEMENTS)
    def learn_relation(self, name: str, surface: str, seen: Arrangement) -> None:
        turn = self.say("It is there.")
        key = self.memory.learn_relation(turn, name, surface, seen)
        self.keep_new(key)
        self.relations[key] = Word(name, surface, "relation"), turn, seen

    @precondition(lambda self: self.objects or self.relations)
    @rule(choice=st.data())
    def forget(self, choice: st.DataObject) -> None:
        key = choice.draw(st.sampled_from(sorted(self.objects | self.relations)))
        self.memory.forget(key)
        self.objects.pop(key, None)
        self.relations.pop(key, None)
        with pytest.raises(NoSuchLessonError, match=f"no lesson {key}"):
            self.memory.forget(key)

    @rule()
    def reopen(self) -> None:
        self.memory.close()
        self.memory = Memory.open(self.path)

    @rule()
    def begin_another(self) -> None:
        began = self.memory.begin_dialogue("later")
        assert began > self.dialogue

    @invariant()
    def it_holds_what_it_was_given(self) -> None:
        assert list(self.memory.turns()) == self.turns
        assert {
            lesson.key: (lesson.word, lesson.turn, plain(lesson.seen))
            for lesson in self.memory.objects()
        } == {key: (w, t, plain(s)) for key, (w, t, s) in self.objects.items()}
        assert {
            lesson.key: (lesson.word, lesson.turn, lesson.seen)
            for lesson in self.memory.relations()
        } == self.relations

    @invariant()
    def its_words_are_those_of_its_lessons(self) -> None:
        taught = sorted((self.objects | self.relations).items())
        first: dict[tuple[str, str], Word] = {}
        for _, (word, *_) in taught:
            first.setdefault((word.kind, word.name), word)
        assert self.memory.words() == tuple(first.values())
        assert [(x.key, x.word, x.turn) for x in self.memory.lessons()] == [
            (key, word, turn) for key, (word, turn, _) in taught
        ]


TestRemembering = Remembering.TestCase
TestRemembering.settings = settings(stateful_step_count=15)


def test_a_transient_memory_remembers_until_it_is_closed(
    said: Callable[[int], Turn], seen: Sighting
) -> None:
    with Memory.transient() as memory:
        memory.begin_dialogue("now")
        memory.learn_object(said(1), "cup", "cup", seen)
        assert memory.words() == (Word("cup", "cup", "object"),)
    with Memory.transient() as memory:
        assert memory.words() == ()


def test_what_was_said_cannot_be_rewritten(
    said: Callable[[int], Turn], seen: Sighting
) -> None:
    with Memory.transient() as memory:
        memory.begin_dialogue("now")
        memory.record_turn(said(1))
        other = Turn(1, 1, "tutor", "This is a book.", "", "later")
        with pytest.raises(ValueError, match="on record"):
            memory.learn_object(other, "book", "book", seen)
        assert (memory.turns(), memory.words()) == ((said(1),), ())


def test_a_lesson_that_fails_half_way_leaves_nothing(
    path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    with Memory.open(path) as memory:
        memory.begin_dialogue("now")
        with pytest.raises(UnicodeEncodeError):
            memory.learn_object(said(1), "cup", "a surrogate: \udcff", seen)
        memory.begin_dialogue("later")
        assert (memory.turns(), memory.words()) == ((), ())


def test_nothing_is_left_of_what_is_forgotten(
    path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    there = Arrangement("synthetic", 0.0, "book", "car", Point(-0.2, 0.0, 0.1))
    with Memory.open(path) as memory:
        memory.begin_dialogue("now")
        memory.forget(memory.learn_object(said(1), "cup", "cup", seen))
        memory.forget(memory.learn_relation(said(2), "left", "left of", there))
    with closing(sqlite3.connect(path)) as connection:
        for table in ("lessons", "sightings", "scans", "arrangements"):
            assert connection.execute(f"SELECT * FROM {table}").fetchall() == []


def test_a_turn_belongs_to_a_dialogue(said: Callable[[int], Turn]) -> None:
    with (
        Memory.transient() as memory,
        pytest.raises(ValueError, match="dialogue 1 never began"),
    ):
        memory.record_turn(said(1))


def test_one_turn_may_teach_two_words(
    said: Callable[[int], Turn], seen: Sighting
) -> None:
    with Memory.transient() as memory:
        memory.begin_dialogue("now")
        memory.learn_object(said(1), "cup", "cup", seen)
        memory.learn_object(said(1), "mug", "mug", seen)
        assert memory.turns() == (said(1),)
        assert [lesson.turn for lesson in memory.lessons()] == [said(1), said(1)]


def test_lessons_may_be_forgotten_and_learned_while_they_are_read(
    path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    with Memory.open(path) as memory:
        memory.begin_dialogue("now")
        keys = [memory.learn_object(said(n), "cup", "cup", seen) for n in range(3)]
        lessons = memory.objects()
        assert next(lessons).key == keys[0]
        memory.forget(keys[1])
        memory.learn_object(said(3), "cup", "cup", seen)
        assert next(lessons).key == keys[2]
    with Memory.open(path) as memory:
        assert len(memory.lessons()) == 3
