"""Measurements of each patch by itself, for all patches at once."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.perception.geometry import CAMERA_UP, table_axes
from kille.perception.surfaces.patches import Surface
from kille.perception.surfaces.relief import Labels, Relief, jumps
from kille.perception.table import Plane

Vectors = NDArray[np.float64]
Indices = NDArray[np.intp]

_UNIT = 0.1  # the rays of a picture reach about so far from its middle
_ENDS = (0.04, 0.96)  # shares of the readings that count as the ends of a patch
_RIDGE = 1e-3
_SELF_HIDING = 0.05  # metres


@dataclass(frozen=True, eq=False)
class Fits:
    """Sums from which surfaces w = c · b are fitted to patches and to their unions.

    The basis b = (1, x, y, x², xy, y²) is of the ray: its first three numbers give
    planes, all six curved surfaces. Sums of two patches are those of their union.
    """

    bb: Vectors
    """Sums of b bᵀ (k, 6, 6)."""
    bw: Vectors
    """Sums of b w (k, 6)."""
    ww: Vectors
    """Sums of w² (k,)."""

    def of(self, one: Indices) -> Fits:
        """The sums of these patches."""
        return Fits(self.bb[one], self.bw[one], self.ww[one])

    def union(self, other: Fits) -> Fits:
        """The sums of the unions, pair by pair."""
        return Fits(self.bb + other.bb, self.bw + other.bw, self.ww + other.ww)

    def coefficients(self, terms: int) -> Vectors:
        """The coefficients (k, terms) of the best surface with `terms` terms."""
        bb = self.bb[:, :terms, :terms] + _RIDGE * np.eye(terms)
        best = np.linalg.solve(bb, self.bw[:, :terms, None])
        return np.asarray(best[..., 0], np.float64)

    def error(self, c: Vectors) -> Vectors:
        """The sums of squared differences (k,) from the surfaces c (k, terms)."""
        terms = c.shape[1]
        bb = self.bb[:, :terms, :terms]
        square = np.einsum("ki,kij,kj->k", c, bb, c)
        error: Vectors = self.ww - 2 * (c * self.bw[:, :terms]).sum(axis=1) + square
        return np.maximum(error, 0.0)


@dataclass(frozen=True, eq=False)
class PatchMeasures:
    """Patches 1 … k as arrays of k, in order of their labels.

    pixels: how many; depth: its mean; area in m² facing the camera; middle, normal
    (3, k) in camera axes; up: the normal's vertical part; low, high (3, k): the ends
    right, away and up, above the table; heap: the number of the heap it is part of;
    centre (k, 2): a pixel in the middle; hulls: around its pixels.
    """

    pixels: Vectors
    depth: Vectors
    area: Vectors
    middle: Vectors
    normal: Vectors
    up: Vectors
    low: Vectors
    high: Vectors
    fits: Fits
    heap: Indices
    centre: NDArray[np.int32]
    hulls: tuple[NDArray[np.int32], ...]


def measure_patches(
    labels: Labels, relief: Relief, surface: Surface, table: Plane | None
) -> PatchMeasures:
    """Measure all patches in labels (h, w), which are numbered from 1.

    Every patch must have readings. A heap is what hangs together in the picture, but
    for jumps that are deeper than those by which a thing hides parts of itself.
    """
    rows, columns = np.nonzero((labels > 0) & np.isfinite(relief.depth))
    order = np.argsort(labels[rows, columns], kind="stable")
    rows, columns = rows[order], columns[order]
    groups = _Groups(labels[rows, columns].astype(np.intp) - 1)
    z = relief.depth[rows, columns].astype(np.float64)
    x = relief.rays.right[rows, columns].astype(np.float64)
    y = relief.rays.down[rows, columns].astype(np.float64)
    points = np.stack([x * z, y * z, z])
    normal = groups.sums(*np.nan_to_num(surface.normals[:, rows, columns]))
    normal /= np.maximum(np.linalg.norm(normal, axis=0), 1e-9)
    axes = table_axes(CAMERA_UP if table is None else table.up)
    places = axes @ points
    places[2] += -places[2].min() if table is None else table.distance
    low, high = groups.ends(places)
    depth = groups.sums(z)[0] / groups.sizes
    pixels = groups.split(np.stack([columns, rows], axis=1).astype(np.int32))
    pixel_area = relief.step**2 / (relief.lens.fx * relief.lens.fy)
    return PatchMeasures(
        pixels=groups.sizes.astype(np.float64),
        depth=depth,
        area=groups.sizes * depth**2 * pixel_area,
        middle=groups.sums(*points) / groups.sizes,
        normal=normal,
        up=axes[2] @ normal,
        low=low,
        high=high,
        heap=groups.mode(_heaps(relief, labels)[rows, columns]),
        fits=_fits(groups, x, y, 1 / z),
        centre=np.stack([np.median(it, axis=0) for it in pixels]).astype(np.int32),
        hulls=tuple(cv2.convexHull(it)[:, 0].astype(np.int32) for it in pixels),
    )


def _heaps(relief: Relief, labels: Labels) -> Labels:
    deep = jumps(relief.depth, _SELF_HIDING)
    core = ((labels > 0) & ~deep).astype(np.uint8)
    return np.asarray(cv2.connectedComponents(core, connectivity=4)[1], np.int32)


class _Groups:
    """Pixels (n,), ordered by the patches (k) that they belong to."""

    def __init__(self, owner: Indices) -> None:
        self._owner = owner
        self.sizes = np.bincount(owner)
        self._starts = np.cumsum(self.sizes) - self.sizes

    def sums(self, *values: Vectors) -> Vectors:
        """The sums (m, k) of m values (n,) over each patch."""
        return np.stack([np.bincount(self._owner, some) for some in values])

    def ends(self, values: Vectors) -> tuple[Vectors, Vectors]:
        """The low and the high ends (m, k) of m values (n,) in each patch."""
        ordered = [some[np.lexsort((some, self._owner))] for some in values]
        at = [self._starts + (end * (self.sizes - 1)).astype(int) for end in _ENDS]
        low, high = (np.stack([some[it] for some in ordered]) for it in at)
        return low, high

    def mode(self, names: Labels) -> Indices:
        """The most frequent of the names (n,), other than 0, in each patch."""
        size = int(names.max()) + 1
        pairs = self._owner * size + names
        counts = np.bincount(pairs, minlength=len(self.sizes) * size)
        counts = counts.reshape(-1, size)
        counts[:, 0] = 0
        most: Indices = counts.argmax(axis=1)
        return most

    def split(self, values: NDArray[np.int32]) -> list[NDArray[np.int32]]:
        """Split the values (n, …) by patch."""
        return np.split(values, self._starts[1:])


def _fits(groups: _Groups, x: Vectors, y: Vectors, w: Vectors) -> Fits:
    x, y, w = (x - x.mean()) / _UNIT, (y - y.mean()) / _UNIT, w - w.mean()
    basis = np.stack([np.ones_like(x), x, y, x * x, x * y, y * y])
    upper = np.triu_indices(len(basis))
    bb = np.empty((len(groups.sizes), len(basis), len(basis)))
    bb[:, upper[0], upper[1]] = groups.sums(*basis[upper[0]] * basis[upper[1]]).T
    bb[:, upper[1], upper[0]] = bb[:, upper[0], upper[1]]
    return Fits(bb, groups.sums(*basis * w).T, groups.sums(w * w)[0])
