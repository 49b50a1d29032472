"""Pictures as a Kinect's sensors put them on the wire."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Depth = NDArray[np.uint16]
Colour = NDArray[np.uint8]
Infrared = NDArray[np.uint16]


def packed(values: NDArray[np.uint16], bits: int) -> bytes:
    """The lowest `bits` bits of each value, most significant first, without gaps.

    >>> packed(np.array([0b10000000001, 0b01111111110, 0, 0, 0, 0, 0, 1]), 11).hex()
    '802ff80000000000000001'
    """
    left = (values.ravel().astype(np.uint16) << (16 - bits)).astype(">u2")
    columns = np.unpackbits(left.view(np.uint8)).reshape(-1, 16)[:, :bits]
    return np.packbits(columns).tobytes()


def mosaic(colour: Colour) -> Colour:
    """What the colour sensor sees: each pixel through one filter of the Bayer pattern.

    Even rows are green, red, green, red …; odd rows blue, green, blue, green ….

    >>> rgb = np.array([[[1, 2, 3], [4, 5, 6]], [[7, 8, 9], [10, 11, 12]]], np.uint8)
    >>> mosaic(rgb).tolist()
    [[2, 4], [9, 11]]
    """
    raw = colour[:, :, 1].copy()
    raw[0::2, 1::2] = colour[0::2, 1::2, 0]
    raw[1::2, 0::2] = colour[1::2, 0::2, 2]
    return raw
