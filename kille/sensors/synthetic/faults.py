"""What a Kinect gets wrong, one function for each fault.

Depth is measured by the shift of a projected pattern of infrared dots, coded in 11
bits: raw = A - B / z. So errors that are even in raw grow with z squared in metres.
"""

from __future__ import annotations

from collections.abc import Collection

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.scene import Colour, Depth, Mask

FAULTS = ("noise", "steps", "shadow", "edges", "bayer")

BASELINE = 0.075
"""From the infrared camera to the projector on its right, in metres."""

_REFERENCE = 1.20
_PIXEL = 0.001042
_RAW_SCALE = 4 * _REFERENCE * BASELINE / _PIXEL
_RAW_AT_INFINITY = 4 * (BASELINE / _PIXEL + 0.375) + 4 * 200
_RAW_NONE = 2047

NOISE = 0.0014
"""Standard deviation of a reading at 1 m, in metres."""

_EDGE = 0.02
_KEPT_AT_EDGES = 0.25
_COLOUR_NOISE = 2.0


def raw_of(depth: NDArray[np.floating]) -> NDArray[np.float32]:
    """The Kinect's raw number for a depth in metres, not rounded: A - B / z.

    The constants are a device's usual calibration: reference distance 1.20 m, baseline
    7.5 cm, pixel 1.042 mm at the reference, four steps a pixel and an offset of 800.
    """
    return (_RAW_AT_INFINITY - _RAW_SCALE / depth).astype(np.float32)


def depth_of(raw: NDArray[np.floating]) -> NDArray[np.float32]:
    """The depth in metres for a raw number, B / (A - raw)."""
    return (_RAW_SCALE / (_RAW_AT_INFINITY - raw)).astype(np.float32)


def degrade_depth(
    depth: Depth, focal: float, faults: Collection[str], seed: tuple[int, ...]
) -> Depth:
    """The depth (H, W) with the faults among `noise steps shadow edges`.

    `focal` in pixels; every fault has a random stream of its own, so that switching
    one changes nothing in another.
    """
    seen = depth
    if "noise" in faults:
        seen = with_noise(seen, np.random.default_rng([*seed, 0]))
    if "steps" in faults:
        seen = with_steps(seen)
    lost = [
        *([infrared_shadow(depth, focal)] if "shadow" in faults else []),
        *(
            [lost_edges(depth, np.random.default_rng([*seed, 1]))]
            if "edges" in faults
            else []
        ),
    ]
    if not lost:
        return seen
    return np.where(np.logical_or.reduce(lost), np.float32(np.nan), seen)


def with_noise(depth: Depth, rng: np.random.Generator) -> Depth:
    """Each depth z changed by about `NOISE` z², as an even error of 1 / z."""
    error = rng.standard_normal(depth.shape, np.float32)
    error *= np.float32(NOISE)
    error *= depth
    error += 1
    return depth / error


def with_steps(depth: Depth) -> Depth:
    """Depth rounded to what 11 bits can say; NaN beyond them."""
    raw = np.rint(raw_of(depth))
    stepped = depth_of(raw)
    stepped[(raw < 0) | (raw >= min(_RAW_NONE, _RAW_AT_INFINITY))] = np.nan
    return stepped


def infrared_shadow(depth: Depth, focal: float) -> Mask:
    """Pixels that the projector on the camera's right does not light.

    A point at column u and depth z is lit at the projector's column u - f b / z. It
    lies in the dark when a point further right in its row is lit at that column or
    before: that one stands in the way. So shadows fall to the left of near things.
    """
    columns = np.arange(depth.shape[1], dtype=np.float32)
    lit = columns - np.float32(focal * BASELINE) / depth
    nearest = np.minimum.accumulate(lit[:, ::-1], axis=1)[:, ::-1]
    dark = np.zeros(depth.shape, bool)
    dark[:, :-1] = lit[:, :-1] >= nearest[:, 1:]
    return dark


def lost_edges(depth: Depth, rng: np.random.Generator) -> Mask:
    """Most pixels next to a jump of depth, others in every frame.

    A jump is measured in 1 / z, in which a plane has the same slope everywhere, so that
    no slanted table is taken for one.
    """
    inverse = np.float32(1) / depth
    square = np.ones((3, 3), np.uint8)
    jump = cv2.dilate(inverse, square) - cv2.erode(inverse, square)
    lost = jump > _EDGE
    lost[lost] = rng.random(int(lost.sum())) > _KEPT_AT_EDGES
    return lost


def mosaic(colour: Colour) -> NDArray[np.uint8]:
    """What the sensor's pixels see through their filters: green red / blue green."""
    seen = colour[..., 1].copy()
    seen[0::2, 1::2] = colour[0::2, 1::2, 0]
    seen[1::2, 0::2] = colour[1::2, 0::2, 2]
    return seen


def with_bayer(colour: Colour, rng: np.random.Generator) -> Colour:
    """Colour seen through the mosaic with a little noise, and interpolated again."""
    noise = rng.standard_normal(colour.shape[:2], np.float32)
    noise *= np.float32(_COLOUR_NOISE)
    seen = cv2.add(mosaic(colour), noise, dtype=cv2.CV_8U)
    return cv2.cvtColor(seen, cv2.COLOR_BayerGRBG2RGB).astype(np.uint8, copy=False)


def degrade_colour(
    colour: Colour, faults: Collection[str], seed: tuple[int, ...]
) -> Colour:
    """The colour (H, W, 3) with the fault `bayer`, if it is among them."""
    if "bayer" not in faults:
        return colour
    return with_bayer(colour, np.random.default_rng([*seed, 2]))
