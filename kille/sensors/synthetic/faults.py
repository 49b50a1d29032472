"""What a Kinect gets wrong, one function for each fault.

Depth is measured by the shift of a projected pattern of infrared dots, coded in 11
bits: raw = A - B / z. So errors that are even in raw grow with z squared in metres.
"""

from __future__ import annotations

from collections.abc import Collection
from functools import cached_property

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


class FaultyView:
    """An unchanging view as a Kinect has it: its frames differ by chance alone.

    `focal` in pixels. Of the faults, what chance does not change is found once. Each
    has a random stream of its own, so that switching one changes nothing in another.
    """

    def __init__(
        self, colour: Colour, depth: Depth, focal: float, faults: Collection[str]
    ) -> None:
        self._colour, self._depth = colour, depth
        self._focal, self._faults = focal, faults

    def colour(self, seed: tuple[int, ...]) -> Colour:
        """The colour (H, W, 3) of the frame with this seed."""
        if "bayer" not in self._faults:
            return self._colour
        noise = standard_noise(self._depth.shape, (*seed, 2))
        return with_bayer(self._mosaic, noise)

    def depth(self, seed: tuple[int, ...]) -> Depth:
        """The depth (H, W) of the frame with this seed; NaN where it is lost."""
        seen = self._depth
        if "noise" in self._faults:
            seen = with_noise(seen, standard_noise(seen.shape, (*seed, 0)))
        if "steps" in self._faults:
            seen = with_steps(seen)
        lost = []
        if "shadow" in self._faults:
            lost.append(self._shadow)
        if "edges" in self._faults:
            lost.append(lost_edges(self._jumps, np.random.default_rng([*seed, 1])))
        if not lost:
            return seen
        return np.where(np.logical_or.reduce(lost), np.float32(np.nan), seen)

    @cached_property
    def _mosaic(self) -> NDArray[np.uint8]:
        return mosaic(self._colour)

    @cached_property
    def _shadow(self) -> Mask:
        return infrared_shadow(self._depth, self._focal)

    @cached_property
    def _jumps(self) -> Mask:
        return depth_jumps(self._depth)


def standard_noise(
    shape: tuple[int, ...], seed: tuple[int, ...]
) -> NDArray[np.float32]:
    """A standard normal number for each pixel, the same for the same seed."""
    return np.random.default_rng(seed).standard_normal(shape, np.float32)


def with_noise(depth: Depth, noise: NDArray[np.float32]) -> Depth:
    """Each depth z changed by about `NOISE` z², as an even error of 1 / z."""
    error = noise * np.float32(NOISE)
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


def depth_jumps(depth: Depth) -> Mask:
    """The pixels next to a jump of depth.

    A jump is measured in 1 / z, in which a plane has the same slope everywhere, so that
    no slanted table is taken for one.
    """
    inverse = np.float32(1) / depth
    square = np.ones((3, 3), np.uint8)
    jump = cv2.dilate(inverse, square) - cv2.erode(inverse, square)
    return jump > _EDGE


def lost_edges(jumps: Mask, rng: np.random.Generator) -> Mask:
    """Most of the pixels next to a jump, others in every frame."""
    lost = jumps.copy()
    lost[lost] = rng.random(int(lost.sum())) > _KEPT_AT_EDGES
    return lost


def mosaic(colour: Colour) -> NDArray[np.uint8]:
    """What the sensor's pixels see through their filters: green red / blue green."""
    seen = colour[..., 1].copy()
    seen[0::2, 1::2] = colour[0::2, 1::2, 0]
    seen[1::2, 0::2] = colour[1::2, 0::2, 2]
    return seen


def with_bayer(seen: NDArray[np.uint8], noise: NDArray[np.float32]) -> Colour:
    """The colour interpolated from a mosaic (H, W) with a little noise."""
    noisy = cv2.add(seen, noise * np.float32(_COLOUR_NOISE), dtype=cv2.CV_8U)
    return cv2.cvtColor(noisy, cv2.COLOR_BayerGRBG2RGB).astype(np.uint8, copy=False)
