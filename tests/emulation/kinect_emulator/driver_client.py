"""Kille's own driver as a program of its own, so that it loads the fake libusb.

    python driver_client.py NAME COUNT OUT.npz

Opens the sensor of that name and saves what it captured: raw depth, colour, ticks, and
depth on the colour picture in metres.
"""

from __future__ import annotations

import sys

import numpy as np

from kille.sensors.kinect.capture import RawSource, frame_of
from kille.sensors.sources import open_sensor


def main(name: str, count: int, out: str) -> None:
    """Capture and save."""
    sensor = open_sensor(name)
    try:
        assert isinstance(sensor, RawSource)
        captures = [sensor.capture() for _ in range(count)]
        frames = [frame_of(it, sensor.calibration) for it in captures]
    finally:
        sensor.close()
    np.savez(
        out,
        raw=[it.depth for it in captures],
        colour=[it.colour for it in captures],
        ticks=[it.ticks_depth for it in captures],
        metres=np.array([it.depth for it in frames]),
    )


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), sys.argv[3])
