"""A cup and a can of paint."""

from __future__ import annotations

import numpy as np

from kille.scene import Colour
from kille.sensors.synthetic.toy_model import ToyModel
from tools.modelling import drawing as draw
from tools.modelling.shapes import (
    Grid,
    curve,
    disc,
    inside_out,
    lathe,
    move,
    tube,
)
from tools.modelling.sheets import Sheet, assemble

_GLAZE: draw.RGB = (238, 236, 228)
_BLUE: draw.RGB = (32, 66, 150)
_STEEL: draw.RGB = (176, 180, 184)
_PAINT: draw.RGB = (206, 38, 58)
_DRIPS = (292, 338, 366, 620, 700, 905, 60)


def cup() -> ToyModel:
    """A mug of 10.5 cm with a folk pattern, a handle to the right and coffee in it."""
    wall = [
        (0.0455, 0.105),
        (0.0452, 0.080),
        (0.0447, 0.045),
        (0.042, 0.014),
        (0.036, 0.0),
    ]
    inner = [(0.0415, 0.105), (0.041, 0.085)]
    lip = [(0.0415, 0.105), (0.0435, 0.1068), (0.0455, 0.105)]
    handle = curve(
        [
            (0.042, 0, 0.086),
            (0.060, 0, 0.088),
            (0.072, 0, 0.074),
            (0.073, 0, 0.052),
            (0.062, 0, 0.033),
            (0.040, 0, 0.026),
        ],
        18,
    )
    coffee = move(disc(0.041), z=0.088)
    return assemble(
        [
            Sheet(lathe(curve(wall, 12), 40), _folk_pattern()),
            Sheet(lathe(lip, 40), draw.blank(40, 4, _BLUE)),
            Sheet(inside_out(lathe(inner, 40)), draw.blank(40, 10, _GLAZE)),
            Sheet(coffee, _coffee()),
            Sheet(tube(handle, 0.0062, 10), draw.blank(20, 20, _BLUE)),
        ]
    )


def can_of_paint() -> ToyModel:
    """A litre can of 12.5 cm with lid, rims, label, drips of red paint and a handle."""
    shell = [
        (0.050, 0.125),
        (0.0535, 0.1265),
        (0.055, 0.124),
        (0.0535, 0.121),
        (0.053, 0.116),
    ]
    foot = [(0.053, 0.006), (0.0545, 0.004), (0.0545, 0.0)]
    groove = [(0.044, 0.1205), (0.050, 0.125)]
    steel = draw.blank(80, 20, _STEEL)
    return assemble(
        [
            Sheet(move(disc(0.043), z=0.1226), _lid()),
            Sheet(lathe(groove, 40), steel),
            Sheet(lathe(shell, 40), _rim()),
            Sheet(lathe([(0.053, 0.116), (0.053, 0.006)], 40), _label()),
            Sheet(lathe(foot, 40), steel),
            Sheet(tube(_bail(), 0.0022, 6), draw.blank(8, 8, (84, 86, 92))),
            *[Sheet(ear, steel) for ear in _ears()],
        ]
    )


def _bail() -> Grid:
    """The wire handle, hanging down in front from ear to ear."""
    angle = np.radians(np.linspace(-90, 90, 24))
    reach, drop = 0.0575, 0.062
    x, y = reach * np.sin(angle), -(reach + 0.001) * np.cos(angle)
    return np.stack([x, y, 0.110 - drop * np.cos(angle) ** 0.8], axis=1)


def _ears() -> list[Grid]:
    """The two knobs that hold the handle."""
    return [
        tube([(side * 0.052, 0, 0.110), (side * 0.060, 0, 0.110)], 0.006, 10)
        for side in (-1, 1)
    ]


def _folk_pattern() -> Colour:
    """Bands of zigzag and dots around a row of tulips and hearts."""
    rng = np.random.default_rng(41)
    wall = draw.blank(860, 320, _GLAZE)
    draw.rectangle(wall, (0, 0), (860, 12), _BLUE)
    draw.rectangle(wall, (0, 296), (860, 320), _BLUE)
    for x in range(0, 860, 43):
        draw.polygon(wall, [(x, 52), (x + 21, 20), (x + 43, 52), (x + 21, 40)], _BLUE)
        draw.oval(wall, (x + 2, 26), (7, 7), (214, 60, 46))
        draw.polygon(
            wall, [(x, 262), (x + 21, 290), (x + 43, 262), (x + 21, 274)], _BLUE
        )
        draw.oval(wall, (x + 21, 252), (6, 6), (238, 168, 40))
    red, green, gold = (208, 44, 48), (40, 128, 78), (240, 170, 40)
    for number, x in enumerate(range(43, 860, 86)):
        lift = int(rng.integers(-8, 9))
        draw.line(wall, [(x, 235), (x, 140 + lift)], green, 7)
        draw.oval(wall, (x - 17, 205), (17, 7), green, 35)
        draw.oval(wall, (x + 17, 195), (17, 7), green, -35)
        bloom = (red, gold, _BLUE, (150, 60, 140))[number % 4]
        head = 115 + lift
        tulip = [
            (x - 26, head - 34),
            (x - 12, head - 14),
            (x, head - 40),
            (x + 12, head - 14),
        ]
        draw.polygon(
            wall,
            [
                *tulip,
                (x + 26, head - 34),
                (x + 20, head + 18),
                (x, head + 28),
                (x - 20, head + 18),
            ],
            bloom,
        )
        draw.oval(wall, (x, head + 4), (7, 9), _GLAZE)
        draw.star(
            wall, (x + 43, 96 - lift), 15, gold if number % 2 else red, 5 + number % 3
        )
        draw.oval(wall, (x + 43, 158), (9, 9), _BLUE)
        draw.oval(wall, (x + 43, 158), (4, 4), gold)
        draw.oval(wall, (x + 43, 226 + lift // 2), (6, 6), red)
    return wall


def _coffee() -> Colour:
    coffee = draw.blank(80, 80, (70, 40, 22))
    draw.oval(coffee, (40, 40), (34, 34), (84, 50, 28))
    draw.oval(coffee, (30, 48), (9, 4), (150, 104, 66), 20)
    draw.oval(coffee, (52, 30), (6, 3), (150, 104, 66), -30)
    return coffee


def _label() -> Colour:
    """The wrap-around label; red paint has run down over it."""
    rng = np.random.default_rng(42)
    label = draw.blank(1000, 330, (244, 240, 226))
    for start in (0, 500):
        panel = label[:, start : start + 500]
        draw.rectangle(panel, (0, 0), (500, 64), (30, 62, 120))
        draw.lettering(panel, "COLORA", (250, 34), 50, draw.WHITE, 1000)
        draw.lettering(panel, "PAINT", (250, 122), 100, _PAINT, 1000)
        draw.rectangle(panel, (96, 176), (404, 236), _PAINT)
        draw.lettering(panel, "POPPY RED", (250, 207), 44, draw.WHITE, 900)
        draw.lettering(panel, "gloss · 1 litre", (250, 258), 32, draw.BLACK, 600)
        draw.rectangle(panel, (0, 282), (500, 330), (30, 62, 120))
        draw.small_print(panel, (60, 300), (440, 322), draw.WHITE, rng, 11)
        draw.small_print(panel, (14, 84), (80, 276), (90, 90, 96), rng, 11)
        draw.bar_code(panel, (424, 90), (488, 200), rng)
        for number, colour in enumerate([(230, 180, 40), (40, 140, 90), (40, 90, 180)]):
            draw.oval(panel, (444, 222 + 22 * number), (10, 10), colour)
    for x in _DRIPS:
        _drip(label, x, rng.uniform(40, 150), rng.uniform(6, 10))
    return np.roll(label, -250, axis=1)


def _drip(picture: Colour, x: float, length: float, radius: float) -> None:
    """Paint run down from the top edge to a round end."""
    corners = [(x - 2.2 * radius, 0), (x + 2.2 * radius, 0), (x + radius, 20)]
    draw.polygon(
        picture,
        [*corners, (x + radius, length), (x - radius, length), (x - radius, 20)],
        _PAINT,
    )
    draw.oval(picture, (x, length), (1.25 * radius, 1.5 * radius), _PAINT)


def _rim() -> Colour:
    rim = draw.blank(1000, 60, _STEEL)
    draw.rectangle(rim, (0, 0), (1000, 16), (214, 216, 220))
    for x in _DRIPS:
        draw.rectangle(rim, (x - 24, 0), (x + 24, 60), _PAINT)
    return np.roll(rim, -250, axis=1)


def _lid() -> Colour:
    """A pried lid: rings in the steel, and a splash of the paint."""
    rng = np.random.default_rng(43)
    lid = draw.blank(200, 200, (190, 194, 198))
    for radius, shade in ((94, 150), (88, 204), (60, 160), (56, 196)):
        draw.oval(lid, (100, 100), (radius, radius), (shade, shade + 3, shade + 6))
    draw.oval(lid, (128, 120), (34, 22), _PAINT, 30)
    draw.oval(lid, (158, 146), (20, 9), _PAINT, 40)
    draw.speckles(lid, 16, (2, 5), [_PAINT, (150, 24, 40)], rng)
    draw.lettering(lid, "COLORA", (84, 78), 28, (96, 98, 104), 900)
    return lid
