"""When a frame was taken, from the device's clock and the moments frames arrived."""

from __future__ import annotations

from collections import deque

from kille.sensors.kinect.packets import TICKS_A_SECOND

_WINDOW = 60
"""Frames, of which one at least is taken to have arrived at once."""

_TICKS_A_MICROFRAME = TICKS_A_SECOND // 8_000
_AT_ONCE = 512
"""Microframes: those of two batches."""

LATEST = 0.5
"""Seconds that no frame is under way; a clock that says so is not believed."""


class DeviceClock:
    """The host's seconds for one stream's ticks, without the delays of single frames.

    A frame arrives some time after it was taken, now more and now less. The device's
    clock runs evenly, but from a beginning of its own: it is set by the frame, among
    the latest, that was delayed the least.

    >>> clock = DeviceClock()
    >>> [round(clock.at(n * 2_000_000, n / 30 + late), 3)
    ...  for n, late in enumerate((0.002, 0.001, 0.050))]
    [0.002, 0.034, 0.068]
    """

    def __init__(self) -> None:
        self._ticks = 0
        self._last: int | None = None
        self._offsets: deque[float] = deque(maxlen=_WINDOW)

    def at(self, ticks: int, arrived: float) -> float:
        """The time of a frame; call it for each, in order. Ticks have 32 bits."""
        if self._last is not None:
            self._ticks += (ticks - self._last) & 0xFFFFFFFF
        self._last = ticks
        seconds = self._ticks / TICKS_A_SECOND
        self._offsets.append(arrived - seconds)
        return max(seconds + min(self._offsets), arrived - LATEST)


class MissedMicroframes:
    """Counts the microframes that passed by the device's clock, but were not read.

    USB asks the device 8000 times a second, as long as somebody reads; what is sent
    while nobody does is lost. Being ahead or behind by one batch is no miss.

    >>> misses = MissedMicroframes()
    >>> for second in range(4):
    ...     misses.count_read(8_000 if second < 3 else 4_000)
    ...     misses.reach(second * TICKS_A_SECOND)
    >>> misses.count
    3488
    """

    def __init__(self) -> None:
        self.count = 0
        self._read = 0
        self._behind = 0
        self._reached: int | None = None

    def count_read(self, microframes: int) -> None:
        """Count microframes that were read, with packets in them or not."""
        self._read += microframes

    def reach(self, ticks: int | None) -> None:
        """The device's clock at the latest frame that was read, if there is any."""
        last, self._reached = self._reached, ticks
        if ticks is None or ticks == last:
            return
        step = 0 if last is None else (ticks - last) & 0xFFFFFFFF
        # A jump backwards is no time that passed, but another clock.
        if 0 < step < 1 << 31:
            passed = step // _TICKS_A_MICROFRAME
            self._behind = max(self._behind + passed - self._read, -_AT_ONCE)
            self.count = max(self.count, self._behind - _AT_ONCE)
        self._read = 0
