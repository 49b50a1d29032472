"""Which picture and which depth belong together."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from kille.sensors.kinect.packets import RawFrame

NEAR = 1.1 / 60
"""Seconds: half a frame at thirty a second, and a tenth of that to spare."""


class Pair(NamedTuple):
    """A picture and the depth of the same moment."""

    colour: RawFrame
    depth: RawFrame


def first_pair(colours: Sequence[RawFrame], depths: Sequence[RawFrame]) -> Pair | None:
    """The first depth that has a picture within half a frame, and the nearest such.

    Both cameras give thirty frames a second, but not at the same instants.
    """
    for depth in depths:
        near = [it for it in colours if abs(it.time - depth.time) <= NEAR]
        if near:
            return Pair(min(near, key=lambda it: abs(it.time - depth.time)), depth)
    return None
