"""What every transport owes the driver, on an emulated Kinect."""

from __future__ import annotations

import gc
import struct
import threading
import time
import weakref
from collections.abc import Callable

import numpy as np
import pytest

from kille.sensors.kinect.transport import (
    AccessDeniedError,
    Batch,
    Connection,
    DeviceBusyError,
    DeviceGoneError,
    PluggedDevice,
    StalledError,
)
from kinect_emulator.descriptors import (
    FOR_WINDOWS,
    MODEL_1414,
    MODEL_1473,
    NO_SERIAL,
    SECOND_KINECT,
    UNPOWERED,
    Model,
)
from kinect_emulator.faults import Faults
from kinect_emulator.kinect import Kinect
from kinect_emulator.modes import DEPTH_11, HEADER

CAMERAS = (0x02AE, 0x02BF)
DEPTH, PACKET_SIZE = 0x82, 1_760
TOO_LONG = 60.0
START_DEPTH = ((0x105, 0), (0x06, 0), (0x12, 3), (0x13, 1), (0x14, 30), (0x06, 2))


class Packets:
    """A receiver that keeps what comes, and can be waited for."""

    def __init__(self) -> None:
        self.kept: list[bytes] = []
        self.calls = 0
        self._came = threading.Condition()

    def __call__(self, batch: Batch) -> None:
        with self._came:
            self.calls += 1
            rows = zip(batch.packets, batch.lengths, strict=True)
            self.kept += [row[:length].tobytes() for row, length in rows if length]
            self._came.notify_all()

    def wait(self, count: int) -> list[bytes]:
        """The packets, when there are so many."""
        self.until(lambda: len(self.kept) >= count)
        return list(self.kept)

    def until(self, reached: Callable[[], bool]) -> None:
        """Wait for something that comes with packets."""
        with self._came:
            assert self._came.wait_for(reached, TOO_LONG)


def camera(devices: tuple[PluggedDevice, ...]) -> PluggedDevice:
    """The first camera."""
    return next(it for it in devices if it.product in CAMERAS)


def order(connection: Connection, number: int, *words: int) -> bytes:
    """One command and its reply."""
    head = struct.pack("<2s3H", b"GM", len(words), number, 7)
    connection.write(0, 0, 0, head + struct.pack(f"<{len(words)}H", *words))
    return connection.read(0, 0, 0, 0x200)


def start_depth(connection: Connection) -> None:
    """Let the camera send depth."""
    for register, value in START_DEPTH:
        order(connection, 0x03, register, value)


def test_devices_tell_who_and_where_they_are(wired_both: Callable) -> None:
    first, second = Kinect(serial="B0001"), Kinect(serial="B0002")
    found = wired_both(first, second).bus.devices()
    assert [it.serial for it in found if it.product == 0x02AE] == ["B0001", "B0002"]
    assert [it.product for it in found] == 2 * [0x02B0, 0x02AD, 0x02AE]
    assert len({it.place for it in found}) == 6
    assert len({it.place[:-1] for it in found}) == 2
    assert found == tuple(sorted(found, key=lambda it: it.place))
    assert {it.release for it in found if it.product == 0x02AE} == {0x010B}


@pytest.mark.parametrize(
    ("model", "serial"),
    [(MODEL_1414, "B7"), (MODEL_1473, NO_SERIAL), (FOR_WINDOWS, NO_SERIAL)],
    ids=lambda it: getattr(it, "name", it),
)
def test_cameras_of_all_models_are_found(
    wired: Callable, model: Model, serial: str
) -> None:
    assert (
        camera(wired(Kinect(model=model, serial="B7")).bus.devices()).serial == serial
    )


@pytest.mark.parametrize("model", [UNPOWERED, SECOND_KINECT], ids=lambda it: it.name)
def test_what_has_no_camera_shows_none(wired: Callable, model: Model) -> None:
    found = wired(Kinect(model=model)).bus.devices()
    assert found
    assert not any(it.product in CAMERAS for it in found)


def test_a_command_is_answered(wired_both: Callable) -> None:
    wire = wired_both(Kinect())
    connection = wire.bus.open(camera(wire.bus.devices()), 0)
    assert order(connection, 0x03, 0x14, 0x1E) == bytes.fromhex("52420100030007000000")
    read = order(connection, 0x02, 0x14)
    assert struct.unpack("<2s5H", read)[-1] == 0x1E
    assert connection.read(0, 0, 0, 0x200) == b""
    connection.close()
    connection.close()


def test_packets_come_whole_and_in_order(wired_both: Callable) -> None:
    kinect = Kinect()
    wire = wired_both(kinect)
    connection = wire.bus.open(camera(wire.bus.devices()), 0)
    packets = Packets()
    stream = connection.stream(DEPTH, PACKET_SIZE, packets)
    start_depth(connection)
    came = packets.wait(2 * DEPTH_11.packets)[: 2 * DEPTH_11.packets]
    stream.stop()
    connection.close()
    assert stream.ended is None
    assert [it[5] for it in came] == [number % 256 for number in range(len(came))]
    frame = b"".join(it[HEADER:] for it in came[: DEPTH_11.packets])
    assert frame == kinect.show.payload(DEPTH_11, 0)


def test_after_stop_nothing_is_received(wired: Callable) -> None:
    wire = wired(Kinect())
    connection = wire.bus.open(camera(wire.bus.devices()), 0)
    packets = Packets()
    stream = connection.stream(DEPTH, PACKET_SIZE, packets)
    start_depth(connection)
    packets.wait(10)
    stream.stop()
    calls = packets.calls
    time.sleep(0.1)
    assert packets.calls == calls
    stream.stop()
    again = Packets()
    connection.stream(DEPTH, PACKET_SIZE, again)
    again.wait(10)
    connection.close()
    calls = again.calls
    time.sleep(0.05)
    assert again.calls == calls


def test_what_is_closed_is_freed_without_a_search_for_cycles(wired: Callable) -> None:
    wire = wired(Kinect())
    gc.collect()
    gc.disable()
    try:
        connection = wire.bus.open(camera(wire.bus.devices()), 0)
        packets = Packets()
        held = weakref.ref(connection.stream(DEPTH, PACKET_SIZE, packets))
        start_depth(connection)
        packets.wait(10)
        connection.close()
        held_packets = weakref.ref(packets)
        del connection, packets
        deadline = time.monotonic() + TOO_LONG
        # The thread that took the last packets may have them in its hands.
        while held() or held_packets():
            assert time.monotonic() < deadline
            time.sleep(0.01)
    finally:
        gc.enable()


def test_pulling_it_out_ends_the_stream_and_plugging_in_begins_anew(
    wired: Callable,
) -> None:
    kinect = Kinect()
    wire = wired(kinect)
    before = camera(wire.bus.devices())
    connection = wire.bus.open(before, 0)
    packets = Packets()
    stream = connection.stream(DEPTH, PACKET_SIZE, packets)
    start_depth(connection)
    packets.wait(10)
    wire.unplug(kinect)
    deadline = time.monotonic() + TOO_LONG
    while stream.ended is None and time.monotonic() < deadline:
        time.sleep(0.01)
    assert isinstance(stream.ended, DeviceGoneError)
    with pytest.raises(DeviceGoneError):
        order(connection, 0x02, 0x14)
    with pytest.raises(DeviceGoneError):
        wire.bus.open(before, 0)
    assert wire.bus.devices() == ()
    connection.close()
    wire.plug(kinect)
    connection = wire.bus.open(camera(wire.bus.devices()), 0)
    packets = Packets()
    stream = connection.stream(DEPTH, PACKET_SIZE, packets)
    start_depth(connection)
    assert packets.wait(10)[0][5] == 0
    connection.close()


def test_it_may_be_plugged_in_as_often_as_one_likes(wired: Callable) -> None:
    kinect = Kinect()
    wire = wired(kinect)
    for _ in range(80):
        wire.unplug(kinect)
        wire.plug(kinect)
    wire.bus.open(camera(wire.bus.devices()), 0).close()


@pytest.mark.parametrize(
    ("faults", "error"),
    [(Faults(forbidden=True), AccessDeniedError), (Faults(busy=True), DeviceBusyError)],
    ids=["forbidden", "busy"],
)
def test_what_cannot_be_had_says_why(
    wired: Callable, faults: Faults, error: type[Exception]
) -> None:
    kinect = Kinect()
    kinect.faults = faults
    wire = wired(kinect)
    with pytest.raises(error):
        wire.bus.open(camera(wire.bus.devices()), 0)
    kinect.faults = Faults()
    wire.bus.open(camera(wire.bus.devices()), 0).close()


def test_one_camera_is_had_by_one_at_a_time(wired_both: Callable) -> None:
    wire = wired_both(Kinect())
    device = camera(wire.bus.devices())
    connection = wire.bus.open(device, 0)
    with pytest.raises(DeviceBusyError):
        wire.bus.open(device, 0)
    connection.close()
    wire.bus.open(device, 0).close()


def test_a_refused_request_is_stalled(wired_both: Callable) -> None:
    kinect = Kinect()
    wire = wired_both(kinect)
    connection = wire.bus.open(camera(wire.bus.devices()), 0)
    kinect.faults = Faults(stalled=True)
    with pytest.raises(StalledError):
        order(connection, 0x02, 0x14)
    kinect.faults = Faults()
    assert order(connection, 0x02, 0x14)
    connection.close()


def test_failed_packets_have_no_length(wired_both: Callable) -> None:
    kinect = Kinect()
    wire = wired_both(kinect)
    connection = wire.bus.open(camera(wire.bus.devices()), 0)
    kinect.faults = Faults(broken=True)
    packets = Packets()
    connection.stream(DEPTH, PACKET_SIZE, packets)
    start_depth(connection)
    # More than were under way when the camera began to send.
    enough = packets.calls + 20
    packets.until(lambda: packets.calls >= enough)
    assert packets.kept == []
    kinect.faults = Faults()
    packets.wait(10)
    connection.close()


def test_a_camera_for_windows_streams_in_its_second_setting(wired: Callable) -> None:
    kinect = Kinect(model=FOR_WINDOWS)
    wire = wired(kinect)
    connection = wire.bus.open(camera(wire.bus.devices()), 1)
    packets = Packets()
    connection.stream(DEPTH, PACKET_SIZE, packets)
    start_depth(connection)
    packets.wait(10)
    connection.close()


def test_both_streams_run_at_their_pace(wired: Callable) -> None:
    wire = wired(Kinect())
    connection = wire.bus.open(camera(wire.bus.devices()), 0)
    depth, video = Packets(), Packets()
    connection.stream(DEPTH, PACKET_SIZE, depth)
    connection.stream(0x81, 1_920, video)
    start_depth(connection)
    for register, value in ((0x0C, 0), (0x0D, 1), (0x0E, 30), (0x05, 1)):
        order(connection, 0x03, register, value)
    video.wait(5 * 162)
    connection.close()
    for packets, per_frame in ((depth, 242), (video, 162)):
        numbers = np.array([it[5] for it in packets.kept])
        assert set(np.diff(numbers) % 256) == {1}
        assert len(numbers) >= 4 * per_frame
