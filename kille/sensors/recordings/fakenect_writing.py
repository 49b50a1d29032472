"""Write fakenect folders, in which all that the index names is always whole.

A file is written first and named in the index afterwards; a program that is killed
leaves at most one file that is not named. `sync` makes the computer write its buffers
to the disk.
"""

from __future__ import annotations

import json
import os
from math import inf
from pathlib import Path
from types import TracebackType
from typing import Self

import numpy as np

from kille.scene import Intrinsics
from kille.sensors.kinect.calibration import Calibration
from kille.sensors.kinect.capture import COLOUR_CAMERA, KinectCapture
from kille.sensors.kinect.motor import Tilt
from kille.sensors.recordings.fakenect import BYTES, DEVICE, HEADS, INDEX, TILT
from kille.sensors.recordings.moments import after

SUFFIXES = {"r": "ppm", "d": "pgm", "a": "dump"}
CAPTURE_BYTES = sum(BYTES[kind] + len(HEADS[kind]) for kind in "rd")


class FakenectWriter:
    """Adds captures to a recording in a folder that is new or empty.

    `began` is the time of the computer, in seconds of the epoch, at which the first
    capture is said to have come. Every method may raise OSError, and what was written
    until then stays a recording.
    """

    def __init__(
        self, folder: Path, calibration: Calibration, lens: Intrinsics, began: float
    ) -> None:
        self._folder = folder
        self._began = began
        self._first: float | None = None
        self._last = -inf
        self._tilt: Tilt | None = None
        self._unsynced: list[Path] = []
        folder.mkdir(exist_ok=True)
        self._write(folder / DEVICE, _device_text(calibration, lens).encode())
        self._index = (folder / INDEX).open("xb", buffering=0)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if error is None:
            self.close()
        else:
            self._index.close()

    def write(self, capture: KinectCapture) -> None:
        """Add a capture: its tilt, if it changed, then colour, then depth."""
        if self._first is None:
            self._first = capture.time
        time = after(self._last, self._began + capture.time - self._first)
        self._last = time
        if capture.tilt is not None and capture.tilt != self._tilt:
            self._tilt = tilt = capture.tilt
            data = TILT.pack(tilt.x, tilt.y, tilt.z, tilt.doubled, tilt.status)
            self._add("a", time, capture.ticks_depth, data)
        colour = np.ascontiguousarray(capture.colour, np.uint8)
        self._add("r", time, capture.ticks_colour, colour.data)
        depth = np.ascontiguousarray(capture.depth, "<u2")
        self._add("d", time, capture.ticks_depth, depth.data)

    def sync(self) -> None:
        """Make sure that the disk holds everything written so far."""
        waiting, self._unsynced = self._unsynced, []
        for path in waiting:
            _sync(path)
        os.fsync(self._index.fileno())
        _sync(self._folder)

    def close(self) -> None:
        """Sync and let go of the folder; a second call does nothing."""
        if self._index.closed:
            return
        try:
            self.sync()
        finally:
            self._index.close()

    def _add(
        self, kind: str, time: float, ticks: int, data: bytes | memoryview
    ) -> None:
        name = f"{kind}-{time:.6f}-{ticks}.{SUFFIXES[kind]}"
        self._write(self._folder / name, HEADS[kind], data)
        self._index.write(f"{name}\n".encode())

    def _write(self, path: Path, *parts: bytes | memoryview) -> None:
        """Write a new file, or none."""
        try:
            with path.open("xb", buffering=0) as file:
                for part in parts:
                    _write_all(file.fileno(), part)
        except FileExistsError:
            raise
        except BaseException:
            path.unlink(missing_ok=True)
            raise
        self._unsynced.append(path)


def _write_all(file: int, data: bytes | memoryview) -> None:
    rest = memoryview(data).cast("B")
    while rest:
        rest = rest[os.write(file, rest) :]


def _sync(path: Path) -> None:
    file = os.open(path, os.O_RDONLY)
    try:
        os.fsync(file)
    finally:
        os.close(file)


def _device_text(calibration: Calibration, lens: Intrinsics) -> str:
    """The text of `device.json`; the lens is named where it is not the usual one."""
    text = calibration.to_json()
    if lens == COLOUR_CAMERA:
        return text
    own = {"intrinsics": [lens.fx, lens.fy, lens.cx, lens.cy]}
    return json.dumps(json.loads(text) | own, indent=4) + "\n"
