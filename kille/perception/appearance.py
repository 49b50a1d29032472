"""What a region looks like as a whole: its colours, and its size in metres.

Both survive where single features do not: far away, turned, in another light.
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.perception.geometry import Array, points_in
from kille.scene import Frame, Mask, Region, Traits

_LIGHT_BINS, _HUE_BINS = 8, 10
_VIVID = 64  # units of a and b in 8-bit Lab: hardly anything is farther from grey
_LIGHT_BLUR, _HUE_BLUR = 1.2, 1.0  # bins: light and cameras shift colours so much
COLOURS = _LIGHT_BINS * _HUE_BINS**2
"""The length k of a colour vector."""

_RIM = 3  # pixels: at its edges a region may hold readings of what is behind it
_LEAST_POINTS = 20
_ENDS = (2, 98)  # percentiles: what is farther out is noise


def traits_of(frame: Frame, region: Region) -> Traits:
    """All that is seen of the region as a whole."""
    return Traits(colour_of(frame, region), size_of(frame, region))


def colour_of(frame: Frame, region: Region) -> Array | None:
    """The colours (k,) of the region: square roots of a Lab histogram, of length 1.

    The histogram is blurred, so that a slight cast of colour changes it but slightly.
    None for a region without pixels.
    """
    box = region.box
    crop = np.s_[box.top : box.bottom, box.left : box.right]
    inside = region.mask[crop]
    if not inside.any():
        return None
    lab = cv2.cvtColor(frame.colour[crop], cv2.COLOR_RGB2LAB)[inside].astype(np.intp)
    light = lab[:, 0] * _LIGHT_BINS // 256
    a, b = np.clip(lab[:, 1:].T - 128 + _VIVID, 0, 2 * _VIVID - 1)
    a, b = a * _HUE_BINS // (2 * _VIVID), b * _HUE_BINS // (2 * _VIVID)
    bins = (light * _HUE_BINS + a) * _HUE_BINS + b
    counts = np.bincount(bins, minlength=COLOURS)
    shares = counts.reshape(_LIGHT_BINS, _HUE_BINS, _HUE_BINS) / len(lab)
    soft = np.einsum("lab,lx,ay,bz->xyz", shares, _LIGHTS, _HUES, _HUES, optimize=True)
    colour: Array = np.sqrt(soft.ravel()).astype(np.float32)
    return colour


def size_of(frame: Frame, region: Region) -> Array | None:
    """How far the region's points reach along their principal axes: (3,) in metres.

    Longest first. It is the size of what is visible, not of what is hidden behind it.
    None where the sensor has no depth, or too few readings.
    """
    if not region.mask.any():
        return None
    for mask in (_without_rim(region), region.mask):
        points = points_in(frame, mask, region.box)
        if len(points) >= _LEAST_POINTS:
            return _reach(points)
    return None


def _reach(points: Array) -> Array:
    middle = points - points.mean(axis=0)
    _, axes = np.linalg.eigh(middle.T @ middle)
    low, high = np.percentile(middle @ axes, _ENDS, axis=0)
    return np.sort(high - low)[::-1].astype(np.float32)


def _without_rim(region: Region) -> Mask:
    disc = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * _RIM + 1,) * 2)
    box = region.box
    crop = np.s_[box.top : box.bottom, box.left : box.right]
    inner = np.zeros_like(region.mask)
    around = cv2.copyMakeBorder(
        region.mask[crop].astype(np.uint8), *(_RIM,) * 4, cv2.BORDER_CONSTANT, value=0
    )
    inner[crop] = cv2.erode(around, disc)[_RIM:-_RIM, _RIM:-_RIM] > 0
    return inner


def _blur(bins: int, width: float) -> NDArray[np.float64]:
    """How the share of each bin (row) is spread over all bins (bins, bins)."""
    apart = np.subtract.outer(np.arange(bins), np.arange(bins))
    spread = np.exp(-((apart / width) ** 2) / 2)
    shares: NDArray[np.float64] = spread / spread.sum(axis=1, keepdims=True)
    return shares


_LIGHTS = _blur(_LIGHT_BINS, _LIGHT_BLUR)
_HUES = _blur(_HUE_BINS, _HUE_BLUR)
