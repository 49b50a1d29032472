"""The Kinect as a sensor, whatever happens to it, over every transport."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager

import numpy as np
import pytest

from kille.sensors.kinect import sensor as sensors
from kille.sensors.kinect.bayer import colour_of
from kille.sensors.kinect.capture import KinectCapture
from kille.sensors.kinect.sensor import KinectSensor
from kille.sensors.kinect.transport import Connection, PluggedDevice, TransportBus
from kille.sensors.sensor import SensorError
from kinect_emulator.descriptors import (
    FOR_WINDOWS,
    MODEL_1473,
    SECOND_KINECT,
    UNPOWERED,
    Model,
)
from kinect_emulator.encoding import mosaic
from kinect_emulator.faults import Faults, Harm, PacketFault, Reply
from kinect_emulator.kinect import Kinect
from kinect_emulator.pictures import Show, patterns

SHOW = patterns(3)


def shown(capture: KinectCapture, show: Show = SHOW) -> bool:
    """Whether both pictures are views as they were shown, to the last bit."""
    depth = any(np.array_equal(capture.depth, view.depth) for view in show.views)
    colours = (colour_of(mosaic(view.colour)) for view in show.views)
    return depth and any(np.array_equal(capture.colour, it) for it in colours)


def opened(wired: Callable, kinect: Kinect, name: str = "kinect") -> closing:
    """A sensor on a bus with that Kinect."""
    return closing(KinectSensor(name, wired(kinect).bus))


def one_line(error: pytest.ExceptionInfo) -> str:
    """The message, which is one line that begins with the sensor's name."""
    text = str(error.value)
    assert "\n" not in text
    assert text.startswith("kinect")
    return text


def test_frames_are_what_is_shown(wired_both: Callable) -> None:
    with opened(wired_both, Kinect(SHOW)) as sensor:
        captures = [sensor.capture() for _ in range(6)]
    assert all(map(shown, captures))
    steps = np.diff([it.ticks_depth for it in captures]) % 2**32
    assert all(step % 2_000_000 == 0 and step > 0 for step in steps)


@pytest.mark.slow
@pytest.mark.parametrize("harm", Harm, ids=lambda harm: harm.name.lower())
def test_no_harm_to_packets_makes_a_wrong_frame(wired: Callable, harm: Harm) -> None:
    kinect = Kinect(SHOW)
    # Less than one in two frames of either stream is hit.
    kinect.faults = Faults(packets=(PacketFault(harm, every=700, spared=100),))
    with opened(wired, kinect) as sensor:
        captures = [sensor.capture() for _ in range(6)]
        counts = sensor.counts
    assert all(map(shown, captures))
    assert sum(it.broken for it in counts.values()) > 0


@pytest.mark.slow
@pytest.mark.parametrize(
    "reply", [it for it in Reply if it is not Reply.LATE], ids=lambda it: it.name
)
def test_wrong_replies_are_refused(wired: Callable, reply: Reply) -> None:
    kinect = Kinect()
    kinect.faults = Faults(reply=reply)
    with pytest.raises(SensorError) as error:
        KinectSensor("kinect", wired(kinect).bus)
    one_line(error)


def test_late_replies_are_waited_for(wired_both: Callable) -> None:
    kinect = Kinect(SHOW)
    kinect.faults = Faults(reply=Reply.LATE)
    with opened(wired_both, kinect) as sensor:
        assert shown(sensor.capture())


@pytest.mark.parametrize(
    "faults",
    [Faults(stalled=True), Faults(forbidden=True), Faults(busy=True)],
    ids=["stalled", "forbidden", "busy"],
)
def test_a_kinect_that_cannot_be_had_is_a_line(wired: Callable, faults: Faults) -> None:
    kinect = Kinect()
    kinect.faults = faults
    with pytest.raises(SensorError) as error:
        KinectSensor("kinect", wired(kinect).bus)
    one_line(error)


def test_a_kernel_driver_is_moved_aside_and_put_back(libusb: Callable) -> None:
    kinect = Kinect(SHOW)
    kinect.faults = Faults(driven=True)
    wire = libusb(kinect)
    for _ in range(2):
        with closing(KinectSensor("kinect", wire.bus)) as sensor:
            assert shown(sensor.capture())


@pytest.mark.parametrize("model", [UNPOWERED, SECOND_KINECT], ids=lambda it: it.name)
def test_what_is_no_whole_kinect_is_a_line(wired: Callable, model: Model) -> None:
    with pytest.raises(SensorError) as error:
        KinectSensor("kinect", wired(Kinect(model=model)).bus)
    one_line(error)


def test_none_at_all_is_a_line(wired: Callable) -> None:
    with pytest.raises(SensorError) as error:
        KinectSensor("kinect", wired().bus)
    one_line(error)


@pytest.mark.parametrize("model", [MODEL_1473, FOR_WINDOWS], ids=lambda it: it.name)
def test_newer_models_see_but_do_not_tilt(wired: Callable, model: Model) -> None:
    with opened(wired, Kinect(SHOW, model)) as sensor:
        assert shown(sensor.capture())
        with pytest.raises(SensorError) as error:
            sensor.tilt(10)
    one_line(error)


def test_the_head_turns(wired_both: Callable) -> None:
    kinect = Kinect(SHOW)
    with opened(wired_both, kinect) as sensor:
        sensor.tilt(-10)
        deadline = time.monotonic() + 60
        while sensor.posture().degrees != -10 and time.monotonic() < deadline:
            time.sleep(0.02)
        assert sensor.posture().degrees == -10
    assert kinect.motor.tilts == [-20]


def test_infrared_is_seen_as_it_is(wired: Callable) -> None:
    kinect = Kinect(SHOW)
    with opened(wired, kinect, "kinect?picture=infrared") as sensor:
        capture = sensor.capture()
    greys = [view.infrared[:480] >> 2 for view in SHOW.views]
    assert any(np.array_equal(capture.colour[:, :, 0], it) for it in greys)
    assert any(np.array_equal(capture.depth, view.depth) for view in SHOW.views)
    assert kinect.camera.registers[0x05] == 0


def test_two_kinects_are_told_apart_by_serial(wired: Callable) -> None:
    left, right = Kinect(patterns(1, 5), serial="B1"), Kinect(SHOW, serial="B2")
    bus = wired(left, right).bus
    with (
        closing(KinectSensor("kinect:B2", bus)) as second,
        closing(KinectSensor("kinect:B1", bus)) as first,
    ):
        assert shown(first.capture(), left.show)
        assert shown(second.capture(), right.show)
    with pytest.raises(SensorError) as error:
        KinectSensor("kinect:B3", bus)
    assert "B1" in one_line(error)


@contextmanager
def hasty() -> Iterator[None]:
    """Sensors that give a silent Kinect up sooner, to save time."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sensors, "PATIENCE", 0.6)
        patch.setattr(sensors, "_SILENCE", 0.2)
        yield


@pytest.mark.slow
@pytest.mark.parametrize("silent", [{0x81}, {0x81, 0x82}], ids=str)
def test_a_silent_camera_is_a_line(wired: Callable, silent: set[int]) -> None:
    kinect = Kinect()
    kinect.faults = Faults(silent=frozenset(silent))
    with (
        opened(wired, kinect) as sensor,
        hasty(),
        pytest.raises(SensorError) as error,
    ):
        sensor.capture()
    one_line(error)


class Watched:
    """A bus, and how often somebody looked what is on it."""

    def __init__(self, bus: TransportBus) -> None:
        self._bus = bus
        self.looks = 0

    def devices(self) -> tuple[PluggedDevice, ...]:
        self.looks += 1
        return self._bus.devices()

    def open(self, device: PluggedDevice, alternate: int) -> Connection:
        return self._bus.open(device, alternate)


def test_frames_go_on_when_it_is_plugged_in_again(wired_both: Callable) -> None:
    kinect = Kinect(SHOW)
    wire = wired_both(kinect)
    bus = Watched(wire.bus)
    with closing(KinectSensor("kinect", bus)) as sensor:
        assert shown(sensor.capture())
        for _ in range(2):
            wire.unplug(kinect)
            wire.plug(kinect)
            looks = bus.looks
            # What came before may still be given: no more than a few.
            captures = [sensor.capture() for _ in range(6)]
            assert all(map(shown, captures))
            # It is found as soon as it is missed: how soon that is in seconds, the
            # benchmark says.
            assert bus.looks == looks + 1


def test_one_that_stays_away_is_a_line(wired: Callable) -> None:
    kinect = Kinect(SHOW)
    wire = wired(kinect)
    with closing(KinectSensor("kinect", wire.bus)) as sensor:
        assert shown(sensor.capture())
        wire.unplug(kinect)
        with hasty(), pytest.raises(SensorError) as error:
            [sensor.capture() for _ in range(5)]
        one_line(error)
        wire.plug(kinect)
        assert shown(sensor.capture())
