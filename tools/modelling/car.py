"""A toy car."""

from __future__ import annotations

import cv2
import numpy as np

from kille.scene import Colour
from kille.sensors.synthetic.toy_model import ToyModel
from tools.modelling import drawing as draw
from tools.modelling.shapes import Grid, box, curve, disc, lathe, move, quad, turn
from tools.modelling.sheets import Sheet, assemble

_CAR: draw.RGB = (214, 30, 34)
_GLASS: draw.RGB = (58, 84, 112)
_REAR, _FRONT, _FLOOR = -0.100, 0.100, 0.013
_PER_METRE = 3000


def car() -> ToyModel:
    """A toy rally car of 20 cm seen from its side, the bonnet to the right."""
    tilted = [Sheet(turn(p.points, (0, 0, 1), 24), p.picture) for p in _car_parts()]
    return assemble(tilted)


def _car_parts() -> list[Sheet]:
    body = _body()
    wheels = [
        part
        for x in (-0.062, 0.062)
        for away in (0, 180)
        for part in _wheel(x if away == 0 else -x, away)
    ]
    return [*body, *wheels, *_spoiler()]


def _roof_line() -> Grid:
    """The car from above its axis: x and the height of its top."""
    return curve(
        [
            (_REAR, 0.040),
            (-0.082, 0.045),
            (-0.064, 0.047),
            (-0.046, 0.064),
            (-0.010, 0.069),
            (0.020, 0.065),
            (0.046, 0.046),
            (0.080, 0.041),
            (_FRONT, 0.031),
        ],
        33,
    )


def _half_width(x: Grid, z: Grid) -> Grid:
    """Half the body's width: rounded at both ends, and narrower at the windows."""
    ends = 0.008 * (np.abs(x) / _FRONT) ** 4
    return 0.042 - ends - 0.40 * np.maximum(z - 0.043, 0)


def _body() -> list[Sheet]:
    """Two flanks, the deck from boot to bonnet, and the two ends."""
    x, top = _roof_line().T
    share = np.linspace(0, 1, 9)[:, None]
    z = top + (_FLOOR - top) * share
    wide = _half_width(np.broadcast_to(x, z.shape), z)
    near = np.stack([np.broadcast_to(x, z.shape), -wide, z], axis=2)
    far = (near * [1, -1, 1])[:, ::-1]
    across = np.linspace(1, -1, 7)[:, None]
    crown = top + 0.002 * (1 - across**2)
    deck = np.stack(
        [np.broadcast_to(x, crown.shape), across * _half_width(x, top), crown], axis=2
    )
    skin = _fit(_flank(), top)
    front_y = float(_half_width(x[-1:], top[-1:])[0])
    rear_y = float(_half_width(x[:1], top[:1])[0])
    nose = quad(
        (_FRONT, -front_y, top[-1]),
        (_FRONT, front_y, top[-1]),
        (_FRONT, -front_y, _FLOOR),
    )
    tail = quad(
        (_REAR, rear_y, top[0]), (_REAR, -rear_y, top[0]), (_REAR, rear_y, _FLOOR)
    )
    return [
        Sheet(near, skin),
        Sheet(far, skin[:, ::-1]),
        Sheet(deck, _deck()),
        Sheet(nose, _nose()),
        Sheet(tail, _tail()),
    ]


def _fit(side: Colour, top: Grid) -> Colour:
    """The drawing of the flank stretched so that it lies straight on the bent sheet."""
    columns = np.linspace(0, side.shape[1] - 1, side.shape[1], dtype=np.float32)
    roof = np.interp(columns, np.linspace(0, side.shape[1] - 1, len(top)), top)
    share = np.linspace(0, 1, side.shape[0])[:, None]
    height = roof + (_FLOOR - roof) * share
    rows = ((0.072 - height) * _PER_METRE).astype(np.float32)
    place = _roof_line()[:, 0]
    x = np.interp(columns, np.linspace(0, side.shape[1] - 1, len(place)), place)
    across = ((x - _REAR) * _PER_METRE).astype(np.float32)
    return cv2.remap(
        side,
        np.broadcast_to(across, rows.shape).copy(),
        rows,
        cv2.INTER_LINEAR,
        borderMode=cv2.BORDER_REPLICATE,
    ).astype(np.uint8)


def _flank() -> Colour:
    """The car's side drawn to scale: windows, doors, arches, stripes, number 7."""
    flank = draw.blank(600, 180, _CAR)
    for shift, colour in ((0, draw.WHITE), (11, (30, 60, 150))):
        draw.polygon(
            flank,
            [
                (0, 112 + shift),
                (600, 128 + shift),
                (600, 137 + shift),
                (0, 121 + shift),
            ],
            colour,
        )
    draw.polygon(flank, [(122, 76), (168, 26), (256, 18), (256, 76)], _GLASS)
    draw.polygon(flank, [(266, 76), (266, 18), (356, 26), (418, 76)], _GLASS)
    for x in (150, 300):
        draw.polygon(
            flank, [(x, 70), (x + 34, 26), (x + 46, 26), (x + 14, 70)], (150, 180, 200)
        )
    for x in (261, 392, 150):
        draw.line(flank, [(x, 78), (x, 150)], (110, 10, 16), 3)
    for x in (242, 372):
        draw.rectangle(flank, (x - 12, 86), (x + 2, 91), draw.BLACK)
    draw.oval(flank, (316, 118), (33, 33), draw.WHITE)
    draw.lettering(flank, "7", (316, 118), 58, draw.BLACK, 1000)
    draw.lettering(flank, "TURBO", (212, 102), 26, (250, 220, 60), 1000)
    draw.lettering(flank, "KILO", (484, 100), 22, draw.WHITE, 900)
    draw.lettering(flank, "OIL", (40, 98), 22, draw.WHITE, 900)
    draw.rectangle(flank, (0, 166), (600, 180), (40, 40, 44))
    for x in (114, 486):
        draw.oval(flank, (x, 160), (72, 68), draw.BLACK)
    draw.oval(flank, (586, 106), (16, 11), (250, 240, 170))
    draw.oval(flank, (10, 96), (12, 11), (250, 150, 60))
    return flank


def _deck() -> Colour:
    """From above, left to right: boot, rear window, roof, windscreen, bonnet."""
    deck = draw.blank(600, 250, _CAR)
    for y in (92, 132):
        draw.rectangle(deck, (0, y), (600, y + 24), draw.WHITE)
    draw.polygon(deck, [(150, 8), (206, 20), (206, 230), (150, 242)], _GLASS)
    draw.polygon(deck, [(356, 20), (428, 6), (428, 244), (356, 230)], _GLASS)
    draw.line(deck, [(372, 60), (418, 40)], (170, 196, 214), 5)
    draw.line(deck, [(372, 90), (418, 70)], (170, 196, 214), 5)
    draw.oval(deck, (282, 125), (46, 46), draw.WHITE)
    draw.lettering(deck, "7", (282, 125), 76, draw.BLACK, 1000)
    draw.lettering(deck, "TURBO", (516, 48), 34, (250, 220, 60), 1000)
    draw.lettering(deck, "TURBO", (516, 206), 34, (250, 220, 60), 1000)
    for y in (104, 146):
        draw.rectangle(deck, (476, y - 8), (536, y + 8), draw.BLACK)
    return deck


def _nose() -> Colour:
    nose = draw.blank(240, 70, _CAR)
    draw.rectangle(nose, (70, 12), (170, 44), draw.BLACK)
    for x in range(76, 170, 12):
        draw.line(nose, [(x, 12), (x, 44)], (150, 152, 156), 2)
    for x in (36, 204):
        draw.oval(nose, (x, 24), (24, 15), (250, 246, 200))
        draw.oval(nose, (x, 24), (11, 9), draw.WHITE)
    draw.rectangle(nose, (0, 52), (240, 70), (60, 60, 64))
    draw.lettering(nose, "KL 007", (120, 61), 18, draw.WHITE, 800)
    return nose


def _tail() -> Colour:
    tail = draw.blank(240, 100, _CAR)
    for x in (34, 206):
        draw.rectangle(tail, (x - 26, 16), (x + 26, 40), (250, 120, 40))
    draw.rectangle(tail, (82, 40), (158, 66), draw.WHITE)
    draw.lettering(tail, "KL 007", (120, 53), 20, draw.BLACK, 800)
    draw.rectangle(tail, (0, 76), (240, 100), (60, 60, 64))
    return tail


def _wheel(x: float, away: float) -> list[Sheet]:
    """A tyre with its hub, on the side that a turn of `away` degrees brings it to."""
    hub = move(turn(disc(0.0195, 20), (1, 0, 0), 90), x, -0.0445, 0.0195)
    tread = turn(lathe([(0.0195, 0.0), (0.0195, -0.016)], 20), (1, 0, 0), 90)
    tread = move(tread, x, -0.0445, 0.0195)
    return [
        Sheet(turn(hub, (0, 0, 1), away), _hub()),
        Sheet(turn(tread, (0, 0, 1), away), draw.blank(40, 8, draw.BLACK)),
    ]


def _hub() -> Colour:
    hub = draw.blank(120, 120, draw.BLACK)
    draw.oval(hub, (60, 60), (40, 40), (196, 198, 204))
    for step in range(5):
        angle = 2 * np.pi * step / 5
        draw.oval(
            hub, (60 + 24 * np.sin(angle), 60 - 24 * np.cos(angle)), (8, 8), draw.BLACK
        )
    draw.oval(hub, (60, 60), (9, 9), _CAR)
    return hub


def _spoiler() -> list[Sheet]:
    """A wing on two struts over the boot."""
    black = draw.blank(20, 8, draw.BLACK)
    wing = [
        move(sheet, -0.088, 0, 0.060) for sheet in box(0.020, 0.078, 0.003).values()
    ]
    struts = [
        move(sheet, -0.088, y, 0.040)
        for y in (-0.026, 0.026)
        for sheet in box(0.010, 0.003, 0.021).values()
    ]
    return [Sheet(sheet, black) for sheet in (*wing, *struts)]
