"""Between pixels and places: rays of a pinhole camera, points, and level axes."""

from __future__ import annotations

from dataclasses import astuple
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kille.scene import Box, Depth, Frame, Intrinsics, Mask, Point

Array = NDArray[np.float32]
Direction = tuple[float, float, float]

CAMERA_UP: Direction = (0.0, -1.0, 0.0)
"""What counts as up when no table is seen: a camera that is held level."""


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


def points_at(frame: Frame, pixels: Array) -> Array:
    """The points (n, 3) in metres seen at pixels (n, 2), NaN where nothing was read."""
    depth, lens = frame.depth, frame.intrinsics
    if depth is None or lens is None:
        return np.full((len(pixels), 3), np.nan, np.float32)
    height, width = depth.shape
    columns = np.clip(np.rint(pixels[:, 0]).astype(int), 0, width - 1)
    rows = np.clip(np.rint(pixels[:, 1]).astype(int), 0, height - 1)
    z = depth[rows, columns]
    x = (pixels[:, 0] - lens.cx) / lens.fx * z
    y = (pixels[:, 1] - lens.cy) / lens.fy * z
    return np.stack([x, y, z], axis=1).astype(np.float32)


def points_under(depth: Depth, mask: Mask, lens: Intrinsics) -> Array:
    """The points (n, 3) in metres that were read under the mask (H, W)."""
    vs, us = np.nonzero(mask & np.isfinite(depth))
    z = depth[vs, us]
    x = (us - lens.cx) / lens.fx * z
    y = (vs - lens.cy) / lens.fy * z
    return np.stack([x, y, z], axis=1).astype(np.float32)


def points_in(frame: Frame, mask: Mask, box: Box) -> Array:
    """The points (n, 3) in metres read under a mask (H, W) that lies in the box.

    There are none if the frame has no depth or no intrinsics.
    """
    if frame.depth is None or frame.intrinsics is None:
        return np.empty((0, 3), np.float32)
    fx, fy, cx, cy = astuple(frame.intrinsics)
    lens = Intrinsics(fx, fy, cx - box.left, cy - box.top)
    inside = np.s_[box.top : box.bottom, box.left : box.right]
    return points_under(frame.depth[inside], mask[inside], lens)


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
    """Where the target is from the landmark, in metres: right, away, up.

    Away is along the table, away from the viewer.

    >>> offset(Point(0.1, 0.0, 1.2), Point(0.0, 0.2, 1.0), CAMERA_UP)
    (0.1, 0.2, 0.2)
    """
    apart = table_axes(up) @ (np.asarray(target) - np.asarray(landmark))
    right, away, above = (round(float(it), 6) for it in apart)
    return right, away, above
