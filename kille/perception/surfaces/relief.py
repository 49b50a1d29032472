"""The depth picture at working size, what stands out from the table in it, its jumps.

A pixel at working size sees a fixed angle, whatever the camera: the finer pictures of a
long lens are of the same sensor, and only repeat its noise. It keeps the nearest
reading of its block, so that the depths of two things are never mixed.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.perception.geometry import Array, Rays, rays_of, readings
from kille.perception.table import Plane, find_table, reach_of
from kille.scene import Frame, Intrinsics, Mask

Labels = NDArray[np.int32]
Window = tuple[slice, slice]

_WORKING_FOCUS = 262.5  # pixels: a Kinect's picture (525) at half size
_HIGHEST = 0.6  # metres above the table
_NEAR = 1.5  # metres: without a table what is nearer than this may be a thing
_LARGEST_SHARE = 0.3  # of the picture: without a table what is larger is a wall
_MARGIN = 6  # working pixels around what stands out


@dataclass(frozen=True, eq=False)
class Relief:
    """Depth (h, w) at working size, the rays of its pixels, and how it was made."""

    depth: Array
    rays: Rays
    step: int
    lens: Intrinsics

    def areas(self) -> Array:
        """The area in m² of each pixel, if it faces the camera; 0 without depth."""
        sides = np.nan_to_num(self.depth) * np.float32(self.step)
        areas: Array = sides**2 / np.float32(self.lens.fx * self.lens.fy)
        return areas

    def crop(self, window: Window) -> Relief:
        """The part of the relief in a window of rows and columns."""
        rays = Rays(self.rays.right[window], self.rays.down[window])
        return replace(self, depth=self.depth[window], rays=rays)


def relief_of(frame: Frame) -> Relief | None:
    """The frame's depth at working size; None if it has none or no intrinsics."""
    depth, lens = readings(frame), frame.intrinsics
    if depth is None or lens is None:
        return None
    largest = max(1, min(depth.shape))
    step = int(np.clip(round(lens.fx / _WORKING_FOCUS), 1, largest))
    rows, columns = (size // step * step for size in depth.shape)
    blocks = [
        depth[down:rows:step, right:columns:step]
        for down in range(step)
        for right in range(step)
    ]
    rays = rays_of(lens, (rows, columns), step)
    return Relief(np.fmin.reduce(blocks), rays, step, lens)


def table_in(relief: Relief) -> Plane | None:
    """The table in view, or None if there is none."""
    return find_table(relief.rays, relief.depth)


def protruding_pixels(relief: Relief, table: Plane | None) -> Mask:
    """The pixels (h, w) of things: above the table, but not too high above it.

    Without a table, these are the near pixels that belong to no wall.
    """
    if table is None:
        near: Mask = relief.depth < _NEAR
        return _without_walls(near, relief.depth)
    heights = table.heights(relief.rays, relief.depth)
    clear = 0.004 + 0.006 * relief.depth**2  # the sensor's noise grows so
    above: Mask = (heights > clear) & (heights < _HIGHEST)
    flat = np.abs(heights) < clear
    return above & reach_of(table, relief.rays, relief.depth, flat)


def jump_of(depth: Array) -> Array:
    """The least difference in depth, in metres, that is a jump at this depth."""
    least: Array = 0.004 + 0.012 * depth
    return least


def step_of(depth: Array) -> Array:
    """The least difference in depth, in metres, that is more than noise at this depth.

    What faces the camera has no such differences, a slanting surface may have them.
    """
    least: Array = 0.003 + 0.008 * depth**2
    return least


def jumps(
    depth: Array, least: float = 0.0, of: Callable[[Array], Array] = jump_of
) -> Mask:
    """The pixels (h, w) just behind a jump in depth, in a row or a column.

    A jump exceeds what `of` says at its depth, and `least` metres. Only its far side is
    marked: that is the less certain one, and one pixel is enough to separate two
    things.
    """
    filled = np.nan_to_num(depth)
    behind = np.zeros(depth.shape, bool)
    for ahead, back in (
        (np.s_[:-1, :], np.s_[1:, :]),
        (np.s_[:, :-1], np.s_[:, 1:]),
    ):
        rise = filled[back] - filled[ahead]
        step = np.maximum(of(np.minimum(filled[back], filled[ahead])), least)
        behind[back] |= rise > step
        behind[ahead] |= -rise > step
    return behind


def window_of(inside: Mask) -> Window:
    """The rows and columns around the pixels inside, with a margin."""
    left, top, width, height = cv2.boundingRect(inside.astype(np.uint8))
    rows = slice(max(0, top - _MARGIN), top + height + _MARGIN)
    return rows, slice(max(0, left - _MARGIN), left + width + _MARGIN)


def _without_walls(near: Mask, depth: Array) -> Mask:
    """The near pixels without connected pieces as large as a wall."""
    core = (near & ~jumps(depth)).astype(np.uint8)
    _, labels, stats, _ = cv2.connectedComponentsWithStats(core, connectivity=4)
    wall = stats[:, cv2.CC_STAT_AREA] >= _LARGEST_SHARE * labels.size
    wall[0] = False
    kept: Mask = near & ~wall[labels]
    return kept
