"""The robot as nodes on a bus within a process: sensor, perception and dialogue."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from kille import Agent, Memory
from kille.bus import Asking, Bundle, Bus, BusError, Facts, LocalBus, Text, serve
from kille.bus.packing import pack, unpack
from kille.nodes.dialogue import DialogueNode
from kille.nodes.look_messages import bundle_of, look_in, mask_in, runs_of
from kille.nodes.perception import PerceptionNode
from kille.nodes.remote_sensor import RemoteSensor
from kille.nodes.sensor import SensorNode
from kille.nodes.topics import (
    CALLS,
    FRAMES,
    HYPOTHESES,
    INTERRUPTED,
    LOOKS,
    PROBLEMS,
    STATE,
    SYSTEM_OUTPUT,
    USER_INPUT,
)
from kille.perception.look import look
from kille.scene import Frame, Mask
from kille.sensors.sensor import SensorError
from kille.sensors.sources import open_sensor
from ttr import parse

SCENE = "synthetic:empty?seed=7"
WAIT = 60.0


class Robot:
    """The three nodes, and a tutor who takes turns with them."""

    def __init__(self, bus: Bus, memory: Path | None = None) -> None:
        self.bus, self._running = bus, ExitStack()
        self._sensor = open_sensor(SCENE)
        self.sensing = self._run(SensorNode(bus, self._sensor, rate=12))
        self.seeing = self._run(PerceptionNode(bus))
        eyes = RemoteSensor(bus, WAIT)
        self.talking = self._run(
            DialogueNode(bus, lambda: Agent(eyes, memory, scans=1))
        )

    def _run(self, node: Any) -> Any:
        self._running.callback(node.close)
        return node

    def close(self) -> None:
        self._running.close()
        self._sensor.close()
        self.bus.close()


@pytest.fixture
def robot() -> Iterator[Robot]:
    made = Robot(LocalBus())
    yield made
    made.close()


class Tutor:
    """Says something, and hears what comes of it."""

    def __init__(self, bus: Bus, heard: Any) -> None:
        self.state, self.problems = heard(bus, STATE), heard(bus, PROBLEMS)
        self.output = heard(bus, SYSTEM_OUTPUT)
        self._saying = bus.publisher(USER_INPUT)
        self.state.next()

    def says(self, text: str) -> str:
        """The robot's answer."""
        self._saying.publish(Text(text))
        facts = self.state.next().facts
        if not facts["said"]:
            return ""
        assert self.output.next() == Text("\n".join(facts["said"]))
        return "\n".join(facts["said"])

    def cannot(self, text: str) -> str:
        """What is wrong with what is said."""
        self._saying.publish(Text(text))
        problem: str = self.problems.next().text
        assert "\n" not in problem
        return problem


def test_a_lesson_is_taught_and_asked_over_the_bus(robot: Robot, heard: Any) -> None:
    tutor = Tutor(robot.bus, heard)
    assert tutor.says("What is this?") == "I see nothing on the table."
    assert tutor.says("@ show cup") == ""
    assert tutor.says("This is a cup.") == "OK, I learned a cup."
    assert tutor.says("What is this?") == "This is a cup."
    assert tutor.says("Bye.") == "Goodbye."


def test_the_state_is_told_after_each_turn(robot: Robot, heard: Any) -> None:
    states = heard(robot.bus, STATE)
    assert states.next().facts["turn"] == 0
    robot.bus.publisher(USER_INPUT).publish(Text("What is this?"))
    told = states.next().facts
    assert told["turn"] == 1
    assert [it["act"] for it in told["moves"]] == ["ask_name", "see_nothing"]
    assert [it["by"] for it in told["moves"]] == ["tutor", "robot"]
    assert told["state"].startswith("{private = {")


def test_who_comes_late_is_told_the_present_state(robot: Robot, heard: Any) -> None:
    Tutor(robot.bus, heard).says("What is this?")
    assert heard(robot.bus, STATE).next().facts["turn"] == 1


def test_a_new_dialogue_begins_after_a_farewell(robot: Robot, heard: Any) -> None:
    tutor = Tutor(robot.bus, heard)
    tutor.says("Bye.")
    assert "latest = {}" in heard(robot.bus, STATE).next().facts["state"]
    assert tutor.says("What is this?") == "I see nothing on the table."


def test_things_are_pointed_at_by_number_and_by_pixel(robot: Robot, heard: Any) -> None:
    tutor = Tutor(robot.bus, heard)
    tutor.says("@ show cup")
    tutor.says("This is a cup.")
    tutor.says("@ place book right of cup")
    learned = "OK, the one on the right (#2) is a book."
    assert tutor.says("#2 This is a book.").startswith(learned)
    assert tutor.says("What is #1?").startswith("This is a cup.")
    assert tutor.cannot("@ point 99") == (
        "there is no thing #99 to point at: there are 2"
    )
    assert "nothing at 1 1" in tutor.cannot("@ point 1 1")


def test_who_speaks_over_the_robot_is_told_the_rest_again(
    robot: Robot, heard: Any
) -> None:
    tutor = Tutor(robot.bus, heard)
    speaking = robot.bus.publisher(INTERRUPTED)
    tutor.says("@ show cup")
    tutor.says("This is a cup.")
    tutor.says("What is this?")
    speaking.publish(Text("This is a mug."))
    assert "does not begin the latest answer" in tutor.problems.next().text
    speaking.publish(Text("This is"))
    assert 'uttered = "This is"' in tutor.state.next().facts["state"]
    assert tutor.says("Go on.") == "This is a cup."


def test_what_was_perhaps_said_is_weighed(robot: Robot, heard: Any) -> None:
    tutor = Tutor(robot.bus, heard)
    perhaps = robot.bus.publisher(HYPOTHESES)
    perhaps.publish(Facts({"texts": [["What is this?", 0.9], ["What is it?", 0.05]]}))
    assert tutor.state.next().facts["said"] == ["I see nothing on the table."]
    for wrong in (
        {},
        {"texts": []},
        {"texts": [["What?", "high"]]},
        {"texts": [["a", 2]]},
    ):
        perhaps.publish(Facts(wrong))
        assert "are no hypotheses" in tutor.problems.next().text


@pytest.mark.parametrize(
    ("said", "because"),
    [
        ("@ show unicorn", "unicorn"),
        ("@ juggle", "unknown command"),
        ("@ scene synthetic", "a node of its own"),
        ("@ place cup left of", "place"),
    ],
)
def test_what_cannot_be_done_is_one_line(
    robot: Robot, heard: Any, said: str, because: str
) -> None:
    tutor = Tutor(robot.bus, heard)
    assert because in tutor.cannot(said)
    assert tutor.says("What is this?") == "I see nothing on the table."


# --- programs ------------------------------------------------------------------------


def test_programs_teach_ask_and_forget(robot: Robot, heard: Any) -> None:
    tutor = Tutor(robot.bus, heard)
    tutor.says("@ show cup")
    program = Asking(robot.bus, CALLS, WAIT)
    taught = program.ask({"do": "teach", "word": "mug", "thing": 1})
    assert (taught["heard"], taught["answer"]) == (
        "#1 This is a mug.",
        "OK, I learned a mug.",
    )
    assert [it["act"] for it in taught["moves"]] == ["learned"]
    assert program.ask({"do": "ask"})["answer"] == "This is a mug."
    assert "no longer know" in program.ask({"do": "forget", "word": "mug"})["answer"]
    assert program.ask({"do": "say", "text": "Hello."})["answer"] == "Hello."
    assert program.ask({"do": "say", "text": "@ remove cup"})["answer"] == ""
    assert program.ask({"do": "ask"})["answer"] == "I see nothing on the table."


@pytest.mark.parametrize(
    "call",
    [
        {},
        {"do": "dance"},
        {"do": "teach"},
        {"do": "teach", "word": " "},
        {"do": "ask", "thing": 0},
        {"do": "ask", "thing": True},
        {"do": "ask", "thing": 99},
        {"do": "say", "text": 7},
    ],
)
def test_what_is_no_call_is_refused_in_one_line(
    robot: Robot, call: dict[str, Any]
) -> None:
    with pytest.raises(BusError) as caught:
        Asking(robot.bus, CALLS, WAIT).ask(call)
    assert "\n" not in str(caught.value)


# --- failing -------------------------------------------------------------------------


def test_without_perception_the_state_stays_and_the_talk_goes_on(
    heard: Any, tmp_path: Path, eventually: Callable[..., Any]
) -> None:
    bus = LocalBus()
    sensor = open_sensor(SCENE)
    sensing = SensorNode(bus, sensor)
    eyes = RemoteSensor(bus, 0.5)
    talking = DialogueNode(bus, lambda: Agent(eyes, tmp_path / "m.db", scans=1))
    tutor = Tutor(bus, heard)
    assert "is `kille ros perception` running?" in tutor.cannot("What is this?")
    seeing = PerceptionNode(bus, patience=WAIT)
    # On a busy machine a look may take longer than there is patience for.
    eventually(lambda: asked_for_a_name(bus))
    seeing.close()
    assert "nobody answered" in tutor.cannot("What is this?")
    for it in (talking, sensing, sensor, bus):
        it.close()


def asked_for_a_name(bus: Bus) -> bool:
    """Whether the robot says what it sees, now."""
    try:
        answer = Asking(bus, CALLS, WAIT).ask({"do": "ask"})["answer"]
    except BusError:
        return False
    return bool(answer == "I see nothing on the table.")


def test_without_a_sensor_perception_says_so(heard: Any) -> None:
    bus = LocalBus()
    seeing = PerceptionNode(bus, patience=0.2)
    with pytest.raises(BusError, match="no picture came on camera/rgb/image_color"):
        Asking(bus, LOOKS, WAIT).request({"scans": 1})
    seeing.close()
    bus.close()


def test_what_is_learned_is_there_for_the_next_dialogue_node(
    heard: Any, tmp_path: Path
) -> None:
    for turn in ("This is a cup.", "What is this?"):
        robot = Robot(LocalBus(), tmp_path / "memory.db")
        tutor = Tutor(robot.bus, heard)
        tutor.says("@ show cup")
        answer = tutor.says(turn)
        robot.close()
    assert answer == "This is a cup."


class Failing:
    """A sensor that works, fails and works again, as a cable does."""

    def __init__(self) -> None:
        self._inner, self.broken, self.read = open_sensor(SCENE), False, 0

    name = "a loose cable"

    def frame(self) -> Frame:
        if self.broken:
            raise SensorError("the cable is loose")
        self.read += 1
        return self._inner.frame()

    def close(self) -> None:
        self._inner.close()


def test_a_sensor_that_fails_is_told_once_and_tried_again(heard: Any) -> None:
    bus, sensor = LocalBus(), Failing()
    problems = heard(bus, PROBLEMS)
    sensing, seeing = SensorNode(bus, sensor), PerceptionNode(bus)
    asking = Asking(bus, LOOKS, WAIT)
    assert asking.request({"scans": 1}).facts["things"] == []
    sensor.broken = True
    assert problems.next().text == "the cable is loose"
    assert problems.nothing(1.5)
    sensor.broken = False
    assert asking.request({"scans": 1}).facts["things"] == []
    for it in (seeing, sensing, sensor, bus):
        it.close()


def test_a_sensor_is_read_only_while_somebody_listens() -> None:
    bus, sensor = LocalBus(), Failing()
    sensing = SensorNode(bus, sensor)
    threading.Event().wait(0.2)
    assert sensor.read == 0
    seeing = PerceptionNode(bus)
    assert Asking(bus, LOOKS, WAIT).request({"scans": 1}).facts["things"] == []
    assert sensor.read > 0
    for it in (seeing, sensing, sensor, bus):
        it.close()


def test_depth_alone_may_be_listened_to(heard: Any) -> None:
    bus, sensor = LocalBus(), Failing()
    sensing = SensorNode(bus, sensor)
    assert FRAMES.depth is not None
    assert heard(bus, FRAMES.depth).next().pixels.dtype == np.float32
    for it in (sensing, sensor, bus):
        it.close()


class Odd(Failing):
    """A sensor whose driver fails in a way that nobody thought of."""

    def frame(self) -> Frame:
        if self.broken:
            raise ZeroDivisionError("a fault of the driver")
        return super().frame()


def test_a_fault_of_a_sensor_is_told_and_it_is_tried_again(
    heard: Any, caplog: pytest.LogCaptureFixture
) -> None:
    bus, sensor = LocalBus(), Odd()
    sensor.broken = True
    problems, pictures = heard(bus, PROBLEMS), heard(bus, FRAMES.colour)
    sensing = SensorNode(bus, sensor)
    assert problems.next().text == (
        "a loose cable failed, by a fault of its own; the log of its node says why"
    )
    assert "ZeroDivisionError" in caplog.text
    sensor.broken = False
    assert pictures.next().pixels.dtype == np.uint8
    for it in (sensing, sensor, bus):
        it.close()


class Slow:
    """Eyes that look only when they may."""

    name = "slow eyes"

    def __init__(self) -> None:
        self._inner = open_sensor(SCENE)
        self.looking, self.may = threading.Event(), threading.Event()

    def frame(self) -> Frame:
        self.looking.set()
        self.may.wait(WAIT)
        return self._inner.frame()

    def close(self) -> None:
        self._inner.close()


def test_who_is_told_to_end_in_a_turn_ends_the_turn(heard: Any) -> None:
    bus, eyes = LocalBus(), Slow()
    talking = DialogueNode(bus, lambda: Agent(eyes, scans=1))
    output = heard(bus, SYSTEM_OUTPUT)
    bus.publisher(USER_INPUT).publish(Text("What is this?"))
    assert eyes.looking.wait(WAIT)
    ending = threading.Thread(target=talking.close)
    ending.start()
    eyes.may.set()
    ending.join()
    assert output.next() == Text("I see nothing on the table.")
    bus.close()


@pytest.mark.parametrize(
    "request_",
    [{"scans": -1}, {"scans": "x"}, {"pointed": {}}, {"pointed": {"runs": 3}}],
)
def test_a_broken_request_is_refused_in_one_line(
    robot: Robot, request_: dict[str, Any]
) -> None:
    with pytest.raises(BusError, match="this is no request for a look"):
        Asking(robot.bus, LOOKS, WAIT).request(request_)


def test_a_look_that_is_none_is_one_line() -> None:
    bus = LocalBus()
    serving = serve(bus, LOOKS, lambda asked: Bundle({"lens": None, "time": 0.0}))
    with pytest.raises(SensorError, match="what came on kille/results is no look"):
        RemoteSensor(bus, WAIT).look(1, None)
    serving.close()
    bus.close()


# --- looks as messages ---------------------------------------------------------------


@pytest.mark.parametrize("scene", ["synthetic:desk?seed=7", "synthetic:empty"])
def test_a_look_comes_over_whole(scene: str) -> None:
    sensor = open_sensor(scene)
    seen = look(sensor, 2)
    sensor.close()
    again = look_in(unpack(pack(bundle_of(seen))))
    assert again.up == seen.up
    assert again.frame.intrinsics == seen.frame.intrinsics
    assert again.frame.time == seen.frame.time
    same(again.frame.colour, seen.frame.colour)
    same(again.frame.depth, seen.frame.depth)
    assert len(again.percepts) == len(seen.percepts)
    for one, other in zip(again.percepts, seen.percepts, strict=True):
        same(one.region.mask, other.region.mask)
        assert one.region.box == other.region.box
        np.testing.assert_allclose(one.region.place, other.region.place)
        assert list(one.traits) == list(other.traits)
        for name in one.traits:
            same(one.traits[name], other.traits[name])
        assert len(one.scans) == len(other.scans)
        for scan, twin in zip(one.scans, other.scans, strict=True):
            same(scan.descriptors, twin.descriptors)
            same(scan.pixels, twin.pixels)
            same(scan.points, twin.points)


def same(one: Any, other: Any) -> None:
    assert one.dtype == other.dtype
    np.testing.assert_array_equal(one, other)


@given(arrays.arrays(bool, st.tuples(st.integers(1, 8), st.integers(1, 8))))
def test_runs_are_the_mask(mask: Mask) -> None:
    same(mask_in(runs_of(mask), mask.shape), mask)


def test_the_same_is_learned_over_the_bus_as_directly(robot: Robot, heard: Any) -> None:
    tutor = Tutor(robot.bus, heard)
    with Agent(SCENE, Memory.transient(), scans=1) as direct:
        for thing in ("cup", "book"):
            direct.do(f"show {thing}")
            tutor.says(f"@ show {thing}")
            taught = f"This is a {thing}."
            assert tutor.says(taught) == direct.hear(taught)
        for thing in ("book", "cup"):
            direct.do(f"show {thing}")
            tutor.says(f"@ show {thing}")
            assert tutor.says("What is this?") == direct.hear("What is this?")


def test_the_content_of_a_move_is_in_the_notation(robot: Robot, heard: Any) -> None:
    tutor = Tutor(robot.bus, heard)
    robot.bus.publisher(USER_INPUT).publish(Text("Hello."))
    moves = tutor.state.next().facts["moves"]
    assert [it["act"] for it in moves] == ["greet", "greet_back"]
    assert parse(moves[0]["content"]) is not None
