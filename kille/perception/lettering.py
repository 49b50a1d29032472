"""Letters in pictures: any script that the font has, on a ground of their own."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import cv2
import numpy as np

from kille.scene import Box, Colour

INK, PAPER = (32, 32, 36), (255, 255, 255)
"""The colours of letters and of what they stand on, RGB; the other way round, too."""

INK_ON_ANY_PAGE = (122, 122, 122)
"""Of letters on no ground of their own, RGB: 4 : 1 of contrast on white and on dark."""

_BOLD, _REGULAR = 700, 400


@cache
def _font() -> cv2.FontFace:
    return cv2.FontFace("sans")


def write_text(
    picture: Colour,
    text: str,
    at: tuple[int, int],
    size: int,
    *,
    bold: bool = False,
    ink: tuple[int, int, int] = INK,
) -> None:
    """Write a line of text on a picture, its left upper corner at (x, y) pixels.

    `size` is the height of a line in pixels. What is drawn beyond the edge is lost.
    """
    weight = _BOLD if bold else _REGULAR
    base = at[0], at[1] + round(0.76 * size)
    cv2.putText(picture, text, base, ink, _font(), round(0.8 * size), weight)


def text_width(text: str, size: int, *, bold: bool = False) -> int:
    """How many pixels wide a line of text is."""
    weight = _BOLD if bold else _REGULAR
    box = cv2.getTextSize((0, 0), text, (0, 0), _font(), round(0.8 * size), weight)
    return int(box[0] + box[2])


def wrap_text(text: str, width: int, size: int) -> list[str]:
    """The lines of a text that is at most `width` pixels wide.

    >>> wrap_text("a cup and a book", 1, 20)
    ['a', 'cup', 'and', 'a', 'book']
    """
    lines: list[str] = []
    for word in text.split():
        longer = f"{lines[-1]} {word}" if lines else word
        if lines and text_width(longer, size) <= width:
            lines[-1] = longer
        else:
            lines.append(word)
    return lines


def write_label(
    picture: Colour, text: str, thing: Box, size: int, taken: Sequence[Box] = ()
) -> Box:
    """Write a label on a dark ground beside a thing; returns where it stands.

    It stands above the thing, else below or within, where it is in the picture and
    covers no label that stands there already, if there is such a place.
    """
    height, width = picture.shape[:2]
    wide, high = text_width(text, size, bold=True) + size // 2, size + size // 4
    left = min(max(thing.left, 0), max(width - wide, 0))
    tops = (thing.top - high - 2, thing.bottom + 2, thing.top + 2)
    places = [Box(left, top, left + wide, top + high) for top in tops]
    inside = [it for it in places if it.top >= 0 and it.bottom <= height] or places[2:]
    free = (it for it in inside if not any(_overlap(it, other) for other in taken))
    place = next(free, inside[0])
    ground = picture[max(place.top, 0) : place.bottom, place.left : place.right]
    ground[:] = np.array(INK, np.uint8)
    at = place.left + size // 4, place.top + size // 8
    write_text(picture, text, at, size, bold=True, ink=PAPER)
    return place


def _overlap(one: Box, other: Box) -> bool:
    return (
        one.left < other.right
        and other.left < one.right
        and one.top < other.bottom
        and other.top < one.bottom
    )
