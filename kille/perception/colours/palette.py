"""The palette of a thing: its colours, robust to shading and highlights.

The colours of a region form clouds in Lab: one for each paint, drawn out along the
lightness where it is shaded. Every colour climbs to where they are densest (mean shift,
Comaniciu and Meer 2002), and what climbs to the same place is one colour of the thing.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from kille.perception.colours.histogram import cells_of
from kille.perception.colours.space import Lab, lab_of
from kille.perception.colours.white_balance import balance_light
from kille.scene import Frame, Region, Vector

Numbers = NDArray[np.float64]

_CELL = 5.0  # Lab units: finer differences are noise of the camera
_SHADING = 0.5  # of a step in lightness: shades are of one paint more often than hues
_REACH = 8.0  # Lab units: what is nearer is one cloud; about half a usual colour word
_CLIMBS = 8
_PIXELS = 20_000  # tell as much as more of them
_CELLS = 150  # the commonest colours: to climb takes time by their square
_LEAST = 0.08  # of the thing: less is a highlight, an edge or a speck
_PACKED = 4  # colours: hardly a thing has more, each of _LEAST or more
_LIT = 0.5  # the better lit half of a cloud says what colour it is


@dataclass(frozen=True, eq=False)
class Palette:
    """The colours of a thing, commonest first: shares (k,) that sum to 1, lab (k, 3).

    >>> flag = Palette([0.6, 0.4], [[95, 0, 0], [48, 66, 48]])
    >>> flag.shares.tolist()
    [0.6, 0.4]
    """

    shares: Numbers
    lab: Lab

    def __init__(self, shares: ArrayLike, lab: ArrayLike) -> None:
        parts, colours = np.asarray(shares, float), np.asarray(lab, float)
        if parts.ndim != 1 or colours.shape != (len(parts), 3) or not len(parts):
            raise ValueError(
                f"a palette takes shares (k,) and colours (k, 3), k > 0, but was given "
                f"{parts.shape} and {colours.shape}"
            )
        if not (np.isfinite(colours).all() and (parts >= 0).all() and parts.sum() > 0):
            raise ValueError(
                "a palette takes finite colours and shares that are not < 0"
            )
        order = np.argsort(-parts, kind="stable")
        object.__setattr__(self, "shares", parts[order] / parts.sum())
        object.__setattr__(self, "lab", colours[order])


def pack_palette(palette: Palette) -> Vector:
    """Pack the palette into 16 numbers: four times a share and its L, a, b.

    Of a palette of more than four colours the commonest are kept.

    >>> pack_palette(plain([48, 66, 48])).tolist()[:4]
    [1.0, 48.0, 66.0, 48.0]
    """
    rows = np.zeros((_PACKED, 4), np.float32)
    whole = np.column_stack([palette.shares, palette.lab])[:_PACKED]
    rows[: len(whole)] = whole
    return rows.ravel()


def unpack_palette(vector: Vector) -> Palette:
    """Unpack a packed palette; ValueError if the vector is none.

    >>> unpack_palette(pack_palette(plain([48, 66, 48]))).lab.tolist()
    [[48.0, 66.0, 48.0]]
    """
    if vector.shape != (4 * _PACKED,):
        raise ValueError(
            f"a packed palette has {4 * _PACKED} numbers, but this vector has the "
            f"shape {vector.shape}"
        )
    rows = vector.reshape(_PACKED, 4).astype(float)
    used = rows[rows[:, 0] != 0]
    return Palette(used[:, 0], used[:, 1:])


def plain(lab: ArrayLike) -> Palette:
    """The palette of a thing with only one colour.

    >>> plain([48, 66, 48]).shares.tolist()
    [1.0]
    """
    return Palette([1.0], np.asarray(lab, float)[None])


def colours_of(frame: Frame, region: Region) -> Palette | None:
    """The palette of a region, white-balanced; None for a region without pixels.

    >>> from kille.sensors.synthetic import open_synthetic
    >>> frame = open_synthetic("synthetic:desk?seed=7").frame()
    >>> from kille.perception.segment import segment
    >>> region = segment(frame).regions[0]
    >>> round(float(colours_of(frame, region).shares.sum()), 6)
    1.0
    """
    box = region.box
    crop = np.s_[box.top : box.bottom, box.left : box.right]
    inside = region.mask[crop]
    if not inside.any():
        return None
    pixels = frame.colour[crop][inside]
    some = pixels[:: 1 + len(pixels) // _PIXELS]
    return palette_from_colours(lab_of(balance_light(some, frame.colour)))


def colours_in(vector: Vector) -> Palette:
    """The palette recovered from a thing's cue `colour`, without its picture.

    ValueError for a vector that is no such cue.

    >>> from kille.perception.cues import measure_cues
    >>> from kille.perception.segment import segment
    >>> from kille.sensors.synthetic import open_synthetic
    >>> frame = open_synthetic("synthetic:desk?seed=7").frame()
    >>> traits = measure_cues(frame, segment(frame).regions[0])
    >>> round(float(colours_in(traits["colour"]).shares.sum()), 6)
    1.0
    """
    return palette_from_colours(*cells_of(vector))


def palette_from_colours(lab: Lab, weights: Numbers | None = None) -> Palette:
    """The palette of colours (n, 3), n > 0, with weights (n,), by default 1."""
    cells, shares = _commonest(lab, np.ones(len(lab)) if weights is None else weights)
    flat = cells * (_SHADING, 1, 1)
    tops = _climb(flat, shares)
    clouds = _clouds(tops, shares)
    sizes = np.bincount(clouds, shares)
    kept = [cloud for cloud in np.argsort(-sizes) if sizes[cloud] >= _LEAST]
    kept = kept or [int(sizes.argmax())]
    colours = [
        _mean_of_lit_half(cells[clouds == cloud], shares[clouds == cloud])
        for cloud in kept
    ]
    return Palette(sizes[kept], colours)


def _commonest(lab: Lab, weights: Numbers) -> tuple[Lab, Numbers]:
    """The mean colours (m, 3) of the fullest cells, and their shares (m,)."""
    at = np.floor(lab / _CELL).astype(np.int64)
    code = (at[:, 0] * 1024 + at[:, 1]) * 1024 + at[:, 2]
    _, cell = np.unique(code, return_inverse=True)
    full = np.bincount(cell, weights)
    sums = np.stack([np.bincount(cell, weights * lab[:, i]) for i in range(3)], axis=1)
    most = np.argsort(-full, kind="stable")[:_CELLS]
    most = most[full[most] > 0]
    return sums[most] / full[most, None], full[most] / full[most].sum()


def _climb(colours: Lab, shares: Numbers) -> Lab:
    """Move each colour to where colours are densest (mean shift)."""
    tops, squares = colours, (colours**2).sum(axis=1)
    for _ in range(_CLIMBS):
        apart = squares + (tops**2).sum(axis=1)[:, None] - 2 * tops @ colours.T
        near = shares * np.exp(-apart / (2 * _REACH**2))
        tops = near @ colours / near.sum(axis=1, keepdims=True)
    return tops


def _clouds(tops: Lab, shares: Numbers) -> NDArray[np.intp]:
    """The number of each colour's cloud: that of the first top near its own."""
    clouds = np.full(len(tops), -1)
    for number in range(len(tops)):
        free = np.flatnonzero(clouds < 0)
        if not len(free):
            break
        top = tops[free[np.argmax(shares[free])]]
        near = np.linalg.norm(tops[free] - top, axis=1) < _REACH
        clouds[free[near]] = number
    return clouds


def _mean_of_lit_half(colours: Lab, shares: Numbers) -> Lab:
    """The mean colour of the better lit half."""
    order = np.argsort(-colours[:, 0], kind="stable")
    before = np.cumsum(shares[order]) - shares[order]
    half = order[before < _LIT * shares.sum()]
    return np.asarray(np.average(colours[half], axis=0, weights=shares[half]))
