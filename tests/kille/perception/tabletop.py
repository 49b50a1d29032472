"""Small table-tops made by hand: a plane and textured boxes that face the camera."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kille.perception.segment import region_of
from kille.scene import Features, Frame, Intrinsics, Percept, Region

LENS = Intrinsics(525.0, 525.0, 319.5, 239.5)
SHAPE = (480, 640)
TILT = np.radians(35)
UP = (0.0, float(-np.cos(TILT)), float(-np.sin(TILT)))
CAMERA_HEIGHT = 0.55


@dataclass(frozen=True)
class Card:
    """An upright card: metres right and away from below the camera, width, height."""

    right: float
    away: float
    width: float = 0.1
    height: float = 0.14
    seed: int = 0


def frame_of(
    *cards: Card, noise: float = 0.0, seed: int = 0, table: bool = True
) -> Frame:
    """What a tilted camera sees of the cards: `outlines` are by number from 0."""
    chance = np.random.default_rng(seed)
    us, vs = np.meshgrid(np.arange(SHAPE[1]), np.arange(SHAPE[0]))
    rays = np.stack(
        [(us - LENS.cx) / LENS.fx, (vs - LENS.cy) / LENS.fy, np.ones(SHAPE)], axis=2
    )
    up, away = np.array(UP), np.array([0, -np.sin(TILT), np.cos(TILT)])
    rise, run = rays @ up, rays @ away
    depth = np.full(SHAPE, np.nan)
    if table:
        depth = np.where(rise < 0, -CAMERA_HEIGHT / np.minimum(rise, -1e-9), np.nan)
        depth = np.where(depth < 3, depth, np.nan)
    colour = np.full((*SHAPE, 3), 180, np.uint8)
    owner = np.full(SHAPE, -1)
    for number, card in enumerate(cards):
        z = card.away / run
        right = rays[..., 0] * z - card.right + card.width / 2
        above = rise * z + CAMERA_HEIGHT
        hit = (right >= 0) & (right < card.width) & (above >= 0) & (above < card.height)
        hit &= ~(z >= depth)
        depth[hit], owner[hit] = z[hit], number
        texture = texture_of(card.seed)
        rows = (above[hit] / 0.2 * len(texture)).astype(int) % len(texture)
        columns = (right[hit] / 0.2 * len(texture)).astype(int) % len(texture)
        colour[hit] = texture[rows, columns]
    noisy = depth + chance.normal(0, 1, SHAPE) * noise * np.nan_to_num(depth) ** 2
    grain = chance.normal(0, 3, colour.shape)
    return Frame(
        np.clip(colour + grain, 0, 255).astype(np.uint8),
        noisy.astype(np.float32),
        LENS,
        0.0,
        {str(i): owner == i for i in range(len(cards))},
    )


def texture_of(seed: int) -> NDArray[np.uint8]:
    """Blotches (200, 200, 3) of some size, which SIFT finds and tells apart."""
    chance = np.random.default_rng(seed)
    blotches = chance.integers(0, 255, (25, 25, 3)).repeat(8, axis=0).repeat(8, axis=1)
    return blotches.astype(np.uint8)


class Camera:
    """A sensor that gives these frames again and again."""

    name = "by hand"

    def __init__(self, *frames: Frame) -> None:
        self.frames = frames
        self.given = 0

    def frame(self) -> Frame:
        self.given += 1
        return self.frames[(self.given - 1) % len(self.frames)]

    def close(self) -> None:
        pass


def share(mask: NDArray[np.bool_], region: Region) -> float:
    """Pixels in both over pixels in either."""
    return float((mask & region.mask).sum() / (mask | region.mask).sum())


def percept_of(
    chance: np.random.Generator, prototype: NDArray[np.float64], scans: int = 2
) -> Percept:
    """A percept whose descriptors are the prototypes (n, 128), each seen with noise."""
    frame = frame_of(Card(0, 0.8))
    region = region_of(frame, frame.outlines["0"])
    return Percept(region, tuple(_scan(chance, prototype) for _ in range(scans)))


def prototypes(seed: int, count: int = 60) -> NDArray[np.float64]:
    """Descriptors (count, 128) as peaked as those of SIFT are."""
    return np.random.default_rng(seed).gamma(0.4, 40.0, (count, 128))


def _scan(chance: np.random.Generator, prototype: NDArray[np.float64]) -> Features:
    noisy = prototype + chance.normal(0, 4, prototype.shape)
    count = len(prototype)
    return Features(
        np.clip(noisy, 0, 255).astype(np.uint8),
        chance.uniform(0, 480, (count, 2)).astype(np.float32),
        np.tile(np.float32([0.1, 0.2, 0.9]), (count, 1)),
    )
