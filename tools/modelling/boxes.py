"""A book and a shoe-box."""

from __future__ import annotations

import numpy as np

from kille.scene import Colour
from kille.sensors.synthetic.toy_model import ToyModel
from tools.modelling import drawing as draw
from tools.modelling.shapes import box, move
from tools.modelling.sheets import Sheet, assemble

_NAVY: draw.RGB = (22, 40, 84)
_ORANGE: draw.RGB = (238, 112, 34)
_CREAM: draw.RGB = (240, 230, 204)


def book() -> ToyModel:
    """A hardback of 15 x 22 x 3 cm that lies on its back, its spine to the left."""
    boards = {
        "top": _cover(),
        "bottom": _blurb(),
        "left": _spine(),
        "right": _pages(440, 60),
        "front": _pages(300, 60),
        "back": _pages(300, 60),
    }
    faces = box(0.15, 0.22, 0.03)
    return assemble([Sheet(faces[side], boards[side]) for side in boards])


def shoe_box() -> ToyModel:
    """A shoe-box of 30 x 19 x 11 cm with a lid that overhangs and a brand all over."""
    card = draw.blank(20, 20, (214, 186, 140))
    body = {
        "front": _brand(600, 150, "STRIDE"),
        "back": _brand(600, 150, "STRIDE"),
        "left": _size_label(),
        "right": _size_label(),
        "bottom": card,
    }
    lid = {
        "front": _lid_rim(612),
        "back": _lid_rim(612),
        "left": _lid_rim(392),
        "right": _lid_rim(392),
        "top": _lid_top(),
    }
    faces = box(0.30, 0.19, 0.106)
    over = {
        side: move(sheet, z=0.075) for side, sheet in box(0.306, 0.196, 0.035).items()
    }
    return assemble(
        [Sheet(faces[side], body[side]) for side in body]
        + [Sheet(over[side], lid[side]) for side in lid]
    )


def _cover() -> Colour:
    """A night sky, mountains and a boat under a title."""
    rng = np.random.default_rng(31)
    cover = draw.blank(300, 440, _NAVY)
    draw.blend_down(cover, (18, 28, 74), (232, 130, 70))
    draw.speckles(cover[:230], 60, (1.0, 2.2), [draw.WHITE, (250, 230, 160)], rng)
    draw.oval(cover, (222, 186), (34, 34), (250, 226, 150))
    draw.oval(cover, (236, 178), (28, 28), (92, 62, 78))
    peaks = [
        (0, 330),
        (46, 250),
        (86, 292),
        (138, 214),
        (196, 300),
        (246, 246),
        (300, 320),
    ]
    draw.polygon(cover, [*peaks, (300, 360), (0, 360)], (58, 46, 86))
    for x, y in ((46, 250), (138, 214), (246, 246)):
        draw.polygon(
            cover, [(x, y), (x - 15, y + 26), (x, y + 18), (x + 14, y + 27)], draw.WHITE
        )
    draw.rectangle(cover, (0, 345), (300, 440), (20, 78, 104))
    for _ in range(70):
        x, y = int(rng.integers(0, 280)), int(rng.integers(350, 400))
        draw.line(
            cover, [(x, y), (x + int(rng.integers(8, 26)), y)], (120, 190, 196), 2
        )
    draw.polygon(cover, [(92, 352), (190, 352), (172, 376), (108, 376)], (150, 40, 30))
    draw.polygon(cover, [(138, 264), (138, 344), (196, 344)], _CREAM)
    draw.polygon(cover, [(132, 280), (132, 344), (96, 344)], (226, 90, 50))
    draw.lettering(cover, "THE", (150, 36), 34, _CREAM, 800)
    draw.lettering(cover, "LONG", (150, 82), 66, _CREAM, 900)
    draw.lettering(cover, "VOYAGE", (150, 136), 58, (252, 196, 70), 900)
    draw.lettering(cover, "a novel", (66, 176), 24, draw.WHITE, 500)
    draw.rectangle(cover, (0, 400), (300, 440), (14, 22, 46))
    draw.lettering(cover, "ANNA LINDHOLM", (150, 420), 28, _CREAM, 800)
    draw.frame(cover, (5, 5), (294, 434), (214, 170, 70), 3)
    return cover


def _blurb() -> Colour:
    """The back cover: praise too small to read, and a bar code."""
    rng = np.random.default_rng(32)
    back = draw.blank(300, 440, _NAVY)
    draw.lettering(back, "A storm. A map.", (150, 44), 30, (252, 196, 70), 800)
    draw.lettering(back, "One way home.", (150, 80), 30, (252, 196, 70), 800)
    draw.small_print(back, (24, 118), (276, 300), _CREAM, rng, 13)
    draw.bar_code(back, (170, 350), (280, 420), rng)
    draw.star(back, (60, 385), 26, _ORANGE)
    return back


def _spine() -> Colour:
    spine = draw.blank(440, 60, (14, 22, 46))
    draw.lettering(spine, "THE LONG VOYAGE", (190, 30), 32, (252, 196, 70), 900)
    draw.lettering(spine, "LINDHOLM", (386, 30), 18, _CREAM, 700)
    return spine


def _pages(width: int, height: int) -> Colour:
    """The edges of the leaves between two boards."""
    rng = np.random.default_rng(33)
    leaves = draw.blank(width, height, (238, 230, 210))
    for y in range(9, height - 8, 4):
        shade = int(rng.integers(150, 225))
        draw.line(leaves, [(0, y), (width, y)], (shade, shade - 8, shade - 26), 1)
    draw.rectangle(leaves, (0, 0), (width, 7), _NAVY)
    draw.rectangle(leaves, (0, height - 8), (width, height), _NAVY)
    return leaves


def _brand(width: int, height: int, name: str) -> Colour:
    side = draw.blank(width, height, _ORANGE)
    for x in range(-height, width, 46):
        corners = [(x, height), (x + 18, height), (x + 18 + height, 0), (x + height, 0)]
        draw.polygon(side, corners, (224, 92, 22))
    draw.polygon(side, [(20, 100), (60, 40), (80, 40), (52, 100)], draw.WHITE)
    draw.polygon(side, [(62, 100), (102, 40), (122, 40), (94, 100)], draw.WHITE)
    draw.lettering(
        side, name, (width // 2 + 20, height // 2 + 14), 96, draw.WHITE, 1000
    )
    draw.lettering(
        side, "RUNNING SHOES", (width // 2 + 30, height - 12), 22, draw.BLACK, 800
    )
    return side


def _size_label() -> Colour:
    """A short side: a label with a shoe's outline, the size and a bar code."""
    rng = np.random.default_rng(34)
    side = _brand(380, 212, "")
    draw.rectangle(side, (40, 76), (340, 204), draw.WHITE)
    shoe = [
        (56, 150),
        (60, 108),
        (88, 112),
        (120, 136),
        (160, 140),
        (166, 156),
        (56, 158),
    ]
    draw.polygon(side, shoe, draw.BLACK)
    draw.lettering(side, "EU 42", (250, 104), 44, draw.BLACK, 900)
    draw.small_print(side, (56, 172), (180, 200), draw.BLACK, rng, 9)
    draw.bar_code(side, (196, 134), (328, 196), rng)
    return side


def _lid_rim(width: int) -> Colour:
    rim = draw.blank(width, 70, (36, 34, 40))
    for x in range(70, width, 140):
        draw.lettering(rim, "STRIDE", (x, 36), 30, _ORANGE, 900)
    draw.line(rim, [(0, 66), (width, 66)], draw.WHITE, 3)
    return rim


def _lid_top() -> Colour:
    top = draw.blank(612, 392, (36, 34, 40))
    for shift in range(0, 150, 50):
        corners = [
            (60 + shift, 300),
            (150 + shift, 90),
            (182 + shift, 90),
            (92 + shift, 300),
        ]
        draw.polygon(top, corners, _ORANGE)
    draw.lettering(top, "STRIDE", (420, 176), 92, draw.WHITE, 1000)
    draw.lettering(top, "run your own way", (424, 246), 34, _ORANGE, 600)
    draw.frame(top, (14, 14), (597, 377), (120, 116, 120), 3)
    draw.lettering(top, "SHOES  ·  SIZE 42", (424, 330), 30, draw.WHITE, 700)
    return top
