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
from kille.sensors.synthetic.posed_camera import HEIGHT, WIDTH, SimulatedCamera

TABLE_LEFT, TABLE_RIGHT = -0.70, 0.70
TABLE_NEAR, TABLE_END = -0.60, 0.50
_WALL = 0.85
_FLOOR = -0.72
_FINER = 2
_PLASTER, _CARPET = (202, 200, 192), (118, 112, 106)
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
    met = _meet_rays(camera, 1)
    fine = _paint(_meet_rays(camera, _FINER))
    colour = cv2.resize(fine, (WIDTH, HEIGHT), interpolation=cv2.INTER_AREA)
    picture = np.clip(colour, 0, 255).astype(np.uint8)
    for array in (picture, met.depth, met.table):
        array.flags.writeable = False
    return Room(picture, met.depth, met.table)


Grid = NDArray[np.float32]
"""A number for each ray, in rows and columns, or for each row."""


@dataclass(frozen=True, eq=False)
class _Places:
    """Where rays meet the room: the depth, x, y and z in metres, what is table top."""

    depth: Depth
    x: Grid
    y: Grid
    z: Grid
    table: Mask


def _meet_rays(camera: SimulatedCamera, finer: int) -> _Places:
    """Where `finer` squared rays in every pixel meet the room.

    The camera does not roll, so that a row meets the planes at one depth each.
    """
    lens = camera.intrinsics
    u = _middles(WIDTH, finer, lens.cx, lens.fx)
    v = _middles(HEIGHT, finer, lens.cy, lens.fy)[:, None]
    (_, y_of_v, z_of_v), (_, y_ahead, z_ahead) = camera.rotation.astype(np.float32)[1:]
    along_y, along_z = v * y_of_v + y_ahead, v * z_of_v + z_ahead
    lens_x, lens_y, lens_z = camera.position.tolist()
    down = np.minimum(along_z, -1e-6)
    to_table = -lens_z / down
    to_wall = (_WALL - lens_y) / np.maximum(along_y, 1e-6)
    beyond = np.minimum(to_wall, (_FLOOR - lens_z) / down)
    table = _on_table(lens_x + to_table * u, lens_y + to_table * along_y)
    depth = np.where(table, to_table, beyond)
    return _Places(
        depth,
        lens_x + depth * u,
        lens_y + depth * along_y,
        lens_z + depth * along_z,
        table,
    )


def _middles(pixels: int, finer: int, centre: float, focal: float) -> Grid:
    """How far from the axis the rays in a row of pixels lead, at one metre."""
    return (((np.arange(pixels * finer) + 0.5) / finer - 0.5 - centre) / focal).astype(
        np.float32
    )


def _on_table(x: NDArray[np.float32], y: NDArray[np.float32]) -> Mask:
    inside: Mask = (
        (x > TABLE_LEFT) & (x < TABLE_RIGHT) & (y > TABLE_NEAR) & (y < TABLE_END)
    )
    return inside


def _paint(at: _Places) -> NDArray[np.float32]:
    """The colour of every place: wood, plaster or carpet, lit from the upper left."""
    wood = cv2.remap(
        read_colour(_WOOD),
        (at.x - TABLE_LEFT) * 500,
        (TABLE_END - at.y) * 500,
        cv2.INTER_LINEAR,
        borderMode=cv2.BORDER_REPLICATE,
    )
    on_wall = ~at.table & (at.y > _WALL - 1e-3)
    wood[~at.table] = _CARPET
    wood[on_wall] = _PLASTER
    light = np.where(
        on_wall, 1.0 + 0.12 * at.z - 0.08 * at.x, 1.0 - 0.10 * at.x - 0.06 * at.y
    )
    return np.asarray(wood * light[..., None], np.float32)
