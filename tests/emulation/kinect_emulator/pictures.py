"""What the emulated Kinect sees, frame by frame, and its payload for each stream."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from kinect_emulator.encoding import Colour, Depth, Infrared, mosaic, packed
from kinect_emulator.modes import (
    BAYER,
    BAYER_LARGE,
    DEPTH_10,
    DEPTH_11,
    INFRARED,
    Mode,
)

HEIGHT, WIDTH = 480, 640
NO_READING = 2_047


@dataclass(frozen=True, eq=False)
class View:
    """One moment: raw depth (480, 640) in 11 bits and colour (480, 640, 3) in RGB."""

    depth: Depth
    colour: Colour

    @property
    def infrared(self) -> Infrared:
        """A picture of 488 rows in 10 bits, made from the green of the colour."""
        green = self.colour[:, :, 1].astype(np.uint16) << 2
        return np.vstack((green, green[-8:]))

    def payload(self, mode: Mode) -> bytes:
        """The bytes of this frame in that stream, without packet headers."""
        match mode.name:
            case DEPTH_11.name:
                return packed(self.depth, 11)
            case DEPTH_10.name:
                return packed(self.depth // np.uint16(2), 10)
            case BAYER.name:
                return mosaic(self.colour).tobytes()
            case BAYER_LARGE.name:
                return mosaic(enlarged(self.colour)).tobytes()
            case INFRARED.name:
                return packed(self.infrared, 10)
            case other:
                raise ValueError(f"no payload for a stream of {other}")


class Show:
    """A row of views that begins anew when it ends.

    What is on show may be changed while streams run: `views` can be replaced.
    """

    def __init__(self, views: Sequence[View]) -> None:
        self.views = tuple(views)

    def view(self, frame: int) -> View:
        """The view in the frame of that number."""
        return self.views[frame % len(self.views)]

    def payload(self, mode: Mode, frame: int) -> bytes:
        """The bytes of that frame in that stream."""
        return _encoded(self.view(frame), mode)


@lru_cache(maxsize=64)
def _encoded(view: View, mode: Mode) -> bytes:
    return view.payload(mode)


def patterns(count: int = 4, seed: int = 1) -> Show:
    """Views in which every pixel counts: noise on ramps, holes, every raw depth.

    >>> view = patterns(1).view(0)
    >>> len(np.unique(view.depth)), view.colour.shape
    (2048, (480, 640, 3))
    """
    return Show([_pattern(seed, place) for place in range(count)])


@lru_cache(maxsize=16)
def _pattern(seed: int, place: int) -> View:
    rng = np.random.default_rng((seed, place))
    columns, rows = np.meshgrid(np.arange(WIDTH), np.arange(HEIGHT))
    ramp = 450 + (columns * 500) // WIDTH + (rows * 100) // HEIGHT
    depth = (ramp + rng.integers(-3, 4, ramp.shape)).astype(np.uint16)
    depth[rng.random(depth.shape) < 0.1] = NO_READING
    left, top = rng.integers(100, 400, 2)
    depth[top : top + 60, left : left + 90] = 520
    depth[200, :] = np.arange(WIDTH)
    depth[201, :] = np.arange(WIDTH) + WIDTH
    depth[202, :] = np.arange(WIDTH) + 2 * WIDTH
    depth[203, :128] = np.arange(128) + 3 * WIDTH
    colour = rng.integers(0, 256, (HEIGHT, WIDTH, 3), dtype=np.uint8)
    return View(depth, colour)


def enlarged(colour: Colour) -> Colour:
    """The picture with 1280 x 1024 pixels: doubled, the last rows repeated."""
    double = colour.repeat(2, axis=0).repeat(2, axis=1)
    return np.vstack((double, double[-64:]))
