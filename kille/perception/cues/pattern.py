"""Pattern: how grey values vary around pixels, as local binary patterns."""

from __future__ import annotations

from collections.abc import Iterator

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.perception.cues.patch import SIDE, Patch, Window
from kille.perception.geometry import Array
from kille.scene import Mask, Vector

_RADII = (1, 2, 4)
_AROUND = 8
_KINDS = _AROUND * (_AROUND - 1) + 3
_QUARTERS = tuple(
    (rows, columns)
    for rows in (np.s_[: SIDE // 2], np.s_[SIDE // 2 :])
    for columns in (np.s_[: SIDE // 2], np.s_[SIDE // 2 :])
)
LENGTH = len(_RADII) * _KINDS
WHOLE = len(_QUARTERS) * LENGTH


def pattern(patch: Patch) -> Vector | None:
    """Roots (177,) of histograms of the region's uniform patterns, of length 1.

    Source: Ojala, Pietikäinen & Mäenpää 2002, "Multiresolution gray-scale and rotation
    invariant texture classification with local binary patterns" (not made invariant).
    None for a region of next to no pixels.
    """
    if patch.window is None or not patch.window.inside.any():
        return None
    return _roots(
        [_counts(kinds, patch.window.inside) for kinds in _kinds(patch.window)]
    )


def whole_pattern(patch: Patch) -> Vector | None:
    """The patterns of each quarter of the whole picture (708,); None if it has
    depth."""
    if patch.whole is None:
        return None
    everywhere = patch.whole.inside
    return _roots(
        [
            _counts(kinds[quarter], everywhere[quarter])
            for kinds in _kinds(patch.whole)
            for quarter in _QUARTERS
        ]
    )


def _roots(histograms: list[NDArray[np.intp]]) -> Vector:
    shares = [counts / (counts.sum() * len(histograms)) for counts in histograms]
    roots: Vector = np.sqrt(np.concatenate(shares)).astype(np.float32)
    return roots


def _counts(kinds: NDArray[np.intp], inside: Mask) -> NDArray[np.intp]:
    return np.bincount(kinds[inside], minlength=_KINDS)


def _kinds(window: Window) -> list[NDArray[np.intp]]:
    """The kind of pattern around each pixel (SIDE, SIDE), at each radius."""
    grey = window.grey.astype(np.float32)
    return [_UNIFORM[_codes(grey, radius)] for radius in _RADII]


def _codes(grey: Array, radius: int) -> NDArray[np.uint8]:
    """Which of eight pixels around each one are at least as bright, bit by bit."""
    codes = np.zeros(grey.shape, np.uint8)
    least = grey - 1e-3
    for k, there in enumerate(_around(grey, radius)):
        codes |= (there >= least).astype(np.uint8) << np.uint8(k)
    return codes


def _around(grey: Array, radius: int) -> Iterator[Array]:
    """For each pixel what is so far right of it, then on around; the border goes on.

    Right, above, left and below are whole pixels; the others lie between some.
    """
    height, width = grey.shape
    wide = cv2.copyMakeBorder(grey, *(radius,) * 4, cv2.BORDER_REPLICATE)
    for k in range(_AROUND):
        angle = 2 * np.pi * k / _AROUND
        right, down = radius * np.cos(angle), -radius * np.sin(angle)
        if k % 2 == 0:
            top, left = radius + round(down), radius + round(right)
            yield np.asarray(wide[top : top + height, left : left + width])
            continue
        shift = np.array([[1, 0, -right], [0, 1, -down]], np.float32)
        there = cv2.warpAffine(
            grey,
            shift,
            (width, height),
            flags=cv2.INTER_LINEAR,
            borderMode=cv2.BORDER_REPLICATE,
        )
        yield np.asarray(there, np.float32)


def _table() -> NDArray[np.intp]:
    """The kind of each code: the uniform ones (at most two changes), then the rest."""
    bits = (np.arange(2**_AROUND)[:, None] >> np.arange(_AROUND)) & 1
    uniform = (bits != np.roll(bits, 1, axis=1)).sum(axis=1) <= 2
    kinds = np.full(2**_AROUND, _KINDS - 1, np.intp)
    kinds[uniform] = np.arange(uniform.sum())
    return kinds


_UNIFORM = _table()
