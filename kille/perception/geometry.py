"""Convert between pixels and points in space: pinhole rays, points, and level axes."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kille.scene import Box, Depth, Direction, Frame, Intrinsics, Mask, Point

Array = NDArray[np.float32]

CAMERA_UP: Direction = (0.0, -1.0, 0.0)
"""The direction taken as up when no table is seen, as if the camera were level."""

_NEAREST, _FARTHEST = 1e-3, 1e3  # metres: the range of valid readings


class Rays(NamedTuple):
    """Normalised pixel coordinates (h, w): at depth z the point z (right, down, 1)."""

    right: Array
    down: Array


def rays_of(lens: Intrinsics, shape: tuple[int, int], step: int = 1) -> Rays:
    """The rays through a picture of (H, W) pixels, one for each step x step block.

    The ray of a block is that of its middle.
    """
    middle = (step - 1) / 2
    us = np.arange(shape[1] // step) * step + middle
    vs = np.arange(shape[0] // step) * step + middle
    right = ((us - lens.cx) / lens.fx).astype(np.float32)
    down = ((vs - lens.cy) / lens.fy).astype(np.float32)
    return Rays(*np.meshgrid(right, down))


def readings(frame: Frame) -> Depth | None:
    """The frame's depth at the size of its picture; invalid readings are NaN.

    A reading is above 1 mm and below 1 km. Depth of another size is stretched over the
    picture. None if there is no depth, or no camera model to make sense of it.

    >>> depth = np.array([[0.0, np.inf, 0.8, np.nan]], np.float32)
    >>> picture = np.zeros((1, 4, 3), np.uint8)
    >>> readings(Frame(picture, depth, Intrinsics(500, 500, 2, 0), 0.0, {}))
    array([[nan, nan, 0.8, nan]], dtype=float32)
    """
    depth = _depth_at_picture_size(frame)
    return None if depth is None else _drop_unread(depth)


def points_at(frame: Frame, pixels: Array) -> Array:
    """The points (n, 3) in metres at pixels (n, 2); NaN where there is no reading."""
    depth, lens = _depth_at_picture_size(frame), frame.intrinsics
    if depth is None or lens is None:
        return np.full((len(pixels), 3), np.nan, np.float32)
    height, width = depth.shape
    columns = np.clip(np.rint(pixels[:, 0]).astype(int), 0, width - 1)
    rows = np.clip(np.rint(pixels[:, 1]).astype(int), 0, height - 1)
    z = _drop_unread(depth[rows, columns])
    x = (pixels[:, 0] - lens.cx) / lens.fx * z
    y = (pixels[:, 1] - lens.cy) / lens.fy * z
    return np.stack([x, y, z], axis=1).astype(np.float32)


def _depth_at_picture_size(frame: Frame) -> Depth | None:
    """The raw depth, with one number for each pixel of the picture."""
    depth, lens = frame.depth, frame.intrinsics
    if depth is None or depth.size == 0 or lens is None or not _usable(lens):
        return None
    height, width = frame.colour.shape[:2]
    return (
        depth
        if depth.shape == (height, width)
        else _stretch_depth(depth, (height, width))
    )


def _drop_unread(depth: Depth) -> Depth:
    """Set depth outside the range of valid readings to NaN."""
    read = (depth > _NEAREST) & (depth < _FARTHEST)
    return np.where(read, depth, np.float32(np.nan)).astype(np.float32, copy=False)


def _usable(lens: Intrinsics) -> bool:
    numbers = lens.fx, lens.fy, lens.cx, lens.cy
    return all(map(math.isfinite, numbers)) and lens.fx > 0 and lens.fy > 0


def _stretch_depth(depth: Depth, shape: tuple[int, int]) -> Depth:
    """Resize depth to (H, W); each pixel gets the reading nearest to it."""
    rows, columns = (
        (2 * np.arange(size) + 1) * have // (2 * size)
        for size, have in zip(shape, depth.shape, strict=True)
    )
    stretched: Depth = depth[rows[:, None], columns]
    return stretched


def points_under(depth: Depth, mask: Mask, lens: Intrinsics) -> Array:
    """The points (n, 3) in metres of all valid readings under the mask (H, W)."""
    vs, us = np.nonzero(mask & (depth > _NEAREST) & (depth < _FARTHEST))
    z = depth[vs, us]
    x = (us - lens.cx) / lens.fx * z
    y = (vs - lens.cy) / lens.fy * z
    return np.stack([x, y, z], axis=1).astype(np.float32)


def points_in(frame: Frame, mask: Mask, box: Box) -> Array:
    """The points (n, 3) in metres read under a mask (H, W) that lies in the box.

    There are none if the frame has no depth or no intrinsics.
    """
    depth, lens = _depth_at_picture_size(frame), frame.intrinsics
    if depth is None or lens is None:
        return np.empty((0, 3), np.float32)
    inside = np.s_[box.top : box.bottom, box.left : box.right]
    moved = replace(lens, cx=lens.cx - box.left, cy=lens.cy - box.top)
    return points_under(depth[inside], mask[inside], moved)


def table_axes(up: Direction) -> NDArray[np.float64]:
    """The axes of a viewer at the table as rows of (3, 3): right, away, up.

    They are unit vectors in camera axes; right is the camera's right laid level.
    ValueError if up points along the camera's right.

    >>> table_axes(CAMERA_UP).tolist()
    [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]
    """
    vertical = np.asarray(up, np.float64)
    vertical = vertical / np.linalg.norm(vertical)
    level = np.array([1.0, 0.0, 0.0]) - vertical[0] * vertical
    length = np.linalg.norm(level)
    if length < 1e-6:
        raise ValueError(f"up {up} points along the camera's right: nothing is level")
    right = level / length
    axes: NDArray[np.float64] = np.stack([right, np.cross(vertical, right), vertical])
    return axes + 0.0  # so that no zero is negative


def offset(target: Point, landmark: Point, up: Direction) -> Direction:
    """The vector from landmark to target in metres: right, away, up.

    Away is along the table, away from the viewer.

    >>> offset(Point(0.1, 0.0, 1.2), Point(0.0, 0.2, 1.0), CAMERA_UP)
    (0.1, 0.2, 0.2)
    """
    apart = table_axes(up) @ (np.asarray(target) - np.asarray(landmark))
    right, away, above = (round(float(it), 6) for it in apart)
    return right, away, above
