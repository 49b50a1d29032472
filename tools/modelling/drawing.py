"""Drawing with NumPy and OpenCV: the pictures printed on things.

Colours are (red, green, blue) from 0 to 255, places are (x, y) in pixels. Every drawing
function changes the picture it is given and returns nothing, as OpenCV's do.
"""

from __future__ import annotations

from collections.abc import Iterable

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray

from kille.scene import Colour

RGB = tuple[int, int, int]
WHITE: RGB = (246, 245, 240)
BLACK: RGB = (24, 23, 24)

_SUBPIXEL_BITS = 4


def blank(width: int, height: int, colour: RGB) -> Colour:
    """A picture (height, width, 3) of one colour."""
    return np.full((height, width, 3), colour, np.uint8)


def polygon(picture: Colour, corners: ArrayLike, colour: RGB) -> None:
    """A filled polygon with smooth edges."""
    cv2.fillPoly(
        picture, [_to_fixed_point(corners)], colour, cv2.LINE_AA, _SUBPIXEL_BITS
    )


def line(picture: Colour, places: ArrayLike, colour: RGB, width: int = 1) -> None:
    """An open line through the places."""
    cv2.polylines(
        picture,
        [_to_fixed_point(places)],
        False,
        colour,
        width,
        cv2.LINE_AA,
        _SUBPIXEL_BITS,
    )


def rectangle(
    picture: Colour, corner: tuple[int, int], opposite: tuple[int, int], colour: RGB
) -> None:
    """A filled rectangle."""
    cv2.rectangle(picture, corner, opposite, colour, cv2.FILLED)


def frame(
    picture: Colour,
    corner: tuple[int, int],
    opposite: tuple[int, int],
    colour: RGB,
    width: int = 2,
) -> None:
    """The outline of a rectangle."""
    cv2.rectangle(picture, corner, opposite, colour, width)


def oval(
    picture: Colour,
    middle: tuple[float, float],
    radii: tuple[float, float],
    colour: RGB,
    degrees: float = 0.0,
) -> None:
    """A filled ellipse, turned clockwise by degrees."""
    angle = np.linspace(0, 2 * np.pi, 40)
    flat = np.stack([radii[0] * np.cos(angle), radii[1] * np.sin(angle)], axis=1)
    sine, cosine = np.sin(np.radians(degrees)), np.cos(np.radians(degrees))
    turned = flat @ np.array([[cosine, sine], [-sine, cosine]])
    polygon(picture, turned + np.asarray(middle), colour)


def star(
    picture: Colour,
    middle: tuple[float, float],
    radius: float,
    colour: RGB,
    points: int = 5,
) -> None:
    """A filled star that stands on two points."""
    angle = np.arange(2 * points) * np.pi / points
    reach = np.where(np.arange(2 * points) % 2 == 0, radius, 0.45 * radius)
    corners = np.stack([reach * np.sin(angle), -reach * np.cos(angle)], axis=1)
    polygon(picture, corners + np.asarray(middle), colour)


def lettering(
    picture: Colour,
    words: str,
    middle: tuple[float, float],
    height: int,
    colour: RGB,
    weight: int = 700,
) -> None:
    """A line of letters around a middle; height is the font's, weight 100 to 1000."""
    font = cv2.FontFace("sans")
    canvas = (picture.shape[1], picture.shape[0])
    x, y, wide, tall = cv2.getTextSize(canvas, words, (0, 0), font, height, weight)
    start = (round(middle[0] - x - wide / 2), round(middle[1] - y - tall / 2))
    cv2.putText(picture, words, start, colour, font, height, weight)


def small_print(
    picture: Colour,
    corner: tuple[int, int],
    opposite: tuple[int, int],
    colour: RGB,
    rng: np.random.Generator,
    pitch: int = 8,
) -> None:
    """Lines of dashes that look like text too small to read."""
    for y in range(corner[1], opposite[1], pitch):
        x = corner[0]
        while x < opposite[0]:
            word = int(rng.integers(pitch, 4 * pitch))
            end = min(x + word, opposite[0])
            cv2.line(picture, (x, y), (end, y), colour, max(pitch // 3, 1))
            x = end + max(pitch // 2, 2)


def bar_code(
    picture: Colour,
    corner: tuple[int, int],
    opposite: tuple[int, int],
    rng: np.random.Generator,
) -> None:
    """Black bars on a white field."""
    rectangle(picture, corner, opposite, WHITE)
    x = corner[0] + 4
    while x < opposite[0] - 8:
        wide = int(rng.integers(2, 6))
        rectangle(picture, (x, corner[1] + 4), (x + wide, opposite[1] - 4), BLACK)
        x += wide + int(rng.integers(2, 6))


def speckles(
    picture: Colour,
    count: int,
    sizes: tuple[float, float],
    colours: Iterable[RGB],
    rng: np.random.Generator,
) -> None:
    """Small ovals strewn over the picture, their radii between the two sizes."""
    height, width = picture.shape[:2]
    paints = list(colours)
    for _ in range(count):
        middle = (rng.uniform(0, width), rng.uniform(0, height))
        radii = (rng.uniform(*sizes), rng.uniform(*sizes))
        colour = paints[rng.integers(len(paints))]
        oval(picture, middle, radii, colour, rng.uniform(0, 180))


def mottle(
    picture: Colour, strength: float, scale: tuple[int, int], rng: np.random.Generator
) -> None:
    """Make soft patches `scale` = (wide, high) big lighter and darker."""
    height, width = picture.shape[:2]
    cells = (max(height // scale[1], 2), max(width // scale[0], 2))
    coarse = rng.normal(0, strength, cells).astype(np.float32)
    patches = cv2.resize(coarse, (width, height), interpolation=cv2.INTER_CUBIC)
    lit = picture.astype(np.float32) + patches[..., None]
    picture[:] = np.clip(lit, 0, 255).astype(np.uint8)


def blend_down(picture: Colour, top: RGB, bottom: RGB) -> None:
    """Fill the picture with a colour that changes from top to bottom."""
    share = np.linspace(0, 1, picture.shape[0])[:, None, None]
    picture[:] = ((1 - share) * np.array(top) + share * np.array(bottom)).astype(
        np.uint8
    )


def _to_fixed_point(places: ArrayLike) -> NDArray[np.int32]:
    """Places in the fixed-point form that OpenCV draws smoothly."""
    scaled = np.asarray(places, np.float64) * 2**_SUBPIXEL_BITS
    fixed: NDArray[np.int32] = np.round(scaled).astype(np.int32).reshape(-1, 1, 2)
    return fixed
