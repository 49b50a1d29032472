"""Colour and hue: the distribution of a region's colours, with and without
brightness."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from kille.perception.cues.patch import Patch
from kille.perception.geometry import Array
from kille.scene import Vector

LIGHTS = 8
"""Bins of lightness, from black to white."""
HUES = 13
"""Bins of a and of b, each from -VIVID to VIVID: grey is in the middle of one."""
VIVID = 52
"""Units of a and b in 8-bit Lab; what is farther from grey counts as so far."""
LENGTH = LIGHTS * HUES**2
_TONES = 16
HUE_LENGTH = _TONES**2

_LIGHT_SPREAD, _HUE_SPREAD = 1.5, 0.8  # bins: light and cameras shift colours so much
_TONE_SPREAD = 1.0  # bins
_TONE_RANGE = 4.0  # of log R/G and log B/G: indoors hardly anything is beyond it
# Linear light; the dark, where noise would decide, is lightened to be grey.
_LOG_LIGHT = (2.2 * np.log(np.arange(256) + 8.0)).astype(np.float32)


def colour(patch: Patch) -> Vector | None:
    """The roots (1352,) of a histogram of the region's colours in Lab, of length 1.

    Their distance is that of Hellinger. The histogram is blurred, so that a slight cast
    of colour changes it but slightly. None for a region without pixels.
    """
    if not len(patch.lab):
        return None
    lab = patch.lab.astype(np.intp)
    light = lab[:, 0] * LIGHTS // 256
    a, b = (
        (np.clip(lab[:, 1:].T - 128, -VIVID, VIVID) + VIVID) * HUES // (2 * VIVID + 1)
    )
    bins = (light * HUES + a) * HUES + b
    counts = np.bincount(bins, minlength=LENGTH)
    shares = counts.reshape(LIGHTS, HUES, HUES) / len(lab)
    # One axis after the other; every step moves the axis that is blurred to the end.
    for blur in (LIGHT_BLUR, HUE_BLUR, HUE_BLUR):
        shares = np.tensordot(shares, blur, axes=(0, 0))
    roots: Vector = np.sqrt(shares.ravel()).astype(np.float32)
    return roots


def hue(patch: Patch) -> Vector | None:
    """The roots (256,) of a blurred histogram of log chromaticities, of length 1.

    They are log R/G and log B/G of linear light, which exposure and shading leave as
    they are. Source: Finlayson, Hordley & Drew 2002, "Removing shadows from images".
    None for a region without pixels.
    """
    if not len(patch.rgb):
        return None
    red, green, blue = _LOG_LIGHT[patch.rgb].T
    redness = _tone(red - green, -2.0)
    blueness = _tone(blue - green, -2.5)
    counts = np.bincount(redness * _TONES + blueness, minlength=HUE_LENGTH)
    shares = counts.reshape(_TONES, _TONES) / len(patch.rgb)
    soft = _TONE_BLUR.T @ shares @ _TONE_BLUR
    roots: Vector = np.sqrt(soft.ravel()).astype(np.float32)
    return roots


def _tone(log: Array, least: float) -> NDArray[np.intp]:
    bins = ((log - least) / _TONE_RANGE * _TONES).astype(np.intp)
    return np.clip(bins, 0, _TONES - 1)


def _blur(bins: int, width: float) -> NDArray[np.float64]:
    """The matrix (bins, bins) that spreads the share of each bin (row) over all
    bins."""
    apart = np.subtract.outer(np.arange(bins), np.arange(bins))
    spread = np.exp(-((apart / width) ** 2) / 2)
    shares: NDArray[np.float64] = spread / spread.sum(axis=1, keepdims=True)
    return shares


LIGHT_BLUR = _blur(LIGHTS, _LIGHT_SPREAD)
HUE_BLUR = _blur(HUES, _HUE_SPREAD)
_TONE_BLUR = _blur(_TONES, _TONE_SPREAD)
