"""Pixels out of packed bits: the most significant bit first, no gaps.

Eight pixels of n bits fill n bytes. The first eight and the last eight of those bytes
are read as two big numbers of 64 bits; four pixels are shifted out of each into the
lanes of a third, so that a frame takes a few passes over 38,400 numbers.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Bytes = NDArray[np.uint8]
Pixels = NDArray[np.uint16]

_Words = NDArray[np.uint64]


def unpack_11(packed: Bytes) -> Pixels:
    """The raw depth (480, 640) of a frame of 11 bits; 2047 is no reading.

    >>> unpack_11(np.full(422400, 0xFF, np.uint8)).min()
    np.uint16(2047)
    """
    return _unpack(packed, 11).reshape(480, 640)


def unpack_10(packed: Bytes) -> Pixels:
    """The pixels (rows, 640) of a frame of 10 bits: depth, or infrared with 488 rows.

    >>> unpack_10(np.full(384000, 0xFF, np.uint8)).shape
    (480, 640)
    """
    return _unpack(packed, 10).reshape(-1, 640)


def _unpack(packed: Bytes, bits: int) -> Pixels:
    groups = packed.size // bits
    data = np.ascontiguousarray(packed).data
    early = np.ndarray((groups,), ">u8", data, 0, (bits,)).astype(np.uint64)
    late = np.ndarray((groups,), ">u8", data, bits - 8, (bits,)).astype(np.uint64)
    lanes = np.empty((groups, 2), "<u8")
    lanes[:, 0] = _four(early, 64 - bits, bits)
    lanes[:, 1] = _four(late, 3 * bits, bits)
    return lanes.view("<u2")


def _four(words: _Words, first: int, bits: int) -> _Words:
    """Four pixels in lanes of 16 bits, the first of them `first` bits from below."""
    lanes = np.zeros_like(words)
    for lane in range(4):
        shift = first - lane * (bits + 16)
        moved = words >> np.uint64(shift) if shift > 0 else words << np.uint64(-shift)
        moved &= np.uint64(((1 << bits) - 1) << (16 * lane))
        lanes |= moved
    return lanes
