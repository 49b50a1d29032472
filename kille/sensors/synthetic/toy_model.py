"""A thing to be rendered: triangles with normals, and one texture for all its parts."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.scene import Colour

TEXELS_PER_METRE = 1000.0
"""How finely pictures are printed: about 1.7 texels a pixel at the table's middle.

Much finer textures would flicker from pixel to pixel, since rendering takes one sample.
"""


@dataclass(frozen=True, eq=False)
class ToyModel:
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


def set_down(vertices: NDArray[np.floating]) -> NDArray[np.float32]:
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
