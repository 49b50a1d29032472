"""A thing to be rendered: triangles with normals, and one texture for all its parts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.scene import Colour
from kille.sensors.synthetic.shapes import Grid

TEXELS_PER_METRE = 1000.0
"""How finely pictures are printed: about 1.7 texels a pixel at the table's middle.

Much finer textures would flicker from pixel to pixel, since rendering takes one sample.
"""


@dataclass(frozen=True, eq=False)
class Part:
    """A sheet of points (rows, columns, 3) in metres with a picture printed on it."""

    points: Grid
    picture: Colour


@dataclass(frozen=True, eq=False)
class Model:
    """A thing that stands on z = 0 around the origin, its front towards -y.

    vertices, normals (n, 3) float32 in metres; uv (n, 2) float32 as (column, row) of
    the texture in texels; triangles (m, 3) int32; texture (h, w, 3) uint8.
    """

    vertices: NDArray[np.float32]
    normals: NDArray[np.float32]
    uv: NDArray[np.float32]
    triangles: NDArray[np.int32]
    texture: Colour

    @cached_property
    def size(self) -> NDArray[np.float32]:
        """Width, depth and height of the box around it, in metres."""
        extent: NDArray[np.float32] = np.ptp(self.vertices, axis=0)
        return extent

    @cached_property
    def footprint(self) -> NDArray[np.float32]:
        """What it covers from above: the convex hull (k, 2) of its (x, y)."""
        ground = np.ascontiguousarray(self.vertices[:, :2])
        return cv2.convexHull(ground)[:, 0].astype(np.float32)


def assembled(parts: Sequence[Part]) -> Model:
    """The parts as one model, set down on z = 0 around the origin."""
    pictures = [_printed(part) for part in parts]
    texture, tops = _stacked(pictures)
    sheets = [
        _sheet(part.points, picture.shape, top)
        for part, picture, top in zip(parts, pictures, tops, strict=True)
    ]
    sizes = [len(vertices) for vertices, _, _, _ in sheets]
    firsts = np.concatenate([[0], np.cumsum(sizes)[:-1]])
    return Model(
        vertices=standing(np.concatenate([sheet[0] for sheet in sheets])),
        normals=np.concatenate([sheet[1] for sheet in sheets]),
        uv=np.concatenate([sheet[2] for sheet in sheets]),
        triangles=np.concatenate(
            [sheet[3] + first for sheet, first in zip(sheets, firsts, strict=True)]
        ).astype(np.int32),
        texture=texture,
    )


def standing(vertices: NDArray[np.floating]) -> NDArray[np.float32]:
    """The vertices shifted so that their box stands on z = 0 around the origin."""
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    middle = (low + high) / 2
    ground = np.array([middle[0], middle[1], low[2]])
    return np.asarray(vertices - ground, np.float32)


def smooth_normals(
    vertices: NDArray[np.floating], triangles: NDArray[np.int32]
) -> NDArray[np.float32]:
    """Unit normals (n, 3), each the mean over the triangles that meet at that place.

    Vertices at the same place share their normal, so that no seam shows.
    """
    _, place = np.unique(np.round(vertices, 6), axis=0, return_inverse=True)
    place = place.reshape(-1)
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    face = np.cross(b - a, c - a)
    total = np.stack(
        [
            np.bincount(
                place[triangles].ravel(),
                weights=np.repeat(face[:, axis], 3),
                minlength=len(vertices),
            )
            for axis in range(3)
        ],
        axis=1,
    )
    length = np.linalg.norm(total, axis=1, keepdims=True)
    return np.asarray((total / np.maximum(length, 1e-12))[place], np.float32)


def _printed(part: Part) -> Colour:
    """The picture at the number of texels that the sheet's size asks for."""
    steps_right = np.linalg.norm(np.diff(part.points, axis=1), axis=2).sum(axis=1)
    steps_down = np.linalg.norm(np.diff(part.points, axis=0), axis=2).sum(axis=0)
    width = int(np.clip(steps_right.max() * TEXELS_PER_METRE, 4, 1500))
    height = int(np.clip(steps_down.max() * TEXELS_PER_METRE, 4, 1500))
    rows, columns = part.picture.shape[:2]
    shrinks = width * height < rows * columns
    how = cv2.INTER_AREA if shrinks else cv2.INTER_CUBIC
    return cv2.resize(part.picture, (width, height), interpolation=how).astype(np.uint8)


def _stacked(pictures: Sequence[Colour]) -> tuple[Colour, list[int]]:
    """The pictures one under the other, and the row where each begins."""
    width = max(picture.shape[1] for picture in pictures)
    heights = [picture.shape[0] for picture in pictures]
    tops = [0, *np.cumsum(heights)[:-1].tolist()]
    texture = np.zeros((sum(heights), width, 3), np.uint8)
    for picture, top in zip(pictures, tops, strict=True):
        texture[top : top + picture.shape[0], : picture.shape[1]] = picture
    return texture, tops


def _sheet(
    points: Grid, picture: tuple[int, ...], top: int
) -> tuple[Grid, NDArray[np.float32], NDArray[np.float32], NDArray[np.int32]]:
    """Vertices, normals, texels and triangles of one sheet.

    The rim of a sheet lies on the centres of its picture's outer texels, so that no
    neighbour in the texture shines through.
    """
    rows, columns = points.shape[:2]
    vertices = points.reshape(-1, 3)
    across = np.linspace(0, picture[1] - 1, columns)
    down = top + np.linspace(0, picture[0] - 1, rows)
    uv = np.stack(np.meshgrid(across, down), axis=2).reshape(-1, 2)
    index = np.arange(rows * columns).reshape(rows, columns)
    a, b = index[:-1, :-1].ravel(), index[:-1, 1:].ravel()
    c, d = index[1:, :-1].ravel(), index[1:, 1:].ravel()
    halves = [np.stack([a, c, b], axis=1), np.stack([b, c, d], axis=1)]
    triangles = np.concatenate(halves).astype(np.int32)
    normals = smooth_normals(vertices, triangles)
    return vertices, normals, uv.astype(np.float32), triangles
