"""Pointing: find the region that a tutor means by a pixel."""

from __future__ import annotations

import numpy as np

from kille.perception.segment import segment
from kille.scene import Frame, Mask, Region

_SLACK = 20.0  # pixels: a finger may miss a thing by so much


def region_at(frame: Frame, pixel: tuple[int, int]) -> Region | None:
    """The region at the pixel (u, v), or the one nearest to it within 20 pixels.

    None if there is nothing near the pixel.
    """
    regions = segment(frame).regions
    found = min(regions, key=lambda it: _miss(it.mask, pixel), default=None)
    if found is None or _miss(found.mask, pixel) > _SLACK:
        return None
    return found


def _miss(mask: Mask, pixel: tuple[int, int]) -> float:
    """The distance in pixels from this pixel to the mask."""
    rows, columns = np.nonzero(mask)
    if not rows.size:
        return float("inf")
    return float(np.sqrt(((columns - pixel[0]) ** 2 + (rows - pixel[1]) ** 2).min()))
