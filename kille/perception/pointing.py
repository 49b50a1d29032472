"""Pointing: the region a tutor means by a pixel.

Things that touch are one piece to the plain rule. A tutor who points into a pile means
the part around the finger: the surface that ends where depth jumps or where the shape
turns inwards, as it does where one thing meets another.
"""

from __future__ import annotations

import cv2
import numpy as np

from kille.perception.geometry import Array, points_under
from kille.perception.segment import (
    Labels,
    Relief,
    enlarged,
    grown,
    pieces,
    region_of,
    relief_of,
    segment,
)
from kille.scene import Frame, Mask, Region

_SLACK = 20.0  # pixels: a finger may miss a thing by so much
_LARGEST = 0.24  # metres from end to end: what is larger may be a pile
_PART = 0.6  # of the region: a larger surface than that is the thing, not a part
_SMOOTHING = 0.02  # 1/m: differences below it are noise, above it are edges
_INWARD = 0.3  # how far normals turn towards each other where two things meet
_REACH = 3  # working pixels to each side when normals are compared
_STRIDE = 2  # working pixels to each side when normals are made
_RIM = 7  # working pixels given back to a surface that was cut out


def region_at(frame: Frame, pixel: tuple[int, int]) -> Region | None:
    """The region at the pixel (u, v), or the one nearest to it within 20 pixels.

    A region of more than 24 cm from end to end may be a pile: if the surface around the
    pixel is less than .6 of it, only that surface is meant. None if there is nothing
    near the pixel.
    """
    regions = segment(frame).regions
    found = min(regions, key=lambda it: _miss(it.mask, pixel), default=None)
    if found is None or _miss(found.mask, pixel) > _SLACK:
        return None
    relief = relief_of(frame)
    if relief is None or extent(frame, found) <= _LARGEST:
        return found
    surface = _surface(frame, relief, found, pixel)
    part = np.count_nonzero(surface.mask) < _PART * np.count_nonzero(found.mask)
    return surface if part else found


def extent(frame: Frame, region: Region) -> float:
    """Metres from end to end of the region, without its outermost points; 0 if unknown.

    The ends are the 5th and the 95th percentile along each axis of the camera.
    """
    if frame.depth is None or frame.intrinsics is None:
        return 0.0
    points = points_under(frame.depth, region.mask, frame.intrinsics)
    if not len(points):
        return 0.0
    low, high = np.percentile(points, (5, 95), axis=0)
    return float(np.linalg.norm(high - low))


def _miss(mask: Mask, pixel: tuple[int, int]) -> float:
    """Pixels from this one to the mask."""
    rows, columns = np.nonzero(mask)
    if not rows.size:
        return float("inf")
    return float(np.sqrt(((columns - pixel[0]) ** 2 + (rows - pixel[1]) ** 2).min()))


def _surface(
    frame: Frame, relief: Relief, pile: Region, pixel: tuple[int, int]
) -> Region:
    """The smooth surface of the pile around the pixel; the pile if there is none."""
    rows, columns = (size * relief.step for size in relief.depth.shape)
    inside = pile.mask[: rows : relief.step, : columns : relief.step]
    labels = pieces(relief, inside & ~turns_inwards(relief))
    labels = enlarged(grown(labels, inside, _RIM), relief.step, frame.colour.shape)
    label = _nearest_label(labels, pixel)
    return region_of(frame, labels == label) if label else pile


def turns_inwards(relief: Relief) -> Mask:
    """The pixels (h, w) where the surface bends towards the viewer, as in a corner.

    There the normals on the two sides lean towards each other.
    """
    surface = _smooth_points(relief)
    normals = _normals(surface)
    inwards = np.zeros(relief.depth.shape, bool)
    for down, right in ((0, _REACH), (_REACH, 0), (_REACH, _REACH), (-_REACH, _REACH)):
        apart = _shifted(surface, down, right) - _shifted(surface, -down, -right)
        turn = _shifted(normals, down, right) - _shifted(normals, -down, -right)
        lean = (turn * apart).sum(axis=2) / np.linalg.norm(apart, axis=2)
        inwards |= lean < -_INWARD
    return inwards


def _smooth_points(relief: Relief) -> Array:
    """The points (h, w, 3) of the depth smoothed within surfaces, NaN where it is."""
    inverse = np.nan_to_num(1 / relief.depth)
    smooth = cv2.bilateralFilter(inverse, 7, _SMOOTHING, 3)
    known = np.isfinite(relief.depth) & (smooth > 0)
    depth = np.divide(1, smooth, out=np.full_like(smooth, np.nan), where=known)
    right, down = relief.rays
    return np.stack([right * depth, down * depth, depth], axis=2)


def _normals(surface: Array) -> Array:
    """Unit normals (h, w, 3) towards the camera, NaN where points are missing."""
    across = _shifted(surface, 0, _STRIDE) - _shifted(surface, 0, -_STRIDE)
    along = _shifted(surface, _STRIDE, 0) - _shifted(surface, -_STRIDE, 0)
    normals = np.cross(along, across)
    unit: Array = normals / np.linalg.norm(normals, axis=2, keepdims=True)
    return unit


def _shifted(array: Array, down: int, right: int) -> Array:
    """The array (h, w, 3) whose pixel is the one so far down and right, NaN outside."""
    moved = np.full_like(array, np.nan)
    height, width = array.shape[:2]
    moved[
        max(0, -down) : height - max(0, down), max(0, -right) : width - max(0, right)
    ] = array[
        max(0, down) : height + min(0, down), max(0, right) : width + min(0, right)
    ]
    return moved


def _nearest_label(labels: Labels, pixel: tuple[int, int]) -> int:
    """The label at the pixel or nearest to it; 0 if there is none at all."""
    rows, columns = np.nonzero(labels)
    if not rows.size:
        return 0
    nearest = np.argmin((columns - pixel[0]) ** 2 + (rows - pixel[1]) ** 2)
    return int(labels[rows[nearest], columns[nearest]])
