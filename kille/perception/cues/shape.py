"""Shape: the outline as a whole, in a few numbers."""

from __future__ import annotations

import cv2
import numpy as np

from kille.perception.cues.patch import Patch
from kille.scene import Vector

LENGTH = 12


def shape(patch: Patch) -> Vector | None:
    """Twelve numbers (12,) of the outline, independent of its place.

    The share of the picture (or, with depth, the area in dm²) as a logarithm; how wide
    it is to its height, upright and along its own axes; how much of its box and of its
    convex hull it fills; how round it is; how the longer axis leans; Hu's moments 1-4.
    None for a region of next to no pixels.
    """
    if patch.window is None:
        return None
    mask = patch.window.inside.astype(np.uint8)
    outlines, _ = cv2.findContours(mask, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    area = float(np.count_nonzero(mask))
    if not area:
        return None
    around = np.concatenate(outlines)
    _, (one, other), _ = cv2.minAreaRect(around)
    width, height = cv2.boundingRect(around)[2:]
    hull = max(cv2.contourArea(cv2.convexHull(around)), area)
    length = sum(cv2.arcLength(outline, True) for outline in outlines)
    moments = cv2.moments(mask, binaryImage=True)
    hu = cv2.HuMoments(moments).ravel()[:4]
    long, short = max(one, other, 1.0), max(min(one, other), 1.0)
    tilt = 0.5 * np.arctan2(2 * moments["mu11"], moments["mu20"] - moments["mu02"])
    stretch = np.log(long / short)
    numbers = [
        0.5 * np.log(_area(patch)),
        np.log(width / height),
        stretch,
        2 * area / (width * height),
        2 * area / hull,
        2 * np.sqrt(4 * np.pi * area) / max(length, 1.0),
        stretch * np.cos(2 * tilt) / 2,
        stretch * abs(np.sin(2 * tilt)) / 2,
        *(-np.log10(np.abs(hu) + 1e-7) / (2, 4, 6, 6)),
    ]
    return np.asarray(numbers, np.float32)


def _area(patch: Patch) -> float:
    """The region's share of the picture; with depth what it covers, in dm²."""
    pixels = float(np.count_nonzero(patch.inside))
    lens = patch.frame.intrinsics
    if patch.region.place is None or lens is None:
        return pixels / patch.region.mask.size
    return float(100 * pixels * patch.region.place.z**2 / (lens.fx * lens.fy) + 1e-4)
