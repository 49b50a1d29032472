"""Which picture and which depth belong together."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from kille.sensors.kinect.clock import LATEST
from kille.sensors.kinect.packets import TICKS_A_SECOND, RawFrame

NEAR = 1.1 / 60
"""Seconds: half a frame at thirty a second, and a tenth of that to spare."""

_HALF_ROUND = 1 << 31
"""Ticks: half of what the device's clock of 32 bits counts."""


class Pair(NamedTuple):
    """A picture and the depth of the same moment."""

    colour: RawFrame
    depth: RawFrame


def first_pair(colours: Sequence[RawFrame], depths: Sequence[RawFrame]) -> Pair | None:
    """The first depth that has a picture within half a frame, and the nearest such.

    Both cameras give thirty frames a second, but not at the same instants.
    """
    for depth in depths:
        near = [it for it in colours if _apart(it, depth) <= NEAR]
        if near:
            return Pair(min(near, key=lambda it: _apart(it, depth)), depth)
    return None


def _apart(one: RawFrame, other: RawFrame) -> float:
    """Seconds between two frames, by the device's clock if both were timed by it.

    The host's times are not so sure: one camera's frames may all have been late. If
    they differ by more than that, the cameras count from beginnings of their own.
    """
    told = one.time - other.time
    ticks = (one.ticks - other.ticks + _HALF_ROUND) % (2 * _HALF_ROUND) - _HALF_ROUND
    counted = ticks / TICKS_A_SECOND
    return abs(counted if abs(counted - told) <= LATEST else told)
