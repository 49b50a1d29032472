"""Pictures in a terminal: half blocks, each with two pixels in colours of its own."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from rich.color import Color
from rich.console import Console
from rich.style import Style
from rich.text import Text

from kille.scene import Colour

Pixels = NDArray[np.float64]

_UPPER_HALF = "\N{UPPER HALF BLOCK}"


def shows_pictures(console: Console) -> bool:
    """Can colours and blocks be seen where this console writes?"""
    if not console.is_terminal or console.no_color or console.color_system is None:
        return False
    return console.encoding.lower().startswith("utf")


def half_blocks(picture: Colour, columns: int, rows: int) -> Text:
    """The picture (H, W, 3), as large as fits into so many columns and rows.

    >>> red = np.full((2, 1, 3), (255, 0, 0), np.uint8)
    >>> block = half_blocks(red, 10, 1)
    >>> block.plain, str(block.spans[0].style)
    ('▀', '#ff0000 on #ff0000')
    """
    small = _fitted(picture, columns, 2 * rows)
    text = Text(no_wrap=True)
    for upper, lower in zip(small[::2], small[1::2], strict=True):
        if text:
            text.append("\n")
        for above, below in zip(upper, lower, strict=True):
            text.append(_UPPER_HALF, Style(color=_shade(above), bgcolor=_shade(below)))
    return text


def _fitted(picture: Colour, width: int, height: int) -> Colour:
    """The picture scaled to fit; as many rows as make whole blocks."""
    high, wide = picture.shape[:2]
    scale = min(width / wide, height / high)
    columns = max(1, min(width, round(wide * scale)))
    rows = max(2, min(height, 2 * round(high * scale / 2)))
    across = _averaged(picture.astype(np.float64), columns, 1)
    return _averaged(across, rows, 0).round().astype(np.uint8)


def _averaged(pixels: Pixels, count: int, axis: int) -> Pixels:
    """The pixels along an axis gathered into so many groups, or repeated."""
    n = pixels.shape[axis]
    starts = np.arange(count) * n // count
    if n < count:
        repeated: Pixels = pixels.take(starts, axis)
        return repeated
    sizes = np.diff(starts, append=n).reshape((1, -1, 1) if axis else (-1, 1, 1))
    groups: Pixels = np.add.reduceat(pixels, starts, axis) / sizes
    return groups


def _shade(pixel: Colour) -> Color:
    red, green, blue = pixel.tolist()
    return Color.from_rgb(red, green, blue)
