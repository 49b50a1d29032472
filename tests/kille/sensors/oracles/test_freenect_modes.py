"""Debian's libfreenect reads every kind of stream just as the emulator means it."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

import kinect_emulator
from kinect_emulator.encoding import mosaic
from kinect_emulator.kinect import Kinect
from kinect_emulator.pictures import View, enlarged
from kinect_emulator.running import run
from kinect_emulator.server import Server

pytestmark = pytest.mark.oracle

COUNT = 3
CLIENT = str(Path(kinect_emulator.__file__).with_name("freenect_client.py"))


class Asked(NamedTuple):
    """A mode in libfreenect's numbers, and the pixels it should give of a view."""

    kind: str
    form: int
    resolution: int
    pixels: Callable[[View], np.ndarray]


MODES = {
    "depth, 11 bits": Asked("depth", 0, 1, lambda view: view.depth),
    "depth, 10 bits": Asked("depth", 1, 1, lambda view: view.depth // 2),
    "Bayer": Asked("video", 1, 1, lambda view: mosaic(view.colour)),
    "large Bayer": Asked("video", 1, 2, lambda view: mosaic(enlarged(view.colour))),
    "infrared": Asked("video", 3, 1, lambda view: view.infrared),
}


@pytest.mark.parametrize("asked", MODES.values(), ids=MODES)
def test_pixels_arrive_as_they_were_shown(
    program: Callable[[str], str],
    libusb: Path,
    serve: Callable[..., Server],
    tmp_path: Path,
    asked: Asked,
) -> None:
    program("freenect-camtest")
    kinect = Kinect()
    out = tmp_path / "frames.npz"
    mode = [asked.kind, str(asked.form), str(asked.resolution)]
    command = [sys.executable, CLIENT, *mode, str(COUNT), str(out)]
    done = run(command, libusb, serve(kinect), tmp_path)
    assert done.status == 0, done.err
    came = np.load(out)
    views = [asked.pixels(view) for view in kinect.show.views]
    shown = [np.frombuffer(frame.tobytes(), views[0].dtype) for frame in came["frames"]]
    first = next(
        place
        for place, view in enumerate(views)
        if np.array_equal(view.ravel(), shown[0])
    )
    expected = [views[(first + later) % len(views)] for later in range(COUNT)]
    assert all(map(np.array_equal, shown, (view.ravel() for view in expected)))
    steps = np.diff(came["ticks"].astype(np.int64)) % 2**32
    assert len(set(steps.tolist())) == 1
