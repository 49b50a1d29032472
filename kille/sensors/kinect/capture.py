"""What a Kinect gives at one moment, before and after its depth is put to use."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from kille.scene import Colour, Frame, Intrinsics
from kille.sensors.kinect.calibration import Calibration
from kille.sensors.kinect.metric import beyond, look_up
from kille.sensors.kinect.motor import Tilt
from kille.sensors.kinect.registration import register_depth

COLOUR_CAMERA = Intrinsics(fx=525.0, fy=525.0, cx=319.5, cy=239.5)
"""The lens that is taken for every Kinect's colour camera, as is usual."""


@dataclass(frozen=True, eq=False)
class KinectCapture:
    """Colour and raw depth that belong together.

    `time` in seconds; `colour` (480, 640, 3) RGB; `depth` (480, 640) of 11 bits, 2047
    for no reading; the ticks of both on the device's clock of 60 MHz, in 32 bits;
    `tilt` if the motor was asked.
    """

    time: float
    colour: Colour
    depth: NDArray[np.uint16]
    ticks_colour: int
    ticks_depth: int
    tilt: Tilt | None = None


@runtime_checkable
class RawSource(Protocol):
    """A sensor that gives captures too, and knows what their depth means."""

    @property
    def calibration(self) -> Calibration:
        """What turns raw depth into metres on the colour picture."""
        ...

    def capture(self) -> KinectCapture:
        """The next capture."""
        ...


def frame_of(capture: KinectCapture, calibration: Calibration) -> Frame:
    """The frame of a capture: its depth on the colour picture, in metres."""
    # What is too far has no depth, though some of it would wrap around to one.
    seen = register_depth(capture.depth, calibration, beyond(calibration))
    depth = look_up(_metres(), seen)
    return Frame(capture.colour, depth, COLOUR_CAMERA, capture.time, {})


@lru_cache(maxsize=1)
def _metres() -> NDArray[np.float32]:
    """The metres (65536,) of millimetres; not a number for 0."""
    metres = np.arange(1 << 16, dtype=np.float32)
    metres[0] = np.nan
    return metres / np.float32(1000)
