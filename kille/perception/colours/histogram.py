"""Recover colours from the cue `colour` by sharpening its blurred histogram.

A lesson keeps the cue of what was seen, not the picture. The histogram is sharpened by
the steps of Richardson (1972) and Lucy (1974), which keep shares positive: what comes
out is the likeliest histogram to be blurred into the one that was kept.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from kille.perception.colours.space import Lab
from kille.perception.cues import colour as cue
from kille.scene import Vector

_STEPS = 30  # more steps sharpen the noise as well
_FAINT = 1e-9


def cells_of(vector: Vector) -> tuple[Lab, NDArray[np.float64]]:
    """The centres (n, 3) of the histogram's cells in Lab, and their shares (n,).

    ValueError for a vector that is no such cue.
    """
    if vector.shape != (cue.LENGTH,):
        raise ValueError(
            f"the cue colour has {cue.LENGTH} numbers, but this vector has the shape "
            f"{vector.shape}"
        )
    blurred = np.square(vector.astype(float)).reshape(cue.LIGHTS, cue.HUES, cue.HUES)
    if not (np.isfinite(blurred).all() and blurred.any()):
        raise ValueError("the cue colour has finite numbers that are not all 0")
    return _MIDDLES, _sharpen(blurred / blurred.sum()).ravel()


def _sharpen(blurred: NDArray[np.float64]) -> NDArray[np.float64]:
    shares = blurred
    for _ in range(_STEPS):
        expected = _spread(shares, cue.LIGHT_BLUR, cue.HUE_BLUR)
        ratio = blurred / np.maximum(expected, _FAINT)
        shares = shares * _spread(ratio, cue.LIGHT_BLUR.T, cue.HUE_BLUR.T)
    return np.asarray(shares / shares.sum())


def _spread(
    cells: NDArray[np.float64], light: NDArray[np.float64], hue: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Spread the share of each cell as the rows of a blur say."""
    for blur in (light, hue, hue):
        cells = np.tensordot(cells, blur, axes=(0, 0))
    return cells


def _middles() -> Lab:
    lights = (np.arange(cue.LIGHTS) + 0.5) * 100 / cue.LIGHTS
    width = (2 * cue.VIVID + 1) / cue.HUES
    hues = (np.arange(cue.HUES) - (cue.HUES - 1) / 2) * width
    grid = np.meshgrid(lights, hues, hues, indexing="ij")
    return np.stack([axis.ravel() for axis in grid], axis=1)


_MIDDLES = _middles()
