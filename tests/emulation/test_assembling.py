"""The driver puts frames together from what the emulator sends, whatever is harmed."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.sensors.kinect import streams
from kille.sensors.kinect.packets import Assembler
from kille.sensors.kinect.transport import Batch
from kinect_emulator import modes
from kinect_emulator.faults import NONE, Faults, Harm, PacketFault
from kinect_emulator.pictures import patterns
from kinect_emulator.stream import Stream, Window

SHOW = patterns(3)
PAIRS = (
    (streams.DEPTH_11, modes.DEPTH_11),
    (streams.DEPTH_10, modes.DEPTH_10),
    (streams.COLOUR, modes.BAYER),
    (streams.INFRARED, modes.INFRARED),
)
STEP = 128

faults = st.builds(
    PacketFault,
    harm=st.sampled_from(Harm),
    every=st.integers(150, 2_000),
    run=st.integers(1, 20),
    spared=st.integers(0, 600),
)


def batch(window: Window, size: int) -> Batch:
    """The packets in rows."""
    rows = np.zeros((len(window.lengths), size), np.uint8)
    at = 0
    for row, length in zip(rows, window.lengths.tolist(), strict=True):
        row[:length] = np.frombuffer(window.data[at : at + length], np.uint8)
        at += length
    return Batch(rows, window.lengths.astype(np.int32), 0.0)


def assembled(
    ours: streams.Mode, mode: modes.Mode, wrong: Faults, microframes: int
) -> tuple[list[bytes], Assembler]:
    """The frames that come out, and what put them together."""
    stream, assembler = Stream(mode, SHOW, start=5, ticks=2**32 - 3), Assembler(ours)
    frames = []
    for first in range(0, microframes, STEP):
        window = stream.window(first, STEP, wrong)
        came = assembler.feed(batch(window, ours.packet_size))
        frames += [frame.data.tobytes() for frame in came]
    return frames, assembler


@pytest.mark.parametrize(("ours", "mode"), PAIRS, ids=lambda it: it.name)
def test_every_frame_of_a_good_stream_comes_whole(
    ours: streams.Mode, mode: modes.Mode
) -> None:
    frames, assembler = assembled(ours, mode, NONE, 1_664)
    assert frames == [SHOW.payload(mode, number) for number in range(6)]
    assert (assembler.counts.lost, assembler.counts.strange) == (0, 0)


@given(st.sampled_from(PAIRS), st.lists(faults, min_size=1, max_size=4))
def test_no_mixture_of_harms_makes_a_wrong_frame(
    pair: tuple[streams.Mode, modes.Mode], harms: list[PacketFault]
) -> None:
    frames, _ = assembled(*pair, Faults(packets=tuple(harms)), 1_664)
    shown = [SHOW.payload(pair[1], number) for number in range(3)]
    assert all(frame in shown for frame in frames)
