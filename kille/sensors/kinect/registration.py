"""Depth as the colour camera sees it, by the device's own 29 numbers.

A pixel (x, y) of the depth picture goes to the pixel (x + dx + s, y + dy) of the colour
picture. dx and dy bend slowly over the picture: the device gives the first values of
their first, second and third differences, in fixed point, along rows and columns. s is
the parallax between the two cameras, which depends on the depth alone. Where several
pixels meet, the nearest is what the colour camera sees.
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kille.sensors.kinect.calibration import Calibration, Registration
from kille.sensors.kinect.metric import FARTHEST, NO_READING, depths, look_up

WIDTH, HEIGHT = 640, 480

_PIXEL = 256
"""Places are reckoned in parts of a pixel."""

_UNSEEN = 0xFFFF


def register_depth(
    raw: NDArray[np.uint16], calibration: Calibration, nothing_from: int = NO_READING
) -> NDArray[np.uint16]:
    """The depth (480, 640) in millimetres on the colour picture; 0 where none is seen.

    Equal to libfreenect's registered depth, bit for bit, but that raw numbers tell
    nothing from `nothing_from` on.
    """
    tables = _tables(calibration, nothing_from)
    moved = look_up(tables.shifts, raw)
    moved += tables.places
    moved >>= 8
    canvas = np.full((HEIGHT + 1, WIDTH + 2 * tables.margin), _UNSEEN, np.uint16)
    depth = look_up(tables.depths, raw)
    np.minimum.at(canvas.reshape(-1), moved.astype(np.intp).ravel(), depth.ravel())
    seen = canvas[:HEIGHT, tables.margin : tables.margin + WIDTH]
    # Less than a pixel outside the left edge is cut to the edge, by integer division.
    np.minimum(seen[:, 0], canvas[:HEIGHT, tables.margin - 1], out=seen[:, 0])
    # In sixteen bits, one more than what is unseen is 0.
    return _drop_top_lines(seen + np.uint16(1), calibration.padding.start_lines)


def _drop_top_lines(picture: NDArray[np.uint16], lines: int) -> NDArray[np.uint16]:
    """The picture without the lines that the sensor leaves out at its top.

    libfreenect counts 480, not 640, pixels for each of them.
    """
    if not lines:
        return picture
    kept = picture.reshape(-1)[HEIGHT * lines :]
    return np.pad(kept, (0, picture.size - kept.size)).reshape(picture.shape)


class _Tables(NamedTuple):
    """The map to a picture that has a margin on both sides, and one more line.

    Pixels land in the margin if the parallax carries them out of the picture, and in
    the last line if the map does.
    """

    margin: int
    places: NDArray[np.int32]
    """Where each pixel goes, in parts of a pixel from the first, but for parallax."""
    shifts: NDArray[np.int32]
    """The parallax of each raw number, in parts of a pixel."""
    depths: NDArray[np.uint16]
    """The millimetres of each raw number less one, or _UNSEEN."""


@lru_cache(maxsize=4)
def _tables(calibration: Calibration, nothing_from: int) -> _Tables:
    mm = depths(calibration)
    told = (mm > 0) & (mm < FARTHEST) & (np.arange(mm.size) < nothing_from)
    shifts = np.where(told, _shifts(calibration), 0)
    margin = int(np.abs(shifts).max()) // _PIXEL + 2
    lines, columns = _map(calibration.registration)
    begins = lines * (WIDTH + 2 * margin) + margin
    return _Tables(
        margin,
        (begins * _PIXEL + columns).astype(np.int32),
        shifts.astype(np.int32),
        np.where(told, mm - np.uint16(1), _UNSEEN).astype(np.uint16),
    )


def _map(numbers: Registration) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """The line that each pixel goes to, and the column in parts of a pixel."""
    y, x = np.mgrid[:HEIGHT, :WIDTH].astype(np.float64)
    x += _bend(_along_x(numbers)) + 1
    y += _bend(_along_y(numbers)) + 1
    inside = (x >= 0) & (x < WIDTH) & (y >= 0) & (y < HEIGHT)
    lines = np.where(inside, np.trunc(y), HEIGHT)
    columns = np.where(inside, np.trunc(x * _PIXEL), 0)
    return lines.astype(np.int64), columns.astype(np.int64)


def _shifts(calibration: Calibration) -> NDArray[np.float64]:
    """The parallax of each raw number in parts of a pixel, within a picture's width."""
    plane = calibration.zero_plane
    # Single precision first, as in libfreenect: its last bit may decide on a pixel.
    tenths = np.float32(plane.reference_pixel_size) * np.float32(2) * np.float32(10)
    step = 1.0 / float(tenths)
    apart = plane.dcmos_rcmos_distance * step * 10
    reference = plane.reference_distance * step * 10
    away = np.maximum(depths(calibration), 1) * step
    shift = (apart * (away - reference) / away + 0.375) * _PIXEL
    widest = float(_PIXEL * (WIDTH + 1))
    return np.clip(np.trunc(shift), -widest, widest)


class _Differences(NamedTuple):
    """A cubic's first values: itself, its differences, and their growth."""

    start: int
    by_column: int
    by_row: int
    by_column_twice: int
    by_both: int
    by_row_twice: int
    along_columns: int
    along_rows: int
    turning: int
    twisting: int


def _along_x(it: Registration) -> _Differences:
    return _Differences(
        _signed_number(it.dx_start, 19, 9),
        _signed_number(it.dxdx_start, 21, 8),
        _signed_number(it.dydx_start, 21, 8),
        _signed_number(it.dxdxdx_start, 24, 8),
        _signed_number(it.dydxdx_start, 24, 8),
        _signed_number(it.dydydx_start, 24, 8),
        it.ax,
        it.bx,
        it.cx,
        it.dx,
    )


def _along_y(it: Registration) -> _Differences:
    return _Differences(
        _signed_number(it.dy_start, 19, 9),
        _signed_number(it.dxdy_start, 21, 8),
        _signed_number(it.dydy_start, 21, 8),
        _signed_number(it.dxdxdy_start, 24, 8),
        _signed_number(it.dydxdy_start, 24, 8),
        _signed_number(it.dydydy_start, 24, 8),
        it.ay,
        it.by,
        it.cy,
        it.dy,
    )


def _signed_number(number: int, bits: int, shift: int) -> int:
    """A signed number of so many bits, shifted to the left.

    >>> _signed_number(134217727, 24, 8)
    -256
    """
    low = number & ((1 << bits) - 1)
    return (low - ((low >> (bits - 1)) << bits)) << shift


def _bend(it: _Differences) -> NDArray[np.float64]:
    """The cubic (480, 640) in pixels; the first row is one step down already."""
    down = slice(1, HEIGHT + 1)
    twice = _line(it.by_row_twice, it.along_rows)
    start = _running_sum(it.start, _running_sum(it.by_row, twice >> 8) >> 6)[down]
    once = _running_sum(it.by_column, _line(it.by_both, it.twisting) >> 8)[down]
    twice = _line(it.by_column_twice, it.turning)[down]
    growth = np.arange(WIDTH, dtype=np.int64) * it.along_columns
    second = twice[:, None] + growth
    first = _running_sums(once, second >> 8)
    return _running_sums(start, first >> 6) / (1 << 17)


def _line(start: int, step: int) -> NDArray[np.int64]:
    """start, start + step, … of one more than there are rows."""
    return start + step * np.arange(HEIGHT + 1, dtype=np.int64)


def _running_sum(start: int, steps: NDArray[np.int64]) -> NDArray[np.int64]:
    """start, and the sums of it and all steps but the last, in their order."""
    return start + np.concatenate([[0], np.cumsum(steps[:-1])])


def _running_sums(
    starts: NDArray[np.int64], steps: NDArray[np.int64]
) -> NDArray[np.int64]:
    """The same for every row of steps, from a start of its own."""
    sums = np.cumsum(steps, axis=1)
    return starts[:, None] + np.pad(sums[:, :-1], ((0, 0), (1, 0)))
