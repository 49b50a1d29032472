"""Local descriptors on a regular grid, from values pooled once for all of them."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import cv2
import numpy as np

from kille.perception.cues.patch import SIDE, Window
from kille.perception.geometry import Array

_STEP = 4  # pixels between two descriptors
_EDGE_CELLS = (3, 5, 8)  # pixels across one of 4 x 4 cells: from print to shape
_COLOUR_CELLS = (4, 7)
_BEARINGS = 8
_FLAT = 200.0  # units of grey times pixels: gradients that are weaker are noise


class Descriptors(NamedTuple):
    """Descriptors (n, k) and the places (n, 2) of their middles, from -.5 to .5."""

    values: Array
    places: Array


Pooled = Callable[[Window, int], Array]
"""What is around each pixel (SIDE, SIDE, m), in a cell of so many pixels."""


def edges(window: Window) -> Descriptors:
    """RootSIFT (n, 128) wherever the middle is inside of what the window shows.

    Source: Lowe 2004; on a grid as in Vedaldi & Fulkerson 2010, "VLFeat", with flat
    windows; roots by Arandjelović & Zisserman 2012.
    """
    found = _on_grid(window, _gradients, _EDGE_CELLS)
    sums = found.values.sum(axis=1, keepdims=True)
    return Descriptors(np.sqrt(found.values / (sums + np.float32(_FLAT))), found.places)


def colours(window: Window) -> Descriptors:
    """Means and deviations (n, 96) of Lab in 4 x 4 cells, on the same grid.

    Source: local colour statistics by Clinchant, Csurka, Perronnin & Renders 2007,
    "XRCE's participation to ImagEval" (there in RGB).
    """
    return _on_grid(window, _statistics, _COLOUR_CELLS)


def _on_grid(window: Window, pooled: Pooled, cells: tuple[int, ...]) -> Descriptors:
    found = [_of_cells(window, pooled(window, cell), cell) for cell in cells]
    return Descriptors(
        np.concatenate([each.values for each in found]),
        np.concatenate([each.places for each in found]),
    )


def _of_cells(window: Window, pooled: Array, cell: int) -> Descriptors:
    """Descriptors of 4 x 4 cells each, from the values pooled around each pixel."""
    middles = np.arange(_STEP // 2 + cell, SIDE - cell, _STEP)
    offsets = np.rint((np.arange(4) - 1.5) * cell).astype(int)
    down, right = (it.ravel() for it in np.meshgrid(middles, middles, indexing="ij"))
    inside = window.inside[down, right]
    down, right = down[inside], right[inside]
    rows = np.clip(down[:, None] + offsets, 0, SIDE - 1)
    columns = np.clip(right[:, None] + offsets, 0, SIDE - 1)
    cells = (rows[:, :, None] * SIDE + columns[:, None, :]).ravel()
    each = pooled.reshape(SIDE * SIDE, -1)
    values = each.take(cells, axis=0).reshape(len(down), 16 * each.shape[1])
    places = np.stack([right, down], axis=1) / np.float32(SIDE) - np.float32(0.5)
    return Descriptors(values, places.astype(np.float32))


def _gradients(window: Window, cell: int) -> Array:
    """The strength of the gradients in each of eight directions around each pixel."""
    smooth = cv2.GaussianBlur(
        window.grey.astype(np.float32), (0, 0), max(cell / 5, 0.4)
    )
    right, down = (
        cv2.Sobel(smooth, cv2.CV_32F, *axis, ksize=1, scale=0.5)
        for axis in ((1, 0), (0, 1))
    )
    length, angle = cv2.cartToPolar(right, down)
    turn = angle * np.float32(_BEARINGS / (2 * np.pi))
    kernel = np.bartlett(2 * cell + 1)[1:-1].astype(np.float32)
    pooled = np.empty((SIDE, SIDE, _BEARINGS), np.float32)
    for bearing in range(_BEARINGS):
        off = np.abs(turn - bearing)
        near = np.maximum(1 - np.minimum(off, _BEARINGS - off), 0)
        pooled[..., bearing] = cv2.sepFilter2D(length * near, -1, kernel, kernel)
    return pooled


def _statistics(window: Window, cell: int) -> Array:
    """The mean and the standard deviation of L, a and b around each pixel."""
    lab = window.lab
    mean, squares = (cv2.blur(it, (cell, cell)) for it in (lab, lab * lab))
    deviation = np.sqrt(np.maximum(squares - mean * mean, 0))
    return np.concatenate([mean, deviation], axis=2)
