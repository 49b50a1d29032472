"""Draws the borders of colour words anew: `python docs/pictures/colours.py`."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
from grounds import remove_ground

from kille.perception.colours import BASIC, lab_of, rgb_of, xkcd
from kille.perception.picture_sheet import write_picture
from kille.scene import Colour

HERE = Path(__file__).parent
WIDTH, HEIGHT, MARGIN, EDGE = 640, 360, 44, 8
STEP = 4  # pixels of one colour: so the file is small
LEVELS = (0.5, 0.8)
WITHOUT_HUE = ("black", "white", "grey")
INK, PAPER = (40, 40, 40), (255, 255, 255)


def borders() -> Colour:
    """The hue-lightness plane, as vivid as a screen can be, with the words' borders.

    The thick line is where a word holds to .5, the thin one to .8. Words without a hue
    have no place in this plane.
    """
    hues, lights = np.meshgrid(np.linspace(0, 360, WIDTH), np.linspace(97, 4, HEIGHT))
    lab = most_vivid(hues, lights)
    picture = rgb_of(lab[::STEP, ::STEP]).repeat(STEP, axis=0).repeat(STEP, axis=1)
    words = xkcd().among(word for word in BASIC if word not in WITHOUT_HUE)
    degrees = words.degrees(lab.reshape(-1, 3)).reshape(HEIGHT, WIDTH, -1)
    for number in range(len(words.names)):
        outlined(picture, degrees[..., number])
    for number, word in enumerate(words.names):
        written(picture, word, best_place(degrees[..., number]))
    return framed(picture)


def most_vivid(hues: np.ndarray, lights: np.ndarray) -> np.ndarray:
    """The Lab colours of these hues and lightnesses farthest from grey on a screen."""
    turns = np.radians(hues)
    low, high = np.zeros(hues.shape), np.full(hues.shape, 140.0)
    for _ in range(9):
        middle = (low + high) / 2
        lab = np.stack(
            [lights, middle * np.cos(turns), middle * np.sin(turns)], axis=-1
        )
        shown = np.abs(lab_of(rgb_of(lab)) - lab).max(axis=-1) < 1.5
        low, high = np.where(shown, middle, low), np.where(shown, high, middle)
    return np.stack([lights, low * np.cos(turns), low * np.sin(turns)], axis=-1)


def outlined(picture: Colour, degrees: np.ndarray) -> None:
    """Draw where a word holds to each of the levels."""
    for level, thick in zip(LEVELS, (2, 1), strict=True):
        inside = cv2.GaussianBlur(degrees, (0, 0), 2) > level
        lines, _ = cv2.findContours(
            inside.astype(np.uint8), cv2.RETR_LIST, cv2.CHAIN_APPROX_NONE
        )
        long = [line for line in lines if len(line) > 30]
        cv2.polylines(picture, long, False, PAPER, thick + 2, cv2.LINE_AA)
        cv2.polylines(picture, long, False, INK, thick, cv2.LINE_AA)


def best_place(degrees: np.ndarray) -> np.ndarray:
    """The middle of the largest piece where a word holds."""
    _, _, boxes, middles = cv2.connectedComponentsWithStats(
        (degrees > LEVELS[0]).astype(np.uint8)
    )
    return middles[1 + int(boxes[1:, cv2.CC_STAT_AREA].argmax())]


def written(picture: Colour, word: str, middle: np.ndarray) -> None:
    """The word, dark with a light edge, around this place."""
    (across, down), _ = cv2.getTextSize(word, cv2.FONT_HERSHEY_SIMPLEX, 0.55, 1)
    left = int(np.clip(middle[0] - across / 2, 4, WIDTH - across - 4))
    at = left, int(middle[1] + down / 2)
    letters = np.zeros(picture.shape[:2], np.uint8)
    cv2.putText(letters, word, at, cv2.FONT_HERSHEY_SIMPLEX, 0.55, 255, 1, cv2.LINE_AA)
    edge = cv2.dilate(letters, np.ones((5, 5), np.uint8))
    for mask, ink in ((edge, PAPER), (letters, INK)):
        share = mask[..., None] / 255
        picture[:] = (1 - share) * picture + share * ink


def framed(picture: Colour) -> Colour:
    """The picture with its axes: hue in degrees, lightness."""
    size = HEIGHT + MARGIN + EDGE, WIDTH + MARGIN + 2 * EDGE, 3
    page = np.full(size, 255, np.uint8)
    for hue in range(0, 361, 60):
        x = MARGIN + hue * (WIDTH - 1) // 360
        label(page, str(hue), (x - 4 * len(str(hue)), EDGE + HEIGHT + 16))
    label(page, "hue in Lab, degrees", (MARGIN + WIDTH // 2 - 70, EDGE + HEIGHT + 36))
    for light in (10, 50, 90):
        y = EDGE + round((97 - light) / 93 * HEIGHT)
        label(page, str(light), (MARGIN - 24, y + 5))
    label(page, "L", (6, EDGE + HEIGHT // 2 + 5))
    bare = remove_ground(page)
    inside = bare[EDGE : EDGE + HEIGHT, MARGIN : MARGIN + WIDTH]
    inside[..., :3], inside[..., 3] = picture, 255
    return bare


def label(page: Colour, text: str, at: tuple[int, int]) -> None:
    """Small dark text that begins there."""
    cv2.putText(page, text, at, cv2.FONT_HERSHEY_SIMPLEX, 0.42, INK, 1, cv2.LINE_AA)


if __name__ == "__main__":
    write_picture(HERE / "colours.png", borders())
