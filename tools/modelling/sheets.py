"""Models put together from sheets of points with pictures printed on them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.scene import Colour
from kille.sensors.synthetic.toy_model import (
    TEXELS_PER_METRE,
    ToyModel,
    set_down,
    smooth_normals,
)
from tools.modelling.shapes import Grid


@dataclass(frozen=True, eq=False)
class Sheet:
    """A sheet of points (rows, columns, 3) in metres with a picture printed on it."""

    points: Grid
    picture: Colour


def assemble(parts: Sequence[Sheet]) -> ToyModel:
    """The parts as one model, set down on z = 0 around the origin."""
    pictures = [_print_at_size(part) for part in parts]
    texture, tops = _stack(pictures)
    sheets = [
        _sheet(part.points, picture.shape, top)
        for part, picture, top in zip(parts, pictures, tops, strict=True)
    ]
    sizes = [len(vertices) for vertices, _, _, _ in sheets]
    firsts = np.concatenate([[0], np.cumsum(sizes)[:-1]])
    return ToyModel(
        vertices=set_down(np.concatenate([sheet[0] for sheet in sheets])),
        normals=np.concatenate([sheet[1] for sheet in sheets]),
        uv=np.concatenate([sheet[2] for sheet in sheets]),
        triangles=np.concatenate(
            [sheet[3] + first for sheet, first in zip(sheets, firsts, strict=True)]
        ).astype(np.int32),
        texture=texture,
    )


def _print_at_size(part: Sheet) -> Colour:
    """The picture at the number of texels that the sheet's size asks for."""
    steps_right = np.linalg.norm(np.diff(part.points, axis=1), axis=2).sum(axis=1)
    steps_down = np.linalg.norm(np.diff(part.points, axis=0), axis=2).sum(axis=0)
    width = int(np.clip(steps_right.max() * TEXELS_PER_METRE, 4, 1500))
    height = int(np.clip(steps_down.max() * TEXELS_PER_METRE, 4, 1500))
    rows, columns = part.picture.shape[:2]
    shrinks = width * height < rows * columns
    how = cv2.INTER_AREA if shrinks else cv2.INTER_CUBIC
    return cv2.resize(part.picture, (width, height), interpolation=how).astype(np.uint8)


def _stack(pictures: Sequence[Colour]) -> tuple[Colour, list[int]]:
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
