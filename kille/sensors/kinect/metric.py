"""Raw depth and millimetres, by the device's own calibration.

The pattern of a point nearer than the zero plane is shifted, by raw / 4 pixels from an
offset; from triangles, with b the distance of projector and camera, d the zero plane's
distance and m the shift in centimetres on the zero plane,

    m = (raw / 4 - offset - 0.375) p,    z = d + d m / (b - m).

Integers are those of libfreenect, bit for bit: also where, beyond sixty-five metres,
they wrap around in their 16 bits.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TypeVar

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.sensors.kinect.calibration import Calibration

NO_READING = 2047
"""The raw number of a pixel whose depth could not be measured."""

FARTHEST = 10_000
"""Millimetres at and beyond which no depth is given."""

_RAW_NUMBERS = 2048

_ON_ONE_CORE = 640 * 240
"""So many pixels OpenCV looks up on one core."""

_Entry = TypeVar("_Entry", np.uint16, np.int32, np.float32)


def millimetres(
    raw: NDArray[np.uint16], calibration: Calibration
) -> NDArray[np.uint16]:
    """The depth in millimetres: 0 for no reading, 10000 for 10 m and more.

    >>> millimetres(np.array([[450, 700, 2047]], np.uint16), Calibration.typical())
    array([[540, 887,   0]], dtype=uint16)
    """
    return look_up(np.minimum(depths(calibration), FARTHEST), raw)


def raw_of(
    mm: NDArray[np.floating | np.integer], calibration: Calibration
) -> NDArray[np.uint16]:
    """The raw numbers whose depth is the nearest to these millimetres.

    NO_READING for what is not a number, nearer than the camera can tell, or 10 m away.

    >>> raw_of(np.array([887.0, np.nan, 10.0]), Calibration.typical())
    array([ 700, 2047, 2047], dtype=uint16)
    """
    known = depths(calibration)[: beyond(calibration)].astype(np.float64)
    middles = (known[1:] + known[:-1]) / 2
    told = np.asarray(mm, np.float64)
    nearest = np.searchsorted(middles, told)
    told_well = (told >= known[0] - 0.5) & (told < FARTHEST)
    return np.where(told_well, nearest, NO_READING).astype(np.uint16)


@lru_cache(maxsize=8)
def depths(calibration: Calibration) -> NDArray[np.uint16]:
    """The millimetres (65536,) of each raw number, also of those too far to count."""
    plane = calibration.zero_plane
    raw = np.arange(_RAW_NUMBERS, dtype=np.float64)
    shift = (raw - 4 * float(calibration.const_shift)) / 4 - 0.375
    on_plane = shift * plane.reference_pixel_size
    with np.errstate(divide="ignore"):
        far = (
            on_plane
            * plane.reference_distance
            / (plane.dcmos_emitter_distance - on_plane)
        )
    table = np.zeros(1 << 16, np.uint16)
    table[:_RAW_NUMBERS] = wrap_to_bits(10 * (far + plane.reference_distance), 16)
    table[NO_READING] = 0
    table.flags.writeable = False
    return table


@lru_cache(maxsize=8)
def beyond(calibration: Calibration) -> int:
    """The first raw number of 10 m or more; it and those after it tell no depth.

    >>> beyond(Calibration.typical())
    1055
    """
    return int(np.argmax(depths(calibration) >= FARTHEST))


def look_up(table: NDArray[_Entry], numbers: NDArray[np.uint16]) -> NDArray[_Entry]:
    """The entries of a table of 65536 at each of the numbers.

    OpenCV would look up a whole picture on all cores, which takes no less time but, as
    they wait for each other, more of every core: so it gets the picture in parts.
    """
    entries = np.empty(numbers.shape, table.dtype)
    asked, found = numbers.reshape(-1), entries.reshape(-1)
    for first in range(0, asked.size, _ON_ONE_CORE):
        part = slice(first, first + _ON_ONE_CORE)
        cv2.LUT(asked[part], table, dst=found[part])
    return entries


def wrap_to_bits(values: NDArray[np.floating], bits: int) -> NDArray[np.int64]:
    """Whole numbers towards zero, of which so many bits are kept.

    >>> wrap_to_bits(np.array([1.9, -1.9, 65537.0]), 16).tolist()
    [1, 65535, 1]
    """
    whole = np.nan_to_num(np.trunc(values), posinf=0.0, neginf=0.0)
    kept: NDArray[np.int64] = whole.astype(np.int64) & ((1 << bits) - 1)
    return kept
