"""Colours as numbers: CIELAB, in which equal steps look about equally large.

L is the lightness, 0 to 100; a runs from green to red, b from blue to yellow; what is
grey has a = b = 0. The white is that of daylight (D65), as in sRGB.
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray

Lab = NDArray[np.float64]
"""Colours (..., 3): L, a, b.

>>> from kille.perception.colours import Lab, lab_of
>>> red: Lab = lab_of([255, 0, 0])
>>> red.shape
(3,)
"""

_DAYLIGHT = (0.95047, 1.0, 1.08883)  # D65, the white of Lab
_KNEE = 6 / 29  # where the cube of Lab gives way to a straight line
_CONES = np.array(
    [
        [0.8189330101, 0.3618667424, -0.1288597137],
        [0.0329845436, 0.9293118715, 0.0361456387],
        [0.0482003018, 0.2643662691, 0.6338517070],
    ]
)
_OPPONENT = np.array(
    [
        [0.2104542553, 0.7936177850, -0.0040720468],
        [1.9779984951, -2.4285922050, 0.4505937099],
        [0.0259040371, 0.7827717662, -0.8086757660],
    ]
)
_SCALE = (100, 300, 300)


def lab_of(rgb: ArrayLike) -> Lab:
    """The Lab colours of sRGB colours (..., 3) in 0 to 255.

    >>> lab_of([[255, 0, 0], [128, 128, 128]]).round()
    array([[53., 80., 67.],
           [54.,  0.,  0.]])
    """
    shares = np.asarray(rgb, np.float32) / np.float32(255)
    lab = cv2.cvtColor(_row(shares), cv2.COLOR_RGB2LAB)
    return np.asarray(lab, np.float64).reshape(shares.shape) + 0.0


def rgb_of(lab: ArrayLike) -> NDArray[np.uint8]:
    """The nearest sRGB colours (..., 3) to Lab colours.

    >>> rgb_of([53.2, 80.1, 67.2]).tolist()
    [255, 0, 0]
    """
    colours = np.asarray(lab, np.float32)
    rgb = cv2.cvtColor(_row(colours), cv2.COLOR_LAB2RGB).reshape(colours.shape)
    return np.asarray(np.clip(rgb * 255, 0, 255).round(), np.uint8)


def even(lab: ArrayLike) -> Lab:
    """Convert Lab colours (n, 3) to Oklab (Ottosson 2020), at about the same scale.

    Its hues are even: in Lab a blue that gets paler turns towards violet, so that no
    straight border holds all blues.

    >>> abs(even([[0, 0, 0], [100, 0, 0]])).round().tolist()
    [[0.0, 0.0, 0.0], [100.0, 0.0, 0.0]]
    """
    light, a, b = np.asarray(lab, np.float64).T
    middle = (light + 16) / 116
    cones = np.stack([middle + a / 500, middle, middle - b / 200], axis=1)
    straight = 3 * _KNEE**2 * (cones - 4 / 29)
    xyz = np.where(cones > _KNEE, cones**3, straight) * _DAYLIGHT
    return np.asarray(np.cbrt(xyz @ _CONES.T) @ _OPPONENT.T * _SCALE)


def _row(colours: NDArray[np.float32]) -> NDArray[np.float32]:
    return np.ascontiguousarray(colours.reshape(-1, 1, 3))
