"""SIFT features of one region in one frame, and their points in space."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.perception.geometry import points_at
from kille.scene import Box, Features, Frame, Region

Grey = NDArray[np.uint8]

_MARGIN = 12  # pixels around the box, for features whose surroundings reach out of it
# Both let more features through than SIFT's own .04 and 10: things with little texture
# need them, and words learned from few pictures were told apart better.
_CONTRAST = 0.02
_EDGE = 20.0
_MOST = 1280 * 960  # pixels: a larger region is made smaller, finer detail is noise
_BRIM = 3  # pixels around the mask: outlines from depth are a little off

NONE = Features(
    np.empty((0, 128), np.uint8),
    np.empty((0, 2), np.float32),
    np.empty((0, 3), np.float32),
)
"""No features at all."""


def features_of(frame: Frame, region: Region, sift: cv2.SIFT | None = None) -> Features:
    """The SIFT features of the region; there may be none without texture.

    SIFT runs on the region's box and a margin, not on the frame: its cost is that of
    the pixels it is given, mask or not; a huge box is made smaller. Another SIFT than
    the robot's may be given.
    """
    box = _widen_box(region.box, frame.colour.shape)
    crop = np.s_[box.top : box.bottom, box.left : box.right]
    if not frame.colour[crop].size:
        return NONE
    grey = np.asarray(cv2.cvtColor(frame.colour[crop], cv2.COLOR_RGB2GRAY), np.uint8)
    brim = np.ones((2 * _BRIM + 1,) * 2, np.uint8)
    mask = np.asarray(cv2.dilate(region.mask[crop].astype(np.uint8), brim), np.uint8)
    seen, inside = _smaller(grey, mask)
    keypoints, descriptors = (sift or _sift()).detectAndCompute(seen, inside)
    if not keypoints:
        return NONE
    # The middle of a pixel is its whole number, hence the halves.
    stretch = np.divide(grey.shape, seen.shape)[::-1]
    corner = np.array([box.left, box.top]) + (stretch - 1) / 2
    found = np.array([point.pt for point in keypoints])
    pixels = np.asarray(found * stretch + corner, np.float32)
    return Features(descriptors.astype(np.uint8), pixels, points_at(frame, pixels))


def descriptors_of(scans: Iterable[Features]) -> NDArray[np.uint8]:
    """The descriptors (n, 128) of all scans together."""
    return np.concatenate([NONE.descriptors, *(it.descriptors for it in scans)])


def _smaller(grey: Grey, mask: Grey) -> tuple[Grey, Grey]:
    """Both pictures, shrunk if they have more pixels than SIFT is given at most."""
    stretch = np.sqrt(grey.size / _MOST)
    if stretch <= 1:
        return grey, mask
    size = tuple(max(1, int(side / stretch)) for side in grey.shape[::-1])
    few = cv2.resize(grey, size, interpolation=cv2.INTER_AREA)
    inside = cv2.resize(mask, size, interpolation=cv2.INTER_NEAREST)
    return np.asarray(few, np.uint8), np.asarray(inside, np.uint8)


@cache
def _sift() -> cv2.SIFT:
    return cv2.SIFT.create(contrastThreshold=_CONTRAST, edgeThreshold=_EDGE)


def _widen_box(box: Box, shape: tuple[int, ...]) -> Box:
    """The box with a margin, within the picture."""
    return Box(
        max(0, box.left - _MARGIN),
        max(0, box.top - _MARGIN),
        min(shape[1], box.right + _MARGIN),
        min(shape[0], box.bottom + _MARGIN),
    )
