"""The posed camera, and the table it looks at.

Table axes: x to the right as the camera sees it, y away from it, z up, in metres, the
origin in the middle of the table top. Camera axes are those of `kille.scene`.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from kille.scene import Intrinsics, Point

WIDTH, HEIGHT = 640, 480
NEAR, FAR = 0.1, 10.0
KINECT = Intrinsics(fx=525.0, fy=525.0, cx=319.5, cy=239.5)


@dataclass(frozen=True)
class SimulatedCamera:
    """A pinhole camera that looks at the table's middle from a distance, downwards.

    `distance` in metres from the lens to the table's middle; `tilt` in degrees below
    the horizontal.
    """

    distance: float = 0.9
    tilt: float = 33.0
    intrinsics: Intrinsics = KINECT

    @cached_property
    def position(self) -> NDArray[np.float64]:
        """The lens in table axes."""
        tilt = np.radians(self.tilt)
        return self.distance * np.array([0.0, -np.cos(tilt), np.sin(tilt)])

    @cached_property
    def rotation(self) -> NDArray[np.float64]:
        """The matrix (3, 3) from table to camera axes: rows right, down, forward."""
        sine, cosine = np.sin(np.radians(self.tilt)), np.cos(np.radians(self.tilt))
        return np.array([[1, 0, 0], [0, -sine, -cosine], [0, cosine, -sine]])

    @property
    def up(self) -> tuple[float, float, float]:
        """The table's normal as a unit vector in camera axes."""
        x, y, z = self.rotation[:, 2].tolist()
        return (x, y, z)

    @property
    def height(self) -> float:
        """How far the lens is above the table; on the table, up . point = -height."""
        return float(self.position[2])

    def points(self, points: NDArray[np.floating]) -> NDArray[np.float64]:
        """Points (n, 3) of the table's axes in the camera's."""
        there: NDArray[np.float64] = (points - self.position) @ self.rotation.T
        return there

    def pixels(self, points: NDArray[np.floating]) -> NDArray[np.float64]:
        """Where points (n, 3) of the table's axes are in the picture, as (u, v)."""
        x, y, z = self.points(points).T
        lens = self.intrinsics
        return np.stack([lens.fx * x / z + lens.cx, lens.fy * y / z + lens.cy], axis=1)

    def point(self, place: NDArray[np.floating]) -> Point:
        """One place (3,) of the table's axes in the camera's."""
        x, y, z = self.points(place[None])[0].tolist()
        return Point(x, y, z)
