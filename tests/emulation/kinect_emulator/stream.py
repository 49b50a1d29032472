"""From frames to the packets of each microframe."""

from __future__ import annotations

import struct
from collections import deque
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kinect_emulator.faults import Faults, Harm
from kinect_emulator.modes import HEADER, Mode
from kinect_emulator.pictures import Show

_HEADER = np.dtype(
    [
        ("magic", "S2"),
        ("pad", "u1"),
        ("flag", "u1"),
        ("unknown", "u1"),
        ("sequence", "u1"),
        ("more", "u1", 2),
        ("ticks", "<u4"),
    ]
)
FIRST, MIDDLE, LAST = 1, 2, 5


class Window(NamedTuple):
    """The packets of some microframes: their lengths, and their bytes end to end."""

    lengths: NDArray[np.uint32]
    data: bytes


class Stream:
    """One running stream, which started in the microframe `start`."""

    def __init__(self, mode: Mode, show: Show, start: int, ticks: int = 0) -> None:
        self.mode = mode
        self.start = start
        self._show = show
        self._ticks = ticks
        self._wired: tuple[int, bytes] = (-1, b"")
        self._backlog: deque[bytes] = deque()
        self._held: list[bytes] = []

    def window(self, first: int, count: int, faults: Faults) -> Window:
        """The packets of `count` microframes from the one numbered `first`."""
        after = max(first - self.start, 0)
        end = max(first + count - self.start, 0)
        if self.mode.endpoint in faults.silent or end == 0:
            return Window(np.zeros(count, np.uint32), b"")
        if faults.packets or self._backlog or self._held:
            return self._harmed(first, count, faults)
        packets = range(self.mode.before(after), self.mode.before(end))
        return self._plain(first, count, packets)

    def packet(self, number: int) -> bytes:
        """The packet of that number as it should be."""
        step = HEADER + self.mode.payload
        frame, place = divmod(number, self.mode.packets)
        return self._frame(frame)[place * step : (place + 1) * step]

    def _plain(self, first: int, count: int, packets: Sequence[int]) -> Window:
        lengths = np.zeros(count, np.uint32)
        if not packets:
            return Window(lengths, b"")
        mode, step = self.mode, HEADER + self.mode.payload
        numbers = np.arange(packets[0], packets[-1] + 1)
        places = numbers % mode.packets
        due = numbers * 800 // (mode.frames * mode.packets) + self.start - first
        lengths[due] = np.where(places == mode.packets - 1, HEADER + mode.last, step)
        cuts = [packets[0], *(numbers[1:][places[1:] == 0]), packets[-1] + 1]
        data = b"".join(self._slice(int(a), int(b)) for a, b in pairwise(cuts))
        return Window(lengths, data)

    def _slice(self, begin: int, end: int) -> bytes:
        """The packets from `begin` to before `end`, all of one frame."""
        step = HEADER + self.mode.payload
        frame, place = divmod(begin, self.mode.packets)
        return self._frame(frame)[place * step : (place + end - begin) * step]

    def _harmed(self, first: int, count: int, faults: Faults) -> Window:
        """Packets queue up, so that one sent twice delays those behind it."""
        lengths = np.zeros(count, np.uint32)
        sent = []
        for microframe in range(count):
            at = first + microframe - self.start
            for number in range(self.mode.before(at), self.mode.before(at + 1)):
                self._backlog.extend(self._outcome(number, faults))
            if self._backlog:
                sent.append(self._backlog.popleft())
                lengths[microframe] = len(sent[-1])
        return Window(lengths, b"".join(sent))

    def _outcome(self, number: int, faults: Faults) -> list[bytes]:
        """What is sent in the place of that packet."""
        packet = self.packet(number)
        endpoint = self.mode.endpoint
        harms = {it.harm for it in faults.packets if it.hits(endpoint, number)}
        if Harm.SWAPPED in harms:
            self._held.append(packet)
            return []
        sent = [] if Harm.LOST in harms else [_hurt(packet, harms, self.mode)]
        if Harm.TWICE in harms:
            sent = 2 * sent
        held, self._held = self._held, []
        return sent + held

    def _frame(self, frame: int) -> bytes:
        """The packets of a frame, end to end; the last one made is kept."""
        if self._wired[0] != frame:
            payload = self._show.payload(self.mode, frame)
            ticks = self._ticks + self.mode.ticks(frame)
            self._wired = (frame, wire(self.mode, frame, payload, ticks))
        return self._wired[1]


def wire(mode: Mode, frame: int, payload: bytes, ticks: int) -> bytes:
    """A frame cut into packets with their headers, end to end."""
    packets = np.zeros((mode.packets, HEADER + mode.payload), np.uint8)
    padded = payload.ljust(mode.packets * mode.payload, b"\0")
    packets[:, HEADER:] = np.frombuffer(padded, np.uint8).reshape(mode.packets, -1)
    headers = np.zeros(mode.packets, _HEADER)
    headers["magic"] = b"RB"
    headers["flag"] = mode.base | MIDDLE
    headers["flag"][0] = mode.base | FIRST
    headers["flag"][-1] = mode.base | LAST
    numbers = frame * mode.packets + np.arange(mode.packets)
    headers["sequence"] = numbers % 256
    headers["ticks"] = ticks % 2**32
    packets[:, :HEADER] = headers.view(np.uint8).reshape(-1, HEADER)
    return packets.tobytes()[: mode.packets * HEADER + mode.size]


def _hurt(packet: bytes, harms: set[Harm], mode: Mode) -> bytes:
    if Harm.CUT in harms:
        packet = packet[: len(packet) // 2]
    if Harm.ALIEN in harms:
        packet = b"X" + packet[1:]
    if Harm.MISPLACED in harms:
        packet = packet[:3] + struct.pack("B", mode.base | FIRST) + packet[4:]
    return packet
