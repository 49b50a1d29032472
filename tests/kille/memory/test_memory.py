"""A memory gives back what it was given, and nothing else: against a plain list."""

from __future__ import annotations

import sqlite3
import tempfile
from collections.abc import Callable
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, precondition, rule

from kille.memory import (
    Arrangement,
    Memory,
    NoSuchLessonError,
    Sighting,
    Turn,
    Word,
    reading,
)
from kille.scene import Configuration

from .conftest import ARRANGEMENTS, NAMES, SIGHTINGS, SURFACES, plain

ARTICLES = st.sampled_from(["", "a", "ett"])
HOLDS = st.booleans()


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
        self.attributes: dict[int, tuple[Word, Turn, Sighting]] = {}
        self.holding: dict[int, bool] = {}
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

    @rule(name=NAMES, surface=SURFACES, seen=SIGHTINGS, article=ARTICLES, holds=HOLDS)
    def learn_object(
        self, name: str, surface: str, seen: Sighting, article: str, holds: bool
    ) -> None:
        turn = self.say("This is it.")
        key = self.memory.learn_object(
            turn, name, surface, seen, article=article, holds=holds
        )
        self.keep_new(key)
        self.objects[key] = Word(name, surface, "object", article), turn, seen
        self.holding[key] = holds

    @rule(name=NAMES, surface=SURFACES, seen=SIGHTINGS, holds=HOLDS)
    def learn_attribute(
        self, name: str, surface: str, seen: Sighting, holds: bool
    ) -> None:
        turn = self.say("This is so.")
        key = self.memory.learn_attribute(turn, name, surface, seen, holds=holds)
        self.keep_new(key)
        self.attributes[key] = Word(name, surface, "attribute"), turn, seen
        self.holding[key] = holds

    @rule(name=NAMES, surface=SURFACES, seen=ARRANGEMENTS, holds=HOLDS)
    def learn_relation(
        self, name: str, surface: str, seen: Arrangement, holds: bool
    ) -> None:
        turn = self.say("It is there.")
        key = self.memory.learn_relation(turn, name, surface, seen, holds=holds)
        self.keep_new(key)
        self.relations[key] = Word(name, surface, "relation"), turn, seen
        self.holding[key] = holds

    @property
    def taught(self) -> dict[int, tuple[Word, Turn, Sighting | Arrangement]]:
        every = {**self.objects, **self.attributes, **self.relations}
        return dict(sorted(every.items()))

    def drop(self, key: int) -> None:
        for lessons in (self.objects, self.attributes, self.relations):
            lessons.pop(key, None)

    @precondition(lambda self: self.taught)
    @rule(choice=st.data())
    def forget_word(self, choice: st.DataObject) -> None:
        word, *_ = choice.draw(st.sampled_from(list(self.taught.values())))
        own = [
            key
            for key, (it, *_) in self.taught.items()
            if (it.kind, it.name) == (word.kind, word.name)
        ]
        assert self.memory.keys_of(word.kind, word.name) == tuple(own)
        assert self.memory.forget_word(word.kind, word.name) == tuple(own)
        for key in own:
            self.drop(key)
        with pytest.raises(NoSuchLessonError):
            self.memory.forget_word(word.kind, word.name)

    @precondition(lambda self: self.taught)
    @rule(choice=st.data())
    def forget(self, choice: st.DataObject) -> None:
        key = choice.draw(st.sampled_from(list(self.taught)))
        self.memory.forget(key)
        self.drop(key)
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
            lesson.key: (lesson.word, lesson.turn, plain(lesson.seen))
            for lesson in self.memory.attributes()
        } == {key: (w, t, plain(s)) for key, (w, t, s) in self.attributes.items()}
        assert {
            lesson.key: (lesson.word, lesson.turn, lesson.seen)
            for lesson in self.memory.relations()
        } == {
            key: (word, turn, replace(seen, picture=None))
            for key, (word, turn, seen) in self.relations.items()
        }

    @invariant()
    def it_shows_what_was_seen(self) -> None:
        for key, (word, turn, seen) in self.taught.items():
            lesson = self.memory.lesson(key)
            assert (lesson.word, lesson.turn) == (word, turn)
            assert (
                lesson.holds
                == self.memory.lesson_without_sight(key).holds
                == self.holding[key]
            )
            assert lesson.seen.picture == self.memory.picture(key) == seen.picture

    @invariant()
    def its_words_are_those_of_its_lessons(self) -> None:
        taught = list(self.taught.items())
        first: dict[tuple[str, str], Word] = {}
        articles: dict[tuple[str, str], str] = {}
        for key, (word, *_) in taught:
            if word.article:
                articles.setdefault((word.kind, word.name), word.article)
            if self.holding[key]:
                first.setdefault((word.kind, word.name), word)
        assert self.memory.words() == tuple(
            replace(word, article=articles.get(named, ""))
            for named, word in first.items()
        )
        lessons = [(x.key, x.word, x.turn) for x in self.memory.lessons()]
        assert lessons == [(key, word, turn) for key, (word, turn, _) in taught]
        newest = [it.key for it in self.memory.latest(2)]
        assert newest == [key for key, *_ in lessons][-2:]


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


def test_what_was_said_may_be_understood_later(said: Callable[[int], Turn]) -> None:
    heard = replace(said(1), judgement="")
    with Memory.transient() as memory:
        memory.begin_dialogue("now")
        assert memory.record_turn(heard) == memory.record_turn(said(1))
        assert memory.turns() == (said(1),)
        for other in (heard, replace(said(1), judgement="s : Greeting")):
            with pytest.raises(ValueError, match="on record"):
                memory.record_turn(other)


def test_a_lesson_that_fails_half_way_leaves_nothing(
    path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    with Memory.open(path) as memory:
        memory.begin_dialogue("now")
        halved = replace(seen, sensor="a surrogate: \udcff")
        with pytest.raises(UnicodeEncodeError):
            memory.learn_object(said(1), "cup", "cup", halved)
        memory.begin_dialogue("later")
        assert (memory.turns(), memory.words()) == ((), ())


def test_where_a_thing_without_a_name_was_is_kept(
    path: Path, said: Callable[[int], Turn]
) -> None:
    nameless = Arrangement("synthetic", 0.0, "", "car", Configuration((0.1, 0.0, 0.0)))
    with Memory.open(path) as memory:
        memory.begin_dialogue("now")
        memory.learn_relation(said(1), "left", "left of", nameless)
    with Memory.open(path) as memory:
        (kept,) = memory.relations()
        assert kept.seen == nameless


def test_nothing_is_left_of_what_is_forgotten(
    path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    stand = Configuration((-0.2, 0.0, 0.1))
    there = Arrangement("synthetic", 0.0, "book", "car", stand, seen.picture)
    with Memory.open(path) as memory:
        memory.begin_dialogue("now")
        memory.forget(memory.learn_object(said(1), "cup", "cup", seen))
        memory.forget(memory.learn_relation(said(2), "left", "left of", there))
    with closing(sqlite3.connect(path)) as connection:
        kept = {
            name
            for (name,) in connection.execute(
                "SELECT name FROM sqlite_schema WHERE type = 'table'"
            )
            if connection.execute(f"SELECT * FROM {name}").fetchall()
        }
    assert kept == {"dialogues", "turns", "sqlite_sequence"}
    content = path.read_bytes()
    assert seen.scans[0].descriptors[3].tobytes() not in content
    assert seen.traits["colour"].tobytes() not in content
    assert b"colour" not in content.replace(b"colour BLOB", b"")


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
    path: Path,
    said: Callable[[int], Turn],
    seen: Sighting,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(reading, "BATCH", 1)
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


def test_a_reader_sees_no_half_of_what_another_does_meanwhile(
    path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    with Memory.open(path) as memory, Memory.open_to_read(path) as reader:
        memory.begin_dialogue("now")
        key = memory.learn_object(said(1), "cup", "cup", seen)
        with reader.at_one_moment() as then:
            (listed,) = then.lessons()
            memory.forget(key)
            assert memory.lessons() == ()
            assert plain(then.lesson(listed.key).seen) == plain(seen)
        assert reader.lessons() == ()


def test_two_words_for_one_thing_and_one_word_for_two(
    said: Callable[[int], Turn], seen: Sighting
) -> None:
    other = replace(seen, traits={}, place=None, picture=None)
    with Memory.transient() as memory:
        memory.begin_dialogue("now")
        taught = [("cup", seen), ("mug", seen), ("cup", other)]
        for number, (word, sighting) in enumerate(taught):
            memory.learn_object(said(number), word, word, sighting)
        assert [word.name for word in memory.words()] == ["cup", "mug"]
        lessons = [(it.word.name, plain(it.seen)) for it in memory.objects()]
        assert lessons == [(word, plain(sighting)) for word, sighting in taught]


def test_a_lesson_that_is_not_there_has_neither_content_nor_picture() -> None:
    with Memory.transient() as memory:
        assert memory.picture(3) is None
        for question in (memory.lesson, memory.lesson_without_sight):
            with pytest.raises(NoSuchLessonError, match="no lesson 3"):
                question(3)


def test_points_without_depth_are_learned(
    said: Callable[[int], Turn], seen: Sighting
) -> None:
    points = seen.scans[0].points.copy()
    points[3] = np.nan
    seen = replace(seen, scans=(replace(seen.scans[0], points=points),))
    with Memory.transient() as memory:
        memory.begin_dialogue("now")
        memory.learn_object(said(1), "cup", "cup", seen)
        (kept,) = memory.objects()
        assert plain(kept.seen) == plain(seen)


def test_an_article_is_that_of_the_word_of_this_kind(
    said: Callable[[int], Turn], seen: Sighting
) -> None:
    """An orange is orange; no adjective has an article because a noun has one."""
    with Memory.transient() as memory:
        memory.begin_dialogue("now")
        memory.learn_attribute(said(1), "orange", "orange", seen)
        memory.learn_object(said(2), "orange", "orange", seen, article="an")
        memory.learn_object(said(3), "cup", "cup", seen)
        assert memory.words() == (
            Word("orange", "orange", "attribute"),
            Word("orange", "orange", "object", "an"),
            Word("cup", "cup", "object"),
        )


def test_a_lesson_holds_unless_it_is_said_not_to(
    said: Callable[[int], Turn], seen: Sighting
) -> None:
    there = Arrangement("synthetic", 0.0, "", "car", Configuration((0.1, 0.0, 0.0)))
    with Memory.transient() as memory:
        memory.begin_dialogue("now")
        memory.learn_object(said(1), "cup", "cup", seen)
        memory.learn_attribute(said(2), "red", "red", seen)
        memory.learn_relation(said(3), "left", "left of", there)
        assert [it.holds for it in memory.lessons()] == [True] * 3


def test_the_lessons_in_which_a_word_holds_are_counted(
    said: Callable[[int], Turn], seen: Sighting
) -> None:
    with Memory.transient() as memory:
        memory.begin_dialogue("now")
        for number, holds in enumerate((True, False, True)):
            memory.learn_object(said(number), "cup", "cup", seen, holds=holds)
        memory.learn_attribute(said(3), "cup", "cup", seen)
        memory.learn_object(said(4), "mug", "mug", seen, holds=False)
        assert memory.counts() == {("object", "cup"): 2, ("attribute", "cup"): 1}


# --- all or nothing ------------------------------------------------------------------


def test_what_is_kept_together_is_on_disk_at_the_end_alone(
    path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    with Memory.open(path) as memory, Memory.open_to_read(path) as reader:
        memory.begin_dialogue("now")
        with memory.together():
            memory.learn_object(said(1), "cup", "cup", seen)
            with memory.together():
                memory.learn_object(said(2), "mug", "mug", seen)
            assert len(memory.lessons()) == 2
            assert reader.lessons() == ()
        assert [it.word.name for it in reader.lessons()] == ["cup", "mug"]
        memory.learn_object(said(3), "jug", "jug", seen)
        assert len(reader.lessons()) == 3


def learn_and_fail(memory: Memory, turn: Turn, seen: Sighting) -> None:
    """Have something fail after a lesson and a dialogue that belong with it."""
    with memory.together():
        memory.learn_object(turn, "mug", "mug", seen)
        memory.begin_dialogue("later")
        raise ZeroDivisionError


def test_what_fails_together_never_happened(
    path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    with Memory.open(path) as memory:
        memory.begin_dialogue("now")
        with pytest.raises(ZeroDivisionError):
            learn_and_fail(memory, said(1), seen)
        assert (memory.lessons(), memory.turns()) == ((), ())
        assert len(memory.dialogues()) == 1
        memory.learn_object(said(2), "cup", "cup", seen)
    with Memory.open_to_read(path) as reader:
        assert [it.word.name for it in reader.lessons()] == ["cup"]


def test_a_part_that_fails_is_undone_and_the_rest_is_kept(
    path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    with Memory.open(path) as memory:
        memory.begin_dialogue("now")
        with memory.together():
            memory.learn_object(said(1), "cup", "cup", seen)
            with pytest.raises(ZeroDivisionError):
                learn_and_fail(memory, said(2), seen)
            with pytest.raises(NoSuchLessonError):
                memory.forget(9)
            memory.learn_object(said(3), "jug", "jug", seen)
    with Memory.open_to_read(path) as reader:
        assert [it.word.name for it in reader.lessons()] == ["cup", "jug"]
