"""The table: the upright plane that most readings lie on, and its extent.

A plane is kept as n with n · X = 1 for its points X in metres (camera axes). That is
linear in the inverse depth which the sensor measures, 1/z = n · (right, down, 1), and
there its noise is the same near and far.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.perception.geometry import Array, Rays, table_axes
from kille.scene import Direction, Mask

Vectors = NDArray[np.float64]

_HYPOTHESES = 200
_SAMPLE = 1500
_REFITS = 3
_TOLERANCE = 0.006  # 1/m; one step of an 11-bit Kinect disparity is .0028
_LEAST_SHARE = 0.15  # of the readings: fewer on a plane and it is no table
_LEAST_UPRIGHT = 0.1  # cosine of the normal with the picture's up: a wall has none

_CELL = 0.01  # metres; of the grid the seen part of the table is drawn on
_REACH = 3.0  # metres from the camera; no table is larger
_LEAST_PATCH = 0.01  # of the largest patch of table; smaller ones are noise
_LEVEL = 0.9  # cosine of a patch's own normal with that of the table: a wall has none
_BELOW = 0.25  # of the picture's height: so far the table goes on below the picture


@dataclass(frozen=True, eq=False)
class Plane:
    """The plane n · X = 1 in camera axes, n in 1/m, seen from the camera's side."""

    n: Vectors

    @property
    def up(self) -> Direction:
        """The unit normal that points to the side of the camera."""
        x, y, z = -self.n / np.linalg.norm(self.n)
        return float(x), float(y), float(z)

    @property
    def distance(self) -> float:
        """Metres from the camera to the plane."""
        return float(1 / np.linalg.norm(self.n))

    def heights(self, rays: Rays, depth: Array) -> Array:
        """Metres above the plane (h, w), NaN where there is no depth (h, w)."""
        a, b, c = self.n.astype(np.float32)
        length = np.float32(np.linalg.norm(self.n))
        heights: Array = (1 - depth * (a * rays.right + b * rays.down + c)) / length
        return heights

    def depths(self, right: Array, down: Array) -> Array:
        """The depth in metres at which rays (n,) meet the plane."""
        depths: Array = 1 / (self.n[0] * right + self.n[1] * down + self.n[2])
        return depths


def find_table(rays: Rays, depth: Array) -> Plane | None:
    """The upright plane that most readings lie on; None if there is none.

    Planes through three readings each are tried, and the best one is fitted again to
    all readings on it. Which are tried is seeded: the same depth, the same plane.
    """
    rows, columns = np.nonzero(np.isfinite(depth))
    chance = np.random.default_rng(0)
    some = chance.permutation(rows.size)[:_SAMPLE]
    seen = rows[some], columns[some]
    directions = np.stack(
        [rays.right[seen], rays.down[seen], np.ones(len(some))], axis=1
    )
    inverse = 1 / depth[seen].astype(np.float64)
    n = _best_of_three(directions, inverse, chance)
    for _ in range(_REFITS):
        if n is None:
            return None
        n = _refit(n, directions, inverse)
    return None if n is None else Plane(n)


def reach_of(table: Plane, rays: Rays, depth: Array, flat: Mask) -> Mask:
    """The pixels (h, w) whose points lie over the visible part of the table.

    That part is the convex hull of the flat patches that are as level as the table,
    laid out on it. Things may cut small patches off from the others. Where the table
    leaves the picture at the bottom it goes on, towards the viewer.
    """
    patches = _level_patches(table, rays, depth, flat)
    filled = np.nan_to_num(depth)
    across, along = _cells(table, rays.right, rays.down, filled)
    corners = np.stack([across[patches], along[patches]], axis=1)[::4]
    corners = np.concatenate([corners, _below(table, rays, patches)])
    grid = np.zeros((int(2 * _REACH / _CELL),) * 2, np.uint8)
    if len(corners):
        cv2.fillConvexPoly(grid, cv2.convexHull(corners), (1,))
    inside: Mask = grid[along, across] > 0
    return inside


def _best_of_three(
    directions: Vectors, inverse: Vectors, chance: np.random.Generator
) -> Vectors | None:
    if len(inverse) < 3:
        return None
    triples = chance.integers(0, len(inverse), (_HYPOTHESES, 3))
    apart = np.abs(np.linalg.det(directions[triples])) > 1e-6
    triples = triples[apart]
    planes = np.linalg.solve(directions[triples], inverse[triples][:, :, None])[:, :, 0]
    planes = planes[planes[:, 1] > _LEAST_UPRIGHT * np.linalg.norm(planes, axis=1)]
    if not len(planes):
        return None
    expected = planes.astype(np.float32) @ directions.T.astype(np.float32)
    votes = (np.abs(expected - inverse.astype(np.float32)) < _TOLERANCE).sum(axis=1)
    return np.asarray(planes[np.argmax(votes)], np.float64)


def _refit(n: Vectors, directions: Vectors, inverse: Vectors) -> Vectors | None:
    """Fit the plane to the readings on it; None if too few for a table lie on it."""
    on = np.abs(directions @ n - inverse) < _TOLERANCE
    if on.sum() < max(3, _LEAST_SHARE * len(inverse)):
        return None
    solved = np.linalg.lstsq(directions[on], inverse[on], rcond=None)[0]
    fitted = np.asarray(solved, np.float64)
    return fitted if fitted[1] > _LEAST_UPRIGHT * np.linalg.norm(fitted) else None


def _level_patches(table: Plane, rays: Rays, depth: Array, flat: Mask) -> Mask:
    """The connected parts of the flat pixels that are parts of the table.

    They are not tiny, and a plane fitted to each is as level as the table: where a wall
    behind the table crosses its height, it is not.
    """
    solid = cv2.erode(flat.astype(np.uint8), np.ones((3, 3), np.uint8))
    _, labels, stats, _ = cv2.connectedComponentsWithStats(solid, connectivity=4)
    areas = stats[:, cv2.CC_STAT_AREA].copy()
    areas[0] = 0
    large = areas >= max(1, _LEAST_PATCH * areas.max())
    large &= areas > 0
    for patch in np.flatnonzero(large):
        if areas[patch] == areas.max():
            continue
        inside = labels == patch
        large[patch] = _is_level(
            table, rays.right[inside], rays.down[inside], depth[inside]
        )
    return np.asarray(large[labels], bool)


def _is_level(table: Plane, right: Array, down: Array, depth: Array) -> bool:
    """Whether the plane through these readings (n,) has the direction of the table."""
    directions = np.stack([right, down, np.ones_like(right)], axis=1).astype(float)
    n = np.linalg.lstsq(directions, 1 / depth.astype(float), rcond=None)[0]
    cosine = n @ table.n / max(np.linalg.norm(n) * np.linalg.norm(table.n), 1e-9)
    return bool(cosine > _LEVEL)


def _below(table: Plane, rays: Rays, patches: Mask) -> NDArray[np.int32]:
    """The cells of the table just below the picture, where it leaves the picture."""
    columns = np.nonzero(patches[-8:].any(axis=0))[0]
    height = rays.down[-1, 0] - rays.down[0, 0]
    right = rays.right[-1, columns]
    down = rays.down[-1, columns] + _BELOW * height
    depth = table.depths(right, down)
    return np.stack(_cells(table, right, down, depth), axis=1)


def _cells(
    table: Plane, right: Array, down: Array, depth: Array
) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """The grid cells on the table under these points: across and along."""
    axes = table_axes(table.up).astype(np.float32)
    last = int(2 * _REACH / _CELL) - 1
    across, along = (
        np.clip((depth * (a * right + b * down + c) + _REACH) / _CELL, 0, last)
        for a, b, c in axes[:2]
    )
    return across.astype(np.int32), along.astype(np.int32)
