"""The motor of model 1414: it tilts the head, lights the lamp and feels gravity."""

from __future__ import annotations

import math
import struct

STOPPED, AT_LIMIT, MOVING = 0, 1, 4
LIMIT = 31
COUNTS_PER_G = 819
DEGREES_PER_SECOND = 20.0


class Motor:
    """A head that turns at 20 degrees a second; seconds are told to it.

    `tilts` and `lamps` are all it was told, in half degrees and in lamp numbers.
    """

    def __init__(self) -> None:
        self.tilts: list[int] = []
        self.lamps: list[int] = []
        self.wanted = 0.0
        self._from = 0.0
        self._since = 0.0

    def tilt_to(self, half_degrees: int, seconds: float) -> None:
        """Start to move towards an angle, told in half degrees."""
        self.tilts.append(half_degrees)
        self._from = self.angle(seconds)
        self._since = seconds
        self.wanted = max(-LIMIT, min(LIMIT, half_degrees / 2))

    def light(self, lamp: int) -> None:
        """Light the lamp in one of its seven ways."""
        self.lamps.append(lamp)

    def angle(self, seconds: float) -> float:
        """Where the head is, in degrees above the horizon."""
        way = (seconds - self._since) * DEGREES_PER_SECOND
        left = self.wanted - self._from
        return self._from + math.copysign(min(abs(left), way), left)

    def status(self, seconds: float) -> int:
        """Stopped, at its limit or moving."""
        if self.angle(seconds) != self.wanted:
            return MOVING
        return AT_LIMIT if abs(self.wanted) == LIMIT else STOPPED

    def state(self, seconds: float) -> bytes:
        """The ten bytes it answers: acceleration, twice the angle, status."""
        angle = self.angle(seconds)
        up = round(COUNTS_PER_G * math.cos(math.radians(angle)))
        forward = round(COUNTS_PER_G * math.sin(math.radians(angle)))
        twice = round(2 * angle)
        return struct.pack(">H3hbB", 0, 0, up, forward, twice, self.status(seconds))
