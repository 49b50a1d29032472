"""The Kinect as a sensor, on an emulated device in the same process."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from types import SimpleNamespace

import numpy as np
import pytest

from kille.sensors.kinect import sensor as sensors
from kille.sensors.kinect import session as sessions
from kille.sensors.kinect.camera import KinectCamera
from kille.sensors.kinect.capture import RawSource
from kille.sensors.kinect.motor import Light
from kille.sensors.kinect.packets import RawFrame
from kille.sensors.kinect.sensor import KinectSensor
from kille.sensors.kinect.streams import DEPTH_10, INFRARED
from kille.sensors.kinect.transport import TransportError
from kille.sensors.kinect.unpacking import unpack_10
from kille.sensors.sensor import SensorError
from kinect_emulator.descriptors import (
    FOR_WINDOWS,
    MODEL_1473,
    SECOND_KINECT,
    UNPOWERED,
)
from kinect_emulator.faults import NONE, Faults, Harm, PacketFault, Reply
from kinect_emulator.host import Host
from kinect_emulator.inside import InsideBus
from kinect_emulator.kinect import Kinect
from kinect_emulator.modes import MICROFRAMES_PER_SECOND

DEPTH = "depth of 11 bits"
A_FRAME, A_SECOND = 2_000_000, 60_000_000
"""Ticks of the device's clock."""

LONG = 60.0
"""Seconds after which what has not come never comes, also on a busy machine."""


@pytest.fixture
def hasty(monkeypatch: pytest.MonkeyPatch, bus: InsideBus) -> None:
    """Patience for tests: what a user waits seconds for is told at once.

    The seconds are those of the bus, so that a busy machine has no part in it.
    """
    clock = SimpleNamespace(
        monotonic=lambda: bus.host.now / MICROFRAMES_PER_SECOND, sleep=time.sleep
    )
    monkeypatch.setattr(sensors, "time", clock)
    monkeypatch.setattr(sessions, "time", clock)
    monkeypatch.setattr(sensors, "PATIENCE", 0.15)
    monkeypatch.setattr(sensors, "_SILENCE", 0.4)


def until(happened: Callable[[], object]) -> None:
    """Wait for it."""
    deadline = time.monotonic() + LONG
    while not happened():
        assert time.monotonic() < deadline
        time.sleep(0.005)


def problem_of(bus: InsideBus, name: str = "kinect") -> str:
    with pytest.raises(SensorError) as caught:
        KinectSensor(name, bus)
    assert "\n" not in str(caught.value)
    return str(caught.value)


def test_captures_are_what_the_device_saw(kinect: Kinect, sensor: KinectSensor) -> None:
    assert isinstance(sensor, RawSource)
    seen = [view.depth for view in kinect.show.views]
    for capture in (sensor.capture() for _ in range(5)):
        places = [np.array_equal(capture.depth, depth) for depth in seen]
        assert sum(places) == 1
        true = kinect.show.views[places.index(True)].colour
        # The mosaic keeps one colour of each pixel.
        assert np.array_equal(
            capture.colour[2:-2:2, 3:-2:2, 0], true[2:-2:2, 3:-2:2, 0]
        )
        assert np.array_equal(
            capture.colour[2:-2:2, 2:-2:2, 1], true[2:-2:2, 2:-2:2, 1]
        )
        assert np.array_equal(
            capture.colour[3:-2:2, 2:-2:2, 2], true[3:-2:2, 2:-2:2, 2]
        )


def test_captures_follow_one_another(sensor: KinectSensor) -> None:
    ticks = [sensor.capture().ticks_depth for _ in range(8)]
    steps = np.diff(ticks) % 2**32
    # On a busy machine some may be missed.
    assert (steps % A_FRAME == 0).all()
    assert (steps > 0).all()
    assert (steps < LONG * A_SECOND).all()


def test_a_frame_has_depth_and_the_seconds_since_it_was_opened(bus: InsideBus) -> None:
    began = time.monotonic()
    sensor = KinectSensor("kinect", bus)
    frame = sensor.frame()
    sensor.close()
    assert 0 < frame.time < time.monotonic() - began
    assert frame.depth is not None
    assert frame.depth.shape == (480, 640)
    assert np.isfinite(frame.depth).mean() > 0.3


def test_after_a_pause_the_frame_is_a_fresh_one(sensor: KinectSensor) -> None:
    early = sensor.capture().ticks_depth
    before = sensor.counts
    until(
        lambda: all(
            sensor.counts[mode].frames >= before[mode].frames + 14 for mode in before
        )
    )
    assert (sensor.capture().ticks_depth - early) % 2**32 > 0.3 * A_SECOND


def test_closing_leaves_no_thread_and_a_camera_at_rest(
    kinect: Kinect, bus: InsideBus
) -> None:
    before = threading.active_count()
    opened = KinectSensor("kinect", bus)
    opened.frame()
    opened.close()
    opened.close()
    assert kinect.camera.modes() == ()
    assert threading.active_count() == before
    KinectSensor("kinect", bus).close()


def test_a_frame_after_closing_opens_it_again(sensor: KinectSensor) -> None:
    sensor.close()
    assert sensor.frame().time > 0


def test_lost_packets_cost_frames_and_are_counted(
    kinect: Kinect, sensor: KinectSensor
) -> None:
    sensor.frame()
    kinect.faults = Faults(
        packets=tuple(
            PacketFault(harm, every=4_000 + 100 * place)
            for place, harm in enumerate(Harm)
        ),
    )
    views = [view.depth for view in kinect.show.views]

    def suffered() -> bool:
        depth = sensor.capture().depth
        assert any(np.array_equal(depth, view) for view in views)
        counts = sensor.counts[DEPTH]
        return min(counts.lost, counts.broken, counts.strange) > 0

    until(suffered)


def test_unplugged_and_plugged_in_again_it_goes_on(
    kinect: Kinect, bus: InsideBus, sensor: KinectSensor
) -> None:
    def recovered() -> float:
        """Seconds until it went on."""
        back: list[float] = []

        def plug() -> None:
            bus.plug(kinect)
            back.append(time.monotonic())

        sensor.frame()
        bus.unplug(kinect)
        timer = threading.Timer(0.5, plug)
        timer.start()
        while not back:
            sensor.frame()
        took = time.monotonic() - back[0]
        timer.join()
        return took

    # Only a machine that is busy all the time makes it slow three times.
    assert any(recovered() < 2.0 for _ in range(3))


@pytest.mark.usefixtures("hasty")
def test_unplugged_for_long_it_says_so(
    kinect: Kinect, bus: InsideBus, sensor: KinectSensor
) -> None:
    sensor.frame()
    bus.unplug(kinect)
    with pytest.raises(SensorError, match="no Kinect is plugged in"):
        sensor.frame()
    bus.plug(kinect)
    assert sensor.frame().time > 0


def test_a_stall_is_got_over(kinect: Kinect, sensor: KinectSensor) -> None:
    early = sensor.capture().ticks_depth
    kinect.faults = Faults(silent=frozenset({0x81, 0x82}))
    timer = threading.Timer(0.3, lambda: setattr(kinect, "faults", NONE))
    timer.start()
    until(lambda: (sensor.capture().ticks_depth - early) % 2**32 > 0.3 * A_SECOND)
    timer.join()


@pytest.mark.slow
@pytest.mark.usefixtures("hasty")
@pytest.mark.parametrize(
    ("faults", "said"),
    [
        (Faults(silent=frozenset({0x81, 0x82})), "another USB port, a USB 2 one"),
        (Faults(silent=frozenset({0x81})), "one of its two cameras sends nothing"),
        (Faults(packets=(PacketFault(Harm.LOST, every=50),)), "no picture is whole"),
        (Faults(stalled=True), "it does not answer"),
        (Faults(reply=Reply.MAGIC), "it answers nonsense"),
        (Faults(broken=True), "USB transfers|no pictures|status"),
    ],
)
def test_pictures_that_do_not_come(
    kinect: Kinect, bus: InsideBus, faults: Faults, said: str
) -> None:
    opened = KinectSensor("kinect", bus)
    opened.frame()
    opened.close()
    kinect.faults = faults
    with pytest.raises(SensorError, match=said):
        opened.frame()
    opened.close()


@pytest.mark.parametrize("reply", [Reply.MAGIC, Reply.TAG, Reply.SHORT, Reply.LENGTH])
def test_replies_that_are_nonsense(
    kinect: Kinect, bus: InsideBus, reply: Reply
) -> None:
    kinect.faults = Faults(reply=reply)
    assert "it answers nonsense" in problem_of(bus)


def test_replies_that_come_late_are_waited_for(kinect: Kinect, bus: InsideBus) -> None:
    kinect.faults = Faults(reply=Reply.LATE)
    KinectSensor("kinect", bus).close()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("faults", "said"),
    [
        (Faults(forbidden=True), "no permission to open it; echo 'SUB"),
        (Faults(busy=True), "another program has it|modprobe -r gspca_kinect"),
        (Faults(stalled=True), "it does not answer"),
        (Faults(reply=Reply.NEVER), "it does not answer"),
    ],
)
def test_what_cannot_be_opened(
    kinect: Kinect, bus: InsideBus, faults: Faults, said: str
) -> None:
    kinect.faults = faults
    with pytest.raises(SensorError, match=said):
        KinectSensor("kinect", bus)
    kinect.faults = NONE
    KinectSensor("kinect", bus).close()


def test_what_is_plugged_in_instead() -> None:
    assert "no Kinect is plugged in" in problem_of(InsideBus(Host()))
    bare = InsideBus(Host(Kinect(model=UNPOWERED)))
    assert "plug in the Kinect's own power supply" in problem_of(bare)
    second = InsideBus(Host(Kinect(model=SECOND_KINECT)))
    assert "this is a Kinect v2" in problem_of(second)


@pytest.mark.parametrize("model", [MODEL_1473, FOR_WINDOWS])
def test_later_models_see_but_do_not_nod(model) -> None:
    kinect = Kinect(model=model, serial="B5")
    with InsideBus(Host(kinect)).running() as bus:
        opened = KinectSensor("kinect:A5", bus)
        assert opened.capture().tilt is None
        with pytest.raises(SensorError, match="turn its head by hand"):
            opened.tilt(5)
        opened.close()
        assert "turn its head by hand" in problem_of(bus, "kinect?tilt=5")
        KinectSensor("kinect", bus).close()


def test_head_and_light(kinect: Kinect, sensor: KinectSensor) -> None:
    sensor.tilt(-20)
    sensor.light(Light.GREEN)
    assert sensor.posture().moving
    assert sensor.capture().tilt is not None


def test_options_are_set_when_it_is_opened(bus: InsideBus) -> None:
    opened = KinectSensor("kinect?tilt=10&light=red", bus)
    assert opened.posture().moving
    opened.close()
    assert "degrees from -31" in problem_of(bus, "kinect?tilt=90")
    assert "no option 'tlit'" in problem_of(bus, "kinect?tlit=9")


def test_the_infrared_picture_lies_on_the_depth(bus: InsideBus, kinect: Kinect) -> None:
    opened = KinectSensor("kinect?picture=infrared", bus)
    capture = opened.capture()
    opened.close()
    assert any(
        np.array_equal(capture.colour[:, :, 0], view.infrared[:480] >> 2)
        for view in kinect.show.views
    )


def test_two_kinects_by_their_numbers() -> None:
    one, two = Kinect(serial="B1"), Kinect(serial="B2")
    one.show.views, two.show.views = one.show.views[:1], two.show.views[1:2]
    with InsideBus(Host(one, two)).running() as bus:
        second = KinectSensor("kinect:B2", bus)
        first = KinectSensor("kinect:B1", bus)
        assert np.array_equal(first.capture().depth, one.show.views[0].depth)
        assert np.array_equal(second.capture().depth, two.show.views[0].depth)
        first.close()
        assert np.array_equal(second.capture().depth, two.show.views[0].depth)
        second.close()
        assert "plugged in: B1 and B2" in problem_of(bus, "kinect:B3")


def test_one_kinect_is_had_by_one(sensor: KinectSensor, bus: InsideBus) -> None:
    sensor.frame()
    assert "has it" in problem_of(bus)


def test_failures_in_taking_frames_are_counted(bus: InsideBus) -> None:
    camera = KinectCamera(bus.open(bus.devices()[-1], 0))
    done = threading.Event()

    def fail(frame: RawFrame) -> None:
        done.set()
        raise ValueError("no room")

    feed = camera.start(DEPTH_10, fail)
    assert done.wait(LONG)
    camera.stop(feed)
    camera.close()
    assert feed.failures >= 1
    assert isinstance(feed.failure, ValueError)
    assert feed.ended is None


@pytest.mark.parametrize(("mode", "shift"), [(DEPTH_10, 1), (INFRARED, 0)])
def test_other_streams(bus: InsideBus, kinect: Kinect, mode, shift: int) -> None:
    camera = KinectCamera(bus.open(bus.devices()[-1], 0))
    frames: list[RawFrame] = []
    feed = camera.start(mode, frames.append)
    until(lambda: frames)
    camera.stop(feed)
    camera.close()
    views = kinect.show.views
    true = [view.depth >> 1 if shift else view.infrared for view in views]
    assert any(np.array_equal(unpack_10(frames[0].data), it) for it in true)


def test_registers_can_be_read(bus: InsideBus) -> None:
    camera = KinectCamera(bus.open(bus.devices()[-1], 0))
    feed = camera.start(DEPTH_10, lambda frame: None)
    assert (camera.register(0x06), camera.register(0x12)) == (2, 2)
    camera.stop(feed)
    assert camera.register(0x06) == 0
    camera.close()


def test_a_start_that_fails_leaves_nothing_behind(
    kinect: Kinect, bus: InsideBus
) -> None:
    kinect.faults = Faults(stalled=True)
    before = threading.active_count()
    problem_of(bus)
    assert threading.active_count() == before
    camera = KinectCamera(bus.open(bus.devices()[-1], 0))
    with pytest.raises(TransportError):
        camera.rest()
    camera.close()
