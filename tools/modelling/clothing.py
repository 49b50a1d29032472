"""A cap and a shoe."""

from __future__ import annotations

import numpy as np

from kille.scene import Colour
from kille.sensors.synthetic.toy_model import ToyModel
from tools.modelling import drawing as draw
from tools.modelling.shapes import (
    Grid,
    curve,
    ellipsoid,
    inside_out,
    lathe,
    move,
    turn,
)
from tools.modelling.sheets import Sheet, assemble

_BLUE: draw.RGB = (30, 62, 142)
_RED: draw.RGB = (204, 40, 44)
_YELLOW: draw.RGB = (248, 200, 52)
_LEATHER: draw.RGB = (240, 238, 232)
_RUBBER: draw.RGB = (250, 250, 246)
_LENGTH = 0.28


def cap() -> ToyModel:
    """A baseball cap of six panels, its visor pointing to the front left."""
    profile = curve(
        [(0.0, 0.118), (0.035, 0.113), (0.068, 0.092), (0.085, 0.055), (0.089, 0.0)], 14
    )
    crown = lathe(profile, 40) * [1.0, 1.1, 1.0]
    parts = [
        Sheet(crown, _crown()),
        Sheet(
            move(ellipsoid((0.008, 0.008, 0.005), 12), z=0.118), draw.blank(8, 8, _RED)
        ),
        Sheet(_visor(), _brim()),
        Sheet(inside_out(move(_visor(), z=-0.002)), draw.blank(20, 20, (90, 30, 34))),
    ]
    return assemble([Sheet(turn(p.points, (0, 0, 1), -38), p.picture) for p in parts])


def shoe() -> ToyModel:
    """A running shoe of 28 cm seen from its side, the toe to the right."""
    return assemble(
        [
            Sheet(_upper(), _upper_picture()),
            Sheet(_sole(), _sole_picture()),
            Sheet(_welt(), draw.blank(20, 8, _RUBBER)),
        ]
    )


def _visor() -> Grid:
    """A crescent in front of the crown, bent down at its sides."""
    angle = np.radians(np.linspace(-72, 72, 25))
    reach = np.linspace(0, 1, 7)[:, None] * 0.082 * np.cos(angle * 90 / 74) ** 0.6
    x = np.broadcast_to(0.0885 * np.sin(angle), reach.shape) * (1 + reach)
    y = -0.097 * np.cos(angle) - reach
    z = 0.018 - 2.4 * x**2 - 0.10 * reach
    return np.stack([x, y, z], axis=2)


def _crown() -> Colour:
    """Six panels with stitched seams, eyelets, and the emblem in front."""
    rng = np.random.default_rng(51)
    crown = draw.blank(780, 250, _BLUE)
    draw.mottle(crown, 5, (6, 6), rng)
    draw.rectangle(crown, (260, 0), (520, 250), (238, 236, 228))
    for seam in range(0, 781, 130):
        draw.line(crown, [(seam, 0), (seam, 250)], (16, 34, 84), 4)
        for side in (-9, 9):
            _stitches(crown, (seam + side, 0), (seam + side, 250))
    for x in range(65, 780, 130):
        draw.oval(crown, (x, 84), (9, 8), draw.BLACK)
        draw.oval(crown, (x, 84), (5, 5), (150, 150, 154))
    draw.star(crown, (390, 148), 84, _RED)
    draw.star(crown, (390, 148), 66, _YELLOW)
    draw.lettering(crown, "K", (390, 156), 84, _BLUE, 1000)
    draw.rectangle(crown, (0, 226), (780, 250), _RED)
    for start in (60, 640):
        draw.lettering(crown, "KINGS", (start, 165), 40, _YELLOW, 900)
    _stitches(crown, (0, 222), (780, 222))
    return crown


def _brim() -> Colour:
    brim = draw.blank(240, 110, _RED)
    for row in range(14, 110, 16):
        _stitches(brim, (0, row), (240, row))
    draw.rectangle(brim, (0, 102), (240, 110), _YELLOW)
    return brim


def _stitches(picture: Colour, start: tuple[int, int], end: tuple[int, int]) -> None:
    """A dashed line of thread."""
    way = np.subtract(end, start)
    dashes = max(int(np.abs(way).max()) // 10, 1)
    for number in range(dashes):
        near = np.add(start, way * number / dashes)
        far = np.add(start, way * (number + 0.55) / dashes)
        draw.line(picture, [near, far], (250, 236, 200), 2)


def _stations() -> Grid:
    """Along the shoe: x, half its width, height of the upper and of the sole."""
    return curve(
        [
            (-0.140, 0.010, 0.050, 0.034),
            (-0.134, 0.026, 0.088, 0.034),
            (-0.110, 0.034, 0.096, 0.033),
            (-0.070, 0.035, 0.085, 0.032),
            (-0.035, 0.034, 0.092, 0.030),
            (-0.010, 0.036, 0.106, 0.029),
            (0.030, 0.040, 0.086, 0.028),
            (0.070, 0.045, 0.066, 0.027),
            (0.105, 0.043, 0.054, 0.027),
            (0.130, 0.028, 0.044, 0.029),
            (0.140, 0.008, 0.034, 0.032),
        ],
        45,
    )


def _upper() -> Grid:
    """Arches from sole to sole over the foot, hollow at the ankle."""
    x, half, top, sole = _stations().T
    angle = np.linspace(0, np.pi, 25)[:, None]
    y = half * np.sign(np.cos(angle)) * np.abs(np.cos(angle)) ** 0.75
    rise = np.sin(angle) ** 0.7
    hollow = ((x + 0.072) / 0.050) ** 2 + ((angle - np.pi / 2) / 0.62) ** 2
    depth = 0.045 * np.clip(1.25 * (1 - hollow), 0, 1)
    z = sole + (top - sole) * rise - depth
    return np.stack([np.broadcast_to(x, z.shape), y, z], axis=2)


def _outline(margin: float) -> Grid:
    """The sole's rim (n, 2), from the middle of the far side round by the heel."""
    x, half, _, _ = _stations().T
    near = np.stack([x, -half - margin], axis=1)
    far = near * [1.0, -1.0]
    middle = len(x) // 2
    ring = np.concatenate(
        [far[middle::-1], near, far[:middle:-1], far[middle : middle + 1]]
    )
    stretch = [1 + margin / (_LENGTH / 2), 1.0]
    return ring * stretch


def _sole() -> Grid:
    """The band of rubber from the upper down to the ground."""
    wide, narrow = _outline(0.005), _outline(0.001)
    x = wide[:, 0]
    lift = 0.010 * np.clip((x - 0.09) / 0.055, 0, 1) ** 2
    levels = [(wide, 0.034 + 0.3 * lift), (wide, 0.012 + lift), (narrow, 0.0 + lift)]
    rows = [np.column_stack([ring, height]) for ring, height in levels]
    return np.stack(rows)


def _welt() -> Grid:
    """The top of the sole, a narrow shelf around the upper."""
    rings = [_outline(-0.004), _outline(0.005)]
    lift = 0.003 * np.clip((rings[1][:, 0] - 0.09) / 0.055, 0, 1) ** 2
    return np.stack([np.column_stack([ring, 0.034 + lift]) for ring in rings])


def _upper_picture() -> Colour:
    """Both sides of the upper unrolled: the middle row is the ridge with the laces."""
    rng = np.random.default_rng(52)
    upper = draw.blank(580, 420, (38, 76, 160))
    _mesh(upper)
    _half_upper(upper)
    upper[:210] = upper[:209:-1]
    draw.polygon(upper, [(270, 168), (395, 182), (395, 238), (270, 252)], (22, 38, 84))
    for x in range(284, 396, 18):
        draw.line(upper, [(x, 166), (x + 20, 254)], draw.WHITE, 7)
        draw.line(upper, [(x + 20, 166), (x, 254)], draw.WHITE, 7)
        for y in (164, 256):
            draw.oval(upper, (x + 2, y), (5, 5), draw.BLACK)
    draw.oval(upper, (142, 210), (108, 82), (232, 92, 40))
    draw.oval(upper, (142, 210), (96, 68), (34, 30, 34))
    draw.oval(upper, (138, 210), (62, 30), (70, 66, 70))
    draw.lettering(upper, "42", (140, 210), 30, (200, 196, 190), 700)
    draw.mottle(upper, 4, (5, 5), rng)
    return upper


def _mesh(upper: Colour) -> None:
    """The weave of the cloth."""
    for x in range(0, 580, 9):
        for y in range(0, 420, 9):
            draw.rectangle(upper, (x, y), (x + 3, y + 3), (26, 54, 124))


def _half_upper(upper: Colour) -> None:
    """The side that faces the viewer: heel, stripes, toe cap and eyelets' edge."""
    draw.polygon(upper, [(0, 210), (64, 210), (96, 420), (0, 420)], (232, 92, 40))
    draw.lettering(upper, "RUN", (42, 345), 34, draw.WHITE, 1000)
    draw.polygon(upper, [(246, 240), (400, 240), (420, 270), (250, 296)], _LEATHER)
    for shift in (0, 56, 112):
        left, right = 170 + shift, 198 + shift
        draw.polygon(
            upper,
            [(left - 44, 410), (right - 44, 410), (right + 40, 280), (left + 40, 280)],
            _LEATHER,
        )
        draw.line(upper, [(left - 38, 406), (left + 44, 284)], (150, 150, 150), 2)
    draw.polygon(
        upper, [(500, 210), (580, 210), (580, 420), (430, 420), (470, 330)], _LEATHER
    )
    for step in range(6):
        draw.oval(upper, (505 + 11 * step, 300 + 10 * (step % 2)), (3, 3), draw.BLACK)
    draw.line(upper, [(500, 210), (470, 330), (430, 420)], (120, 120, 126), 3)


def _sole_picture() -> Colour:
    sole = draw.blank(1300, 80, _RUBBER)
    draw.rectangle(sole, (0, 50), (1300, 80), (60, 62, 70))
    draw.rectangle(sole, (0, 26), (1300, 34), (232, 92, 40))
    for x in range(0, 1300, 24):
        draw.rectangle(sole, (x, 58), (x + 10, 80), draw.BLACK)
        draw.line(sole, [(x, 6), (x + 8, 20)], (176, 178, 180), 3)
    return sole
