"""Debian's freenect-camtest streams depth and colour from the emulated Kinect."""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import pytest

from kinect_emulator.descriptors import FOR_WINDOWS, MODEL_1414, MODEL_1473, Model
from kinect_emulator.faults import Faults, Harm, PacketFault
from kinect_emulator.kinect import Kinect
from kinect_emulator.running import After, Ran, run
from kinect_emulator.server import Server

pytestmark = pytest.mark.oracle

COUNT = 24
TICKS_PER_FRAME = 2_000_000
COMPLAINTS = re.compile(r"Lost|Inconsistent|Invalid|Expected|[Ee]rror|Failed")

START_DEPTH = [(0x105, 0), (0x06, 0), (0x12, 3), (0x13, 1), (0x14, 30), (0x06, 2)]
START_COLOUR = [(0x0C, 0), (0x0D, 1), (0x0E, 30), (0x05, 1)]
NOT_MIRRORED = [(0x17, 0)], [(0x47, 0)]
STOP = [(0x06, 0), (0x05, 0)]


def times(ran: Ran, stream: str) -> list[int]:
    """When frames of that stream came, in the device's ticks."""
    found = re.findall(rf"Received {stream} frame at (-?\d+)", ran.out)
    return [int(it) for it in found]


@pytest.mark.slow
@pytest.mark.parametrize(
    "model", [MODEL_1414, MODEL_1473, FOR_WINDOWS], ids=lambda model: model.name
)
def test_every_frame_of_every_model_comes(
    ran: Callable[..., Ran], model: Model
) -> None:
    kinect = Kinect(model=model)
    done = ran(kinect, "freenect-camtest", enough=After("Received depth", COUNT))
    assert not COMPLAINTS.search(done.err), done.err
    for stream in ("depth", "video"):
        came = times(done, stream)
        steps = {(b - a) % 2**32 for a, b in pairwise(came)}
        assert len(came) >= COUNT - 1
        assert steps == {TICKS_PER_FRAME}
    depth_flag, colour_flag = NOT_MIRRORED
    sent = START_DEPTH + depth_flag + START_COLOUR + colour_flag + STOP
    assert kinect.camera.written() == sent


def test_each_lost_packet_is_missed(ran: Callable[..., Ran]) -> None:
    kinect = Kinect()
    lost = PacketFault(Harm.LOST, every=1_000, run=2, endpoint=0x82, spared=990)
    kinect.faults = Faults(packets=(lost,))
    done = ran(kinect, "freenect-camtest", enough=After("Received depth", COUNT))
    missed = re.findall(r"\[Stream (\d\d)\] Lost (\d+) packets", done.err)
    frames = len(times(done, "depth"))
    assert len(missed) >= frames * 242 // 1_000 - 1 > 3
    assert set(missed) == {("70", "2")}


def test_a_header_of_no_kinect_is_noticed(ran: Callable[..., Ran]) -> None:
    kinect = Kinect()
    kinect.faults = Faults(packets=(PacketFault(Harm.ALIEN, every=100, spared=990),))
    done = ran(kinect, "freenect-camtest", enough=After("Received depth", COUNT))
    assert "Invalid magic 5842" in done.err


def test_being_unplugged_is_noticed(
    libusb: Path,
    program: Callable[[str], str],
    serve: Callable[..., Server],
    tmp_path: Path,
) -> None:
    camtest = program("freenect-camtest")
    kinect = Kinect()
    server = serve(kinect)
    tenth = After("Received depth", 10)

    def pull(line: str) -> bool:
        if tenth(line):
            server.unplug(kinect)
        return False

    done = run([camtest], libusb, server, tmp_path, pull)
    assert len(times(done, "depth")) >= 10
    assert "USB camera marked dead" in done.err
