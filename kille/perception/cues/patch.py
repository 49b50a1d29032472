"""Patches, from which cues are measured: a region of a frame, cropped only once."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.perception.geometry import Array, points_in
from kille.scene import Box, Frame, Mask, Region

SIDE = 128
"""Pixels of a square window: what is finer is lost in a small thing far away."""

_MARGIN = 0.15  # of the longer side of the box, on every side
_RIM = 3  # pixels: so far a region may reach over what is behind it
_ENOUGH = 500 * 500  # pixels of a box: more tell no more of its colours
_LEAST = 4  # pixels: a smaller region has no outline to speak of


@dataclass(frozen=True, eq=False)
class Window:
    """A square piece of a picture (SIDE, SIDE, 3), and which of its pixels are the
    thing.
    """

    colour: NDArray[np.uint8]
    inside: Mask

    @cached_property
    def grey(self) -> NDArray[np.uint8]:
        """Its grey values (SIDE, SIDE)."""
        return np.asarray(cv2.cvtColor(self.colour, cv2.COLOR_RGB2GRAY), np.uint8)

    @cached_property
    def lab(self) -> Array:
        """Its colours (SIDE, SIDE, 3) in Lab."""
        light = self.colour.astype(np.float32) / np.float32(255)
        return np.asarray(cv2.cvtColor(light, cv2.COLOR_RGB2LAB), np.float32)


@dataclass(frozen=True, eq=False)
class Patch:
    """A region of a frame, with crops that are made when first asked for.

    >>> from kille.sensors.synthetic import open_synthetic
    >>> frame = open_synthetic("synthetic:desk?seed=7").frame()
    >>> from kille.perception.segment import segment
    >>> patch = Patch(frame, segment(frame).regions[0])
    >>> patch.rgb.dtype.name
    'uint8'
    """

    frame: Frame
    region: Region

    @cached_property
    def inside(self) -> Mask:
        """The region's pixels in its box (h, w)."""
        return self.region.mask[_pixels(self.region)]

    @cached_property
    def rgb(self) -> NDArray[np.uint8]:
        """The colours (n, 3) of the pixels; a sample of them if the region is huge."""
        step = 1 + int(np.sqrt(self.inside.size / _ENOUGH))
        some = np.s_[::step, ::step]
        return self.frame.colour[_pixels(self.region)][some][self.inside[some]]

    @cached_property
    def lab(self) -> NDArray[np.uint8]:
        """The same in 8-bit Lab."""
        if not len(self.rgb):
            return self.rgb
        lab = cv2.cvtColor(self.rgb[None], cv2.COLOR_RGB2LAB)[0]
        return np.asarray(lab, np.uint8)

    @cached_property
    def points(self) -> Array:
        """The points (n, 3) in metres read under the region; none without depth."""
        return points_in(self.frame, self.region.mask, self.region.box)

    @cached_property
    def inner_points(self) -> Array:
        """The points (n, 3) without those at the edges, which may lie behind the
        thing."""
        box, region = self.region.box, self.region
        around = cv2.copyMakeBorder(
            self.inside.astype(np.uint8), *(_RIM,) * 4, cv2.BORDER_CONSTANT, value=0
        )
        disc = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * _RIM + 1,) * 2)
        inner = np.zeros_like(region.mask)
        eroded = cv2.erode(around, disc)[_RIM:-_RIM, _RIM:-_RIM] > 0
        inner[_pixels(region)] = eroded
        return points_in(self.frame, inner, box)

    @cached_property
    def window(self) -> Window | None:
        """A square window around the region, with a margin; None for a tiny region."""
        if np.count_nonzero(self.inside) < _LEAST**2:
            return None
        box = self.region.box
        mask = self.region.mask.view(np.uint8) * np.uint8(255)
        return Window(
            cut_square(self.frame.colour, box, SIDE, cv2.BORDER_REPLICATE),
            cut_square(mask, box, SIDE, cv2.BORDER_CONSTANT) > 127,
        )

    @cached_property
    def whole(self) -> Window | None:
        """The whole picture as a window, if it has no depth.

        Then the region's outline is but a guess, and what is around a thing tells
        something about it. None for a picture with depth, or of next to no pixels.
        """
        if self.frame.depth is not None:
            return None
        if min(self.frame.colour.shape[:2]) < _LEAST:
            return None
        return Window(
            resize_picture(self.frame.colour, SIDE), np.ones((SIDE, SIDE), bool)
        )


def _pixels(region: Region) -> tuple[slice, slice]:
    box = region.box
    return np.s_[box.top : box.bottom, box.left : box.right]


def cut_square(
    picture: NDArray[np.uint8], box: Box, side: int, border: int, value: int = 0
) -> NDArray[np.uint8]:
    """Cut a square around a box, with a margin, as (side, side, ...).

    `border` tells OpenCV how to fill what lies beyond the picture.
    """
    height, width = picture.shape[:2]
    longer = max(box.right - box.left, box.bottom - box.top)
    size = max(1, round(longer * (1 + 2 * _MARGIN)))
    left = round((box.left + box.right - size) / 2)
    top = round((box.top + box.bottom - size) / 2)
    crop = cv2.copyMakeBorder(
        picture[max(0, top) : top + size, max(0, left) : left + size],
        max(0, -top),
        max(0, top + size - height),
        max(0, -left),
        max(0, left + size - width),
        border,
        value=(value,) * 3,
    )
    return resize_picture(np.asarray(crop, np.uint8), side)


def resize_picture(picture: NDArray[np.uint8], side: int) -> NDArray[np.uint8]:
    """Squeeze or stretch the picture to (side, side, ...)."""
    way = cv2.INTER_AREA if max(picture.shape[:2]) > side else cv2.INTER_LINEAR
    return np.asarray(cv2.resize(picture, (side, side), interpolation=way), np.uint8)
