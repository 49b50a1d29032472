"""Outline and form: where a window has edges, and in which directions."""

from __future__ import annotations

from functools import cache

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.perception.cues.patch import Patch, Window
from kille.scene import Vector

_SIDE, _CELL, _BLOCK, _BEARINGS = 64, 16, 32, 9
LENGTH = (_SIDE // _CELL - 1) ** 2 * (_BLOCK // _CELL) ** 2 * _BEARINGS


def outline(patch: Patch) -> Vector | None:
    """Where the region's own outline runs (324,), whatever it encloses.

    None for a region of next to no pixels, as with all vectors of this module.
    """
    if patch.window is None:
        return None
    return histograms(patch.window.inside.astype(np.uint8) * np.uint8(255))


def form(patch: Patch) -> Vector | None:
    """Where the edges on and around the region run (324,)."""
    return _edges(patch.window)


def whole_form(patch: Patch) -> Vector | None:
    """Where the edges in the whole picture run (324,); None if it has depth."""
    return _edges(patch.whole)


def histograms(picture: NDArray[np.uint8]) -> Vector:
    """Roots of histograms of oriented gradients, of length 1 (0 without any edge).

    Source: Dalal & Triggs 2005, "Histograms of oriented gradients for human detection".
    """
    small = cv2.resize(picture, (_SIDE, _SIDE), interpolation=cv2.INTER_AREA)
    found = np.sqrt(np.asarray(_hog().compute(small), np.float32).ravel())
    length = max(float(np.linalg.norm(found)), 1e-9)
    return np.asarray(found / length, np.float32)


def _edges(window: Window | None) -> Vector | None:
    return None if window is None else histograms(window.grey)


@cache
def _hog() -> cv2.HOGDescriptor:
    window, block, cell = (_SIDE,) * 2, (_BLOCK,) * 2, (_CELL,) * 2
    return cv2.HOGDescriptor(window, block, cell, cell, _BEARINGS)
