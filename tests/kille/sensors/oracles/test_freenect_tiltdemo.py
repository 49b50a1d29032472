"""Debian's freenect-tiltdemo tilts the emulated Kinect and reads how it stands."""

from __future__ import annotations

import math
import re
from collections.abc import Callable

import pytest

from kinect_emulator.kinect import Kinect
from kinect_emulator.running import After, Ran

pytestmark = pytest.mark.oracle

LINE = re.compile(
    r"led\[(\d+)\] tilt\[(-?\d+)\] accel\[([-\d.]+),([-\d.]+),([-\d.]+)\]"
)


@pytest.mark.slow
def test_the_motor_does_what_it_is_told(ran: Callable[..., Ran]) -> None:
    kinect = Kinect()
    done = ran(kinect, "freenect-tiltdemo", enough=After("led[", 2))
    told = LINE.findall(done.out)
    assert len(told) >= 2
    # It may be ended after it has set the next, and before it has told of it.
    assert len(kinect.motor.lamps) - len(told) in (0, 1)
    assert kinect.motor.lamps[: len(told)] == [int(it[0]) for it in told]
    assert kinect.motor.tilts[: len(told)] == [2 * int(it[1]) for it in told]
    for *_, x, y, z in told:
        gravity = float(x) ** 2 + float(y) ** 2 + float(z) ** 2
        assert gravity**0.5 == pytest.approx(9.80665, abs=0.02)
        lean = math.degrees(math.atan2(float(z), float(y)))
        assert -31.5 <= lean <= 31.5
