"""Pictures in a terminal, in half blocks, each of which shows two pixels."""

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
    """Does this console show colours and blocks?"""
    if not console.is_terminal or console.no_color or console.color_system is None:
        return False
    return console.encoding.lower().startswith("utf")


def half_blocks(picture: Colour, columns: int, rows: int) -> Text:
    """The picture (H, W, 3), as large as fits into these columns and rows.

    >>> red = np.full((2, 1, 3), (255, 0, 0), np.uint8)
    >>> block = half_blocks(red, 10, 1)
    >>> block.plain, str(block.spans[0].style)
    ('▀', '#ff0000 on #ff0000')
    """
    small = _fit_picture(picture, columns, 2 * rows)
    text = Text(no_wrap=True)
    for upper, lower in zip(small[::2], small[1::2], strict=True):
        if text:
            text.append("\n")
        for above, below in zip(upper, lower, strict=True):
            text.append(_UPPER_HALF, Style(color=_shade(above), bgcolor=_shade(below)))
    return text


def _fit_picture(picture: Colour, width: int, height: int) -> Colour:
    """Scale the picture to fit, with an even number of rows."""
    high, wide = picture.shape[:2]
    scale = min(width / wide, height / high)
    columns = max(1, min(width, round(wide * scale)))
    rows = max(2, min(height, 2 * round(high * scale / 2)))
    across = _average_groups(picture.astype(np.float64), columns, 1)
    return _average_groups(across, rows, 0).round().astype(np.uint8)


def _average_groups(pixels: Pixels, count: int, axis: int) -> Pixels:
    """Average the pixels along an axis in `count` groups, or repeat them."""
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
