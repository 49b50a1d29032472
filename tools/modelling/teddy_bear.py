"""A teddy bear."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from kille.scene import Colour
from kille.sensors.synthetic.toy_model import ToyModel
from tools.modelling import drawing as draw
from tools.modelling.shapes import Grid, ellipsoid, move, turn
from tools.modelling.sheets import Sheet, assemble

_FUR: draw.RGB = (164, 108, 58)
_PALE_FUR: draw.RGB = (222, 184, 130)
_NOSE: draw.RGB = (38, 26, 24)
_SATIN: draw.RGB = (196, 30, 48)


def teddy_bear() -> ToyModel:
    """A teddy bear of 26 cm that sits and looks at the viewer."""
    rng = np.random.default_rng(61)
    brown, pale = _fur(_FUR, rng), _fur(_PALE_FUR, rng)
    dark = draw.blank(12, 12, _NOSE)
    parts = [
        Sheet(_ball((0.064, 0.055, 0.086), (0, 0, 0.086)), _belly(brown, pale)),
        Sheet(_ball((0.060, 0.052, 0.054), (0, -0.010, 0.196)), brown),
        Sheet(_ball((0.028, 0.022, 0.021), (0, -0.055, 0.183)), _muzzle(pale)),
        Sheet(_ball((0.010, 0.007, 0.007), (0, -0.076, 0.192)), dark),
    ]
    for side in (-1, 1):
        arm = turn(ellipsoid((0.023, 0.025, 0.055), 16), (0, 1, 0), -side * 32)
        arm = turn(arm, (1, 0, 0), -18)
        leg = turn(ellipsoid((0.030, 0.060, 0.029), 16), (0, 0, 1), side * 14)
        parts += [
            Sheet(_ball((0.008, 0.005, 0.008), (side * 0.023, -0.056, 0.209)), _eye()),
            Sheet(
                _ball((0.023, 0.013, 0.023), (side * 0.047, -0.004, 0.240)),
                _ear(brown, pale),
            ),
            Sheet(move(arm, side * 0.074, -0.024, 0.112), brown),
            Sheet(move(leg, side * 0.054, -0.066, 0.031), brown),
            Sheet(
                _ball((0.031, 0.017, 0.038), (side * 0.068, -0.117, 0.040)),
                _paw(brown, pale),
            ),
            Sheet(
                _ball((0.022, 0.008, 0.015), (side * 0.022, -0.056, 0.150)), _ribbon()
            ),
        ]
    parts.append(Sheet(_ball((0.008, 0.010, 0.009), (0, -0.058, 0.150)), _ribbon()))
    return assemble(parts)


def _ball(radii: ArrayLike, middle: tuple[float, float, float]) -> Grid:
    return move(ellipsoid(radii, 16), *middle)


def _fur(colour: draw.RGB, rng: np.random.Generator) -> Colour:
    """Tufts of hair, lighter and darker, that point down."""
    fur = draw.blank(300, 200, colour)
    draw.mottle(fur, 16, (14, 14), rng)
    for _ in range(1300):
        x, y = rng.uniform(0, 300), rng.uniform(0, 200)
        change = rng.normal(0, 26)
        shade = tuple(int(np.clip(c + change, 0, 255)) for c in colour)
        way = (x + rng.normal(0, 4), y + rng.uniform(4, 11))
        draw.line(fur, [(x, y), way], (shade[0], shade[1], shade[2]), 2)
    return fur


def _belly(brown: Colour, pale: Colour) -> Colour:
    """Fur with a pale patch in front, and a seam."""
    belly = brown.copy()
    patch = np.zeros_like(belly)
    draw.oval(patch, (150, 112), (42, 56), (255, 255, 255))
    belly[patch[..., 0] > 127] = pale[patch[..., 0] > 127]
    for y in range(60, 166, 10):
        draw.line(belly, [(147, y), (153, y + 4)], (120, 76, 40), 2)
    return belly


def _muzzle(pale: Colour) -> Colour:
    muzzle = pale.copy()
    draw.line(muzzle, [(150, 84), (150, 118)], _NOSE, 6)
    draw.line(muzzle, [(150, 118), (138, 130), (122, 128)], _NOSE, 6)
    draw.line(muzzle, [(150, 118), (162, 130), (178, 128)], _NOSE, 6)
    return muzzle


def _eye() -> Colour:
    eye = draw.blank(48, 32, _NOSE)
    draw.oval(eye, (22, 11), (3, 4), draw.WHITE)
    return eye


def _ear(brown: Colour, pale: Colour) -> Colour:
    ear = brown.copy()
    ear[50:165, 96:204] = pale[50:165, 96:204]
    return ear


def _paw(brown: Colour, pale: Colour) -> Colour:
    """The sole of a foot: one large pad and three small ones."""
    paw = brown.copy()
    paw[30:180, 80:220] = pale[30:180, 80:220]
    pad = (112, 70, 48)
    draw.oval(paw, (150, 128), (36, 32), pad)
    for x, y in ((112, 74), (150, 60), (188, 74)):
        draw.oval(paw, (x, y), (14, 15), pad)
    return paw


def _ribbon() -> Colour:
    ribbon = draw.blank(120, 80, _SATIN)
    for x in range(8, 120, 20):
        for y in range(8, 80, 20):
            draw.oval(ribbon, (x + (y // 20 % 2) * 10, y), (5, 5), draw.WHITE)
    return ribbon
