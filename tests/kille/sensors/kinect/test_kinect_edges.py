"""What is rare with a Kinect: parts that come and go, replies lost, others like it."""

from __future__ import annotations

import gc
import threading
import time
import weakref
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager, nullcontext
from dataclasses import replace
from itertools import count

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.interfaces.doctor.kinect import kinect_findings
from kille.sensors.kinect import camera as cameras
from kille.sensors.kinect import motor_control as heads
from kille.sensors.kinect import sensor as sensors
from kille.sensors.kinect.address import parse_address
from kille.sensors.kinect.devices import Kinect as Found
from kille.sensors.kinect.devices import again, kinects
from kille.sensors.kinect.motor import Light, tilt_value
from kille.sensors.kinect.sensor import KinectSensor
from kille.sensors.kinect.session import StreamSession
from kille.sensors.kinect.streams import COLOUR
from kille.sensors.kinect.transport import Connection, PluggedDevice, TransportError
from kille.sensors.sensor import SensorError
from kinect_emulator.calibration import LIKELY
from kinect_emulator.descriptors import MODEL_1414, MODEL_1473, Model, Role
from kinect_emulator.faults import NONE, Faults, Reply
from kinect_emulator.host import Host
from kinect_emulator.inside import InsideBus
from kinect_emulator.kinect import Kinect
from kinect_emulator.pictures import patterns
from kinect_emulator.running import PATIENCE

LONG = 60.0
NAMELESS = replace(
    MODEL_1414,
    parts=tuple(replace(part, tells_serial=False) for part in MODEL_1414.parts),
)
OTHER_MAKING = replace(LIKELY, reference_distance=121.0)
ALL_WRONG_TILTS = [
    float("nan"), float("inf"), -float("inf"), 31.5, -32, 1e300, "5", None, True, 5j, []
]  # fmt: skip


@pytest.fixture
def impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    """What a user waits seconds for comes at once."""
    monkeypatch.setattr(sensors, "PATIENCE", 0.2)
    monkeypatch.setattr(heads, "_RARELY", 0.0)
    monkeypatch.setattr(cameras, "_PATIENCE", (0.01, 0.05, 0.2))


@contextmanager
def bus_of(*kinects: Kinect) -> Iterator[InsideBus]:
    with InsideBus(Host(*kinects, patience=PATIENCE)).running() as bus:
        yield bus


def until(happened: Callable[[], object]) -> None:
    """Wait for it."""
    deadline = time.monotonic() + LONG
    while not happened():
        assert time.monotonic() < deadline
        time.sleep(0.005)


def shows(sensor: KinectSensor, kinect: Kinect) -> bool:
    """Whether what it captures is what that Kinect sees."""
    depth = sensor.capture().depth
    return any(np.array_equal(depth, view.depth) for view in kinect.show.views)


def look(sensor: KinectSensor, kinect: Kinect, times: int) -> None:
    """See what that Kinect sees; some that came before may be seen of another."""
    for _ in range(times):
        assert shows(sensor, kinect)


def nameless(view: int, **given) -> Kinect:
    """A Kinect that tells no number and shows one picture only."""
    kinect = Kinect(patterns(), model=NAMELESS, **given)
    kinect.show.views = kinect.show.views[view : view + 1]
    return kinect


# --- the motor -----------------------------------------------------------------------


@pytest.mark.usefixtures("impatient")
def test_a_motor_that_comes_back_alone_is_used_again(
    kinect: Kinect, bus: InsideBus, sensor: KinectSensor
) -> None:
    sensor.tilt(-5)
    sensor.light(Light.GREEN)
    bus.drop(kinect, Role.MOTOR)
    with pytest.raises(SensorError, match="its motor is not found"):
        sensor.posture()
    assert sensor.capture().tilt is None
    bus.bring_back(kinect, Role.MOTOR)
    assert sensor.posture().moving is not None
    assert sensor.capture().tilt is not None
    # What it was told before it may have forgotten.
    assert (kinect.motor.tilts, kinect.motor.lamps) == ([-10, -10], [1, 1])
    bus.drop(kinect, Role.MOTOR)
    bus.bring_back(kinect, Role.MOTOR)
    sensor.tilt(7)
    assert kinect.motor.tilts[-1] == 14


@pytest.mark.usefixtures("impatient")
def test_what_was_asked_of_a_missing_motor_is_done_when_it_is_back(
    kinect: Kinect, bus: InsideBus, sensor: KinectSensor
) -> None:
    sensor.tilt(3)
    bus.drop(kinect, Role.MOTOR)
    for degrees in (9, 5):
        with pytest.raises(SensorError, match="its motor is not found"):
            sensor.tilt(degrees)
        sensor.frame()
    bus.bring_back(kinect, Role.MOTOR)
    until(lambda: sensor.frame() and kinect.motor.tilts[-1] == 10)
    assert kinect.motor.tilts == [6, 10]


@pytest.mark.usefixtures("impatient")
def test_what_was_asked_last_counts_and_not_the_address(
    kinect: Kinect, bus: InsideBus
) -> None:
    with closing(KinectSensor("kinect?tilt=10&light=red", bus)) as sensor:
        sensor.tilt(5)
        for again_without_motor in (False, True):
            bus.unplug(kinect)
            bus.plug(kinect)
            if again_without_motor:
                bus.drop(kinect, Role.MOTOR)
            told = len(kinect.motor.tilts)
            # As many as may be left from before, and more.
            for _ in range(8):
                sensor.frame()
        assert len(kinect.motor.tilts) == told
        bus.bring_back(kinect, Role.MOTOR)
        until(lambda: sensor.frame() and len(kinect.motor.tilts) > told)
    assert kinect.motor.tilts == [20, 10, 10, 10]
    assert set(kinect.motor.lamps) == {Light.RED}


def test_a_motor_that_is_missing_at_first_is_a_line(
    kinect: Kinect, bus: InsideBus
) -> None:
    bus.drop(kinect, Role.MOTOR)
    with pytest.raises(SensorError, match="its motor is not found"):
        KinectSensor("kinect?tilt=5", bus)
    with closing(KinectSensor("kinect", bus)) as sensor:
        bus.bring_back(kinect, Role.MOTOR)
        sensor.tilt(5)
    assert kinect.motor.tilts == [10]


def test_the_motor_of_another_kinect_is_never_turned() -> None:
    left, right = Kinect(serial="B1"), Kinect(serial="B2")
    with bus_of(left, right) as bus:
        bus.drop(left, Role.CAMERA)
        bus.drop(right, Role.MOTOR)
        with closing(KinectSensor("kinect", bus)) as sensor:
            with pytest.raises(SensorError, match="its motor is not found"):
                sensor.tilt(5)
            assert shows(sensor, right)
    assert left.motor.tilts == right.motor.tilts == []


@pytest.mark.parametrize("degrees", ALL_WRONG_TILTS, ids=repr)
def test_what_is_no_tilt_is_refused_before_it_is_sent(
    kinect: Kinect, bus: InsideBus, sensor: KinectSensor, degrees: float
) -> None:
    with pytest.raises(SensorError, match=r"^kinect: a tilt is a number of degrees"):
        sensor.tilt(degrees)
    assert kinect.motor.tilts == []
    sensor.frame()


@given(st.floats() | st.integers() | st.text() | st.booleans() | st.none())
def test_a_tilt_is_from_31_down_to_31_up_or_an_error(degrees) -> None:
    wrong = isinstance(degrees, str | bool | None) or not -31 <= degrees <= 31
    with pytest.raises(SensorError) if wrong else nullcontext():
        assert -62 <= (tilt_value(degrees) ^ 0x8000) - 0x8000 <= 62


@pytest.mark.parametrize(
    "degrees", ["nan", "inf", "-inf", "31.5", "1e9", "up", "", "5&tilt=6", "0x10"]
)
def test_what_is_no_tilt_in_an_address_is_refused(degrees: str) -> None:
    with pytest.raises(SensorError, match="tilt"):
        parse_address(f"kinect?tilt={degrees}")


@pytest.mark.parametrize("light", ["red", 99, -1, None, True, 1.0])
def test_what_is_no_light_is_refused(
    kinect: Kinect, sensor: KinectSensor, light: Light
) -> None:
    with pytest.raises(SensorError, match=r"^kinect: a light is one of Light\.OFF"):
        sensor.light(light)
    assert kinect.motor.lamps == []


# --- which Kinect it is --------------------------------------------------------------


@pytest.mark.usefixtures("impatient")
def test_another_kinect_is_never_taken_for_one_without_a_number() -> None:
    left, right = nameless(0), nameless(1)
    with bus_of(left, right) as bus, closing(KinectSensor("kinect", bus)) as sensor:
        assert shows(sensor, left)
        bus.unplug(left)
        with pytest.raises(SensorError) as error:
            look(sensor, left, 8)
        assert str(error.value) == (
            "kinect: the Kinect without a serial number at USB 1-1.3 that was looked "
            "through is gone, and another is plugged in: Kinect without a serial "
            "number at USB 1-2.3; plug it in again where it was, or start again to use "
            "another"
        )
        bus.plug(left)
        assert shows(sensor, left)


@pytest.mark.usefixtures("impatient")
def test_another_kinect_in_the_same_place_is_told_by_its_calibration() -> None:
    one, other = nameless(0), nameless(1, making=OTHER_MAKING)
    with bus_of(one) as bus, closing(KinectSensor("kinect", bus)) as sensor:
        assert shows(sensor, one)
        bus.unplug(one)
        bus.plug(other)
        with pytest.raises(SensorError, match="another Kinect was plugged in where"):
            look(sensor, one, 8)
        bus.unplug(other)
        bus.plug(one)
        assert shows(sensor, one)


@pytest.mark.usefixtures("impatient")
def test_another_kinect_is_never_taken_for_one_with_a_number() -> None:
    left, right = Kinect(serial="B1"), Kinect(serial="B2")
    left.show.views, right.show.views = left.show.views[:1], right.show.views[1:2]
    with bus_of(left, right) as bus, closing(KinectSensor("kinect", bus)) as sensor:
        assert shows(sensor, left)
        bus.unplug(left)
        with pytest.raises(SensorError, match=r"Kinect B1 .* is gone.*: Kinect B2"):
            look(sensor, left, 8)


@pytest.mark.usefixtures("impatient")
def test_the_part_that_tells_the_number_may_come_later() -> None:
    kinect = Kinect(model=MODEL_1473, serial="B5")
    with bus_of(kinect) as bus:
        bus.drop(kinect, Role.AUDIO)
        with closing(KinectSensor("kinect", bus)) as sensor:
            sensor.frame()
            for _ in range(2):
                bus.unplug(kinect)
                bus.plug(kinect)
                for _ in range(8):
                    assert shows(sensor, kinect)
                bus.drop(kinect, Role.AUDIO)


@given(st.permutations(range(4)))
def test_the_order_of_devices_does_not_matter(order: list[int]) -> None:
    devices = [
        PluggedDevice(0x045E, product, 0x010B, serial, place)
        for product, serial, place in (
            (0x02B0, "", (1, 1, 1)),
            (0x02AE, "B1", (1, 1, 3)),
            (0x02B0, "", (1, 2, 1)),
            (0x02AE, "B2", (1, 2, 3)),
        )
    ]
    found = {it.serial: it for it in kinects([devices[place] for place in order])}
    assert (found["B1"].motor, found["B2"].motor) == (devices[0], devices[2])
    here = [devices[place] for place in order]
    assert again(here, found["B2"]).camera is devices[3]


def test_a_motor_is_not_shared_by_two_cameras_beside_it() -> None:
    """As where a computer is given single devices, and not their hubs."""
    parts = [(0x02B0, (1, 1)), (0x02AE, (1, 2)), (0x02AE, (1, 3))]
    found = kinects([PluggedDevice(0x045E, it, 0x010B, "", at) for it, at in parts])
    assert [it.motor for it in found] == [None, None]


# --- replies and streams -------------------------------------------------------------


def commands_of_opening() -> int:
    kinect = Kinect()
    with bus_of(kinect) as bus:
        opened = KinectSensor("kinect", bus)
        heard = len(kinect.camera.heard)
        opened.close()
    return heard


@pytest.mark.usefixtures("impatient")
def test_any_two_lost_replies_are_asked_for_again() -> None:
    for lost in range(commands_of_opening()):
        kinect = Kinect()
        kinect.faults = Faults(lost_replies=frozenset({lost, lost + 4}))
        session = session_of(InsideBus(Host(kinect)))
        assert session.calibration.const_shift == LIKELY.const_shift
        assert len(kinect.camera.modes()) == 2
        session.close()


@pytest.mark.usefixtures("impatient")
def test_firmware_that_answers_late_is_understood(
    bus: InsideBus, kinect: Kinect
) -> None:
    # Its answers come when the command has been sent again already.
    kinect.faults = Faults(slow=240)
    opened = KinectSensor("kinect", bus)
    assert opened.calibration.const_shift == 200
    assert shows(opened, kinect)
    opened.close()


@pytest.mark.usefixtures("impatient")
def test_transfers_that_fail_as_a_whole_are_got_over(
    kinect: Kinect, bus: InsideBus, sensor: KinectSensor
) -> None:
    early = sensor.capture().ticks_depth
    for _ in range(3):
        kinect.faults = Faults(failing=True)
        now = bus.host.now
        until(lambda begun=now: bus.host.now > begun + 200)
        kinect.faults = NONE
        until(lambda: sensor.capture().ticks_depth != early)


class Trapped:
    """A bus on which something happens at a certain control transfer."""

    def __init__(self, bus: InsideBus, at: int, happens: Callable[[], None]) -> None:
        self._bus = bus
        self._at = at
        self._happens = happens
        self._count = count()

    def devices(self) -> tuple[PluggedDevice, ...]:
        return self._bus.devices()

    def open(self, device: PluggedDevice, alternate: int) -> Connection:
        connection = self._bus.open(device, alternate)
        write = connection.write

        def trapped(request: int, value: int, index: int, data: bytes) -> None:
            if next(self._count) == self._at:
                self._happens()
            write(request, value, index, data)

        connection.write = trapped  # type: ignore[method-assign]
        return connection


@pytest.mark.usefixtures("impatient")
@pytest.mark.parametrize("at", [0, 2, 5, 8, 13, 17])
def test_one_that_leaves_the_bus_while_it_is_opened_is_opened_again(
    kinect: Kinect, bus: InsideBus, at: int
) -> None:
    def leave() -> None:
        bus.unplug(kinect)
        bus.plug(kinect)

    opened = KinectSensor("kinect", Trapped(bus, at, leave))
    assert shows(opened, kinect)
    opened.close()


@pytest.mark.usefixtures("impatient")
def test_one_that_is_pulled_while_it_is_closed_is_closed(
    kinect: Kinect, bus: InsideBus
) -> None:
    trapped = Trapped(bus, commands_of_opening(), lambda: bus.unplug(kinect))
    opened = KinectSensor("kinect", trapped)
    opened.frame()
    opened.close()
    bus.plug(kinect)
    assert shows(opened, kinect)
    opened.close()


# --- why no pictures come ------------------------------------------------------------


def session_of(bus: InsideBus) -> StreamSession:
    (found,) = kinects(bus.devices())
    return StreamSession(bus, found, COLOUR)


def test_a_computer_that_is_too_busy_is_told_from_a_bad_cable() -> None:
    bus = InsideBus(Host(Kinect()))
    session = session_of(bus)
    bus.pass_time(2_000)
    assert session.wait_for_pair(0) is not None
    while session.wait_for_pair(0):
        pass
    for _ in range(20):
        # For a tenth of a second nobody takes what has come, and asks for more.
        bus.host.pass_time(800)
        bus.deliver()
        session._colours.clear()
    assert min(it.missed for it in session.counts.values()) > 1_000
    assert "this computer was too busy to read" in str(session.why_no_pair())
    session.close()


def test_frames_of_clocks_that_differ_are_told_so() -> None:
    bus = InsideBus(Host(Kinect(apart=12_000_000)))
    session = session_of(bus)
    bus.pass_time(8_000)
    assert session.wait_for_pair(0) is None
    assert [it.missed for it in session.counts.values()] == [0, 0]
    assert "their clocks differ" in str(session.why_no_pair())
    session.close()


# --- the doctor ----------------------------------------------------------------------


@pytest.mark.usefixtures("impatient")
@pytest.mark.parametrize(
    ("faults", "said"),
    [
        (Faults(reply=Reply.NEVER), "it does not answer"),
        (Faults(reply=Reply.MAGIC), "it answers nonsense"),
        (Faults(silent=frozenset({0x81})), "one of its two cameras sends nothing"),
        (Faults(silent=frozenset({0x81, 0x82})), "it answers but sends no pictures"),
    ],
)
def test_the_doctor_says_no_where_opening_or_looking_fails(
    kinect: Kinect,
    bus: InsideBus,
    faults: Faults,
    said: str,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setitem(kinect_findings.__globals__, "_PATIENCE", 0.3)
    kinect.faults = faults
    (finding,) = kinect_findings(bus)
    assert not finding.works
    assert said in finding.state


@pytest.mark.parametrize("model", [MODEL_1414, MODEL_1473, NAMELESS])
def test_the_doctor_leaves_what_it_looked_through_at_rest(model: Model) -> None:
    one, other = Kinect(model=model, serial="B1"), Kinect(model=model, serial="B2")
    with bus_of(one, other) as bus:
        bus.drop(other, Role.AUDIO)
        found = list(kinect_findings(bus))
    assert [it.works for it in found] == [True, True]
    assert one.camera.modes() == other.camera.modes() == ()


@pytest.mark.usefixtures("impatient")
def test_the_doctor_says_what_is_the_matter_with_the_head(
    kinect: Kinect, bus: InsideBus
) -> None:
    bus.drop(kinect, Role.MOTOR)
    (finding,) = kinect_findings(bus)
    assert finding.works
    assert "its head cannot be turned: its motor is not found" in finding.state


# --- what is left --------------------------------------------------------------------


@pytest.fixture
def no_search_for_cycles() -> Iterator[None]:
    gc.collect()
    gc.disable()
    yield
    gc.enable()


@pytest.mark.usefixtures("no_search_for_cycles", "impatient")
@pytest.mark.parametrize("pulled", [False, True])
def test_what_is_closed_is_freed_at_once(
    kinect: Kinect, bus: InsideBus, pulled: bool
) -> None:
    opened = KinectSensor("kinect", bus)
    opened.capture()
    session = opened._streams
    assert isinstance(session, StreamSession)
    feeds = [weakref.ref(feed) for feed in session._feeds]
    held = [weakref.ref(session), *feeds, *(weakref.ref(it().stream) for it in feeds)]
    del session
    if pulled:
        bus.unplug(kinect)
        with pytest.raises(SensorError):
            look(opened, kinect, 8)
    opened.close()
    # The bus's own thread may have one in its hands.
    until(lambda: not any(it() for it in held))


@pytest.mark.deep
@pytest.mark.usefixtures("no_search_for_cycles")
def test_opened_and_closed_120_times_it_leaves_nothing(bus: InsideBus) -> None:
    def left() -> tuple[int, int]:
        with closing(KinectSensor("kinect", bus)) as sensor:
            sensor.frame()
        kinds = (StreamSession, Found, TransportError, np.ndarray)
        return threading.active_count(), sum(
            isinstance(it, kinds) for it in gc.get_objects()
        )

    begun = [left() for _ in range(3)][-1]
    assert [left() for _ in range(120)][-1] == begun
