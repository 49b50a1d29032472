"""Pairs of patches, and features that tell whether the two belong to one thing.

Pairs are of two kinds: touching ones share an edge in the picture, parted ones do not,
but what is between them is hidden by something nearer, or not read.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.perception.geometry import Array
from kille.perception.surfaces.patch_measures import Indices, PatchMeasures, Vectors
from kille.perception.surfaces.patches import CONCAVE, Surface
from kille.perception.surfaces.relief import Labels, Relief, jump_of

FEATURES = (
    # of the edge between the two
    "edge",  # log of its pixels
    "relative edge",  # its pixels by the root of the smaller patch's
    "jump share",  # of the edge: depth jumps there
    "jump",  # mean difference in depth, dm
    "small jump share",  # less than 3 cm
    "lean",  # mean, across the edge
    "concave share",
    "convex share",
    "least lean",  # mean of the most inward of the four
    # of their directions
    "facing",  # cosine of their normals
    "apart",  # how far the normals lean apart from middle to middle
    "more level",  # vertical part of the normal of the more level one
    "less level",
    # of the surfaces fitted to them: log of metres
    "off the plane",  # readings of one from the plane of the other, the less
    "off the plane, at most",  # the other way round, the more
    "one plane",  # readings of both from the plane of both
    "one curved surface",
    "goes on, tops",  # one plane, and the upper ends alike: in [0, 1]
    "goes on, feet",
    # of their heights above the table, dm
    "tops",  # difference of their upper ends
    "feet",  # difference of their lower ends
    "lower foot",
    "higher foot",
    "lower top",
    "stacked",  # from the top of one to the foot of the other
    "overlap",  # on the table, of the boxes around them by the smaller one
    # of their sizes
    "small area",  # log of cm²
    "large area",
    "ratio",  # log
    "extent",  # of both together, dm
    "height",  # of both together, dm
    "solidity",  # pixels of both by those of the convex hull around both
    "hull share",  # pixels of the two hulls by those of the convex hull around both
    # of the heap they are in, 0 if it is not the same
    "same heap",
    "heap extent",  # dm
    "heap height",  # dm
    "heap patches",  # log
    "heap solidity",
    # of the line between their middles
    "hidden share",
    "open share",  # what is seen there is farther than the line
)

_WIDEST = 0.55  # metres: no thing on a table is wider
_LEAST_EDGE = 3  # working pixels
_LEAST_HIDDEN = 0.5
_MOST_OPEN = 0.2
_SMALL_JUMP = 0.03  # metres
_ON_THE_LINE = 16  # places on the line between two patches that are looked at
_FLUSH, _LEVEL = 0.02, 0.03  # metres: what goes on behind something differs by less
_NEARER, _FARTHER = 0.01, 0.015  # metres


@dataclass(frozen=True, eq=False)
class Pairs:
    """Pairs of patches numbered from 0: one, other (m,), touching (m,), their features.

    features (m, n) are in the order of `FEATURES`.
    """

    one: Indices
    other: Indices
    touching: NDArray[np.bool_]
    features: Vectors


def pairs_of(
    labels: Labels, relief: Relief, surface: Surface, patches: PatchMeasures
) -> Pairs:
    """The pairs of patches that may belong to one thing.

    They touch, or what is between them is hidden; and both together are not too wide.
    """
    one, other = np.triu_indices(len(patches.pixels), 1)
    low = np.minimum(patches.low[:, one], patches.low[:, other])
    high = np.maximum(patches.high[:, one], patches.high[:, other])
    narrow = np.linalg.norm(high - low, axis=0) < _WIDEST
    one, other = one[narrow], other[narrow]
    edges = _edges(labels, relief.depth, surface, one, other)
    hidden, open_ = _on_the_line(labels, relief.depth, patches, one, other)
    touching = edges["pixels"] >= _LEAST_EDGE
    kept = touching | ((hidden > _LEAST_HIDDEN) & (open_ < _MOST_OPEN))
    edges = {name: values[kept] for name, values in edges.items()}
    one, other = one[kept], other[kept]
    found = {
        **_of_edges(edges, patches, one, other),
        **_of_directions(patches, one, other),
        **_of_surfaces(patches, one, other),
        **_of_heights(patches, one, other),
        **_of_sizes(patches, one, other),
        **_of_heaps(patches, one, other),
        "hidden share": hidden[kept],
        "open share": open_[kept],
    }
    features = np.stack([found[name] for name in FEATURES], axis=1)
    return Pairs(one, other, touching[kept], np.nan_to_num(features))


def _edges(
    labels: Labels, depth: Array, surface: Surface, one: Indices, other: Indices
) -> dict[str, Vectors]:
    """Sums over the pixels along the edge of each pair, by name."""
    rest = slice(None)
    ways = [
        (surface.leans[0], (rest, slice(0, -1)), (rest, slice(1, None))),
        (surface.leans[1], (slice(0, -1), rest), (slice(1, None), rest)),
    ]
    steps = [_steps(labels, depth, surface, *way) for way in ways]
    first, second, near, far, lean, inwards = np.concatenate(steps, axis=1)
    number = int(labels.max()) + 1
    key = (np.minimum(first, second) * number + np.maximum(first, second)).astype(int)
    gap = far - near
    read = np.isfinite(gap)
    jump = read & (gap > jump_of(near))
    smooth = read & ~jump & np.isfinite(lean)
    values = {
        "pixels": np.ones(len(key)),
        "read": read,
        "jump": jump,
        "gap": np.where(read, np.minimum(gap, 0.2), 0),
        "small": read & (gap < _SMALL_JUMP),
        "smooth": smooth,
        "lean": np.where(smooth, np.clip(lean, -1, 1), 0),
        "inwards": np.where(smooth, np.clip(inwards, -1, 1), 0),
        "concave": smooth & (inwards < -CONCAVE),
        "convex": smooth & (lean > CONCAVE),
    }
    wanted = (one + 1) * number + other + 1
    return {
        name: np.bincount(key, some.astype(np.float64), minlength=number**2)[wanted]
        for name, some in values.items()
    }


def _steps(
    labels: Labels,
    depth: Array,
    surface: Surface,
    leans: Array,
    here: tuple[slice, ...],
    there: tuple[slice, ...],
) -> Vectors:
    """Each step from one patch to another: both labels, near and far depth, leans.

    Of the leans on the two sides, the greater across the edge, and the least of all.
    """
    first, second = labels[here], labels[there]
    edge = (first != second) & (first > 0) & (second > 0)
    z, z2 = depth[here][edge], depth[there][edge]
    lean, lean2 = leans[here][edge], leans[there][edge]
    low, high = np.fmin(lean, lean2), np.fmax(lean, lean2)
    inwards = surface.most_inwards
    return np.stack(
        [
            first[edge],
            second[edge],
            np.minimum(z, z2),
            np.maximum(z, z2),
            np.where(np.abs(low) > np.abs(high), low, high),
            np.fmin(inwards[here][edge], inwards[there][edge]),
        ]
    ).astype(np.float64)


def _of_edges(
    edges: dict[str, Vectors], patches: PatchMeasures, one: Indices, other: Indices
) -> dict[str, Vectors]:
    pixels, read, smooth = (
        np.maximum(edges[name], 1) for name in ("pixels", "read", "smooth")
    )
    smaller = np.minimum(patches.pixels[one], patches.pixels[other])
    return {
        "edge": np.log(pixels),
        "relative edge": np.minimum(edges["pixels"] / np.sqrt(smaller), 3),
        "jump share": edges["jump"] / read,
        "jump": 10 * edges["gap"] / read,
        "small jump share": edges["small"] / pixels,
        "lean": edges["lean"] / smooth,
        "concave share": edges["concave"] / pixels,
        "convex share": edges["convex"] / pixels,
        "least lean": edges["inwards"] / smooth,
    }


def _of_directions(
    patches: PatchMeasures, one: Indices, other: Indices
) -> dict[str, Vectors]:
    normal, normal2 = patches.normal[:, one], patches.normal[:, other]
    between = patches.middle[:, other] - patches.middle[:, one]
    distance = np.maximum(np.linalg.norm(between, axis=0), 1e-3)
    return {
        "facing": (normal * normal2).sum(axis=0),
        "apart": ((normal2 - normal) * between).sum(axis=0) / distance,
        "more level": np.maximum(patches.up[one], patches.up[other]),
        "less level": np.minimum(patches.up[one], patches.up[other]),
    }


def _of_surfaces(
    patches: PatchMeasures, one: Indices, other: Indices
) -> dict[str, Vectors]:
    planes = patches.fits.coefficients(3)
    first, second = patches.fits.of(one), patches.fits.of(other)
    union = first.union(second)
    size = patches.pixels[one] + patches.pixels[other]
    squared = patches.depth**2
    off = np.sqrt(second.error(planes[one]) / patches.pixels[other]) * squared[other]
    back = np.sqrt(first.error(planes[other]) / patches.pixels[one]) * squared[one]
    scale = patches.depth[one] * patches.depth[other]
    facing = (patches.normal[:, one] * patches.normal[:, other]).sum(axis=0)
    flush = np.exp(-np.maximum(off, back) / _FLUSH) * np.maximum(facing, 0) ** 2
    flat = np.sqrt(union.error(union.coefficients(3)) / size) * scale
    curved = np.sqrt(union.error(union.coefficients(6)) / size) * scale
    return {
        "off the plane": _log(np.minimum(off, back)),
        "off the plane, at most": _log(np.maximum(off, back)),
        "one plane": _log(flat),
        "one curved surface": _log(curved),
        "goes on, tops": flush * _alike(patches.high[2, one], patches.high[2, other]),
        "goes on, feet": flush * _alike(patches.low[2, one], patches.low[2, other]),
    }


def _alike(height: Vectors, height2: Vectors) -> Vectors:
    alike: Vectors = np.exp(-np.abs(height - height2) / _LEVEL)
    return alike


def _of_heights(
    patches: PatchMeasures, one: Indices, other: Indices
) -> dict[str, Vectors]:
    foot, foot2 = patches.low[2, one], patches.low[2, other]
    top, top2 = patches.high[2, one], patches.high[2, other]
    low = np.maximum(patches.low[:2, one], patches.low[:2, other])
    high = np.minimum(patches.high[:2, one], patches.high[:2, other])
    ground = np.maximum(patches.high[:2] - patches.low[:2], 0.003).prod(axis=0)
    common = np.maximum(high - low, 0).prod(axis=0)
    return {
        "tops": 10 * np.abs(top - top2),
        "feet": 10 * np.abs(foot - foot2),
        "lower foot": 10 * np.clip(np.minimum(foot, foot2), 0, 0.3),
        "higher foot": 10 * np.clip(np.maximum(foot, foot2), 0, 0.3),
        "lower top": 10 * np.clip(np.minimum(top, top2), 0, 0.5),
        "stacked": 10 * np.clip(np.maximum(foot - top2, foot2 - top), -0.2, 0.2),
        "overlap": common / np.minimum(ground[one], ground[other]),
    }


def _of_sizes(
    patches: PatchMeasures, one: Indices, other: Indices
) -> dict[str, Vectors]:
    small = np.minimum(patches.area[one], patches.area[other])
    large = np.maximum(patches.area[one], patches.area[other])
    low = np.minimum(patches.low[:, one], patches.low[:, other])
    high = np.maximum(patches.high[:, one], patches.high[:, other])
    hull = np.array([_hull(patches, i, j) for i, j in zip(one, other, strict=True)])
    own = np.array([cv2.contourArea(hull) + 1 for hull in patches.hulls])
    pixels = patches.pixels[one] + patches.pixels[other]
    return {
        "small area": np.log(1e4 * small + 0.5),
        "large area": np.log(1e4 * large + 0.5),
        "ratio": np.log(small / large),
        "extent": 10 * np.linalg.norm(high - low, axis=0),
        "height": 10 * (high - low)[2],
        "solidity": np.minimum(pixels / hull, 1.2),
        "hull share": np.minimum((own[one] + own[other]) / hull, 2),
    }


def _of_heaps(
    patches: PatchMeasures, one: Indices, other: Indices
) -> dict[str, Vectors]:
    number = int(patches.heap.max()) + 1
    low, high = np.full((3, number), np.inf), np.full((3, number), -np.inf)
    hull = np.ones(number)
    for heap in range(number):
        members = np.flatnonzero(patches.heap == heap)
        if not members.size:
            continue
        low[:, heap] = patches.low[:, members].min(axis=1)
        high[:, heap] = patches.high[:, members].max(axis=1)
        corners = np.concatenate([patches.hulls[member] for member in members])
        hull[heap] = cv2.contourArea(cv2.convexHull(corners)) + 1
    count = np.bincount(patches.heap, minlength=number)
    pixels = np.bincount(patches.heap, patches.pixels, minlength=number)
    own = patches.heap[one]
    same = (own == patches.heap[other]).astype(np.float64)
    return {
        "same heap": same,
        "heap extent": same * 10 * np.linalg.norm(high - low, axis=0)[own],
        "heap height": same * 10 * (high - low)[2, own],
        "heap patches": same * np.log(count[own]),
        "heap solidity": same * np.minimum(pixels / hull, 1.2)[own],
    }


def _hull(patches: PatchMeasures, one: int, other: int) -> float:
    """The area in pixels of the convex hull around two patches."""
    corners = np.concatenate([patches.hulls[one], patches.hulls[other]])
    return cv2.contourArea(cv2.convexHull(corners)) + 1


def _on_the_line(
    labels: Labels, depth: Array, patches: PatchMeasures, one: Indices, other: Indices
) -> tuple[Vectors, Vectors]:
    """The shares (m,) of the line between two patches that are hidden and open.

    Hidden is what is behind something nearer or was not read, as a share of what is not
    on the two themselves; open is where the picture sees past the line.
    """
    far = np.linspace(0, 1, _ON_THE_LINE + 2)[1:-1]
    start, end = patches.centre[one][:, None], patches.centre[other][:, None]
    columns, rows = np.moveaxis(
        np.rint(start + (end - start) * far[:, None]).astype(int), 2, 0
    )
    seen, owner = depth[rows, columns], labels[rows, columns] - 1
    inverse = (1 - far) / patches.depth[one][:, None] + far / patches.depth[other][
        :, None
    ]
    strange = (owner != one[:, None]) & (owner != other[:, None])
    hidden = strange & ((seen < 1 / inverse - _NEARER) | np.isnan(seen))
    past = strange & (seen > 1 / inverse + _FARTHER)
    share = hidden.sum(axis=1) / np.maximum(strange.sum(axis=1), 1)
    return share, past.sum(axis=1) / _ON_THE_LINE


def _log(metres: Vectors) -> Vectors:
    logarithm: Vectors = np.log(np.minimum(metres, 0.5) + 0.002)
    return logarithm
