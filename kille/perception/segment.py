"""Segmentation: which pixels belong to one thing, from depth alone.

What stands out of the table is cut into patches of smooth surface, and a learned merge
puts the patches of one thing together again (`kille.perception.surfaces`). The rule of
`segment_by_contact` is simpler: connected pieces between jumps of depth. In pictures
without depth the foreground is guessed.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial

import cv2
import numpy as np

from kille.perception.foreground import guess
from kille.perception.geometry import CAMERA_UP, points_in
from kille.perception.surfaces.merging import Rounds, default_rounds, merge_patches
from kille.perception.surfaces.patches import (
    fill_labels,
    patches_of,
    renumber_labels,
    surface_of,
)
from kille.perception.surfaces.relief import (
    Labels,
    Relief,
    jumps,
    protruding_pixels,
    relief_of,
    table_in,
    window_of,
)
from kille.perception.table import Plane
from kille.scene import Box, Direction, Frame, Mask, Point, Region
from ttr.aliases import former_names

__getattr__ = former_names(
    __name__, {"Scene": "SegmentedFrame", "plainly": "segment_by_contact"}
)

__all__ = [
    "SEGMENTATIONS",
    "SegmentedFrame",
    "merging_by",
    "nearness",
    "overlap",
    "segment_by_contact",
    "region_of",
    "segment",
    "whole",
]

_LEAST_AREA = 5e-4  # m², facing the camera: a marker pen has 15 cm²
_LEAST_PIXELS = 24


@dataclass(frozen=True, eq=False)
class SegmentedFrame:
    """A segmented frame: its regions, nearest first, and the direction that is up.

    >>> from kille.sensors.synthetic import open_synthetic
    >>> frame = open_synthetic("synthetic:desk?seed=7").frame()
    >>> regions, up = segment(frame).regions, segment(frame).up
    >>> len(regions), len(up)
    (3, 3)
    """

    regions: tuple[Region, ...]
    up: Direction


Segmentation = Callable[[Frame], SegmentedFrame]


def segment(frame: Frame) -> SegmentedFrame:
    """The things in view, nearest first; things that touch are separated.

    Without depth there is one region, a guess, whose place is unknown. Without a table,
    things are the pieces that are near and not as large as a wall.

    >>> from kille.sensors.synthetic import open_synthetic
    >>> frame = open_synthetic("synthetic:desk?seed=7").frame()
    >>> len(segment(frame).regions)
    3
    """
    return _segment_by(frame, partial(_things, rounds=default_rounds()))


def merging_by(rounds: Rounds) -> Segmentation:
    """A segmentation like `segment` that merges surfaces by these rounds.

    >>> from kille.sensors.synthetic import open_synthetic
    >>> frame = open_synthetic("synthetic:desk?seed=7").frame()
    >>> from kille.perception.segment import segment
    >>> len(merging_by(())(frame).regions) >= len(segment(frame).regions)
    True
    """
    return partial(_segment_by, labeller=partial(_things, rounds=rounds))


def segment_by_contact(frame: Frame) -> SegmentedFrame:
    """The connected pieces in view, nearest first; things that touch are one piece.

    >>> from kille.sensors.synthetic import open_synthetic
    >>> frame = open_synthetic("synthetic:desk?seed=7").frame()
    >>> len(segment_by_contact(frame).regions)
    5
    """
    return _segment_by(frame, _pieces)


SEGMENTATIONS: Mapping[str, Segmentation] = {
    "default": segment,
    "plain": segment_by_contact,
}
"""The ways to segment a frame, by name.

>>> from kille.perception.segment import SEGMENTATIONS
>>> sorted(SEGMENTATIONS)
['default', 'plain']
"""


def region_of(frame: Frame, mask: Mask) -> Region:
    """The region of these pixels (H, W), as when a tutor traces an outline.

    >>> from kille.sensors.synthetic import open_synthetic
    >>> frame = open_synthetic("synthetic:desk?seed=7").frame()
    >>> mask = np.zeros(frame.colour.shape[:2], bool)
    >>> mask[100:120, 200:240] = True
    >>> region_of(frame, mask).box
    Box(left=200, top=100, right=240, bottom=120)
    """
    left, top, width, height = cv2.boundingRect(mask.astype(np.uint8))
    box = Box(left, top, left + width, top + height)
    return Region(mask, box, _place(frame, mask, box))


def whole(frame: Frame) -> Region:
    """The whole picture as one region, whose place is unknown.

    >>> from kille.sensors.synthetic import open_synthetic
    >>> frame = open_synthetic("synthetic:desk?seed=7").frame()
    >>> bool(whole(frame).mask.all()), whole(frame).place
    (True, None)
    """
    height, width = frame.colour.shape[:2]
    return Region(np.ones((height, width), bool), Box(0, 0, width, height), None)


def nearness(region: Region) -> float:
    """Metres from the camera to the middle of the region, infinite if unknown.

    >>> from kille.sensors.synthetic import open_synthetic
    >>> frame = open_synthetic("synthetic:desk?seed=7").frame()
    >>> near, *far = map(nearness, segment(frame).regions)
    >>> all(near <= it for it in far), nearness(whole(frame))
    (True, inf)
    """
    return float("inf") if region.place is None else float(np.linalg.norm(region.place))


def overlap(one: Region, other: Region) -> float:
    """The pixels in both regions divided by those in either, from 0 to 1.

    >>> from kille.sensors.synthetic import open_synthetic
    >>> frame = open_synthetic("synthetic:desk?seed=7").frame()
    >>> one = whole(frame)
    >>> overlap(one, one)
    1.0
    """
    left, top = max(one.box.left, other.box.left), max(one.box.top, other.box.top)
    right = min(one.box.right, other.box.right)
    bottom = min(one.box.bottom, other.box.bottom)
    if left >= right or top >= bottom:
        return 0.0
    common = slice(top, bottom), slice(left, right)
    both = int(np.count_nonzero(one.mask[common] & other.mask[common]))
    either = _pixels(one) + _pixels(other) - both
    return both / either if either else 0.0


_Labeller = Callable[[Relief, Mask, Plane | None], Labels]


def _segment_by(frame: Frame, labeller: _Labeller) -> SegmentedFrame:
    relief = relief_of(frame)
    if relief is None:
        return SegmentedFrame((_guess_region(frame),), CAMERA_UP)
    table = table_in(relief)
    inside = protruding_pixels(relief, table)
    up = CAMERA_UP if table is None else table.up
    if not inside.any():
        return SegmentedFrame((), up)
    window = window_of(inside)
    part = relief.crop(window)
    labels = _large_enough(part, labeller(part, inside[window], table))
    regions = _regions(frame, labels, window, relief.step)
    return SegmentedFrame(tuple(sorted(regions, key=nearness)), up)


def _things(
    relief: Relief, inside: Mask, table: Plane | None, *, rounds: Rounds
) -> Labels:
    """Label (h, w) the patches inside, with one label for all patches of one thing."""
    if table is None:
        return _pieces(relief, inside, table)
    surface = surface_of(relief)
    patches = patches_of(relief, inside, surface)
    return merge_patches(patches, relief, surface, table, rounds)


def _pieces(relief: Relief, inside: Mask, table: Plane | None) -> Labels:
    """Label (h, w) the connected pieces inside, separated where depth jumps."""
    core = (inside & ~jumps(relief.depth)).astype(np.uint8)
    _, labels, stats, _ = cv2.connectedComponentsWithStats(core, connectivity=4)
    kept = stats[:, cv2.CC_STAT_AREA] > _LEAST_PIXELS
    kept[0] = False
    return fill_labels(renumber_labels(np.asarray(labels, np.int32), kept), inside)


def _large_enough(relief: Relief, labels: Labels) -> Labels:
    """Remove the pieces that are too small to be a thing."""
    area = np.bincount(labels.ravel(), relief.areas().ravel())
    kept = (area > _LEAST_AREA) & (np.bincount(labels.ravel()) > _LEAST_PIXELS)
    kept[0] = False
    return renumber_labels(labels, kept)


def _regions(
    frame: Frame, labels: Labels, window: tuple[slice, slice], step: int
) -> list[Region]:
    """The region of each label, at the size of the picture."""
    top, left = window[0].start * step, window[1].start * step
    blocks = labels.astype(np.uint8 if labels.max() < 256 else np.int32)
    blocks = blocks.repeat(step, axis=0).repeat(step, axis=1)
    bottom, right = top + blocks.shape[0], left + blocks.shape[1]
    regions = []
    for label in range(1, int(labels.max()) + 1):
        mask = np.zeros(frame.colour.shape[:2], bool)
        mask[top:bottom, left:right] = blocks == label
        regions.append(region_of(frame, mask))
    return regions


def _guess_region(frame: Frame) -> Region:
    """Guess the region of the thing in a picture without depth."""
    mask = guess(frame)
    if not mask.any():
        return whole(frame)
    left, top, width, height = cv2.boundingRect(mask.astype(np.uint8))
    return Region(mask, Box(left, top, left + width, top + height), None)


def _place(frame: Frame, mask: Mask, box: Box) -> Point | None:
    """The median of the points under the mask; None if there are none."""
    points = points_in(frame, mask, box)
    if not len(points):
        return None
    x, y, z = np.median(np.ascontiguousarray(points.T), axis=1)
    return Point(float(x), float(y), float(z))


def _pixels(region: Region) -> int:
    box = region.box
    return int(
        np.count_nonzero(region.mask[box.top : box.bottom, box.left : box.right])
    )
