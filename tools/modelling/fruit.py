"""An apple and a banana. Fruit is poor in texture, as every teacher of SIFT knows."""

from __future__ import annotations

import cv2
import numpy as np

from kille.scene import Colour
from kille.sensors.synthetic.toy_model import ToyModel
from tools.modelling import drawing as draw
from tools.modelling.shapes import curve, ellipsoid, lathe, move, tube, turn
from tools.modelling.sheets import Sheet, assemble

_WOOD: draw.RGB = (92, 62, 36)


def apple() -> ToyModel:
    """A red apple of 8 cm with yellow streaks, a stalk, a leaf and a fruit label."""
    outline = [
        (0.000, 0.058),
        (0.008, 0.060),
        (0.019, 0.069),
        (0.033, 0.066),
        (0.041, 0.048),
        (0.038, 0.026),
        (0.027, 0.007),
        (0.013, 0.000),
        (0.000, 0.004),
    ]
    stalk = curve([(0, 0, 0.058), (0.002, 0, 0.070), (0.007, 0, 0.083)], 6)
    leaf = turn(ellipsoid((0.017, 0.009, 0.0015), 12), (0, 1, 0), -20)
    return assemble(
        [
            Sheet(lathe(curve(outline, 20), 30), _apple_skin()),
            Sheet(tube(stalk, 0.0018, 6), draw.blank(8, 8, _WOOD)),
            Sheet(move(leaf, 0.020, 0, 0.079), _leaf()),
        ]
    )


def banana() -> ToyModel:
    """A ripe banana of 19 cm, lying, with brown flecks, ridges and dark ends."""
    spine = curve(
        [
            (-0.098, -0.026, 0.020),
            (-0.082, -0.014, 0.020),
            (-0.048, 0.012, 0.019),
            (0.000, 0.026, 0.019),
            (0.048, 0.012, 0.019),
            (0.082, -0.020, 0.020),
            (0.092, -0.034, 0.021),
        ],
        30,
    )
    girth = curve(
        [(0.0055,), (0.0065,), (0.016,), (0.0195,), (0.018,), (0.010,), (0.003,)], 30
    )[:, 0]
    sheet = tube(spine, girth, 20)
    angle = np.linspace(-np.pi, np.pi, 21)[:, None, None]
    ridged = spine + (sheet - spine) * (1 + 0.07 * np.cos(5 * angle))
    return assemble([Sheet(ridged, _banana_skin())])


def _apple_skin() -> Colour:
    rng = np.random.default_rng(11)
    skin = draw.blank(520, 260, (186, 26, 34))
    draw.mottle(skin, 14, (60, 60), rng)
    for _ in range(120):
        x, length = rng.uniform(0, 520), rng.uniform(40, 170)
        lean = x + rng.normal(0, 8)
        colour = (int(rng.integers(196, 226)), int(rng.integers(60, 140)), 58)
        draw.line(skin, [(x, 30), (lean, 30 + length)], colour, int(rng.integers(1, 4)))
    skin[:] = skin // 2 + _soften(skin) // 2
    draw.oval(skin, (260, 0), (400, 38), (172, 160, 62))
    draw.speckles(skin, 330, (1.2, 3.0), [(240, 208, 150), (250, 226, 180)], rng)
    draw.speckles(skin, 14, (3, 6), [(110, 30, 24), (128, 60, 30)], rng)
    draw.oval(skin, (305, 118), (34, 24), draw.WHITE, -8)
    draw.oval(skin, (305, 118), (31, 21), (30, 120, 60), -8)
    draw.lettering(skin, "GALA", (305, 113), 20, draw.WHITE, 900)
    draw.lettering(skin, "4015", (305, 129), 13, (250, 230, 90), 700)
    return skin


def _soften(picture: Colour) -> Colour:
    """The picture with each pixel the mean of a neighbourhood along the height."""
    return cv2.blur(picture, (1, 13)).astype(np.uint8)


def _leaf() -> Colour:
    rng = np.random.default_rng(12)
    leaf = draw.blank(60, 40, (58, 112, 44))
    draw.mottle(leaf, 10, (8, 8), rng)
    draw.line(leaf, [(0, 20), (60, 20)], (130, 170, 90), 2)
    for x in range(6, 60, 9):
        draw.line(leaf, [(x, 20), (x + 8, 4)], (110, 155, 80), 1)
        draw.line(leaf, [(x, 20), (x + 8, 36)], (110, 155, 80), 1)
    return leaf


def _banana_skin() -> Colour:
    rng = np.random.default_rng(21)
    skin = draw.blank(660, 300, (236, 200, 52))
    draw.mottle(skin, 9, (80, 30), rng)
    for row in (30, 90, 150, 210, 270):
        draw.line(skin, [(0, row), (660, row)], (206, 166, 40), 3)
    brown = [(112, 74, 30), (92, 58, 26), (140, 96, 40)]
    draw.speckles(skin, 230, (1.5, 4.5), brown, rng)
    for _ in range(26):
        x, y = rng.uniform(60, 600), rng.uniform(0, 300)
        draw.oval(skin, (x, y), (rng.uniform(8, 24), rng.uniform(2, 4)), brown[0])
    draw.rectangle(skin, (0, 0), (20, 300), (84, 62, 34))
    draw.rectangle(skin, (20, 0), (52, 300), (168, 170, 62))
    draw.rectangle(skin, (636, 0), (660, 300), (58, 42, 28))
    draw.oval(skin, (330, 196), (46, 26), (28, 70, 150))
    draw.lettering(skin, "MAYA", (330, 192), 27, (250, 230, 80), 900)
    draw.lettering(skin, "ECUADOR", (330, 209), 12, draw.WHITE, 700)
    return skin
