"""When a frame was taken, from the device's clock and the moments frames arrived."""

from __future__ import annotations

from collections import deque

from kille.sensors.kinect.packets import TICKS_A_SECOND

_WINDOW = 60
"""Frames, of which one at least is taken to have arrived at once."""

LATEST = 0.5
"""Seconds that no frame is under way; a clock that says so is not believed."""


class Clock:
    """The host's seconds for one stream's ticks, without the delays of single frames.

    A frame arrives some time after it was taken, now more and now less. The device's
    clock runs evenly, but from a beginning of its own: it is set by the frame, among
    the latest, that was delayed the least.

    >>> clock = Clock()
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
