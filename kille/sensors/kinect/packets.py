"""Frames out of packets: in order, whole, and nothing else.

Every packet begins with 'R', 'B', a byte to skip, a flag, a byte to skip, a number that
counts modulo 256, two bytes to skip and the device's clock, four bytes little-endian.
The flag's upper half names the stream; its lower half is 1 in a frame's first packet, 5
in its last and 2 between. Nothing says that a packet's bytes are right, but a frame is
given only if each of its packets came, in order, with the flag, length and time that
belong to its place. Whatever does not fit ends the frame; the next first packet begins
another.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kille.sensors.kinect.streams import HEADER, Mode
from kille.sensors.kinect.transport import Batch

_MAGIC = int.from_bytes(b"RB", "little")
_FIRST, _MIDDLE, _LAST = 1, 2, 5
_KNOWN = np.uint64(0x0000FF00FF00FFFF)
"""The magic, the flag and the number in a header's first eight bytes."""

_NUMBERS = (np.arange(1024, dtype=np.uint64) & np.uint64(0xFF)) << np.uint64(40)

TICKS_A_SECOND = 60_000_000
"""The pace of the device's clock."""

_LONGEST = TICKS_A_SECOND // 8
"""Ticks within which all packets of a frame have come, with much to spare."""


class RawFrame(NamedTuple):
    """A frame's bytes, the device's clock at its last packet, and the host's clock."""

    data: NDArray[np.uint8]
    ticks: int
    time: float


@dataclass(frozen=True)
class StreamCounts:
    """What came through a stream since it was started.

    `packets` that were not empty; `lost` those that the numbers tell to be missing;
    `strange` those that could not be read or did not belong where they came; whole
    `frames`, and `broken` ones that were begun and not given; `missed` microframes, of
    which there are 8000 a second, that passed by the device's clock while the computer
    was too busy to read.
    """

    packets: int = 0
    lost: int = 0
    strange: int = 0
    frames: int = 0
    broken: int = 0
    missed: int = 0

    def __sub__(self, earlier: StreamCounts) -> StreamCounts:
        """What came since then.

        >>> StreamCounts(packets=9, lost=1) - StreamCounts(packets=4)
        StreamCounts(packets=5, lost=1, strange=0, frames=0, broken=0, missed=0)
        """
        names = self.__dataclass_fields__
        return StreamCounts(*(getattr(self, it) - getattr(earlier, it) for it in names))


class Assembler:
    """Puts the packets of one stream together. Feed it every batch, in order."""

    def __init__(self, mode: Mode) -> None:
        self._mode = mode
        flags = np.full(mode.packets, mode.mark | _MIDDLE, np.uint64)
        flags[0], flags[-1] = mode.mark | _FIRST, mode.mark | _LAST
        lengths = np.full(mode.packets, mode.packet_size, np.int32)
        lengths[-1] = HEADER + mode.last
        # In a row, so that a batch may reach from one frame into the next.
        self._heads = np.tile(np.uint64(_MAGIC) | flags << np.uint64(24), 3)
        self._lengths = np.tile(lengths, 3)
        self._body = slice(HEADER, mode.packet_size)
        self._rows = self._fresh()
        self._had = 0
        self._next_number: int | None = None
        self._began: int | None = None
        self._tally = dict.fromkeys(StreamCounts.__dataclass_fields__, 0)

    @property
    def counts(self) -> StreamCounts:
        """What came so far."""
        return StreamCounts(**self._tally)

    @property
    def began(self) -> int | None:
        """The device's clock in the first packet of the latest frame that was begun."""
        return self._began

    def feed(self, batch: Batch) -> list[RawFrame]:
        """The frames that these packets complete."""
        came = batch.lengths.nonzero()[0]
        if not came.size:
            return []
        packets = _Packets(
            came,
            batch.lengths[came],
            batch.packets[:, :8].view("<u8")[came, 0] & _KNOWN,
            batch.packets[:, 8:HEADER].view("<u4")[came, 0],
        )
        if self._all_fit(packets):
            return self._take_all(batch, packets)
        return self._take_each(batch, packets)

    def _all_fit(self, packets: _Packets) -> bool:
        """Whether every packet is the one that was to come: the usual case, quickly."""
        number, first, count = self._next_number, self._had, len(packets.rows)
        end = first + count
        if number is None or end > len(self._heads):
            return False
        heads = self._heads[first:end] | _NUMBERS[number : number + count]
        began = self._began if first else int(packets.ticks[0])
        since = packets.ticks - np.uint32(began or 0)
        # Bytes are compared in less time than NumPy takes to begin.
        return (
            packets.heads.tobytes() == heads.tobytes()
            and packets.lengths.tobytes() == self._lengths[first:end].tobytes()
            and int(since[-1]) <= _LONGEST
            and bool((since[1:] >= since[:-1]).all())
        )

    def _take_all(self, batch: Batch, packets: _Packets) -> list[RawFrame]:
        """Take packets of which each fits, many at a time."""
        frames = []
        taken, count = 0, len(packets.rows)
        while taken < count:
            if not self._had:
                self._began = int(packets.ticks[taken])
            some = min(count - taken, self._mode.packets - self._had)
            wanted = packets.rows[taken : taken + some]
            self._rows[self._had : self._had + some] = batch.packets[wanted, self._body]
            self._had += some
            taken += some
            if self._had == self._mode.packets:
                frames.append(self._whole(int(packets.ticks[taken - 1]), batch.time))
        self._next_number = (int(self._next_number or 0) + count) & 0xFF
        self._tally["packets"] += count
        return frames

    def _take_each(self, batch: Batch, packets: _Packets) -> list[RawFrame]:
        """Take packets one by one, and leave out those that do not fit."""
        self._tally["packets"] += len(packets.rows)
        frames = []
        for row, length, head, ticks in zip(
            *(column.tolist() for column in packets), strict=True
        ):
            if self._fits(_Head.of(head, ticks), length):
                self._rows[self._had] = batch.packets[row, self._body]
                self._had += 1
                if self._had == self._mode.packets:
                    frames.append(self._whole(ticks, batch.time))
        return frames

    def _fits(self, head: _Head, length: int) -> bool:
        """Whether this packet is the next of the frame; if not, what was begun ends."""
        known = {self._mode.mark | part for part in (_FIRST, _MIDDLE, _LAST)}
        if length < HEADER or head.magic != _MAGIC or head.flag not in known:
            # It has no number that could be trusted: the next one tells what is lost.
            self._tally["strange"] += 1
            return False
        if self._next_number is not None and head.number != self._next_number:
            gap = (head.number - self._next_number) & 0xFF
            # Half-way round and more, a packet is late or came twice.
            if gap < 128:
                self._tally["lost"] += gap
            else:
                self._tally["strange"] += 1
            self._end()
        self._next_number = (head.number + 1) & 0xFF
        if head.flag == self._mode.mark | _FIRST:
            self._end()
            self._began = head.ticks
        elif not self._had:
            return False
        if (
            head.flag != int(self._heads[self._had]) >> 24
            or length != self._lengths[self._had]
            or (head.ticks - (self._began or 0)) & 0xFFFFFFFF > _LONGEST
        ):
            self._tally["strange"] += 1
            self._end()
            return False
        return True

    def _whole(self, ticks: int, time: float) -> RawFrame:
        self._tally["frames"] += 1
        frame = RawFrame(self._rows.reshape(-1)[: self._mode.frame_size], ticks, time)
        self._rows = self._fresh()
        self._had = 0
        return frame

    def _end(self) -> None:
        """Leave the frame that was begun, if one was."""
        if self._had:
            self._tally["broken"] += 1
        self._had = 0

    def _fresh(self) -> NDArray[np.uint8]:
        return np.empty((self._mode.packets, self._mode.body), np.uint8)


class _Packets(NamedTuple):
    """The packets of a batch that are not empty, in columns."""

    rows: NDArray[np.intp]
    """Where they are in the batch."""
    lengths: NDArray[np.int32]
    heads: NDArray[np.uint64]
    """The first eight bytes, but for what is to be skipped."""
    ticks: NDArray[np.uint32]


class _Head(NamedTuple):
    """What a packet says of itself."""

    magic: int
    flag: int
    number: int
    ticks: int

    @classmethod
    def of(cls, head: int, ticks: int) -> _Head:
        """From the columns of `_Packets`."""
        return cls(head & 0xFFFF, head >> 24 & 0xFF, head >> 40, ticks)
