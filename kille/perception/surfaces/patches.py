"""Patches: smooth pieces of surface, separated by jumps in depth and concave edges.

Where one thing meets another, the normals of their surfaces lean towards each other; on
the outer side of one thing they seldom do [1]. Edges that turn outwards are left whole,
as those of a box. All is computed in inverse depth w = 1/z, in which the sensor's noise
is the same near and far, and a plane n · X = 1 is w = n · (right, down, 1).

[1] S. C. Stein, M. Schoeler, J. Papon, F. Wörgötter: Object partitioning using local
convexity. CVPR 2014.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from kille.perception.geometry import Array
from kille.perception.surfaces.relief import Labels, Relief, jumps, step_of
from kille.scene import Mask

CONCAVE = 0.13
"""How far normals lean towards each other where two surfaces meet."""

_DIAMETER, _EVEN, _SPREAD = 5, 0.02, 2.0  # of the bilateral filter: pixels, 1/m, pixels
_STRIDE = 2  # pixels to each side when normals are made
_BENT = 0.03  # 1/m: a surface that bends so within two strides is two surfaces
_REACH = 3  # pixels between the normals that are compared
_LEAST = 14  # pixels of a patch; what is smaller goes to its neighbours
_WAYS = ((0, 1), (1, 0), (1, 1), (-1, 1))  # right, down, and both diagonals


@dataclass(frozen=True, eq=False)
class Surface:
    """The shape of a relief at each pixel; NaN where it is unknown.

    normals (3, h, w), unit vectors towards the camera; leans (4, h, w), how far the
    normals on the two sides of a pixel lean apart (> 0, as on a ball) or towards each
    other (< 0, as in a corner): right, down, and along both diagonals.
    """

    normals: Array
    leans: Array

    @property
    def most_inwards(self) -> Array:
        """The least of the leans (h, w)."""
        least: Array = np.fmin.reduce(self.leans)
        return least


def surface_of(relief: Relief) -> Surface:
    """The normals and leans of a relief, smoothed within surfaces."""
    with np.errstate(invalid="ignore", divide="ignore"):
        smooth = _smooth(relief)
        normals = _normals(relief, smooth)
        right, down = relief.rays
        points = np.stack([right / smooth, down / smooth, 1 / smooth])
        leans = np.stack([_lean(normals, points, *way) for way in _WAYS])
    return Surface(normals, leans)


def patches_of(relief: Relief, inside: Mask, surface: Surface) -> Labels:
    """Label (h, w) the patches inside, from 1; 0 is no patch.

    Every pixel inside has the label of the patch that is nearest in the picture.
    """
    concave = surface.most_inwards < -CONCAVE
    core = (inside & ~jumps(relief.depth, of=step_of) & ~concave).astype(np.uint8)
    _, labels, stats, _ = cv2.connectedComponentsWithStats(core, connectivity=4)
    kept = stats[:, cv2.CC_STAT_AREA] >= _LEAST
    kept[0] = False
    return fill_labels(renumber_labels(np.asarray(labels, np.int32), kept), inside)


def renumber_labels(labels: Labels, kept: Mask) -> Labels:
    """Drop the pieces not kept (n,) and number the others from 1."""
    numbers = np.where(kept, np.cumsum(kept), 0).astype(np.int32)
    renumbered: Labels = numbers[labels]
    return renumbered


def fill_labels(labels: Labels, inside: Mask) -> Labels:
    """Give each pixel inside the label (h, w) nearest to it."""
    if not labels.any():
        return labels
    empty = (labels == 0).astype(np.uint8)
    _, nearest = cv2.distanceTransformWithLabels(
        empty, cv2.DIST_L1, 3, labelType=cv2.DIST_LABEL_PIXEL
    )
    names = np.zeros(int(nearest.max()) + 1, np.int32)
    named = empty == 0
    names[nearest[named]] = labels[named]
    return np.where(inside, names[nearest], 0).astype(np.int32)


def _smooth(relief: Relief) -> Array:
    """Inverse depth (h, w), smoothed within surfaces; NaN where nothing was read."""
    inverse = np.nan_to_num(1 / relief.depth, posinf=0.0)
    smooth = cv2.bilateralFilter(inverse, _DIAMETER, _EVEN, _SPREAD)
    missing: Array = np.where(inverse > 0, smooth, np.float32(np.nan))
    return missing


def _normals(relief: Relief, w: Array) -> Array:
    """Normals (3, h, w) from the slopes of inverse depth along the rays."""
    left, right = _shift(w, 0, -_STRIDE), _shift(w, 0, _STRIDE)
    above, below = _shift(w, -_STRIDE, 0), _shift(w, _STRIDE, 0)
    reach = 2 * _STRIDE * relief.step
    across = (right - left) * np.float32(relief.lens.fx / reach)
    along = (below - above) * np.float32(relief.lens.fy / reach)
    ahead = w - across * relief.rays.right - along * relief.rays.down
    length = np.sqrt(across**2 + along**2 + ahead**2)
    bent = (np.abs(right + left - 2 * w) > _BENT) | (
        np.abs(below + above - 2 * w) > _BENT
    )
    length[bent] = np.nan
    normals: Array = np.stack([across, along, ahead]) / -length
    return normals


def _lean(normals: Array, points: Array, down: int, right: int) -> Array:
    """How far the normals on both sides lean apart in one direction, per metre."""
    before, after = _REACH // 2, _REACH - _REACH // 2
    turn = _between(normals, down, right, before, after)
    apart = _between(points, down, right, before, after)
    lean: Array = (turn * apart).sum(axis=0) / np.sqrt((apart**2).sum(axis=0))
    return lean


def _between(planes: Array, down: int, right: int, before: int, after: int) -> Array:
    ahead = _shift(planes, down * after, right * after)
    difference: Array = ahead - _shift(planes, -down * before, -right * before)
    return difference


def _shift(planes: Array, down: int, right: int) -> Array:
    """Shift an array (…, h, w) so that each pixel shows the one so far away; NaN
    outside.
    """
    moved = np.full_like(planes, np.nan)
    height, width = planes.shape[-2:]
    if abs(down) >= height or abs(right) >= width:
        return moved
    moved[..., _to(down, height), _to(right, width)] = planes[
        ..., _to(-down, height), _to(-right, width)
    ]
    return moved


def _to(by: int, size: int) -> slice:
    return slice(max(0, -by), size - max(0, by))
