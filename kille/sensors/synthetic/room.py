"""The room without things: a table, the wall behind it and the floor below."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.scene import Colour, Depth, Mask
from kille.sensors.pictures import read_colour
from kille.sensors.synthetic.camera import HEIGHT, WIDTH, SimulatedCamera

TABLE_LEFT, TABLE_RIGHT = -0.70, 0.70
TABLE_NEAR, TABLE_END = -0.60, 0.50
_WALL = 0.85
_FLOOR = -0.72
_FINER = 2
_WOOD = Path(__file__).with_name("wood.png")  # two millimetres a texel


@dataclass(frozen=True, eq=False)
class Room:
    """The empty room as the camera sees it, and which pixels are table top."""

    colour: Colour
    depth: Depth
    table: Mask


@lru_cache(maxsize=4)
def room(camera: SimulatedCamera) -> Room:
    """The empty room, computed once for a camera.

    Every pixel's ray is met with the table, the wall and the floor; colour is the mean
    of four rays, depth that of the pixel's middle.
    """
    depth, table, _ = _meet_rays(camera, *_grid(1))
    fine = _paint_places(*_meet_rays(camera, *_grid(_FINER)))
    colour = cv2.resize(fine, (WIDTH, HEIGHT), interpolation=cv2.INTER_AREA)
    picture = np.clip(colour, 0, 255).astype(np.uint8)
    for array in (picture, depth, table):
        array.flags.writeable = False
    return Room(picture, depth, table)


def _grid(finer: int) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """The pixel coordinates of `finer` squared rays in every pixel."""
    u = ((np.arange(WIDTH * finer) + 0.5) / finer - 0.5).astype(np.float32)
    v = ((np.arange(HEIGHT * finer) + 0.5) / finer - 0.5).astype(np.float32)
    columns, rows = np.meshgrid(u, v)
    return columns, rows


def _meet_rays(
    camera: SimulatedCamera, u: NDArray[np.float32], v: NDArray[np.float32]
) -> tuple[Depth, Mask, NDArray[np.float32]]:
    """Depth, whether it is table, and the place (.., 3) that each pixel's ray meets."""
    lens = camera.intrinsics
    rays = np.stack(
        [(u - lens.cx) / lens.fx, (v - lens.cy) / lens.fy, np.ones_like(u)], axis=2
    )
    ways = rays @ camera.rotation.astype(np.float32)
    lens_x, lens_y, lens_z = camera.position.tolist()
    down = np.minimum(ways[..., 2], -1e-6)
    to_table = -lens_z / down
    table = _on_table(
        lens_x + to_table * ways[..., 0], lens_y + to_table * ways[..., 1]
    )
    to_wall = (_WALL - lens_y) / np.maximum(ways[..., 1], 1e-6)
    to_floor = (_FLOOR - lens_z) / down
    depth = np.where(table, to_table, np.minimum(to_wall, to_floor))
    places = camera.position.astype(np.float32) + depth[..., None] * ways
    return depth, table, places


def _on_table(x: NDArray[np.float32], y: NDArray[np.float32]) -> Mask:
    inside: Mask = (
        (x > TABLE_LEFT) & (x < TABLE_RIGHT) & (y > TABLE_NEAR) & (y < TABLE_END)
    )
    return inside


def _paint_places(
    depth: Depth, table: Mask, places: NDArray[np.float32]
) -> NDArray[np.float32]:
    """The colour of every place: wood, plaster or carpet, lit from the upper left."""
    x, y, z = (places[..., axis] for axis in range(3))
    on_wall = ~table & (y > _WALL - 1e-3)
    colour = np.full((*depth.shape, 3), (118, 112, 106), np.float32)
    colour[on_wall] = (202, 200, 192)
    colour[table] = cv2.remap(
        read_colour(_WOOD),
        ((x - TABLE_LEFT) * 500).astype(np.float32),
        ((TABLE_END - y) * 500).astype(np.float32),
        cv2.INTER_LINEAR,
        borderMode=cv2.BORDER_REPLICATE,
    )[table]
    light = np.where(on_wall, 1.0 + 0.12 * z - 0.08 * x, 1.0 - 0.10 * x - 0.06 * y)
    return colour * light[..., None].astype(np.float32)
