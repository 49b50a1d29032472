"""Compute a configuration, which spatial words describe, from two regions of a
frame."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import permutations

import numpy as np
from numpy.typing import NDArray

from kille.perception.geometry import offset, points_in, table_axes
from kille.perception.relations.bounding_boxes import Bounds, bounds_of, containment
from kille.scene import Configuration, Direction, Frame, Point, Region

_STRAYS = 0.02
_BARE = 0.004  # metres: nothing that can be seen is flatter


def configuration(
    frame: Frame,
    target: Region,
    landmark: Region,
    others: Sequence[Region],
    up: Direction,
    *,
    places: tuple[Point, Point] | None = None,
) -> Configuration | None:
    """How the target is placed relative to the landmark; None if a place is unknown.

    Sizes are those of the visible points, and the hold is told from their boxes.
    `places` are the target's and the landmark's where they are known better than as
    the middles of their regions.

    >>> from kille.sensors.synthetic import open_synthetic
    >>> frame = open_synthetic("synthetic:desk?seed=7").frame()
    >>> from kille.perception.segment import segment
    >>> seen = segment(frame)
    >>> one, other, *rest = seen.regions
    >>> placed = configuration(frame, one, other, rest, seen.up)
    >>> len(placed.offset), len(placed.others)
    (3, 1)
    """
    here, there = places or (target.place, landmark.place)
    axes = table_axes(up)
    of, to = (
        _Placed(place, _bounds(frame, region, axes))
        for place, region in ((here, target), (there, landmark))
    )
    return _between(of, to, [it.place for it in others], up)


def configurations(
    frame: Frame, regions: Sequence[Region], up: Direction
) -> Mapping[tuple[int, int], Configuration]:
    """The configuration of each pair of regions, by numbers of target and landmark.

    As `configuration` says of each two, with all the others there; a pair of which a
    place is unknown is missing.
    """
    axes = table_axes(up)
    placed = [_Placed(it.place, _bounds(frame, it, axes)) for it in regions]
    found = {}
    for of, to in permutations(range(len(placed)), 2):
        others = [it.place for i, it in enumerate(placed) if i not in (of, to)]
        stand = _between(placed[of], placed[to], others, up)
        if stand is not None:
            found[of, to] = stand
    return found


@dataclass(frozen=True, eq=False)
class _Placed:
    """A thing's place and bounding box, as far as they are known."""

    place: Point | None
    box: Bounds | None


def _between(
    target: _Placed, landmark: _Placed, others: Sequence[Point | None], up: Direction
) -> Configuration | None:
    here, there = target.place, landmark.place
    if here is None or there is None:
        return None
    found = Configuration(
        offset=offset(here, there, up),
        viewed=_direction(table_axes(up) @ np.asarray(there, np.float64)),
        others=tuple(offset(it, there, up) for it in others if it is not None),
    )
    box, base = target.box, landmark.box
    if box is None or base is None:
        return found
    held = containment(box, base)
    return replace(
        found,
        target_size=max(box.size, _BARE),
        landmark_size=max(base.size, _BARE),
        contact=held.contact,
        support=held.support,
        containment=held.containment,
    )


def _bounds(frame: Frame, region: Region, axes: NDArray[np.float64]) -> Bounds | None:
    points = points_in(frame, region.mask, region.box)
    return bounds_of(points.astype(np.float64) @ axes.T, _STRAYS)


def _direction(vector: NDArray[np.float64]) -> Direction:
    right, away, above = (round(float(it), 6) for it in vector)
    return right, away, above
