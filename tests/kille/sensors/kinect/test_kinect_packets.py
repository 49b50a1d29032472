"""Frames out of packets: whole and in order, however the packets come."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from hypothesis import example, given
from hypothesis import strategies as st
from numpy.typing import NDArray

from kille.sensors.kinect.packets import Assembler, RawFrame, StreamCounts
from kille.sensors.kinect.streams import COLOUR, DEPTH_10, DEPTH_11, INFRARED, Mode
from kille.sensors.kinect.transport import Batch

SMALL = Mode("small", 0x82, 20, 0x70, 5 * 8 + 3, (), ())
TICKS = 2_000_000


@dataclass(frozen=True)
class Sent:
    """Packets as they were sent: rows, lengths, and the frames they were cut from."""

    rows: NDArray[np.uint8]
    lengths: NDArray[np.int32]
    frames: list[bytes]


def sent(mode: Mode, frames: int, number: int = 0) -> Sent:
    """Frames that differ in every byte's neighbourhood, cut into packets."""
    rows, lengths, whole = [], [], []
    for frame in range(frames):
        data = (np.arange(mode.frame_size) * 7 + frame * 31).astype(np.uint8).tobytes()
        whole.append(data)
        for place in range(mode.packets):
            part = data[place * mode.body : (place + 1) * mode.body]
            end = place == mode.packets - 1
            flag = mode.mark | (5 if end else 2 if place else 1)
            count = (number + frame * mode.packets + place) % 256
            ticks = (4_294_000_000 + frame * TICKS) % 2**32
            head = b"RB\0" + bytes([flag, 0, count, 0, 0]) + ticks.to_bytes(4, "little")
            rows.append((head + part).ljust(mode.packet_size, b"\xee"))
            lengths.append(len(head + part))
    table = np.frombuffer(b"".join(rows), np.uint8).reshape(-1, mode.packet_size)
    return Sent(table, np.array(lengths, np.int32), whole)


def fed(
    mode: Mode, rows: NDArray[np.uint8], lengths: NDArray[np.int32], cuts: list[int]
) -> tuple[list[RawFrame], StreamCounts]:
    """What comes out if the packets come in batches cut there."""
    assembler = Assembler(mode)
    frames: list[RawFrame] = []
    edges = [0, *sorted({cut % (len(lengths) + 1) for cut in cuts}), len(lengths)]
    for begin, end in pairwise(edges):
        batch = Batch(rows[begin:end].copy(), lengths[begin:end].copy(), float(end))
        frames += assembler.feed(batch)
        batch.packets[:] = 0
    return frames, assembler.counts


def test_all_frames_come_out_whatever_the_stream() -> None:
    for mode in (DEPTH_11, DEPTH_10, COLOUR, INFRARED):
        packets = sent(mode, 3, number=200)
        frames, counts = fed(mode, packets.rows, packets.lengths, [64, 128, 300])
        assert [frame.data.tobytes() for frame in frames] == packets.frames
        assert counts == StreamCounts(packets=3 * mode.packets, frames=3)
        assert frames[1].ticks == (4_294_000_000 + TICKS) % 2**32


def test_what_was_given_is_not_overwritten() -> None:
    packets = sent(SMALL, 40)
    frames, _ = fed(SMALL, packets.rows, packets.lengths, list(range(0, 240, 7)))
    assert [frame.data.tobytes() for frame in frames] == packets.frames


def test_the_first_frame_begins_with_a_first_packet() -> None:
    packets = sent(SMALL, 3)
    frames, counts = fed(SMALL, packets.rows[2:], packets.lengths[2:], [])
    assert [frame.data.tobytes() for frame in frames] == packets.frames[1:]
    assert counts == StreamCounts(packets=16, frames=2)


def test_a_lost_packet_costs_its_frame_and_is_counted() -> None:
    packets = sent(SMALL, 3)
    kept = np.delete(np.arange(18), [8, 9])
    frames, counts = fed(SMALL, packets.rows[kept], packets.lengths[kept], [])
    assert [frame.data.tobytes() for frame in frames] == packets.frames[::2]
    assert counts == StreamCounts(packets=16, lost=2, frames=2, broken=1)


def test_so_many_lost_that_numbers_and_places_fit_again() -> None:
    """768 packets are three rounds of the numbers and 128 frames: only time tells."""
    packets = sent(SMALL, 140)
    kept = np.r_[0:9, 9 + 768 : 840]
    frames, _ = fed(SMALL, packets.rows[kept], packets.lengths[kept], [])
    whole = [packets.frames[0], *packets.frames[130:]]
    assert [frame.data.tobytes() for frame in frames] == whole


def test_empty_microframes_and_failed_packets_are_passed_over() -> None:
    packets = sent(SMALL, 2)
    rows = np.zeros((24, SMALL.packet_size), np.uint8)
    lengths = np.zeros(24, np.int32)
    rows[::2], lengths[::2] = packets.rows, packets.lengths
    frames, counts = fed(SMALL, rows, lengths, [5, 11])
    assert [frame.data.tobytes() for frame in frames] == packets.frames
    assert counts == StreamCounts(packets=12, frames=2)


def test_a_frame_whose_first_packet_is_the_latest_is_broken() -> None:
    """Its clock is wrong by a bit; also if the batch began with another frame."""
    packets = sent(SMALL, 2)
    for bit in range(23):
        rows = packets.rows.copy()
        rows[SMALL.packets, 8:12].view("<u4")[0] ^= np.uint32(1 << bit)
        one_by_one = fed(SMALL, rows, packets.lengths, list(range(12)))
        together = fed(SMALL, rows, packets.lengths, [3])
        assert together[1] == one_by_one[1]
        assert len(together[0]) == len(one_by_one[0])


HARMS = ("lost", "twice", "swapped", "cut", "stretched", "bit")


@st.composite
def harmed(draw: st.DrawFn) -> tuple[Sent, NDArray[np.uint8], NDArray[np.int32]]:
    """Packets to which this and that has happened; bytes of frames stay right."""
    packets = sent(SMALL, draw(st.integers(1, 12)), draw(st.integers(0, 255)))
    order = list(range(len(packets.lengths)))
    rows, lengths = packets.rows.copy(), packets.lengths.copy()
    for _ in range(draw(st.integers(0, 4))):
        at = draw(st.integers(0, len(order) - 1)) if order else 0
        match draw(st.sampled_from(HARMS)) if order else "":
            case "lost":
                del order[at : at + draw(st.integers(1, 8))]
            case "twice":
                order.insert(at, order[at])
            case "swapped":
                order[at : at + 2] = order[at : at + 2][::-1]
            case "cut":
                lengths[order[at]] = draw(st.integers(1, SMALL.packet_size - 1))
            case "stretched":
                lengths[order[at]] = SMALL.packet_size
            case "bit":
                byte = draw(st.sampled_from([0, 1, 3, 5, 8, 9, 10, 11]))
                rows[order[at], byte] ^= 1 << draw(st.integers(0, 7))
    return packets, rows[order], lengths[order]


@given(harmed(), st.lists(st.integers(0, 100), max_size=6))
def test_only_frames_that_were_sent_come_out_and_in_order(
    case: tuple[Sent, NDArray[np.uint8], NDArray[np.int32]], cuts: list[int]
) -> None:
    packets, rows, lengths = case
    frames, counts = fed(SMALL, rows, lengths, cuts)
    places = [packets.frames.index(frame.data.tobytes()) for frame in frames]
    assert places == sorted(set(places))
    assert counts.frames == len(frames)
    assert counts.packets == np.count_nonzero(lengths)


@given(harmed(), st.lists(st.integers(0, 100), max_size=6))
def test_it_is_the_same_however_packets_are_batched(
    case: tuple[Sent, NDArray[np.uint8], NDArray[np.int32]], cuts: list[int]
) -> None:
    _, rows, lengths = case
    one_by_one, counts = fed(SMALL, rows, lengths, list(range(len(lengths))))
    together, its_counts = fed(SMALL, rows, lengths, cuts)
    assert its_counts == counts
    assert [(it.data.tobytes(), it.ticks) for it in together] == [
        (it.data.tobytes(), it.ticks) for it in one_by_one
    ]


@given(st.binary(max_size=400), st.integers(1, 40))
@example(b"RB\0q" * 20, 20)
def test_nonsense_gives_no_frame(noise: bytes, length: int) -> None:
    rows = np.frombuffer(noise.ljust(400, b"\0"), np.uint8).reshape(-1, 20)
    lengths = np.full(len(rows), min(length, 20), np.int32)
    frames, counts = fed(SMALL, rows, lengths, [])
    assert not frames
    assert counts.packets == 20
