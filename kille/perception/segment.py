"""Segmentation: which pixels belong to one thing on the table, from depth alone.

What stands on the table and out of it is cut where the depth jumps; each connected
piece is a region. It is done at half size, where a pixel keeps the nearest reading of
its block, so that the depths of two things are never mixed.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.perception.geometry import (
    CAMERA_UP,
    Array,
    Direction,
    Rays,
    points_in,
    rays_of,
)
from kille.perception.table import Plane, find_table, reach_of
from kille.scene import Box, Frame, Intrinsics, Mask, Point, Region

Labels = NDArray[np.int32]

_WORKING_WIDTH = 320
_LEAST_AREA = 5e-4  # m², facing the camera: a marker pen has 15 cm²
_LEAST_PIXELS = 24
_HIGHEST = 0.6  # metres above the table
_NEAR = 1.5  # metres: without a table what is nearer than this may be a thing
_LARGEST_SHARE = 0.3  # of the picture: without a table what is larger is a wall
_SELF_HIDING = 0.05  # metres: depth jumps by less within a thing
_HAND = 0.3  # metres from end to end of a thing that was joined
_LEAST_BORDER = 6  # pixels
_NEIGHBOURS = tuple(
    pair
    for k in (2, 4)
    for pair in (
        (np.s_[:-k, :], np.s_[k:, :]),
        (np.s_[:, :-k], np.s_[:, k:]),
    )
)
RIM = 2
"""Pixels of a thing that are lost at its edges and given back."""


@dataclass(frozen=True, eq=False)
class Scene:
    """One frame taken apart: its regions, nearest first, and which way is up."""

    regions: tuple[Region, ...]
    up: Direction


@dataclass(frozen=True, eq=False)
class Relief:
    """Depth (h, w) at working size, the rays of its pixels, and how it was made."""

    depth: Array
    rays: Rays
    step: int
    lens: Intrinsics

    def areas(self) -> Array:
        """The area each pixel covers in m², if it faces the camera; 0 without depth."""
        sides = np.nan_to_num(self.depth) * np.float32(self.step)
        areas: Array = sides**2 / np.float32(self.lens.fx * self.lens.fy)
        return areas


def segment(frame: Frame) -> Scene:
    """The things in view, nearest first.

    Without depth the whole picture is one region, whose place is unknown. Without a
    table, things are what is near and not as large as a wall.
    """
    relief = relief_of(frame)
    if relief is None:
        return Scene((whole(frame),), CAMERA_UP)
    table = find_table(relief.rays, relief.depth)
    inside = foreground(relief, table)
    labels = joined(relief, pieces(relief, inside))
    labels = grown(labels if table else _without_walls(labels), inside, RIM)
    full = enlarged(labels, relief.step, frame.colour.shape)
    regions = [
        region_of(frame, full == label) for label in np.unique(labels[labels > 0])
    ]
    up = CAMERA_UP if table is None else table.up
    return Scene(tuple(sorted(regions, key=nearness)), up)


def region_of(frame: Frame, mask: Mask) -> Region:
    """The region of these pixels (H, W), as when a tutor traces an outline."""
    left, top, width, height = cv2.boundingRect(mask.astype(np.uint8))
    box = Box(left, top, left + width, top + height)
    return Region(mask, box, _place(frame, mask, box))


def whole(frame: Frame) -> Region:
    """The whole picture as one region; where it is, is unknown."""
    height, width = frame.colour.shape[:2]
    return Region(np.ones((height, width), bool), Box(0, 0, width, height), None)


def nearness(region: Region) -> float:
    """Metres from the camera to the middle of the region, infinite if unknown."""
    return float("inf") if region.place is None else float(np.linalg.norm(region.place))


def overlap(one: Region, other: Region) -> float:
    """Pixels in both over pixels in either, from 0 to 1."""
    left, top = max(one.box.left, other.box.left), max(one.box.top, other.box.top)
    right = min(one.box.right, other.box.right)
    bottom = min(one.box.bottom, other.box.bottom)
    if left >= right or top >= bottom:
        return 0.0
    common = slice(top, bottom), slice(left, right)
    both = int(np.count_nonzero(one.mask[common] & other.mask[common]))
    either = _pixels(one) + _pixels(other) - both
    return both / either if either else 0.0


def relief_of(frame: Frame) -> Relief | None:
    """The frame's depth at working size; None if it has none or no intrinsics."""
    if frame.depth is None or frame.intrinsics is None:
        return None
    step = max(1, round(frame.depth.shape[1] / _WORKING_WIDTH))
    rows, columns = (size // step * step for size in frame.depth.shape)
    blocks = [
        frame.depth[down:rows:step, right:columns:step]
        for down in range(step)
        for right in range(step)
    ]
    rays = rays_of(frame.intrinsics, (rows, columns), step)
    return Relief(np.fmin.reduce(blocks), rays, step, frame.intrinsics)


def foreground(relief: Relief, table: Plane | None) -> Mask:
    """The pixels (h, w) that stand out of the table, on it and not too high above it.

    Without a table: those that are near.
    """
    if table is None:
        near: Mask = relief.depth < _NEAR
        return near
    heights = table.heights(relief.rays, relief.depth)
    clear = 0.004 + 0.006 * relief.depth**2  # the sensor's noise grows so
    standing: Mask = (heights > clear) & (heights < _HIGHEST)
    flat = np.abs(heights) < clear
    return standing & reach_of(table, relief.rays, relief.depth, flat)


def pieces(relief: Relief, inside: Mask) -> Labels:
    """Labels (h, w) of the connected pieces inside, cut where the depth jumps.

    0 is no piece. Pieces too small to be a thing are left out.
    """
    core = (inside & ~jumps(relief.depth)).astype(np.uint8)
    count, labels, stats, _ = cv2.connectedComponentsWithStats(core, connectivity=4)
    area = np.bincount(labels.ravel(), relief.areas().ravel(), minlength=count)
    kept = (area > _LEAST_AREA) & (stats[:, cv2.CC_STAT_AREA] > _LEAST_PIXELS)
    kept[0] = False
    return _kept(np.asarray(labels, np.int32), kept)


def joined(relief: Relief, labels: Labels) -> Labels:
    """Labels (h, w) in which the parts of one thing are one piece.

    A thing hides parts of itself: a bear its chest behind its feet, a cup its inside
    behind its rim. There the depth jumps by little, while from one thing to what is
    behind it, it jumps by its thickness. Pieces are joined, smallest jump first, as
    long as the whole is of a size that can be held.
    """
    names = np.arange(labels.max() + 1, dtype=np.int32)
    for _, one, other in sorted(_small_jumps(relief.depth, labels)):
        first, second = sorted((names[one], names[other]))
        whole = np.isin(names, (first, second))[labels]
        if first != second and _extent(relief, whole) <= _HAND:
            names[names == second] = first
    return names[labels]


def _small_jumps(depth: Array, labels: Labels) -> list[tuple[float, int, int]]:
    """Pieces between which the depth jumps by little, as (metres, one, other)."""
    apart: dict[tuple[int, int], list[Array]] = {}
    for ahead, back in _NEIGHBOURS:
        one, other = labels[ahead], labels[back]
        border = (one != other) & (one > 0) & (other > 0)
        jump = np.abs(depth[ahead][border] - depth[back][border])
        ends = np.sort(np.stack([one[border], other[border]]), axis=0)
        for a, b in np.unique(ends, axis=1).T.tolist():
            here = (ends[0] == a) & (ends[1] == b)
            apart.setdefault((a, b), []).append(jump[here])
    jumps_between = {pair: np.concatenate(some) for pair, some in apart.items()}
    return [
        (typical, *pair)
        for pair, some in jumps_between.items()
        if len(some) >= _LEAST_BORDER
        and (typical := float(np.percentile(some, 20))) < _SELF_HIDING
    ]


def _extent(relief: Relief, inside: Mask) -> float:
    """Metres from end to end of the pixels (h, w), but for the outermost twentieths."""
    z = relief.depth[inside]
    points = np.stack([relief.rays.right[inside] * z, relief.rays.down[inside] * z, z])
    low, high = np.nanpercentile(points, (5, 95), axis=1)
    return float(np.linalg.norm(high - low))


def jumps(depth: Array) -> Mask:
    """The pixels (h, w) just behind a jump in depth, in a row or a column.

    Only the far side of a jump is marked: it is the less certain one, and one pixel
    is enough to part two things.
    """
    filled = np.nan_to_num(depth)
    behind = np.zeros(depth.shape, bool)
    for ahead, back in (
        (np.s_[:-1, :], np.s_[1:, :]),
        (np.s_[:, :-1], np.s_[:, 1:]),
    ):
        rise = filled[back] - filled[ahead]
        step = 0.004 + 0.012 * np.minimum(filled[back], filled[ahead])
        behind[back] |= rise > step
        behind[ahead] |= -rise > step
    return behind


def grown(labels: Labels, inside: Mask, times: int) -> Labels:
    """Labels (h, w) spread by so many pixels into what is inside and has none."""
    around = np.ones((3, 3), np.uint8)
    for _ in range(times):
        spread = cv2.dilate(labels.astype(np.float32), around).astype(np.int32)
        labels = np.where((labels == 0) & inside, spread, labels)
    return labels


def enlarged(labels: Labels, step: int, shape: tuple[int, ...]) -> Labels:
    """Labels (h, w) at the size of the picture (H, W, …); what is beyond is 0."""
    full = np.zeros(shape[:2], np.int32)
    blocks = labels.repeat(step, axis=0).repeat(step, axis=1)
    full[: blocks.shape[0], : blocks.shape[1]] = blocks
    return full


def _kept(labels: Labels, kept: Mask) -> Labels:
    """The same pieces without those not kept, numbered anew from 1."""
    numbers = np.where(kept, np.cumsum(kept), 0).astype(np.int32)
    return numbers[labels]


def _without_walls(labels: Labels) -> Labels:
    sizes = np.bincount(labels.ravel())
    kept = sizes < _LARGEST_SHARE * labels.size
    kept[0] = False
    return _kept(labels, kept)


def _place(frame: Frame, mask: Mask, box: Box) -> Point | None:
    """The median of the points under the mask; None if none was measured."""
    points = points_in(frame, mask, box)
    if not len(points):
        return None
    x, y, z = np.median(points, axis=0)
    return Point(float(x), float(y), float(z))


def _pixels(region: Region) -> int:
    box = region.box
    return int(
        np.count_nonzero(region.mask[box.top : box.bottom, box.left : box.right])
    )
