"""Things on the table as the camera sees them: colour, true depth, who is where.

`cv2.triangleRasterize` interpolates three numbers over every triangle, perspective
correct. They are the texture's column and row, and the thing's number plus its light,
which share the third channel: number + light with 0 < light < 1. Triangles of two
things share no vertex, so that numbers never mix.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.scene import Colour, Depth, Mask
from kille.sensors.synthetic.posed_camera import (
    FAR,
    HEIGHT,
    NEAR,
    WIDTH,
    SimulatedCamera,
)
from kille.sensors.synthetic.room import Room, room
from kille.sensors.synthetic.toy_model import ToyModel

_TO_LIGHT = np.array([-0.42, -0.50, 0.76]) / np.linalg.norm([-0.42, -0.50, 0.76])
_AMBIENT, _FROM_ABOVE, _DIRECT = 0.50, 0.12, 0.62
_FULL_LIGHT = 1.3
_SHADOW = 0.42
_LENS_BLUR = 0.65
_NOTHING = 0.99 * FAR
_TO_GL = np.diag([1.0, -1.0, -1.0, 1.0]).astype(np.float32)
_SETTINGS = (
    cv2.TriangleRasterizeSettings()
    .setShadingType(cv2.RASTERIZE_SHADING_SHADED)
    .setCullingMode(cv2.RASTERIZE_CULLING_CW)
)


@dataclass(frozen=True)
class Pose:
    """Where a thing stands: metres right and away, turned by degrees.

    A positive turn is counter-clockwise seen from above.
    """

    right: float
    away: float
    turn: float = 0.0

    def turn_points(self, points: NDArray[np.floating]) -> NDArray[np.float64]:
        """Points or directions (n, 2 or 3) turned about the vertical."""
        sine, cosine = np.sin(np.radians(self.turn)), np.cos(np.radians(self.turn))
        there = points.astype(np.float64)
        x, y = there[:, 0].copy(), there[:, 1].copy()
        there[:, 0], there[:, 1] = cosine * x - sine * y, sine * x + cosine * y
        return there

    def move_points(self, points: NDArray[np.floating]) -> NDArray[np.float64]:
        """Points (n, 2 or 3) moved from around the origin to their place."""
        there = self.turn_points(points)
        there[:, :2] += (self.right, self.away)
        return there


@dataclass(frozen=True, eq=False)
class PosedToy:
    """A model in its pose."""

    model: ToyModel
    pose: Pose


@dataclass(frozen=True, eq=False)
class RenderedScene:
    """A rendered scene: colour, exact depth in metres, and the mask of each thing.

    The arrays are read-only, since frames share them.
    """

    colour: Colour
    depth: Depth
    outlines: Mapping[str, Mask]


@dataclass(frozen=True, eq=False)
class _Triangles:
    """All the bodies' triangles at once.

    vertices (n, 3) float64 in table axes; attributes (n, 3) float32 to interpolate;
    indices (m, 3) int32.
    """

    vertices: NDArray[np.float64]
    attributes: NDArray[np.float32]
    indices: NDArray[np.int32]


def render_scene(
    camera: SimulatedCamera, bodies: Mapping[str, PosedToy]
) -> RenderedScene:
    """The room with the bodies in it; a thing that is wholly hidden has no outline."""
    empty = room(camera)
    if not bodies:
        return RenderedScene(empty.colour, empty.depth, MappingProxyType({}))
    triangles = _triangles(list(bodies.values()))
    channels, depth = _rasterize(camera, triangles, empty)
    colour = _with_shadows(camera, triangles, empty)
    outlines = {}
    for number, (name, body) in enumerate(bodies.items(), start=1):
        window = _window(camera.pixels(body.pose.move_points(body.model.vertices)))
        mask = channels[window][..., 2].astype(np.uint8) == number
        if not mask.any():
            continue
        _paint(colour[window], channels[window], mask, number, body.model.texture)
        outlines[name] = np.zeros((HEIGHT, WIDTH), bool)
        outlines[name][window] = mask
    soft = cv2.GaussianBlur(colour, (3, 3), _LENS_BLUR).astype(np.uint8, copy=False)
    soft.flags.writeable = depth.flags.writeable = False
    for mask in outlines.values():
        mask.flags.writeable = False
    return RenderedScene(soft, depth, MappingProxyType(outlines))


def _triangles(bodies: Sequence[PosedToy]) -> _Triangles:
    sizes = [len(body.model.vertices) for body in bodies]
    firsts = [0, *np.cumsum(sizes)[:-1].tolist()]
    numbers = np.repeat(np.arange(1, len(bodies) + 1), sizes)
    normals = np.concatenate(
        [body.pose.turn_points(body.model.normals) for body in bodies]
    )
    attributes = np.empty((sum(sizes), 3), np.float32)
    attributes[:, :2] = np.concatenate([body.model.uv for body in bodies])
    attributes[:, 2] = numbers + _light(normals)
    indices = [
        body.model.triangles + first for body, first in zip(bodies, firsts, strict=True)
    ]
    return _Triangles(
        vertices=np.concatenate(
            [body.pose.move_points(body.model.vertices) for body in bodies]
        ),
        attributes=attributes,
        indices=np.concatenate(indices).astype(np.int32),
    )


def _light(normals: NDArray[np.float64]) -> NDArray[np.float64]:
    """Each vertex's light from 0 to 1, where 1 is `_FULL_LIGHT` times its colour."""
    direct = _DIRECT * np.maximum(normals @ _TO_LIGHT, 0)
    lit = _AMBIENT + _FROM_ABOVE * normals[:, 2] + direct
    return np.asarray(np.clip(lit / _FULL_LIGHT, 0.02, 0.98), np.float64)


def _rasterize(
    camera: SimulatedCamera, triangles: _Triangles, empty: Room
) -> tuple[NDArray[np.float32], Depth]:
    """The three channels, zero where only the room is seen, and the depth."""
    channels, depth = cv2.triangleRasterize(
        camera.points(triangles.vertices).astype(np.float32),
        triangles.indices,
        triangles.attributes,
        np.zeros((HEIGHT, WIDTH, 3), np.float32),
        empty.depth.copy(),
        _TO_GL,
        _field_of_view(camera),
        NEAR,
        FAR,
        _SETTINGS,
    )
    return channels.astype(np.float32, copy=False), depth.astype(np.float32, copy=False)


def _field_of_view(camera: SimulatedCamera) -> float:
    """The vertical opening in radians, as OpenGL counts it."""
    return float(2 * np.arctan(HEIGHT / 2 / camera.intrinsics.fy))


def _window(pixels: NDArray[np.float64], margin: int = 0) -> tuple[slice, slice]:
    """The rows and columns of the picture around pixels (n, 2)."""
    left, top, width, height = cv2.boundingRect(pixels.astype(np.float32))
    rows = np.clip([top - margin, top + height + margin], 0, HEIGHT)
    columns = np.clip([left - margin, left + width + margin], 0, WIDTH)
    return slice(int(rows[0]), int(rows[1])), slice(int(columns[0]), int(columns[1]))


def _paint(
    colour: Colour,
    channels: NDArray[np.float32],
    mask: Mask,
    number: int,
    texture: Colour,
) -> None:
    """Lay a thing's texture, lit, on its pixels of the picture."""
    u, v, light = cv2.split(channels)
    texels = cv2.remap(texture, u, v, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
    light = (light - number) * _FULL_LIGHT
    lit = cv2.multiply(texels, cv2.merge([light, light, light]), dtype=cv2.CV_8U)
    cv2.copyTo(lit, mask.view(np.uint8), colour)


def _with_shadows(
    camera: SimulatedCamera, triangles: _Triangles, empty: Room
) -> Colour:
    """The empty room's colour with the shadows that the things cast on the table.

    A shadow is the thing pressed flat on the table along the light, drawn at half the
    resolution and then blurred, as a lamp with a shade would make it.
    """
    colour = empty.colour.copy()
    flat = triangles.vertices
    flat = flat - _TO_LIGHT * (flat[:, 2:] / _TO_LIGHT[2])
    window = _window(camera.pixels(flat), margin=8)
    if colour[window].size == 0:
        return colour
    depth = cv2.triangleRasterizeDepth(
        camera.points(flat).astype(np.float32),
        triangles.indices,
        np.full((HEIGHT // 2, WIDTH // 2), FAR, np.float32),
        _TO_GL,
        _field_of_view(camera),
        NEAR,
        FAR,
        _SETTINGS,
    )
    dark = cv2.GaussianBlur(
        (np.asarray(depth) < _NOTHING).astype(np.float32), (0, 0), 2.2
    )
    dark = cv2.resize(dark, (WIDTH, HEIGHT))[window]
    left = (1 - _SHADOW * dark * empty.table[window]).astype(np.float32)
    lit = colour[window]
    lit[:] = cv2.multiply(lit, cv2.merge([left, left, left]), dtype=cv2.CV_8U)
    return colour
