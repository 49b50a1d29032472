"""Picture sheets: what the robot saw of a thing, as in figure 2 of the KILLE paper.

A row has four pictures: colour with the region outlined and numbered, depth (near is
warm, no reading is black), the region alone, and its SIFT features.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType

import cv2
import numpy as np

from kille.perception.lettering import PAPER, write_label, write_text
from kille.scene import Box, Colour, Depth, Features, Frame, Look, Mask, Percept

_WIDTH, _HEIGHT = 320, 240
_TITLE, _MARGIN = 26, 8
_DOT = (0, 200, 90)
_SMALLEST, _LINES = 14, 24
"""The height of a label in pixels at least, and how many would fill a picture."""

MARK = (255, 96, 0)
"""The colour of outlines, RGB."""


def picture_sheet(rows: Sequence[tuple[str, Look, int]]) -> Colour:
    """A sheet (H, W, 3) RGB with a row for each title, look, and number of a thing."""
    return np.vstack([_row(title, look, number) for title, look, number in rows])


def overview(
    look: Look,
    names: Sequence[str] = (),
    roles: Mapping[int, str] = MappingProxyType({}),
) -> Colour:
    """The frame (H, W, 3) RGB with every thing in view outlined and numbered.

    Beside the number stands the name of the thing, where one is given that is not
    empty, and its role by its number, such as "that".
    """
    picture = look.frame.colour.copy()
    for percept in look.percepts:
        outline(picture, percept.region.mask)
    labels: list[Box] = []
    size = max(_SMALLEST, picture.shape[1] // _LINES)
    for number, percept in enumerate(look.percepts, start=1):
        role = [f"({roles[number]})"] if number in roles else []
        text = " ".join([str(number), *filter(None, names[number - 1 : number]), *role])
        labels.append(write_label(picture, text, percept.region.box, size, labels))
    return picture


def write_picture(path: Path, picture: Colour) -> None:
    """Write the picture as PNG. OSError if that cannot be done."""
    try:
        encoded = encode_picture(picture, ".png")
    except ValueError as error:
        raise OSError(f"{path}: {error}") from error
    try:
        path.write_bytes(encoded)
    except ValueError as error:  # there is a NUL in it
        raise OSError("that is no path of a file") from error


def encode_picture(picture: Colour, ending: str, settings: Sequence[int] = ()) -> bytes:
    """The picture as a file of this kind, `.png` or `.jpg`. ValueError if it is none.

    `settings` are those of `cv2.imencode`. What can be seen through, (H, W, 4) RGBA, is
    kept so in a `.png`.
    """
    seen_through = picture.shape[-1] == 4
    bgr = cv2.cvtColor(
        picture, cv2.COLOR_RGBA2BGRA if seen_through else cv2.COLOR_RGB2BGR
    )
    done, encoded = cv2.imencode(ending, bgr, settings)
    if not done:
        raise ValueError("the picture could not be encoded")
    return encoded.tobytes()


def _row(title: str, look: Look, number: int) -> Colour:
    percept = look.percepts[number - 1]
    pictures = [
        _mark_region(look.frame, percept, number),
        _depth_picture(look.frame),
        _cut_out_region(look.frame, percept),
        _draw_features(look.frame, percept),
    ]
    strip = [piece for picture in pictures for piece in (_gap(), _fit_cell(picture))]
    pictures_row = np.hstack([*strip, _gap()])
    heading = np.full((_TITLE, pictures_row.shape[1], 3), PAPER, np.uint8)
    text = f"{title}   ({len(percept.scans[0].descriptors)} features)"
    write_text(heading, text, (_MARGIN, 4), 18)
    return np.vstack([heading, pictures_row])


def _gap() -> Colour:
    return np.full((_HEIGHT, _MARGIN, 3), PAPER, np.uint8)


def _fit_cell(picture: Colour) -> Colour:
    """Scale the picture to fit a cell, keeping its proportions."""
    height, width = picture.shape[:2]
    scale = min(_WIDTH / width, _HEIGHT / height)
    size = max(1, round(width * scale)), max(1, round(height * scale))
    shrinking = cv2.INTER_AREA if scale < 1 else cv2.INTER_LINEAR
    scaled = cv2.resize(picture, size, interpolation=shrinking)
    cell = np.full((_HEIGHT, _WIDTH, 3), PAPER, np.uint8)
    top, left = (_HEIGHT - size[1]) // 2, (_WIDTH - size[0]) // 2
    cell[top : top + size[1], left : left + size[0]] = scaled
    return cell


def _mark_region(frame: Frame, percept: Percept, number: int) -> Colour:
    picture, region = frame.colour.copy(), percept.region
    outline(picture, region.mask)
    size = max(_SMALLEST, picture.shape[1] // _LINES)
    write_label(picture, str(number), region.box, size)
    return picture


def outline(picture: Colour, mask: Mask, thick: int = 0) -> None:
    """Draw the outline of a mask (H, W) on a picture of its size.

    It is as many pixels thick as is said, or else as suits the picture.
    """
    edges, _ = cv2.findContours(
        mask.astype(np.uint8), cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE
    )
    thick = thick or max(1, picture.shape[1] // 320)
    drawn = np.ascontiguousarray(picture)  # OpenCV draws on no part of a picture
    picture[:] = cv2.drawContours(drawn, edges, -1, MARK, thick, cv2.LINE_AA)


def _depth_picture(frame: Frame) -> Colour:
    """Depth in colours, or a picture that says "no depth"."""
    if frame.depth is None or not np.isfinite(frame.depth).any():
        blank = np.full_like(frame.colour, 235)
        at = (blank.shape[1] // 2 - 40, blank.shape[0] // 2)
        write_text(blank, "no depth", at, 18)
        return blank
    return _colour_depth(frame.depth)


def _colour_depth(depth: Depth) -> Colour:
    known = np.isfinite(depth)
    near, far = np.percentile(depth[known], (2, 98))
    span = max(float(far - near), 1e-3)
    level = np.clip((far - np.where(known, depth, far)) / span, 0, 1)
    shades = cv2.applyColorMap(
        np.round(level * 255).astype(np.uint8), cv2.COLORMAP_TURBO
    )
    picture: Colour = cv2.cvtColor(shades, cv2.COLOR_BGR2RGB).astype(np.uint8)
    picture[~known] = 0
    return picture


def _cut_out_region(frame: Frame, percept: Percept) -> Colour:
    """The region on white, cropped to its box."""
    mask, box = percept.region.mask, percept.region.box
    picture: Colour = np.where(mask[..., None], frame.colour, np.uint8(255))
    return picture[box.top : box.bottom, box.left : box.right]


def _draw_features(frame: Frame, percept: Percept) -> Colour:
    """The region's box in grey, with a circle at each feature of the first scan."""
    box, features = percept.region.box, percept.scans[0]
    cut = frame.colour[box.top : box.bottom, box.left : box.right]
    grey = cv2.cvtColor(cut, cv2.COLOR_RGB2GRAY)
    scale = max(1, round(_WIDTH / max(cut.shape[1], 1)))
    large = cv2.resize(grey, None, fx=scale, fy=scale, interpolation=cv2.INTER_CUBIC)
    picture = cv2.cvtColor(large, cv2.COLOR_GRAY2RGB)
    for u, v in _spots(features, box):
        at = round((u + 0.5) * scale), round((v + 0.5) * scale)
        cv2.circle(picture, at, 3, _DOT, 1, cv2.LINE_AA)
    return picture.astype(np.uint8)


def _spots(features: Features, box: Box) -> list[tuple[float, float]]:
    """The pixels of the features, relative to the corner of the box."""
    return [(float(u - box.left), float(v - box.top)) for u, v in features.pixels]
