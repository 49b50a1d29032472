"""The scene as values: frames, regions, features and looks, all immutable.

Axes are those of the colour camera: x to the right, y down, z forward, in metres.
Pixels are (u, v) = (column, row). Depth is registered to colour, in metres, NaN where
the sensor gave no reading.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ttr.hooks import hook
from ttr.showing import NotebookValue, Part

Colour = NDArray[np.uint8]
Depth = NDArray[np.float32]
Mask = NDArray[np.bool_]
Vector = NDArray[np.float32]
Direction = tuple[float, float, float]
"""Metres along three axes; where axes are level: right, away, up."""

Traits = Mapping[str, Vector]
"""What a thing looks like as a whole, by the name of the cue that tells it.

What could not be told is missing. Two vectors of one cue are the farther apart, the
less two things are alike in it.
"""


class Point(NamedTuple):
    """A place in metres: right, down and forward of the colour camera."""

    x: float
    y: float
    z: float


class Box(NamedTuple):
    """A box of pixels: left and top are inside, right and bottom are not."""

    left: int
    top: int
    right: int
    bottom: int


@dataclass(frozen=True)
class Intrinsics:
    """The pinhole model in pixels: u = fx x/z + cx, v = fy y/z + cy."""

    fx: float
    fy: float
    cx: float
    cy: float


@dataclass(frozen=True, eq=False)
class Frame:
    """One picture: colour (H, W, 3) RGB, depth (H, W) or None, and time in seconds.

    `outlines` holds what a labelled recording or a simulation knows to be where,
    name -> mask (H, W). It is a tutor's finger and a test's answer; nothing that
    recognises may read it.
    """

    colour: Colour
    depth: Depth | None
    intrinsics: Intrinsics | None
    time: float
    outlines: Mapping[str, Mask]


@dataclass(frozen=True, eq=False)
class Region:
    """The pixels of one thing: mask (H, W), its box, and its middle or None.

    `place` is the median of the 3-D points under the mask; without depth it is None,
    since the location is honestly unknown.
    """

    mask: Mask
    box: Box
    place: Point | None


@dataclass(frozen=True, eq=False)
class Features:
    """SIFT features of one scan of one region.

    descriptors (n, 128) uint8; pixels (n, 2) float32 as (u, v); points (n, 3) float32
    in metres, NaN where there was no depth.
    """

    descriptors: NDArray[np.uint8]
    pixels: NDArray[np.float32]
    points: NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Percept:
    """One thing seen in one look: its region in the first frame, and its scans.

    The scans are of consecutive frames, ten of them where the sensor has as many; they
    may be extracted only when they are asked for, and so are the traits measured.
    `frame` is the first of them, None for what was not seen but described.
    """

    region: Region
    scans: Sequence[Features]
    measure: Callable[[], Traits] = dict
    frame: Frame | None = None

    @cached_property
    def traits(self) -> Traits:
        """The traits, which `measure` computes once."""
        return self.measure()


@hook
def shown_look(look: Look) -> Part:
    """A look as a picture and a table (`kille.perception.shown_looks`)."""
    raise NotImplementedError


@dataclass(frozen=True, eq=False)
class Look(NotebookValue):
    """One look at the scene: the first frame, and the things in view, nearest first."""

    frame: Frame
    percepts: tuple[Percept, ...]
    up: tuple[float, float, float]

    def _shown_as_(self) -> Part:
        return shown_look(self)


@dataclass(frozen=True)
class Configuration:
    """How a target is placed relative to a landmark, as spatial words describe it.

    Directions are in metres on the level axes of the viewer: right, away, up. What is
    unknown is None.
    """

    offset: Direction
    """The vector from the landmark to the target."""
    viewed: Direction | None = None
    """The vector from the viewer to the landmark."""
    target_size: float | None = None
    """Metres from end to end."""
    landmark_size: float | None = None
    others: tuple[Direction, ...] = ()
    """From the landmark to each of the other things."""
    heading: float | None = None
    """The landmark's own front: radians counter-clockwise from right."""
    contact: float | None = None
    """The share of the target that touches the landmark, in [0, 1]."""
    support: float | None = None
    """How far the landmark supports the target, in [0, 1]."""
    containment: float | None = None
    """The share of the target within the landmark's bounds, in [0, 1]."""
