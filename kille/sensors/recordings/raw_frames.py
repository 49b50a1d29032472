"""Raw readings of any sensor: its own, or those that a Kinect would have had."""

from __future__ import annotations

from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.scene import Depth, Frame, Intrinsics
from kille.sensors.kinect.calibration import IDENTITY, Calibration
from kille.sensors.kinect.capture import COLOUR_CAMERA, KinectCapture, RawSource
from kille.sensors.kinect.metric import FARTHEST, raw_of
from kille.sensors.sensor import Sensor, SensorError

TICKS = 60_000_000
"""What a Kinect's clock counts in a second, in 32 bits."""


class RawFrameSource:
    """A sensor of which every frame is turned into what a Kinect would have read.

    Its depth lies in the colour picture already, as its calibration says, and is
    rounded to what 11 bits tell: about 1 mm at half a metre, 3 mm at one.
    """

    def __init__(self, sensor: Sensor) -> None:
        self._sensor = sensor
        self._first: Frame | None = sensor.frame()
        self._lens = self._first.intrinsics or COLOUR_CAMERA
        develop_frame(sensor.name, self._first)

    @property
    def name(self) -> str:
        """The source as a user writes it."""
        return self._sensor.name

    @property
    def calibration(self) -> Calibration:
        """That of a camera with depth on its colour picture."""
        return IDENTITY

    @property
    def lens(self) -> Intrinsics:
        """That of the colour camera."""
        return self._lens

    def frame(self) -> Frame:
        """The next frame."""
        first, self._first = self._first, None
        return first or self._sensor.frame()

    def capture(self) -> KinectCapture:
        """The next frame as raw readings.

        SensorError if it has no depth, or another size than a Kinect's.
        """
        return develop_frame(self.name, self.frame())

    def close(self) -> None:
        """Let go of the source; a second call does nothing."""
        self._sensor.close()


def raw_source(sensor: Sensor) -> RawSource:
    """The sensor itself if it has raw readings, else one that makes them of frames.

    SensorError if it gives no depth, or frames of another size than a Kinect's.
    """
    return sensor if isinstance(sensor, RawSource) else RawFrameSource(sensor)


def lens_of(source: RawSource) -> Intrinsics:
    """The colour camera's, as far as the source knows it."""
    return source.lens if isinstance(source, RawFrameSource) else COLOUR_CAMERA


def develop_frame(name: str, frame: Frame) -> KinectCapture:
    """The frame of that source as `IDENTITY` would have read it.

    SensorError if it has no depth, or another size than a Kinect's.
    """
    if frame.depth is None:
        raise SensorError(
            f"{name}: gives no depth, and a fakenect folder holds what a Kinect "
            "reads; other formats keep colour alone"
        )
    height, width = frame.depth.shape
    if (width, height) != (640, 480):
        raise SensorError(
            f"{name}: frames are {width}x{height}, and a Kinect's are 640x480; "
            "other formats than fakenect keep any size"
        )
    ticks = round(frame.time * TICKS) & 0xFFFF_FFFF
    raw = raw_depth(frame.depth)
    return KinectCapture(frame.time, frame.colour, raw, ticks, ticks)


def raw_depth(depth: Depth) -> NDArray[np.uint16]:
    """The raw numbers of a depth in metres, as `IDENTITY` reads them.

    >>> raw_depth(np.array([[0.887, np.nan, 20.0]], np.float32))
    array([[ 700, 2047, 2047]], dtype=uint16)
    """
    whole = np.rint(np.nan_to_num(depth * np.float32(1000), nan=0.0))
    near = np.where((whole > 0) & (whole < FARTHEST), whole, 0).astype(np.uint16)
    return np.asarray(cv2.LUT(near, _raw_numbers()), np.uint16)


@lru_cache(maxsize=1)
def _raw_numbers() -> NDArray[np.uint16]:
    """The raw numbers (65536,) of millimetres."""
    return raw_of(np.arange(1 << 16), IDENTITY)
