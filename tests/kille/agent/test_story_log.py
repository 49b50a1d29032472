"""Logs of dialogues: every event has a time, and a replay by these is exact."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from contextlib import suppress
from datetime import UTC, datetime, timedelta
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from kille import Agent
from kille.agent.exchanges import Event
from kille.agent.story_log import StoryLog
from kille.agent.story_replay import play
from kille.memory import Memory
from kille.sensors.sensor import SensorError
from ttr import Record
from ttr.dialogues.stories import StoryError, read_stories

SENSOR = "synthetic:empty?seed=11"


class Clock:
    """A clock that goes on by microseconds whenever it is read, and when it is told."""

    def __init__(self) -> None:
        self.now = datetime(2026, 11, 21, 14, 5, 0, 123456, tzinfo=UTC)

    def __call__(self) -> datetime:
        self.now += timedelta(microseconds=777)
        return self.now


class Recorder:
    """Keeps the state after each event of a robot, and passes the event on."""

    def __init__(self, log: StoryLog | None = None) -> None:
        self.robot: Agent | None = None
        self.events: list[Event] = []
        self.states: list[Record] = []
        self._log = log

    def __call__(self, event: Event) -> None:
        assert self.robot is not None
        self.events.append(event)
        self.states.append(self.robot.state)
        if self._log is not None:
            self._log(event)


Happening = tuple[float, str]
"""After how many seconds something happens, and its line."""

LINES = (
    *("@ show cup", "@ place book at 0.1 0.1", "@ look", "@ glimpse", "@ point 1"),
    *("U> This is a cup.", "U> #1 This is a book.", "U> What is this?", "U> Why?"),
    *(
        "@ watch",
        "@ watch busy",
        "@ interrupt",
        "@ spoken",
        "@ meanwhile place cup at 0.1 0.1",
        "U> Wait.",
    ),
    *("@ meanwhile remove cup", "U> Go on.", "U> Yes."),
    *("U> Forget that.", "U> No, this is a mug.", "U>", "U> Blah blah.", "@ restart"),
    "U~ This is a cup. 0.35 | This is a cap. 0.3",
)

happenings = st.lists(
    st.tuples(st.floats(0.0, 90_000.0), st.sampled_from(LINES)), max_size=5
)


def happen(robot: Agent, line: str) -> None:
    """Let something happen, if it can."""
    with suppress(SensorError):
        _happen(robot, line)


def _happen(robot: Agent, line: str) -> None:
    mark, _, text = line.partition(" ")
    if mark == "U>":
        robot.hear(text)
    elif mark == "U~":
        robot.hear_perhaps(("This is a cup.", 0.35), ("This is a cap.", 0.3))
    elif text == "look":
        robot.look()
    else:
        robot.do(text)


def log_of(happened: Sequence[Happening], path: Path, memory: Path) -> Recorder:
    """Holds a dialogue that is logged; returns what happened in it."""
    copy = ""
    if memory.exists():
        copy = "copy.db"
        with Memory.open_to_read(memory) as reader:
            reader.copy_to(path.parent / copy)
    clock = Clock()
    with StoryLog(path) as log:
        recorder = Recorder(log)
        with Agent(
            SENSOR, memory, turns="lively", now=clock, record_event=recorder, scans=1
        ) as robot:
            recorder.robot = robot
            log.begin(robot.gaze.sensor.name, robot.time, ("lively",), copy)
            happen(robot, "@ show cup")
            for seconds, line in happened:
                clock.now += timedelta(seconds=seconds)
                happen(robot, line)
    return recorder


def replay_of(path: Path) -> Recorder:
    """Plays a log again, and compares the answers; returns what happened."""
    again = Recorder()

    def make(*seeing: object, language: str, **how: object) -> Agent:
        again.robot = Agent(
            *seeing,  # type: ignore[arg-type]
            language=language,
            record_event=again,
            scans=1,
            **how,  # type: ignore[arg-type]
        )
        return again.robot

    [story] = read_stories(path)
    assert play(story, make=make) is None
    return again


@pytest.fixture
def folder() -> Iterator[Path]:
    with TemporaryDirectory() as place:
        yield Path(place)


@settings(max_examples=8, deadline=None, suppress_health_check=list(HealthCheck))
@given(happenings, happenings)
def test_a_replay_has_the_same_times_answers_and_states(
    first: list[Happening], second: list[Happening]
) -> None:
    with TemporaryDirectory() as place:
        memory = Path(place, "memory.db")
        for name, happened in (("one.dlg", first), ("two.dlg", second)):
            live = log_of(happened, Path(place, name), memory)
            again = replay_of(Path(place, name))
            assert again.events == live.events
            assert again.states == live.states


def test_how_long_ago_a_lesson_was_is_the_same_to_the_last_digit(folder: Path) -> None:
    happened = [(1.2345678, "U> This is a cup."), (86_399.9876, "U> Why?")]
    happened.insert(1, (0.5, "U> What is this?"))
    live = log_of(happened, folder / "a.dlg", folder / "memory.db")
    assert "yesterday" in live.events[-1].said[0] or "day" in live.events[-1].said[0]
    assert replay_of(folder / "a.dlg").states == live.states


def test_what_is_said_after_a_silence_is_said_again_after_it(folder: Path) -> None:
    happened = [
        (1.0, "U> This is a cup."),
        (0.5, "@ watch"),
        (0.5, "@ meanwhile place book at 0.2 0.1"),
        *[(0.6, "@ watch")] * 5,
        (0.3, "@ watch busy"),
        (5.0, "U> A book."),
        *[(0.6, "@ watch")] * 16,
    ]
    live = log_of(happened, folder / "a.dlg", folder / "memory.db")
    said = [text for it in live.events for text in it.said]
    assert "Something new is here (#2): what is it?" in said
    assert said[-1].endswith("Please tell me where things are.")
    assert replay_of(folder / "a.dlg").states == live.states


def test_every_event_has_the_time_of_the_clock_in_milliseconds(folder: Path) -> None:
    live = log_of([(2.5, "U> Hello.")], folder / "a.dlg", folder / "memory.db")
    start, then = (it.time for it in live.events)
    assert start.microsecond % 1000 == then.microsecond % 1000 == 0
    assert 2.5 <= (then - start).total_seconds() < 2.51
    text = (folder / "a.dlg").read_text()
    assert re.search(r"\n@ time 2\.50\d\nU> Hello\.\nS> Hello\.\n\Z", text)
    assert live.robot is not None
    assert [it.time for it in live.robot.exchanges] == [it.time for it in live.events]


def test_a_log_is_whole_after_every_event(folder: Path) -> None:
    path = folder / "a.dlg"
    with StoryLog(path) as log, Agent(SENSOR, record_event=log) as robot:
        log.begin(SENSOR, robot.time)
        robot.hear("Hello.")
        assert path.read_text().endswith("U> Hello.\nS> Hello.\n")
        robot.hear("one\nline")
        assert "\nU> one line\n" in path.read_text()
    assert path.stat().st_mode & 0o077 == 0


def test_a_log_of_a_memory_is_played_with_what_was_known_then(folder: Path) -> None:
    memory = folder / "memory.db"
    log_of([(1.0, "U> This is a cup.")], folder / "a.dlg", memory)
    live = log_of([(1.0, "U> What is this?")], folder / "b.dlg", memory)
    assert live.events[-1].said == ("This is a cup.",)
    Memory.open(memory).close()
    assert replay_of(folder / "b.dlg").states == live.states
    (folder / "copy.db").unlink()
    with pytest.raises(StoryError, match="does not exist"):
        replay_of(folder / "b.dlg")
