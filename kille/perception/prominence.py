"""How much things stand out in a picture: their size there, how central, how near.

Source: Kelleher, Costello and van Genabith 2005, where the pixels of a thing count the
more, the closer they are to the middle of the picture.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import hypot, inf
from typing import NamedTuple

import numpy as np

from kille.perception.segment import nearness
from kille.scene import Percept, Region

UNKNOWN = 0.5
"""The nearness of things when no distance is known: neither near nor far."""


class Prominence(NamedTuple):
    """How much a thing stands out, in degrees from 0 to 1.

    `size` is its pixels beside those of the biggest thing. `centrality` is 1 in the
    middle of the picture and 0 in its corners. `nearness` is the distance of the
    nearest thing divided by its own, and 1/2 where that is not known.
    """

    size: float
    centrality: float
    nearness: float


def prominences(percepts: Sequence[Percept]) -> list[Prominence]:
    """How much each of these things of one look stands out among them."""
    regions = [it.region for it in percepts]
    pixels = [_pixels(it) for it in regions]
    distances = [nearness(it) for it in regions]
    most, nearest = max(pixels, default=0), min(distances, default=inf)
    return [
        Prominence(
            size / most if most else 0.0,
            _centrality(region),
            UNKNOWN if distance == inf else nearest / distance if distance else 1.0,
        )
        for region, size, distance in zip(regions, pixels, distances, strict=True)
    ]


def _pixels(region: Region) -> int:
    left, top, right, bottom = region.box
    return int(np.count_nonzero(region.mask[top:bottom, left:right]))


def _centrality(region: Region) -> float:
    """How close the middle of the region's box is to that of the picture."""
    (height, width), box = region.mask.shape, region.box
    right = (box.left + box.right - width) / 2.0
    down = (box.top + box.bottom - height) / 2.0
    farthest = hypot(width, height) / 2.0
    return max(0.0, 1.0 - hypot(right, down) / farthest)
