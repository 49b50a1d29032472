"""Where things stand: ready-made scenes, spots beside a landmark, and what fits."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from kille.sensors.synthetic.posed_camera import HEIGHT, WIDTH, SimulatedCamera
from kille.sensors.synthetic.render import Pose, PosedToy, render_scene
from kille.sensors.synthetic.room import TABLE_END, TABLE_LEFT, TABLE_NEAR, TABLE_RIGHT
from kille.sensors.synthetic.toy_model import ToyModel

SCENES: Mapping[str, Mapping[str, Pose]] = {
    "desk": {
        "book": Pose(-0.25, 0.10, 14),
        "cup": Pose(0.02, -0.09, -8),
        "car": Pose(0.21, 0.10, -4),
    },
    "empty": {},
    "all": {
        "apple": Pose(-0.08, -0.24),
        "banana": Pose(0.17, -0.25),
        "teddy bear": Pose(0.08, 0.22, 5),
        "book": Pose(-0.34, 0.13, 12),
        "cap": Pose(0.35, 0.00, 8),
        "car": Pose(-0.27, -0.13),
        "cup": Pose(0.06, -0.06, -5),
        "can of paint": Pose(-0.12, 0.05, -8),
        "shoe": Pose(-0.21, 0.35),
        "shoe-box": Pose(0.37, 0.32, -12),
    },
}
"""The scenes by name: what stands where before chance moves it a little."""

_DIRECTIONS = {
    "left of": 180.0,
    "right of": 0.0,
    "in front of": -90.0,
    "behind": 90.0,
}
_TRIES = 40
_BORDER = 4
_APART = 0.008
_SEEN = 0.3


def jitter_pose(
    pose: Pose, rng: np.random.Generator, metres: float, degrees: float
) -> Pose:
    """The pose moved by up to so many metres each way, turned by up to degrees."""
    right, away = rng.uniform(-metres, metres, 2)
    turn = rng.uniform(-degrees, degrees)
    return Pose(
        pose.right + float(right), pose.away + float(away), pose.turn + float(turn)
    )


def poses_beside(
    model: ToyModel, relation: str, landmark: PosedToy, rng: np.random.Generator
) -> Iterator[Pose]:
    """Poses in a relation to the landmark, ever freer, for the first that fits.

    `relation` is one of `left of`, `right of`, `in front of`, `behind`, `near`. Things
    are a hand's breadth apart at first, counted from hull to hull; the direction is off
    by at most 20 degrees, save for `near`, which takes any.
    """
    around = _hull(landmark) - [landmark.pose.right, landmark.pose.away]
    for number in range(_TRIES):
        freedom = number / _TRIES
        degrees = rng.uniform(-1, 1) * (8 + 12 * freedom)
        angle = np.radians(_DIRECTIONS.get(relation, rng.uniform(-180, 180)) + degrees)
        way = np.array([np.cos(angle), np.sin(angle)])
        turned = Pose(0, 0, float(rng.uniform(-12, 12)))
        reach = (around @ way).max() + (
            turned.turn_points(model.footprint) @ -way
        ).max()
        gap = rng.uniform(0.04, 0.07) + rng.uniform(0, 0.12) * freedom
        right, away = way * (reach + gap)
        yield Pose(
            landmark.pose.right + float(right),
            landmark.pose.away + float(away),
            turned.turn,
        )


def objection(
    camera: SimulatedCamera, name: str, bodies: Mapping[str, PosedToy]
) -> str | None:
    """Why the named body cannot stand where it does among the others, or None.

    It must stand on the table, lie in the picture, not cut into another thing, and at
    least three tenths of it and of every other thing must be seen.
    """
    body = bodies[name]
    hull = _hull(body)
    if not _on_table(hull):
        return "it would not stand on the table"
    if not _in_picture(camera, body):
        return "the camera would not see all of it"
    for other, neighbour in bodies.items():
        if other != name and _meet(hull, _hull(neighbour)):
            return f"it would cut into the {other}"
    hidden = _hidden_thing(camera, bodies)
    if hidden is None:
        return None
    return "it would be hidden" if hidden == name else f"it would hide the {hidden}"


def _hull(body: PosedToy) -> NDArray[np.float64]:
    """What the body covers of the table, as a convex polygon (k, 2)."""
    return body.pose.move_points(body.model.footprint)


def _on_table(hull: NDArray[np.float64]) -> bool:
    inside = (hull > (TABLE_LEFT, TABLE_NEAR)) & (hull < (TABLE_RIGHT, TABLE_END))
    return bool(inside.all())


def _in_picture(camera: SimulatedCamera, body: PosedToy) -> bool:
    pixels = camera.pixels(body.pose.move_points(body.model.vertices))
    size = np.array([WIDTH, HEIGHT])
    return bool(((pixels > _BORDER) & (pixels < size - _BORDER)).all())


def _meet(hull: NDArray[np.float64], other: NDArray[np.float64]) -> bool:
    """Whether two convex polygons come nearer than `_APART`.

    Two convex polygons are apart just when a side of one of them parts them.
    """
    gaps = np.concatenate([_gaps(hull, other), _gaps(other, hull)])
    return bool(gaps.max() < _APART)


def _gaps(hull: NDArray[np.float64], other: NDArray[np.float64]) -> NDArray[np.float64]:
    """How far the other polygon lies beyond each side (k,) of this one, in metres."""
    sides = np.roll(hull, -1, axis=0) - hull
    normals = np.stack([sides[:, 1], -sides[:, 0]], axis=1)
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
    outward = np.sign(np.sum(normals * (hull - hull.mean(axis=0)), axis=1))
    normals *= outward[:, None]
    beyond = (other @ normals.T).min(axis=0)
    gaps: NDArray[np.float64] = beyond - np.sum(normals * hull, axis=1)
    return gaps


def _hidden_thing(
    camera: SimulatedCamera, bodies: Mapping[str, PosedToy]
) -> str | None:
    """A thing of which too little is seen among the others, if there is one."""
    if not any(_cross(camera, a, b) for a, b in combinations(bodies.values(), 2)):
        return None
    outlines = render_scene(camera, bodies).outlines
    for name, body in bodies.items():
        alone = render_scene(camera, {name: body}).outlines
        if name not in outlines:
            return name
        if outlines[name].sum() < _SEEN * alone[name].sum():
            return name
    return None


def _cross(camera: SimulatedCamera, body: PosedToy, other: PosedToy) -> bool:
    """Whether the boxes around two bodies in the picture meet."""
    a = camera.pixels(body.pose.move_points(body.model.vertices))
    b = camera.pixels(other.pose.move_points(other.model.vertices))
    low = np.maximum(a.min(axis=0), b.min(axis=0))
    high = np.minimum(a.max(axis=0), b.max(axis=0))
    return bool((low < high).all())
