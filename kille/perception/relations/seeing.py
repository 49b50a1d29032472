"""From two regions of a frame to a configuration: what a spatial word is judged of."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from kille.perception.geometry import offset, points_in, table_axes
from kille.perception.relations.bounds import Bounds, bounds_of, hold
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
    """How the target stands to the landmark, as seen; None where a place is unknown.

    Sizes are those of the visible points, and the hold is told from their boxes.
    `places` are the target's and the landmark's where they are known better than as
    the middles of their regions.
    """
    here, there = places or (target.place, landmark.place)
    if here is None or there is None:
        return None
    axes = table_axes(up)
    viewed = axes @ np.asarray(there, np.float64)
    found = Configuration(
        offset=offset(here, there, up),
        viewed=_direction(viewed),
        others=tuple(
            offset(it.place, there, up) for it in others if it.place is not None
        ),
    )
    box, base = _bounds(frame, target, axes), _bounds(frame, landmark, axes)
    if box is None or base is None:
        return found
    held = hold(box, base)
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
