"""Debian's freenect-regtest saves raw, metric and registered depth: ours are the same.

Every one of the device's 29 registration numbers is non-zero, and other than in any
published recording.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from kille.sensors.kinect.bayer import colour_of
from kille.sensors.kinect.calibration import Calibration
from kille.sensors.kinect.metric import millimetres
from kille.sensors.kinect.registration import register_depth
from kinect_emulator import netpbm
from kinect_emulator.calibration import LIKELY, Making
from kinect_emulator.encoding import mosaic
from kinect_emulator.kinect import Kinect
from kinect_emulator.pictures import patterns
from kinect_emulator.running import Ran

pytestmark = pytest.mark.oracle

SIGNS = (1, -1)


def shaken(seed: int) -> Making:
    """Another device: all numbers differ a little, the signs of all steps at random."""
    rng = np.random.default_rng(seed)
    numbers = [int(it * rng.uniform(0.8, 1.2)) or 1 for it in LIKELY.registration]
    numbers[0] = int(rng.integers(1, 2**31))
    # The steps are two's complement numbers of 21 and 27 bits: small ones, either way.
    for place in (17, 18, 19, 20):
        numbers[place] = int(rng.integers(300, 1_200)) * rng.choice(SIGNS) % 2**21
    for place in (21, 22, 23, 24, 26, 28):
        numbers[place] = int(rng.integers(200, 2_300)) * rng.choice(SIGNS) % 2**27
    for place in range(1, 11):
        numbers[place] *= rng.choice(SIGNS) if place not in (5, 10) else 1
    plane = {
        "emitter_distance": float(np.float32(rng.uniform(7.3, 7.7))),
        "reference_distance": float(np.float32(rng.uniform(115, 125))),
        "pixel_size": float(np.float32(rng.uniform(0.1, 0.108))),
        "const_shift": int(rng.integers(195, 206)),
    }
    return replace(LIKELY, registration=tuple(map(int, numbers)), **plane)


MAKINGS = {
    "likely": LIKELY,
    "padded": replace(LIKELY, padding=(4, 4, 3)),
    "unpadded": replace(LIKELY, padding=(0, 0, 0)),
    **{f"shaken-{seed}": shaken(seed) for seed in range(6)},
}


@pytest.mark.slow
@pytest.mark.parametrize("making", MAKINGS.values(), ids=MAKINGS)
def test_all_depth_is_the_same_bit_for_bit(
    ran: Callable[..., Ran], tmp_path: Path, making: Making
) -> None:
    assert all(making.registration)
    kinect = Kinect(patterns(1, seed=making.const_shift), making=making)
    done = ran(kinect, "freenect-regtest")
    assert done.status == 0, done.err
    ours = Calibration.from_replies(
        making.registration_reply(),
        making.padding_reply(),
        making.fixed_reply(322),
        making.shift_reply(),
    )
    raw = kinect.show.view(0).depth
    theirs = {
        name: netpbm.depth(tmp_path / f"registration_test_depth_{name}.pgm")
        for name in ("raw", "mm", "registered")
    }
    assert np.array_equal(theirs["raw"], raw)
    assert np.array_equal(theirs["mm"], millimetres(raw, ours))
    assert np.array_equal(theirs["registered"], register_depth(raw, ours))
    assert np.mean(theirs["registered"] > 0) > 0.3


def test_colour_is_the_same_but_for_one_level(
    ran: Callable[..., Ran], tmp_path: Path
) -> None:
    kinect = Kinect(patterns(1))
    assert ran(kinect, "freenect-regtest").status == 0
    theirs = netpbm.colour(tmp_path / "registration_test_rgb.ppm").astype(int)
    ours = colour_of(mosaic(kinect.show.view(0).colour)).astype(int)
    inside = np.s_[2:-2, 2:-2]
    assert np.abs(theirs - ours)[inside].max() <= 1
