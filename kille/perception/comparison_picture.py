"""A picture of a reason: what is seen now, beside the lesson that it is most like.

Lines join the details that both have, and bars show how much each cue counted. It has
no ground of its own, and so can stand on a light page and on a dark one.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import cv2
import numpy as np

from kille.perception.descriptor_index import rooted
from kille.perception.lettering import (
    INK_ON_ANY_PAGE,
    text_width,
    wrap_text,
    write_text,
)
from kille.perception.picture_sheet import MARK, outline
from kille.scene import Box, Colour, Features, Frame, Mask, Region

_PANEL = (360, 300)  # width and height of each side
_MARGIN, _LINE, _BAR = 16, 24, 18  # pixels
_JOIN = (0, 170, 255)
_RATIO = 0.8  # of the distances to the nearest detail and the next: Lowe 2004
_MOST = 40  # lines; with more, nothing can be told apart


class Side(NamedTuple):
    """One side: a picture, and what is marked in it.

    That is one thing (H, W) with its details, or boxes around several.
    """

    picture: Colour
    mask: Mask | None = None
    features: Features | None = None
    boxes: tuple[Box, ...] = ()


def side_of(frame: Frame, region: Region, features: Features) -> Side:
    """The thing in a frame, cut out with a margin."""
    box = _widen(region.box, frame.colour.shape)
    cut = np.s_[box.top : box.bottom, box.left : box.right]
    corner = np.array([box.left, box.top], np.float32)
    moved = replace(features, pixels=features.pixels - corner)
    return Side(frame.colour[cut], region.mask[cut], moved)


def comparison_picture(
    sentence: str, shares: Mapping[str, float], *sides: Side
) -> Colour:
    """The picture (H, W, 4) RGBA of a reason, as it is said, with the cues' shares.

    There are one or two sides: what is seen now, and what the lesson showed.
    """
    on_black, on_white = (_draw(it, sentence, shares, sides) for it in (0, 255))
    return _colour_through_alpha(on_black, on_white)


def _colour_through_alpha(on_black: Colour, on_white: Colour) -> Colour:
    """The picture (H, W, 4) that is these two where it lies on black and on white.

    On a ground b a pixel is c α + b (1 - α): so the two differ by 1 - α.
    """
    black, white = on_black.astype(np.float32), on_white.astype(np.float32)
    alpha = 255 - (white - black).mean(axis=2, keepdims=True)
    colour = 255 * black / np.maximum(alpha, 1)
    both = np.concatenate([colour, alpha], axis=2)
    drawn: Colour = np.clip(np.rint(both), 0, 255).astype(np.uint8)
    return drawn


def _draw(
    ground: int, sentence: str, shares: Mapping[str, float], sides: Sequence[Side]
) -> Colour:
    """The same (H, W, 3) RGB on a ground of this grey, from 0 to 255."""
    width = 2 * _PANEL[0] + 3 * _MARGIN
    lines = wrap_text(sentence, width - 2 * _MARGIN, _LINE)
    top = 2 * _MARGIN + len(lines) * _LINE
    bars = top + _PANEL[1] + _MARGIN
    height = bars + len(shares) * (_BAR + 8) + _MARGIN
    sheet: Colour = np.full((height, width, 3), ground, np.uint8)
    for number, line in enumerate(lines):
        at = _MARGIN, _MARGIN + number * _LINE
        write_text(sheet, line, at, _LINE - 4, ink=INK_ON_ANY_PAGE)
    places = [
        _place(sheet, it, (_MARGIN + n * (_PANEL[0] + _MARGIN), top))
        for n, it in enumerate(sides)
    ]
    if len(sides) == 2:
        _join(sheet, sides, places)
    _draw_bars(sheet, shares, bars)
    return sheet


def matched_details(one: Features, other: Features) -> list[tuple[int, int]]:
    """The pairs of details that are each other's nearest, by far; the nearest first."""
    if min(len(one.descriptors), len(other.descriptors)) < 2:
        return []
    alike = rooted(one.descriptors) @ rooted(other.descriptors).T
    apart = np.sqrt(np.maximum(2 - 2 * alike, 0))
    best = apart.argmin(axis=1)
    back = apart.argmin(axis=0)
    pairs = []
    for n, m in enumerate(best.tolist()):
        nearest, second = np.partition(apart[n], 1)[:2]
        if back[m] == n and nearest < _RATIO * second:
            pairs.append((float(nearest), n, m))
    return [(n, m) for _, n, m in sorted(pairs)[:_MOST]]


class _Placement(NamedTuple):
    """Where a picture stands on the sheet: its corner, and by what it is scaled."""

    left: int
    top: int
    scale: float

    def point(self, pixel: Iterable[float]) -> tuple[int, int]:
        x, y = pixel
        return (
            self.left + round((x + 0.5) * self.scale),
            self.top + round((y + 0.5) * self.scale),
        )


def _place(sheet: Colour, side: Side, at: tuple[int, int]) -> _Placement:
    """Put a picture into the middle of a panel, as large as it fits there."""
    picture = side.picture
    height, width = picture.shape[:2]
    scale = min(_PANEL[0] / width, _PANEL[1] / height)
    size = max(1, round(width * scale)), max(1, round(height * scale))
    way = cv2.INTER_AREA if scale < 1 else cv2.INTER_CUBIC
    left = at[0] + (_PANEL[0] - size[0]) // 2
    top = at[1] + (_PANEL[1] - size[1]) // 2
    shown = sheet[top : top + size[1], left : left + size[0]]
    shown[:] = cv2.resize(picture, size, interpolation=way)
    if side.mask is not None:
        mask = cv2.resize(side.mask.astype(np.uint8), size)
        outline(shown, mask > 0, 2)
    place = _Placement(left, top, scale)
    for box in side.boxes:
        corners = place.point((box.left, box.top)), place.point((box.right, box.bottom))
        cv2.rectangle(sheet, *corners, MARK, 2, cv2.LINE_AA)
    return place


def _join(sheet: Colour, sides: Iterable[Side], places: Iterable[_Placement]) -> None:
    """Draw a line between each two details that match."""
    (one, other), (here, there) = sides, places
    if one.features is None or other.features is None:
        return
    lines = sheet.copy()
    pairs = [
        (here.point(one.features.pixels[n]), there.point(other.features.pixels[m]))
        for n, m in matched_details(one.features, other.features)
    ]
    for start, end in pairs:
        cv2.line(lines, start, end, _JOIN, 1, cv2.LINE_AA)
    sheet[:] = cv2.addWeighted(lines, 0.6, sheet, 0.4, 0)
    for point in (it for pair in pairs for it in pair):
        cv2.circle(sheet, point, 3, _JOIN, -1, cv2.LINE_AA)


def _draw_bars(sheet: Colour, shares: Mapping[str, float], top: int) -> None:
    """A bar for each cue, with its name before it and its share after it."""
    names = max((text_width(name, _BAR) for name in shares), default=0)
    start = _MARGIN + names + _MARGIN // 2
    most = sheet.shape[1] - start - _MARGIN - text_width("100 %", _BAR) - 8
    for number, (name, share) in enumerate(shares.items()):
        at = top + number * (_BAR + 8)
        end = start + max(2, round(share * most))
        cv2.rectangle(sheet, (start, at + 2), (end, at + _BAR - 2), MARK, -1)
        said = f"{share:.0%}".replace("%", " %")
        for text, left in ((name, _MARGIN), (said, end + 8)):
            write_text(sheet, text, (left, at), _BAR, ink=INK_ON_ANY_PAGE)


def _widen(box: Box, shape: tuple[int, ...]) -> Box:
    """The box with a margin of a tenth, within a picture of this shape."""
    margin = 4 + (box.right - box.left + box.bottom - box.top) // 20
    return Box(
        max(box.left - margin, 0),
        max(box.top - margin, 0),
        min(box.right + margin, shape[1]),
        min(box.bottom + margin, shape[0]),
    )
