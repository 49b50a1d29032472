"""The emulator by itself: its clock, its packets, its bus. Nothing of the driver."""

from __future__ import annotations

import struct
from collections import Counter
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kinect_emulator.calibration import LIKELY
from kinect_emulator.camera import Camera, CommandError
from kinect_emulator.encoding import packed
from kinect_emulator.faults import Faults, Harm, PacketFault
from kinect_emulator.host import Code, Completion, Host, Status, UsbError
from kinect_emulator.kinect import Kinect
from kinect_emulator.modes import (
    BAYER,
    BAYER_LARGE,
    DEPTH_10,
    DEPTH_11,
    HEADER,
    INFRARED,
    Mode,
)
from kinect_emulator.motor import AT_LIMIT, MOVING, STOPPED, Motor
from kinect_emulator.pictures import patterns
from kinect_emulator.stream import Stream, Window

SHOW = patterns(2)
MODES = (DEPTH_11, DEPTH_10, BAYER, BAYER_LARGE, INFRARED)
modes = st.sampled_from(MODES)
moments = st.integers(0, 100_000)


def packets(window: Window) -> list[bytes]:
    """The packets one by one."""
    ends = np.cumsum(window.lengths)
    cut = [window.data[a:b] for a, b in pairwise([0, *ends.tolist()])]
    return [packet for packet in cut if packet]


@given(modes, moments)
def test_a_packet_is_due_once(mode: Mode, number: int) -> None:
    due = mode.due(number)
    assert mode.before(due) <= number < mode.before(due + 1)
    assert mode.before(due + 1) - mode.before(due) == 1


@pytest.mark.parametrize("mode", MODES, ids=lambda mode: mode.name)
def test_a_tenth_of_a_second_has_whole_frames(mode: Mode) -> None:
    assert mode.before(800) == mode.frames * mode.packets


@given(modes, st.integers(0, 1_500), st.integers(0, 300), st.integers(0, 300))
def test_windows_join(mode: Mode, first: int, count: int, more: int) -> None:
    def window(begin: int, length: int) -> Window:
        return Stream(mode, SHOW, start=100).window(begin, length, Faults())

    whole = window(first, count + more)
    left, right = window(first, count), window(first + count, more)
    assert whole.data == left.data + right.data
    assert np.array_equal(whole.lengths, np.append(left.lengths, right.lengths))
    assert int(whole.lengths.sum()) == len(whole.data)


@pytest.mark.parametrize("mode", MODES, ids=lambda mode: mode.name)
def test_a_frame_carries_its_payload(mode: Mode) -> None:
    stream = Stream(mode, SHOW, start=0, ticks=2**32 - 1)
    came = packets(stream.window(0, 801, Faults()))[: mode.packets]
    assert b"".join(it[HEADER:] for it in came) == SHOW.payload(mode, 0)
    flags = Counter(it[3] - mode.base for it in came)
    assert flags == {1: 1, 2: mode.packets - 2, 5: 1}
    assert came[0][3] == mode.base | 1
    assert came[-1][3] == mode.base | 5
    assert {struct.unpack_from("<I", it, 8)[0] for it in came} == {2**32 - 1}


@given(st.lists(st.integers(0, 2_047), min_size=8, max_size=64))
def test_packing_is_binary_in_a_row(values: list[int]) -> None:
    whole = values[: len(values) // 8 * 8]
    bits = "".join(f"{value:011b}" for value in whole)
    expected = int(bits, 2).to_bytes(len(bits) // 8, "big")
    assert packed(np.array(whole, np.uint16), 11) == expected


def harmed(*faults: PacketFault) -> list[bytes]:
    """What a stream of depth sends in half a second under those faults."""
    stream = Stream(DEPTH_11, SHOW, start=0)
    return packets(stream.window(0, 4_000, Faults(packets=faults)))


def test_each_harm_is_what_it_says() -> None:
    stream = Stream(DEPTH_11, SHOW, start=0)
    plain = packets(stream.window(0, 4_000, Faults()))
    at = 300

    def after(harm: Harm) -> list[bytes]:
        fault = PacketFault(harm, every=10**6, spared=at)
        came = harmed(fault)
        assert came[:at] == plain[:at]
        return came[at:]

    rest = plain[at:]
    assert after(Harm.LOST) == rest[1:]
    assert after(Harm.TWICE)[: len(rest)] == [rest[0], *rest][: len(rest)]
    assert after(Harm.SWAPPED) == [rest[1], rest[0], *rest[2:]]
    assert after(Harm.CUT) == [rest[0][: len(rest[0]) // 2], *rest[1:]]
    assert after(Harm.ALIEN)[0][:2] == b"XB"
    assert after(Harm.MISPLACED)[0][3] == 0x71


class Bench:
    """A host with one Kinect whose camera is opened, claimed and sends depth."""

    def __init__(self, patience: int = 0) -> None:
        self.kinect = Kinect(SHOW)
        self.host = Host(self.kinect, patience=patience)
        self.handle = self.host.open(5)
        self.host.claim(self.handle)
        for register, value in ((0x12, 3), (0x06, 2)):
            message = struct.pack("<2s5H", b"GM", 2, 3, 1, register, value)
            self.host.write(self.handle, 0x40, 0, 0, message)

    def submit(self, count: int) -> None:
        """Let transfers of 64 microframes wait."""
        for _ in range(count):
            self.host.submit(self.handle, 0x82, 64, 1_760)

    def pass_time(self, microframes: int) -> list[Completion]:
        """What has ended after that."""
        self.host.pass_time(microframes)
        return self.host.ended()


def sequence(ended: list[Completion]) -> list[int]:
    """The numbers of the packets that came."""
    windows = [Window(it.lengths, it.data) for it in ended]
    return [packet[5] for window in windows for packet in packets(window)]


def test_transfers_end_in_order_when_their_time_has_passed() -> None:
    bench = Bench()
    bench.submit(3)
    assert bench.pass_time(63) == []
    ended = bench.pass_time(129)
    assert [it.transfer.packets for it in ended] == [64, 64, 64]
    assert sequence(ended) == list(range(DEPTH_11.before(192)))


def test_a_slow_client_loses_packets() -> None:
    bench = Bench()
    bench.submit(1)
    first = bench.pass_time(100)
    bench.submit(1)
    second = bench.pass_time(64)
    lost = DEPTH_11.before(100) - DEPTH_11.before(64)
    assert sequence(second)[0] == sequence(first)[-1] + 1 + lost


def test_a_patient_clock_waits_for_it_but_not_for_ever() -> None:
    bench = Bench(patience=200)
    bench.submit(1)
    first = bench.pass_time(100)
    bench.submit(1)
    second = bench.pass_time(64)
    assert sequence(second)[0] == sequence(first)[-1] + 1
    assert bench.host.waited == 36
    for _ in range(2):
        bench.pass_time(100)
    assert bench.host.now == 128
    bench.pass_time(1_000)
    assert bench.host.now == 1_128


def test_unplugging_ends_what_waits() -> None:
    bench = Bench()
    bench.submit(2)
    bench.host.unplug(bench.kinect)
    assert {it.status for it in bench.host.ended()} == {Status.NO_DEVICE}
    with pytest.raises(UsbError) as error:
        bench.submit(1)
    assert error.value.code is Code.NO_DEVICE


def test_a_cancelled_transfer_says_so_and_leaves_the_rest() -> None:
    bench = Bench()
    bench.submit(1)
    transfer = bench.host.submit(bench.handle, 0x82, 64, 1_760)
    bench.host.cancel(transfer)
    assert [it.status for it in bench.host.ended()] == [Status.CANCELLED]
    assert [it.status for it in bench.pass_time(64)] == [Status.COMPLETED]
    with pytest.raises(UsbError):
        bench.host.cancel(transfer)


def test_plugging_in_gives_new_addresses_and_forgets_settings() -> None:
    bench = Bench()
    before = set(bench.host.devices)
    bench.host.unplug(bench.kinect)
    bench.host.plug(bench.kinect)
    assert len(bench.host.devices) == len(before)
    assert before.isdisjoint(bench.host.devices)
    assert bench.kinect.streams == {}


def test_the_camera_refuses_what_is_no_command() -> None:
    camera = Camera(LIKELY)
    for message in (b"", b"XY\0\0\3\0\0\0", b"GM\2\0\3\0\0\0\1", b"GM\0\0\x77\0\0\0"):
        with pytest.raises(CommandError):
            camera.take(message)
    assert camera.reply() == b""


@given(st.binary(max_size=40), st.integers(0, 0xFFFF))
def test_any_bytes_are_answered_or_refused(payload: bytes, command: int) -> None:
    camera = Camera(LIKELY)
    words = len(payload) // 2
    message = struct.pack("<2s3H", b"GM", words, command % 0xA0, 9) + payload
    try:
        camera.take(message)
    except CommandError:
        assert camera.reply() == b""
    else:
        reply = camera.reply()
        magic, length, number, tag = struct.unpack_from("<2s3H", reply)
        assert (magic, number, tag) == (b"RB", command % 0xA0, 9)
        assert len(reply) == 8 + 2 * length


def test_the_motor_takes_its_time() -> None:
    motor = Motor()
    motor.tilt_to(40, seconds=1.0)
    assert motor.status(1.5) == MOVING
    assert motor.angle(1.5) == pytest.approx(10)
    assert motor.status(3.0) == STOPPED
    motor.tilt_to(-200, seconds=3.0)
    assert motor.angle(9.0) == -31
    assert motor.status(9.0) == AT_LIMIT
    x, y, z, twice, status = struct.unpack(">2x3hbB", motor.state(9.0))
    assert (x, twice, status) == (0, -62, AT_LIMIT)
    assert y**2 + z**2 == pytest.approx(819**2, rel=0.01)
