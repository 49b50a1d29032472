"""Metric size: the extent of the visible part of a thing, from depth."""

from __future__ import annotations

import numpy as np

from kille.perception.cues.patch import Patch
from kille.perception.geometry import Array
from kille.scene import Vector

LENGTH = 3
_LEAST_POINTS = 20
_ENDS = (2, 98)  # percentiles: what is farther out is noise
_SOFTENING = 0.01  # metres: sensors do not tell a height of 5 mm from one of 1 mm


def size(patch: Patch) -> Vector | None:
    """log(reach + 1 cm) along the three principal axes (3,), longest first.

    It is the size of what is visible, not of what is hidden behind it; twice as long is
    as far from the thing's own size as half as long. None for fewer than 20 points.
    """
    extents = reach(patch)
    if extents is None:
        return None
    logs: Vector = np.log(extents + _SOFTENING).astype(np.float32)
    return logs


def reach(patch: Patch) -> Array | None:
    """The extent of the region's points along their principal axes (3,), in metres.

    Points at the edges are used only if the others are too few; None if all are.
    """
    for points in (patch.inner_points, patch.points):
        if len(points) >= _LEAST_POINTS:
            return _extents(points)
    return None


def _extents(points: Array) -> Array:
    middle = points - np.median(points, axis=0)
    _, axes = np.linalg.eigh(middle.T @ middle)
    low, high = np.percentile(middle @ axes, _ENDS, axis=0)
    return np.sort(high - low)[::-1].astype(np.float32)
