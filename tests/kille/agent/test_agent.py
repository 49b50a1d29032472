"""The robot as a whole: what it learns from what, and that a turn is all or nothing."""

from __future__ import annotations

import gc
import json
import math
import os
import re
import sqlite3
import subprocess
import sys
import weakref
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from kille import Agent, Memory
from kille.dialogue.meanings import predicate_name, record_type, word_of
from kille.memory import MemoryFileError, ObjectLesson
from kille.scene import Frame
from kille.sensors.sensor import At, SensorError
from kille.sensors.synthetic import Synthetic, open_synthetic
from ttr.errors import UpdateError

NOON = datetime(2026, 1, 31, 12, 0, tzinfo=UTC)

LESSON = (
    "@ show cup",
    "This is a cup.",
    "@ show book",
    "This is a book.",
    "What is this?",
    "That is correct.",
    "@ place cup right of book",
    "The cup is to the right of the book.",
    "Where is the cup?",
    "Is it?",
)


def awake(
    name: str = "synthetic:empty?seed=3", memory: Path | None = None, scans: int = 1
) -> Agent:
    """A robot that glances, so that tests are quick, and whose clock stands still."""
    return Agent(name, memory, scans=scans, now=lambda: NOON)


def tell(robot: Agent, *lines: str) -> list[str]:
    """The robot's answers to what is said, and done (@)."""
    return [
        robot.do(line[1:]) if line.startswith("@") else robot.hear(line)
        for line in lines
    ]


def degrees(robot: Agent) -> dict[str, dict[str, float]]:
    """What the learners make of each thing in the latest view."""
    assert robot.view is not None
    return {
        str(number): robot._knowledge.objects.predict_proba_one(percept)
        for number, percept in enumerate(robot.view.look.percepts, start=1)
    }


# --- nothing is learned without the tutor's word about that very observation ---------


def test_what_is_cut_off_is_found_by_its_words() -> None:
    with Agent("synthetic:empty", scans=1) as robot:
        robot.hear("Hello. Thank you. What is this?")
        robot.interrupt("Hello. You  are")
        [cut] = robot.state.shared.cut
        assert (len(cut.moves), cut.uttered) == (2, "You are")
        before = robot.state
        robot.interrupt("")
        assert robot.state == before
        assert robot.hear("Go on.").startswith("You are welcome.\n")
        with pytest.raises(UpdateError, match="does not begin the latest answer"):
            robot.interrupt("Hello.")
        robot.interrupt(robot.exchanges[-1].answer)
        assert robot.state.shared.cut == ()


def test_a_lesson_keeps_the_turn_and_the_frame_it_comes_from() -> None:
    with awake() as robot:
        tell(robot, "@ show cup", "Hello.", "This is a cup.")
        assert robot.view is not None
        (lesson,) = robot.memory.objects()
        assert lesson.turn.text == "This is a cup."
        assert lesson.turn.speaker == "tutor"
        assert "instruct(" in lesson.turn.judgement
        assert lesson.turn in robot.memory.turns()
        assert lesson.seen.time == robot.view.look.frame.time
        assert lesson.seen.sensor == "synthetic:empty?seed=3"
        assert lesson.seen.place == robot.view.look.percepts[0].region.place


def test_looking_asking_and_rejecting_teach_nothing() -> None:
    with awake() as robot:
        tell(robot, "@ show cup", "This is a cup.")
        taught = robot.memory.lessons()
        tell(
            robot,
            "@ show book",
            "What is this?",
            "Where is the cup?",
            "@ place cup left of book",
            "No.",
            "That is wrong.",
            "Hello.",
            "What is it?",
            "Goodbye.",
        )
        assert robot.memory.lessons() == taught


@pytest.mark.parametrize("looks", [0, 1, 12])
def test_what_is_confirmed_is_the_look_that_was_asked_about(looks: int) -> None:
    with awake() as robot:
        tell(robot, "@ show cup", "This is a cup.", "@ show cup", "What is this?")
        assert robot.view is not None
        asked_about = robot.view.look.frame.time
        tell(robot, *["@ show book"] * looks)
        assert robot.hear("That is correct.") == "OK, I learned a cup."
        *_, lesson = robot.memory.objects()
        assert lesson.seen.time == asked_about
        assert lesson.turn.text == "This is a cup."


def test_every_turn_is_kept_with_its_judgement() -> None:
    with awake() as robot:
        tell(robot, "@ show cup", "This is a cup.", "Blah.", "What is this?")
        turns = robot.memory.turns()
    assert [(turn.speaker, turn.text) for turn in turns] == [
        ("tutor", "This is a cup."),
        ("robot", "OK, I learned a cup."),
        ("tutor", "Blah."),
        ("robot", robot.exchanges[2].answer),
        ("tutor", "What is this?"),
        ("robot", "This is a cup."),
    ]
    assert [turn.number for turn in turns] == [1, 2, 3, 4, 5, 6]
    judged = [turn.judgement for turn in turns]
    assert "learned(" in judged[1]
    assert judged[2] == judged[3] == ""
    assert "cup(target.x, look)" in judged[5]
    assert {turn.time for turn in turns} == {NOON.isoformat(timespec="milliseconds")}


# --- restarting ----------------------------------------------------------------------


def test_after_a_restart_it_knows_what_it_knew(tmp_path: Path) -> None:
    questions = ("@ show cup", "What is this?", "@ place book left of cup")
    with awake(memory=tmp_path / "m.db") as robot:
        tell(robot, *LESSON)
        known = robot.state.private.nouns, robot.state.private.relations
        tell(robot, "@ restart")
        assert (robot.state.private.nouns, robot.state.private.relations) == known
        assert robot.state.shared.commitments == ()
        awake_still = tell(robot, *questions), degrees(robot)
    with awake(memory=tmp_path / "m.db") as robot:
        assert (robot.state.private.nouns, robot.state.private.relations) == known
        # The world goes through the same changes, so that what is shown is the same.
        tell(robot, *(line for line in LESSON if line.startswith("@")))
        answers = tell(robot, *questions)
        assert answers == awake_still[0]
        assert degrees(robot).keys() == awake_still[1].keys()


# --- the same lesson, the same robot -------------------------------------------------

RUN = f"""
from datetime import UTC, datetime
from kille import Agent

noon = datetime(2026, 1, 31, 12, 0, tzinfo=UTC)
with Agent("synthetic:empty?seed=3", scans=1, now=lambda: noon) as robot:
    for line in {LESSON!r}:
        robot.do(line[1:]) if line.startswith("@") else robot.hear(line)
    for turn in robot.exchanges:
        print(turn.text, turn.answer, turn.heard, *turn.steps, sep="\\n")
    print(robot.state, *robot.memory.turns(), sep="\\n")
"""


def run_with_hash_seed(seed: int) -> str:
    done = subprocess.run(
        [sys.executable, "-c", RUN],
        env=os.environ | {"PYTHONHASHSEED": str(seed)},
        capture_output=True,
        text=True,
        check=True,
    )
    return done.stdout


def test_identical_lessons_give_identical_robots_in_any_process() -> None:
    first = run_with_hash_seed(1)
    assert "OK, I learned a cup." in first
    assert 'OK, this relation is called "to the right of".' in first
    assert run_with_hash_seed(2) == first


def test_identical_lessons_give_identical_robots_in_one_process() -> None:
    with awake() as one, awake() as other:
        assert tell(one, *LESSON) == tell(other, *LESSON)
        assert str(one.state) == str(other.state)
        assert list(map(str, one.trace)) == list(map(str, other.trace))
        assert degrees(one) == degrees(other)


# --- any words -----------------------------------------------------------------------

WORDS = st.sampled_from(
    re.split(
        r"\s+",
        """this that it is a an the what where cup book to left of not no yes right
        correct called do you know # #1 #99 and ok 's n't ? . - _ é 字 ² list Type
        fun x:T [] =""",
    )
)


@given(st.text(max_size=80) | st.lists(WORDS, max_size=12).map(" ".join))
@example("")
@example("This is a noun.")
@example("This is a ².")
@example("This is a lambda.")
@example("\ud800")
@example("\x00\x1b[31m")
@example("the cup " * 20_000)
@example("#" + "9" * 5000 + " This is a cup.")
def test_any_text_gets_an_answer_and_a_state_of_its_type(text: str) -> None:
    with awake("synthetic:empty") as robot:
        try:
            assert robot.hear(text) or not text.strip()
        except SensorError as error:
            told = str(error)
            pointless = "#" in text and "nothing is in view" in told
            if not pointless:
                raise
        assert robot.model.judge(robot.state, record_type("State")).holds


WORD = st.text(st.characters(categories=["L", "N"]), min_size=1, max_size=12)


@pytest.mark.slow
@given(word=WORD)
@example("noun")
@example("learned")
@example("None")
@example("list")
@example("²")
@example("o1")
def test_any_word_that_is_parsed_can_be_learned(word: str) -> None:
    with awake() as robot:
        robot.do("show cup")
        answer = robot.hear(f"This is a {word}.")
        if answer.startswith("Is "):  # a kind of thing
            answer = robot.hear("Yes.")
        assert robot.model.judge(robot.state, record_type("State")).holds
        if robot.exchanges[-1].heard is not None:
            known = {word_of(sign).name for sign in robot.state.private.nouns}
            if answer.startswith("I take that as a remark"):
                assert not known
            else:
                assert answer.startswith("OK, I learned a")
                assert predicate_name(word) in known


def test_what_is_not_understood_changes_nothing() -> None:
    with awake() as robot:
        tell(robot, "@ show cup", "This is a cup.", "What is this?")
        before = robot.state, robot.memory.lessons(), degrees(robot)
        (answer,) = tell(robot, "Colourless green ideas sleep furiously.")
        assert answer.startswith('Sorry, I did not understand "Colourless green ideas')
        assert "\n" not in answer
        assert robot.state is before[0]
        assert (robot.memory.lessons(), degrees(robot)) == before[1:]
        # What was asked before can still be confirmed.
        assert robot.hear("Yes.") == "OK, I learned a cup."


def test_no_region_in_view() -> None:
    with awake("synthetic:empty") as robot:
        assert set(tell(robot, "This is a cup.", "What is this?")) == {
            "I see nothing on the table."
        }
        assert robot.memory.lessons() == ()
        with pytest.raises(SensorError, match="nothing is in view"):
            robot.hear("#1 This is a cup.")


# --- pointing ------------------------------------------------------------------------


def shown_apart(robot: Agent) -> None:
    tell(robot, "@ show car", "@ place book at -0.25 0.1", "@ place cup at 0.22 -0.05")


def test_a_number_points_at_the_thing_that_has_it_in_view() -> None:
    with awake(scans=5) as robot:
        shown_apart(robot)
        assert robot.view is not None
        places = [it.region.place for it in robot.view.look.percepts if it.region.place]
        assert len(places) == 3
        for number, place in enumerate(places, start=1):
            robot.hear(f"#{number} This is a thing{number}.")
            *_, lesson = robot.memory.objects()
            assert lesson.seen.place is not None
            assert math.dist(lesson.seen.place, place) < 0.01


def test_a_pixel_and_an_outline_point_too() -> None:
    with awake(scans=5) as robot:
        shown_apart(robot)
        assert robot.view is not None
        outlines = robot.view.look.frame.outlines
        for name in ("book", "cup"):
            rows, columns = np.nonzero(outlines[name])
            robot.do(f"point {int(np.median(columns))} {int(np.median(rows))}")
            robot.look()
            by_pixel = robot.view.focus
            robot.do(f"point {name}")
            robot.look()
            assert robot.view is not None
            assert robot.view.focus == by_pixel


@pytest.mark.parametrize(
    "target", ["9", "0", "", "5 5", "9999 9999", "unicorn", "1 2 3"]
)
def test_pointing_at_nothing_says_so_and_points_as_before(target: str) -> None:
    with awake(scans=5) as robot:
        shown_apart(robot)
        tell(robot, "@ point 2", "@ look")
        assert robot.view is not None
        assert robot.view.focus == 2
        with pytest.raises(SensorError) as caught:
            robot.do(f"point {target}")
        assert "\n" not in str(caught.value)
        robot.look()
        assert robot.view.focus == 2


# --- a turn is all or nothing --------------------------------------------------------


class Faulty(Synthetic):
    """The synthetic Kinect, whose cable can be pulled out."""

    pulled: BaseException | None = None

    def frame(self) -> Frame:
        if self.pulled is not None:
            raise self.pulled
        return super().frame()


@pytest.mark.parametrize(
    "failure", [SensorError("the cable is out"), KeyboardInterrupt()]
)
@pytest.mark.parametrize("line", ["This is a book.", "#2 This is a book.", "@ look"])
def test_a_sensor_that_fails_leaves_all_as_it_was(
    failure: BaseException, line: str
) -> None:
    sensor = Faulty(open_synthetic("synthetic:empty?seed=3")._address)
    with Agent(sensor, scans=1) as robot:
        shown_apart(robot)
        tell(robot, "#3 This is a cup.")
        before = robot.state, robot.model, robot.memory.turns(), degrees(robot)
        focus = robot.view and robot.view.focus
        sensor.pulled = failure
        with pytest.raises(type(failure)):
            tell(robot, line)
        sensor.pulled = None
        assert (robot.state, robot.model) == before[:2]
        assert robot.memory.turns() == before[2]
        assert degrees(robot) == before[3]
        assert robot.view is not None
        assert robot.view.focus == focus
        # It is still #3 that is pointed at, among several things.
        said = robot.hear("This is a cup.")
        assert said == "OK, the one on the left (#3) is a cup."


def recorded(folder: Path, scenes: int) -> Path:
    """A recording of a cup, as files."""
    sensor = open_synthetic("synthetic:empty?seed=3&faults=none")
    sensor.show("cup")
    frame = sensor.frame()
    assert frame.depth is not None
    assert frame.intrinsics is not None
    numbers = frame.intrinsics
    for number in range(scenes):
        stem = folder / f"{number:06}"
        cv2.imwrite(f"{stem}_color.png", frame.colour[..., ::-1].copy())
        depth = np.nan_to_num(frame.depth * 1000).astype(np.uint16)
        cv2.imwrite(f"{stem}_depth.png", depth)
    description = {
        "intrinsics": vars(numbers),
        "depth_units_per_metre": 1000,
        "frames": {f"{number:06}": [] for number in range(scenes)},
    }
    (folder / "scene.json").write_text(json.dumps(description))
    return folder


def test_a_picture_that_goes_away_in_mid_dialogue(tmp_path: Path) -> None:
    folder = recorded(tmp_path, 3)
    with Agent(str(folder), scans=1) as robot:
        assert robot.hear("This is a cup.") == "OK, I learned a cup."
        before = robot.state
        (folder / "000001_depth.png").write_bytes(b"no picture")
        with pytest.raises(SensorError, match=r"000001_depth.png.*does not open"):
            robot.hear("This is a mug.")
        assert robot.state is before
        assert len(robot.memory.lessons()) == 1


def lessons_of(robot: Agent) -> list[ObjectLesson]:
    return list(robot.memory.objects())


def limited(memory: Memory, pages: int) -> None:
    """Leave the file so many pages to grow by, as a disk does that is nearly full."""
    count = memory._connection.execute("PRAGMA page_count").fetchone()[0]
    memory._connection.execute(f"PRAGMA max_page_count = {count + pages}")


def freed(memory: Memory) -> None:
    memory._connection.execute("PRAGMA max_page_count = 1000000")


@contextmanager
def failing(memory: Memory, when: str) -> Iterator[None]:
    """Have SQLite refuse some rows, each as if that were the one that did not fit."""
    # The memory holds a transaction open; a trigger made in it would go with it.
    connection = memory._connection
    connection.execute("COMMIT")
    connection.execute(
        f"CREATE TEMP TRIGGER refused BEFORE INSERT ON {when} "
        "BEGIN SELECT RAISE(FAIL, 'disk full'); END"
    )
    connection.execute("BEGIN IMMEDIATE")
    try:
        with pytest.raises(sqlite3.Error, match="disk full"):
            yield
    finally:
        connection.execute("COMMIT")
        connection.execute("DROP TRIGGER refused")
        connection.execute("BEGIN IMMEDIATE")


@pytest.mark.parametrize("pages", [0, 1, 2, 3, 4])
def test_a_full_disk_in_mid_lesson_leaves_all_as_it_was(
    tmp_path: Path, pages: int
) -> None:
    with awake(memory=tmp_path / "m.db") as robot:
        tell(robot, "@ show cup", "This is a cup.", "@ show book")
        before = robot.state, robot.model, robot.memory.turns(), degrees(robot)
        taught = [lesson.key for lesson in lessons_of(robot)]
        limited(robot.memory, pages)
        with pytest.raises(MemoryFileError, match="disk is full") as caught:
            robot.hear("This is a book. ")
        assert "\n" not in str(caught.value)
        assert (robot.state, robot.model) == before[:2]
        assert robot.memory.turns() == before[2]
        assert degrees(robot) == before[3]
        assert [lesson.key for lesson in lessons_of(robot)] == taught
        freed(robot.memory)
        assert robot.hear("What is this?") != "This is a book."
        assert robot.hear("This is a book.") == "OK, I learned a book."
        assert robot.hear("What is this?") == "This is a book."
    with Memory.open(tmp_path / "m.db") as memory:
        assert [word.surface for word in memory.words()] == ["cup", "book"]


def test_a_disk_too_full_for_the_answer_keeps_no_lesson_either(tmp_path: Path) -> None:
    """The lesson fits, what the robot says does not: then it was not taught."""
    with awake(memory=tmp_path / "m.db") as robot:
        robot.do("show cup")
        before = robot.state, degrees(robot)
        with failing(robot.memory, "turns WHEN NEW.speaker = 'robot'"):
            robot.hear("This is a cup.")
        assert lessons_of(robot) == []
        assert robot.memory.turns() == ()
        assert (robot.state, degrees(robot)) == before
        assert robot.hear("This is a cup.") == "OK, I learned a cup."


def test_a_failed_restart_leaves_the_dialogue_as_it_was(tmp_path: Path) -> None:
    with awake(memory=tmp_path / "m.db") as robot:
        tell(robot, "@ show cup", "This is a cup.", "What is this?")
        before = robot.state
        with failing(robot.memory, "dialogues"):
            robot.do("restart")
        assert robot.state is before
        assert robot.hear("Yes.") == "OK, I learned a cup."


def test_looks_that_are_over_are_let_go_at_once() -> None:
    """A long talk does not fill the memory of the machine with frames."""
    frames = []
    gc.collect()
    gc.disable()
    try:
        with awake() as robot:
            robot.do("show cup")
            for _ in range(12):
                tell(robot, "This is a cup.", "What is this?")
                assert robot.view is not None
                frames.append(weakref.ref(robot.view.look.frame))
            alive = sum(frame() is not None for frame in frames)
    finally:
        gc.enable()
    assert alive <= 4


# --- letting go ----------------------------------------------------------------------


def test_a_robot_that_cannot_wake_holds_no_memory(tmp_path: Path) -> None:
    in_use = pytest.raises(MemoryFileError, match="in use")
    with Memory.open(tmp_path / "m.db"), in_use:
        awake(memory=tmp_path / "m.db")
    with pytest.raises(SensorError):
        awake("synthetic:attic", memory=tmp_path / "m.db")
    with awake(memory=tmp_path / "m.db") as robot:
        assert robot.hear("Hello.") == "Hello."


@pytest.mark.parametrize(
    "command",
    [
        "fly",
        "show",
        "show unicorn",
        "place book",
        "remove cup",
        "scene",
        "scene nowhere",
    ],
)
def test_a_command_that_cannot_be_done_changes_nothing(command: str) -> None:
    with awake() as robot:
        tell(robot, "@ show book", "This is a book.")
        before = robot.state
        with pytest.raises(SensorError) as caught:
            robot.do(command)
        assert "\n" not in str(caught.value)
        assert robot.state is before
        assert robot.hear("What is this?") == "This is a book."


def test_the_rules_that_ran_are_in_the_trace() -> None:
    with awake() as robot:
        tell(robot, "@ show cup", "This is a cup.")
        names = [step.rule.name for step in robot.trace]
        assert names[-2:] == ["say", "keep"]
        assert "learn_word" in names
        assert robot.trace[-1].after == robot.state
        heard = robot.exchanges[-1].heard
        assert heard is not None
        assert heard.type <= record_type("Instruct")


@pytest.mark.parametrize(
    ("texts", "told"),
    [
        ((), "nothing was perhaps said: give texts and probabilities"),
        ((("This is a cup.", 0.0),), "'This is a cup.' has 0.0"),
        ((("This is a cup.", math.nan),), "'This is a cup.' has nan"),
        ((("This is a cup.", 0.7), ("This is a cap.", 0.6)), "at most 1, found 1.3"),
    ],
)
def test_what_was_perhaps_said_is_probable(
    texts: tuple[tuple[str, float], ...], told: str
) -> None:
    with awake() as robot:
        state = robot.state
        with pytest.raises(UpdateError) as wrong:
            robot.hear_perhaps(*texts)
        assert str(wrong.value).endswith(told)
        assert robot.state is state


# --- pictures ------------------------------------------------------------------------


def test_things_in_view_have_the_names_that_it_would_call_them() -> None:
    with awake() as robot:
        tell(robot, "@place cup at -0.15 0", "@place book at 0.15 0.1")
        assert robot.names_in_view() == ("", "")
        tell(robot, "@point 1", "This is a cup.")
        robot.do("glimpse")
        assert robot.names_in_view()[0] == "cup"
        tell(robot, "@remove cup", "@place car at 0.1 -0.1")
        robot.do("glimpse")
        assert robot.names_in_view() == ("cup?", "")
        assert robot.hear("What is #1?").startswith("The object is thought to be a cup")
        assert robot.hear("What is #2?").startswith("I do not know what this is.")


def test_beliefs_about_things_in_view_have_the_name_first_and_its_rivals() -> None:
    with awake() as robot:
        tell(robot, "@place cup at -0.15 0", "@place book at 0.15 0.1")
        assert [len(it) for it in robot.beliefs_in_view()] == [0, 0]
        tell(robot, "#1 This is a cup.", "#2 This is a book.", "@glimpse")
        named = [[it.sign.form for it in one] for one in robot.beliefs_in_view()]
        assert named == [["cup"], ["book"]]  # called so, while they are in view
        tell(robot, "@show book", "@glimpse")
        [one] = robot.beliefs_in_view()
        assert [it.sign.form for it in one] == ["book", "cup"]
        assert one[0].p > one[1].p


def test_a_thing_that_has_come_since_the_latest_turn_has_no_name() -> None:
    with awake() as robot:
        tell(robot, "@show cup", "This is a cup.")
        assert robot.names_in_view() == ("cup",)
        assert isinstance(robot.gaze.sensor, Synthetic)
        robot.gaze.sensor.remove("cup")
        robot.gaze.sensor.place("book", At(0.2, 0.1))
        robot.do("glimpse")
        assert robot.names_in_view() == ("",)


def test_a_reason_can_be_shown() -> None:
    with awake() as robot:
        tell(robot, "@show cup", "This is a cup.", "What is this?")
        assert robot.reason_picture() is None
        robot.hear("Why?")
        picture = robot.reason_picture()
        assert picture is not None
        assert picture.pixels.shape[1] > 700
        robot.hear("Forget that.")
        kept = robot.reason_picture()
        assert kept is not None, "what was seen is there, if not what was taught"
        assert kept.pixels.shape == picture.pixels.shape
        assert not np.array_equal(kept.pixels, picture.pixels)


def test_how_things_stand_can_be_shown_as_a_reason() -> None:
    with awake() as robot:
        tell(robot, "@place cup at -0.15 0", "@place book at 0.15 0.1", "@point 1")
        tell(robot, "This is a cup.", "@point 2", "This is a book.")
        told = tell(robot, "The cup is to the left of the book.", "Where is the cup?")
        assert told[-1] == "The cup is to the left of the book."
        assert "stand as they did" in robot.hear("Why?")
        assert robot.reason_picture() is not None


def test_a_robot_that_nobody_has_any_more_is_let_go_at_once() -> None:
    """It refers to itself nowhere, so that its looks do not wait to be collected."""
    robot = awake()
    tell(robot, "@show cup", "This is a cup.", "What is this?", "Why?")
    robot.close()
    gc.collect()
    gone = weakref.ref(robot)
    gc.disable()
    try:
        del robot
        assert gone() is None
    finally:
        gc.enable()
