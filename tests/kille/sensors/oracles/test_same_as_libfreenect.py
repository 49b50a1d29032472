"""Our driver and libfreenect, through the same libusb on the same Kinect."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import kinect_emulator
from kinect_emulator import netpbm
from kinect_emulator.descriptors import FOR_WINDOWS, MODEL_1414, MODEL_1473, Model
from kinect_emulator.encoding import mosaic
from kinect_emulator.kinect import Kinect
from kinect_emulator.pictures import NO_READING, Show, View, patterns
from kinect_emulator.running import run
from kinect_emulator.server import Server

pytestmark = pytest.mark.oracle

COUNT = 5
CLIENT = str(Path(kinect_emulator.__file__).with_name("driver_client.py"))
MODELS = (MODEL_1414, MODEL_1473, FOR_WINDOWS)


def near(view: View) -> View:
    """The view without what is 10 m away or farther.

    There libfreenect's millimetres run over in their 16 bits, and our frames have none.
    """
    far = (view.depth > 1_050) & (view.depth < NO_READING)
    return View(np.where(far, np.uint16(NO_READING), view.depth), view.colour)


@pytest.mark.slow
@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.name)
def test_both_see_the_same(
    program: Callable[[str], str],
    libusb: Path,
    serve: Callable[..., Server],
    tmp_path: Path,
    model: Model,
) -> None:
    regtest = program("freenect-regtest")
    view = near(patterns(1).view(0))
    kinect = Kinect(Show([view]), model)
    server, out = serve(kinect), tmp_path / "ours.npz"
    theirs = run([regtest], libusb, server, tmp_path)
    ours = run(
        [sys.executable, CLIENT, "kinect", str(COUNT), str(out)],
        libusb,
        server,
        tmp_path,
    )
    assert (theirs.status, ours.status) == (0, 0), theirs.err + ours.err
    depth = {
        name: netpbm.depth(tmp_path / f"registration_test_depth_{name}.pgm")
        for name in ("raw", "registered")
    }
    came = np.load(out)
    assert np.array_equal(came["raw"], COUNT * [depth["raw"]])
    millimetres = np.rint(np.nan_to_num(1_000 * came["metres"], nan=0.0))
    assert np.array_equal(millimetres, COUNT * [depth["registered"]])
    colour = netpbm.colour(tmp_path / "registration_test_rgb.ppm").astype(int)
    inside = np.s_[2:-2, 2:-2]
    assert np.abs(came["colour"][0] - colour)[inside].max() <= 1
    sent = mosaic(view.colour)
    assert np.array_equal(mosaic(came["colour"][0])[inside], sent[inside])
