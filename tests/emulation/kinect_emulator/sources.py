"""Views for the emulated Kinect, from any sensor of the product."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from kille.sensors.kinect.calibration import IDENTITY, Calibration
from kille.sensors.kinect.metric import millimetres
from kille.sensors.recordings.raw_frames import raw_source
from kille.sensors.sensor import Sensor
from kille.sensors.sources import open_sensor
from kinect_emulator.calibration import LIKELY, Making
from kinect_emulator.encoding import Depth
from kinect_emulator.kinect import Kinect
from kinect_emulator.pictures import NO_READING, Show, View

COLOUR_DISTANCE = 2.4
"""What drivers take the cameras to be apart, whatever the device says; centimetres."""

STRAIGHT = replace(
    LIKELY,
    registration=(*5 * (0,), -256, *4 * (0,), -256, *18 * (0,)),
    padding=(0, 0, 0),
)
"""A device whose two cameras differ in their places only."""

_SAME_SURFACE = 3


def plugged(name: str, count: int = 16) -> Kinect:
    """A Kinect that sees, over and over, the first frames of the sensor of that name.

    Where the sensor is a Kinect's recording, it is that Kinect; where depth comes on
    the colour picture already, it is moved back to where a depth camera would see it.
    """
    sensor = open_sensor(name)
    try:
        source = raw_source(sensor)
        making = making_of(source.calibration)
        return Kinect(Show(views_of(sensor, count)), making=making)
    finally:
        sensor.close()


def views_of(sensor: Sensor, count: int = 1) -> list[View]:
    """The next frames of a sensor, as the two cameras of a Kinect see them."""
    source = raw_source(sensor)
    captures = [source.capture() for _ in range(count)]
    if source.calibration != IDENTITY:
        return [View(it.depth, it.colour) for it in captures]
    return [View(moved_back(it.depth), it.colour) for it in captures]


def making_of(calibration: Calibration) -> Making:
    """The device that would tell that calibration."""
    if calibration == IDENTITY:
        return STRAIGHT
    plane, lines = calibration.zero_plane, calibration.padding
    return Making(
        tuple(calibration.registration),
        (lines.start_lines, lines.end_lines, lines.cropping_lines),
        calibration.const_shift,
        plane.dcmos_emitter_distance,
        reference_distance=plane.reference_distance,
        pixel_size=plane.reference_pixel_size,
    )


def moved_back(depth: Depth) -> Depth:
    """Raw depth on the colour picture as the depth camera sees it, 2.4 cm beside.

    A point at z millimetres lies 24 / (20 * pixel size) * (1 - 1200 / z) pixels further
    to the left; where two meet the nearer is seen, and what neither camera shares is
    not.
    """
    mm = millimetres(depth, IDENTITY).astype(np.float64)
    rows, columns = np.nonzero((depth < NO_READING) & (mm > 0))
    z = mm[rows, columns]
    step = 10 * COLOUR_DISTANCE / (20 * STRAIGHT.pixel_size)
    parallax = step * (1 - 10 * STRAIGHT.reference_distance / z)
    target = columns - np.rint(parallax).astype(np.intp)
    inside = (target >= 0) & (target < depth.shape[1])
    seen = np.full(depth.shape, NO_READING, np.uint16)
    raw = depth[rows, columns]
    np.minimum.at(seen, (rows[inside], target[inside]), raw[inside])
    return closed(seen)


def closed(depth: Depth) -> Depth:
    """The picture without gaps of one pixel in a surface, which moving it has torn."""
    left, right = depth[:, :-2].astype(np.int64), depth[:, 2:].astype(np.int64)
    torn = (depth[:, 1:-1] == NO_READING) & (np.abs(left - right) <= _SAME_SURFACE)
    whole = depth.copy()
    whole[:, 1:-1][torn] = np.maximum(left, right)[torn]
    return whole
