"""The outline of a thing as a polygon, for pages and other programs."""

from __future__ import annotations

import cv2
import numpy as np

from kille.scene import Mask

_DETAIL = 1.5  # pixels by which the polygon may miss the outline


def polygon_of(mask: Mask) -> list[tuple[int, int]]:
    """The corners (u, v) of the largest connected piece of a mask (H, W).

    >>> mask = np.zeros((40, 40), bool)
    >>> mask[10:20, 5:30] = True
    >>> polygon_of(mask)
    [(5, 10), (5, 19), (29, 19), (29, 10)]
    """
    found, _ = cv2.findContours(
        mask.astype(np.uint8), cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_SIMPLE
    )
    if not found:
        return []
    largest = max(found, key=cv2.contourArea)
    corners = cv2.approxPolyDP(largest, _DETAIL, closed=True)
    return [(int(u), int(v)) for u, v in corners[:, 0]]
