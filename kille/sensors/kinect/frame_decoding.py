"""Pictures and depth out of the bytes of two frames."""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np

from kille.scene import Colour
from kille.sensors.kinect.bayer import colour_of
from kille.sensors.kinect.calibration import IDENTITY, Calibration
from kille.sensors.kinect.capture import KinectCapture
from kille.sensors.kinect.packets import RawFrame
from kille.sensors.kinect.pairing import Pair
from kille.sensors.kinect.streams import INFRARED, Mode
from kille.sensors.kinect.unpacking import unpack_10, unpack_11


def capture_of(pair: Pair, colour: Mode) -> KinectCapture:
    """The capture of a pair, whose picture came through a stream of that mode."""
    return KinectCapture(
        pair.depth.time,
        _picture(pair.colour, colour),
        unpack_11(pair.depth.data),
        pair.colour.ticks,
        pair.depth.ticks,
    )


def calibration_for(told: Calibration, colour: Mode) -> Calibration:
    """What turns depth into metres on pictures of that mode, as the device told it."""
    if colour is not INFRARED:
        return told
    # Depth is measured by the infrared camera: there is nothing to move.
    plane = told.zero_plane._replace(dcmos_rcmos_distance=0.0)
    return replace(IDENTITY, zero_plane=plane)


def _picture(frame: RawFrame, mode: Mode) -> Colour:
    if mode is not INFRARED:
        return colour_of(frame.data.reshape(480, 640))
    grey = (unpack_10(frame.data)[:480] >> 2).astype(np.uint8)
    return np.asarray(cv2.cvtColor(grey, cv2.COLOR_GRAY2RGB), np.uint8)
