"""Shapes as grids of points, each a sheet on which a picture is printed.

A grid has the shape (rows, columns, 3), in metres, x to the right, y away from the
viewer, z up. Seen from outside, its first row is the picture's top and its first column
the picture's left; so the outward normal is down x right everywhere.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

Grid = NDArray[np.float64]


def move(points: Grid, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Grid:
    """The points shifted by (x, y, z)."""
    there: Grid = points + np.array([x, y, z])
    return there


def turn(points: Grid, axis: ArrayLike, degrees: float) -> Grid:
    """The points turned about an axis through the origin, by the right-hand rule.

    >>> turn(np.array([[1.0, 0.0, 0.0]]), (0, 0, 1), 90).round(6) + 0.0
    array([[0., 1., 0.]])
    """
    return points @ rotation(axis, degrees).T


def rotation(axis: ArrayLike, degrees: float) -> NDArray[np.float64]:
    """The matrix of a turn about an axis (Rodrigues): I + sin t K + (1 - cos t) K^2."""
    x, y, z = np.asarray(axis, np.float64) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    angle = np.radians(degrees)
    turn: NDArray[np.float64] = (
        np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    )
    return turn


def inside_out(points: Grid) -> Grid:
    """The same sheet seen from its other side, the picture reading rightly there."""
    return points[:, ::-1]


def lathe(profile: ArrayLike, segments: int = 32) -> Grid:
    """The surface of (radius, height) turned about the vertical, top first.

    The middle column faces the viewer (-y); the seam is at the back.
    """
    radius, height = np.asarray(profile, np.float64).T
    angle = np.linspace(-np.pi, np.pi, segments + 1)
    return np.stack(
        [
            np.outer(radius, np.sin(angle)),
            np.outer(radius, -np.cos(angle)),
            np.repeat(height[:, None], segments + 1, axis=1),
        ],
        axis=2,
    )


def ellipsoid(radii: ArrayLike, segments: int = 24) -> Grid:
    """An ellipsoid about the origin with the radii (x, y, z)."""
    angle = np.linspace(0, np.pi, segments // 2 + 1)
    ball = lathe(np.stack([np.sin(angle), np.cos(angle)], axis=1), segments)
    return ball * np.asarray(radii, np.float64)


def tube(
    path: ArrayLike, radii: ArrayLike, segments: int = 12, flatten: float = 1.0
) -> Grid:
    """A tube around a path (n, 3) with a radius for each point, or one for all.

    Columns run along the path, rows around it, starting underneath. `flatten` scales
    the section in the direction that is closest to the vertical.
    """
    points = np.asarray(path, np.float64)
    along = np.gradient(points, axis=0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    side = np.cross(along, _across(along))
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    high = np.cross(side, along)
    angle = np.linspace(-np.pi, np.pi, segments + 1)[:, None, None]
    ring = np.sin(angle) * side + np.cos(angle) * high * flatten
    width = np.broadcast_to(np.asarray(radii, np.float64), len(points))
    return points + ring * width[:, None]


def _across(along: Grid) -> NDArray[np.float64]:
    """A direction not along the path: up, or away where the path itself goes up."""
    steep = np.abs(along[:, 2]).max() > 0.9
    return np.array([0.0, 1.0, 0.0]) if steep else np.array([0.0, 0.0, 1.0])


def quad(top_left: ArrayLike, top_right: ArrayLike, bottom_left: ArrayLike) -> Grid:
    """A flat rectangle or parallelogram from three of its corners."""
    corner = np.asarray(top_left, np.float64)
    right = np.asarray(top_right, np.float64) - corner
    down = np.asarray(bottom_left, np.float64) - corner
    return np.array([[corner, corner + right], [corner + down, corner + right + down]])


def box(width: float, depth: float, height: float) -> dict[str, Grid]:
    """The six faces of a box that stands on z = 0, by name."""
    x, y, z = width / 2, depth / 2, height
    return {
        "front": quad((-x, -y, z), (x, -y, z), (-x, -y, 0)),
        "back": quad((x, y, z), (-x, y, z), (x, y, 0)),
        "left": quad((-x, y, z), (-x, -y, z), (-x, y, 0)),
        "right": quad((x, -y, z), (x, y, z), (x, -y, 0)),
        "top": quad((-x, y, z), (x, y, z), (-x, -y, z)),
        "bottom": quad((-x, -y, 0), (x, -y, 0), (-x, y, 0)),
    }


def disc(radius: float, segments: int = 24) -> Grid:
    """A flat disc at z = 0 seen from above; rows run from its rim's back to its front.

    Every row is a chord, so that a square picture lies on it as it is drawn.
    """
    angle = np.linspace(0, np.pi, segments // 2 + 1)
    row = np.cos(angle)[:, None] * radius
    half = np.sin(angle)[:, None] * radius
    across = np.linspace(-1, 1, segments // 2 + 1)[None]
    return np.stack(
        [
            half * across,
            np.broadcast_to(row, (len(angle), across.size)),
            0 * half * across,
        ],
        axis=2,
    )


def curve(knots: Sequence[tuple[float, ...]], count: int) -> NDArray[np.float64]:
    """A smooth curve through knots (n, d), by Catmull-Rom, as `count` points.

    >>> curve([(0, 0), (1, 0), (2, 0)], 5)[:, 0].tolist()
    [0.0, 0.4375, 1.0, 1.5625, 2.0]
    """
    known = np.asarray(knots, np.float64)
    padded = np.concatenate([known[:1], known, known[-1:]])
    place = np.linspace(0, len(known) - 1, count)
    start = np.minimum(place.astype(int), len(known) - 2)
    t = (place - start)[:, None]
    a, b, c, d = (padded[start + k] for k in range(4))
    smooth: NDArray[np.float64] = b + 0.5 * t * (
        c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a))
    )
    return smooth
