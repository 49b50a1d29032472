"""Other things of the same kinds: another cup, another book, as shops have many.

A specimen differs from the catalogue's in its proportions, in its colours, and where
people print on a thing, in what is printed on it: of the catalogue's print only the
broad lines are left, such as where a shoe has its sole.
"""

from __future__ import annotations

import zlib
from dataclasses import replace
from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.scene import Colour
from kille.sensors.synthetic import catalogue
from kille.sensors.synthetic.toy_model import ToyModel

_GROWN = {"apple": 15.0, "banana": 8.0, "teddy bear": 12.0}
"""By how many degrees the hue of what is not painted may be another."""

_WHOLE = 0.15  # how far the size may differ, as a logarithm, in all directions alike
_EACH = 0.08  # and in each direction besides
_CHROMA = (0.6, 1.3)
_GAMMA = (0.75, 1.35)
_STRIPES = 9  # a print has so many of them at most
_DOTS = 60
_FADED = 9.0  # texels (1 mm) by which the catalogue's print is blurred


@lru_cache(maxsize=128)
def specimen(name: str, number: int) -> ToyModel:
    """The specimen of that number of a thing in the catalogue; 0 is the catalogue's.

    The same number is always the same thing. KeyError for a name not in the catalogue.
    """
    first = catalogue.toy_model(name)
    if number == 0:
        return first
    rng = np.random.default_rng([zlib.crc32(name.encode()), number])
    grown = _GROWN.get(name)
    texture = first.texture if grown is not None else _print_over(first.texture, rng)
    tint = rng.uniform(-grown, grown) if grown is not None else rng.uniform(60, 300)
    return _stretch(replace(first, texture=_recolour(texture, tint, rng)), rng)


def _stretch(model: ToyModel, rng: np.random.Generator) -> ToyModel:
    factors = np.exp(rng.uniform(-_WHOLE, _WHOLE) + rng.uniform(-_EACH, _EACH, 3))
    # A normal stays upright on a stretched surface if it is stretched the other way.
    normals = model.normals / factors
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    return replace(
        model,
        vertices=np.asarray(model.vertices * factors, np.float32),
        normals=np.asarray(normals / np.maximum(length, 1e-12), np.float32),
    )


def _recolour(texture: Colour, tint: float, rng: np.random.Generator) -> Colour:
    """Every hue turned by so many degrees, chroma and contrast changed alike."""
    lab = cv2.cvtColor(texture.astype(np.float32) / 255, cv2.COLOR_RGB2Lab)
    angle, chroma = np.radians(tint), rng.uniform(*_CHROMA)
    a, b = lab[..., 1].copy(), lab[..., 2].copy()
    lab[..., 0] = 100 * (lab[..., 0] / 100) ** rng.uniform(*_GAMMA)
    lab[..., 1] = chroma * (np.cos(angle) * a - np.sin(angle) * b)
    lab[..., 2] = chroma * (np.sin(angle) * a + np.cos(angle) * b)
    rgb = cv2.cvtColor(lab.astype(np.float32), cv2.COLOR_Lab2RGB)
    return np.asarray(np.clip(rgb * 255, 0, 255).round(), np.uint8)


def _print_over(texture: Colour, rng: np.random.Generator) -> Colour:
    """The texture faded, with stripes as broad as a finger across it, and dots."""
    along = np.arange(texture.shape[1], dtype=np.float32)[None, :]
    down = np.arange(texture.shape[0], dtype=np.float32)[:, None]
    printed = cv2.GaussianBlur(texture, (0, 0), _FADED).astype(np.float32)
    for _ in range(int(rng.integers(3, _STRIPES + 1))):
        angle, width = rng.uniform(0, np.pi), rng.uniform(6, 25)
        across = np.cos(angle) * along + np.sin(angle) * down
        phase, period = rng.uniform(0, 400), rng.uniform(90, 400)
        stripe = ((across + phase) % period < width)[..., None]
        printed = _mix_ink(
            printed, stripe, rng.uniform(0, 255, 3), rng.uniform(0.5, 0.9)
        )
    for _ in range(int(rng.integers(0, _DOTS + 1))):
        middle = rng.uniform(0, 1, 2) * texture.shape[1::-1]
        ink, radius = rng.uniform(0, 255, 3).tolist(), int(rng.integers(3, 14))
        cv2.circle(printed, middle.astype(int).tolist(), radius, ink, -1, cv2.LINE_AA)
    return np.asarray(printed.round(), np.uint8)


def _mix_ink(
    picture: NDArray[np.float32],
    where: NDArray[np.bool_],
    ink: NDArray[np.float64],
    opacity: float,
) -> NDArray[np.float32]:
    inked = (1 - opacity) * picture + opacity * ink
    return np.where(where, inked, picture).astype(np.float32)
