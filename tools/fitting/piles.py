"""Rendered tables with heaps of things on them: what the merge of patches learns from.

Every third thing is a box, a book or a pack of chance size; the others are tins, pots,
bowls, round toys, scanned objects, and specimens of the ten of the simulation. They
stand in front of each other, touch, lie on each other and lean. No physics is reckoned:
a thing is set down where at least a third of its ground is borne.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.scene import Depth, Frame
from kille.sensors.synthetic import catalogue, obj_files
from kille.sensors.synthetic.faults import depth_jumps, infrared_shadow, lost_edges
from kille.sensors.synthetic.posed_camera import SimulatedCamera
from kille.sensors.synthetic.render import Pose, PosedToy, render_scene
from kille.sensors.synthetic.specimens import specimen
from kille.sensors.synthetic.toy_model import ToyModel
from tools.modelling.shapes import (
    Grid,
    box,
    curve,
    disc,
    ellipsoid,
    inside_out,
    lathe,
    move,
    rotation,
    tube,
)
from tools.modelling.sheets import Sheet, assemble

Chance = np.random.Generator

_PLAIN = np.full((4, 4, 3), 128, np.uint8)
_CELL, _CELLS = 0.004, 300  # metres, and how many of them, of the map of heights
_HIGHEST = 0.25  # metres: nothing is set down higher
_BORNE = 0.35  # the share of its ground that must bear a thing
_LEVEL = 0.006  # metres: what is less deep bears
_TRIES = 8
_SEEN = 250  # pixels: what is seen less of need not be found
_SPECIMENS = 12
_STEP = 0.0028  # 1/m: of an 11-bit disparity


def pile(seed: int, meshes: Sequence[Path] = ()) -> Frame:
    """A frame of a heap of things, always the same for a seed; outlines by number."""
    chance = np.random.default_rng([77, seed])
    camera = SimulatedCamera(chance.uniform(0.75, 1.35), chance.uniform(22, 58))
    heap = _Heap(chance, meshes)
    if chance.random() < 0.3:
        heap.put_before_wider(chance.normal(-0.2, 0.04))
        heap.put_before_wider(chance.normal(0.2, 0.04))
        spread, more = 0.2, int(chance.integers(0, 3))
    else:
        spread, more = chance.uniform(0.03, 0.25), int(chance.integers(1, 12))
    for _ in range(more):
        heap.put_anywhere(spread)
    return _capture_heap(camera, heap)


def hide_middle(seed: int) -> Frame:
    """A frame of wide things of which narrow ones hide the middle; else as `pile`."""
    chance = np.random.default_rng([78, seed])
    camera = SimulatedCamera(chance.uniform(0.75, 1.35), chance.uniform(22, 50))
    heap = _Heap(chance, ())
    for right in (-0.22, 0.22):
        heap.put_screened(right + chance.normal(0, 0.03))
    return _capture_heap(camera, heap)


def tidy(seed: int, meshes: Sequence[Path] = ()) -> Frame:
    """A frame of a few things of many parts that stand apart; else as `pile`."""
    chance = np.random.default_rng([79, seed])
    camera = SimulatedCamera(chance.uniform(0.75, 1.35), chance.uniform(22, 58))
    heap = _Heap(chance, meshes)
    for right in np.linspace(-0.36, 0.36, 4) + chance.uniform(-0.03, 0.03, 4):
        heap.put_down(a_manifold(chance, meshes), float(right))
    return _capture_heap(camera, heap)


def crowd(seed: int, meshes: Sequence[Path] = ()) -> Frame:
    """A frame of packs, tins and mugs close together, stacked or flush; else as `pile`.

    Up to a dozen groups cover the table until only scraps of it are seen. Of every
    other table there is no depth behind the things, as in a capture that was trimmed.
    """
    chance = np.random.default_rng([80, seed])
    camera = SimulatedCamera(chance.uniform(0.7, 1.25), chance.uniform(26, 60))
    heap = _Heap(chance, meshes)
    for _ in range(int(chance.integers(1, 13))):
        heap.put_group()
    frame = _capture_heap(camera, heap)
    return _trim(frame, camera, heap) if chance.random() < 0.5 else frame


def _trim(frame: Frame, camera: SimulatedCamera, heap: _Heap) -> Frame:
    """The frame without depth a little behind the farthest thing, and on the floor."""
    assert frame.depth is not None
    last = max((it.pose.away for it in heap.bodies), default=0.0)
    rows, columns = np.indices(frame.depth.shape)
    lens = camera.intrinsics
    rays = np.stack(
        [(columns - lens.cx) / lens.fx, (rows - lens.cy) / lens.fy, 1 + 0 * rows],
        axis=-1,
    )
    points = (rays * frame.depth[..., None]) @ camera.rotation + camera.position
    gone = points[..., 1] > last + heap.chance.uniform(0.05, 0.2)
    gone |= points[..., 2] < -0.05
    return replace(frame, depth=np.where(gone, np.float32(np.nan), frame.depth))


def _capture_heap(camera: SimulatedCamera, heap: _Heap) -> Frame:
    image = render_scene(camera, {str(i): body for i, body in enumerate(heap.bodies)})
    outlines = {k: mask for k, mask in image.outlines.items() if mask.sum() > _SEEN}
    depth = _measure(image.depth, camera, heap.chance)
    return Frame(image.colour, depth, camera.intrinsics, 0.0, outlines)


@dataclass
class _Heap:
    """Bodies on a table, and how high it is filled."""

    chance: Chance
    meshes: Sequence[Path]
    bodies: list[PosedToy] = field(default_factory=list)
    tops: NDArray[np.float64] = field(
        default_factory=lambda: np.zeros((_CELLS, _CELLS))
    )

    def put_anywhere(self, spread: float) -> None:
        """A thing near the middle, on what is there; none if it finds no hold."""
        for _ in range(_TRIES):
            model = a_thing(self.chance, self.meshes)
            right, away = self.chance.normal(0, spread, 2).clip(-0.35, 0.35)
            pose = Pose(right, away, self.chance.uniform(0, 360))
            under = self.tops[self._ground(model, pose)]
            if not under.size:
                continue
            height = float(under.max())
            borne = np.mean(under > height - _LEVEL) >= _BORNE
            if borne and height <= _HIGHEST:
                return self._put(lift_model(model, height), pose)
            if self.chance.random() < 0.1:
                axis, lean = _level_axis(self.chance), self.chance.uniform(8, 25)
                leaning = turn_model(model, axis, lean)
                return self._put(lift_model(leaning, float(np.median(under))), pose)

    def put_before_wider(self, right: float) -> None:
        """Something wide, and something narrower before it."""
        wide = a_box(self.chance) if self.chance.random() < 0.8 else a_tin(self.chance)
        thin = a_box(self.chance)
        for _ in range(20):
            if thin.size[0] < 0.6 * wide.size[0]:
                break
            thin = a_thing(self.chance, self.meshes)
        away = self.chance.uniform(-0.02, 0.15)
        self._put(wide, Pose(right, away, self.chance.uniform(-40, 40)))
        gap = (wide.size[1] + thin.size[1]) / 2 + self.chance.uniform(0, 0.12)
        aside = right + self.chance.normal(0, 0.02)
        self._put(thin, Pose(aside, away - gap, self.chance.uniform(-90, 90)))

    def put_down(self, model: ToyModel, right: float) -> None:
        """A thing on the table itself."""
        away, turn = self.chance.uniform(-0.2, 0.25), self.chance.uniform(0, 360)
        self._put(model, Pose(right, away, turn))

    def put_screened(self, right: float) -> None:
        """Something wide, and something upright before its middle."""
        height = self.chance.uniform(0.05, 0.26)
        wide = _of(*box(self.chance.uniform(0.14, 0.32), 0.08, height).values())
        if self.chance.random() < 0.25:
            wide = turn_model(_tin(self.chance.uniform(0.04, 0.09), 0.3), (0, 1, 0), 90)
        away = self.chance.uniform(0, 0.15)
        self._put(wide, Pose(right, away, self.chance.uniform(-35, 35)))
        tall = height + self.chance.uniform(-0.03, 0.12)
        narrow = self.chance.uniform(0.04, 0.4 * wide.size[0])
        thin = _of(*box(narrow, self.chance.uniform(0.03, 0.2), tall).values())
        if self.chance.random() < 0.5:
            thin = _tin(narrow / 2, tall)
        gap = (wide.size[1] + thin.size[1]) / 2 + self.chance.uniform(0, 0.1)
        aside = right + self.chance.normal(0, 0.02)
        self._put(thin, Pose(aside, away - gap, self.chance.uniform(-45, 45)))

    def put_group(self) -> None:
        """Packs on or beside each other, or one thing, where there is room."""
        kind = self.chance.random()
        if kind < 0.35:
            group = _stack(self.chance)
        elif kind < 0.6:
            group = _row(self.chance)
        elif kind < 0.8:
            group = [(a_mug(self.chance), 0.0, 0.0)]
        else:
            group = [(a_thing(self.chance, self.meshes), 0.0, 0.0)]
        for _ in range(_TRIES):
            right, away = self.chance.uniform((-0.34, -0.25), (0.34, 0.3))
            place = Pose(right, away, self.chance.uniform(0, 360))
            posed = [
                (model, replace(place, right=float(there[0]), away=float(there[1])))
                for model, x, y in group
                for there in place.move_points(np.array([[x, y]]))
            ]
            if not any(self.tops[self._ground(*it)].any() for it in posed):
                for it in posed:
                    self._put(*it)
                return

    def _put(self, model: ToyModel, pose: Pose) -> None:
        ground = self._ground(model, pose)
        top = float(model.vertices[:, 2].max())
        self.tops[ground] = np.maximum(self.tops[ground], top)
        self.bodies.append(PosedToy(model, pose))

    def _ground(self, model: ToyModel, pose: Pose) -> NDArray[np.bool_]:
        """The cells that a thing in this pose is above."""
        corners = pose.move_points(model.footprint) / _CELL + _CELLS / 2
        cells = np.zeros((_CELLS, _CELLS), np.uint8)
        cv2.fillConvexPoly(cells, corners.astype(np.int32), (1,))
        return cells > 0


def a_thing(chance: Chance, meshes: Sequence[Path]) -> ToyModel:
    """Any thing; without meshes there are more specimens of the ten."""
    kind = chance.random()
    if kind < 0.33:
        return a_box(chance)
    if kind < 0.45:
        return _drop(a_tin(chance), chance, 0.15)
    if kind < 0.55:
        bowl = a_bowl(chance)
        return turn_model(bowl, (1, 0, 0), 180) if chance.random() < 0.15 else bowl
    if kind < 0.65:
        return a_toy(chance)
    if kind < 0.83 and meshes:
        return _scan(chance, meshes)
    return _specimen(chance)


def a_manifold(chance: Chance, meshes: Sequence[Path]) -> ToyModel:
    """A thing that may have many parts: a toy, a scanned one, or one of the ten."""
    kind = chance.random()
    if kind < 0.2:
        return a_toy(chance)
    if kind < 0.4 and meshes:
        return _scan(chance, meshes)
    return _specimen(chance)


def _scan(chance: Chance, meshes: Sequence[Path]) -> ToyModel:
    return _drop(
        obj_files.load_scan(meshes[int(chance.integers(len(meshes)))]), chance, 0.35
    )


def _specimen(chance: Chance) -> ToyModel:
    name = catalogue.TOY_NAMES[int(chance.integers(len(catalogue.TOY_NAMES)))]
    return specimen(name, int(chance.integers(_SPECIMENS)))


def a_box(chance: Chance) -> ToyModel:
    """A book, an upright pack, a lying one, or a small box."""
    low, high = _BOXES[int(chance.integers(len(_BOXES)))]
    faces = box(*chance.uniform(low, high))
    return _of(*faces.values())


_BOXES = (
    ((0.12, 0.12, 0.01), (0.25, 0.25, 0.035)),
    ((0.12, 0.04, 0.16), (0.22, 0.08, 0.30)),
    ((0.16, 0.12, 0.04), (0.30, 0.22, 0.12)),
    ((0.05, 0.05, 0.05), (0.14, 0.14, 0.14)),
)


def a_tin(chance: Chance) -> ToyModel:
    """A cylinder, every third one open at the top."""
    r = chance.uniform(0.02, 0.1)
    h = chance.uniform(0.05, 0.25) if r < 0.05 else chance.uniform(0.04, 0.14)
    if chance.random() > 0.35:
        return _tin(r, h)
    wall = lathe([(r, h), (r, 0)])
    inner, floor = 0.95 * r, 0.006
    hollow = inside_out(lathe([(inner, h), (inner, floor)]))
    rim = lathe([(inner, h), (r, h)])
    return _of(wall, hollow, rim, move(disc(inner), z=floor))


def _tin(radius: float, height: float) -> ToyModel:
    wall = lathe([(radius, height), (radius, 0)])
    return _of(wall, move(disc(radius), z=height))


def a_mug(chance: Chance) -> ToyModel:
    """A hollow cylinder with a handle, every tenth one fallen over."""
    r, h = chance.uniform(0.03, 0.05), chance.uniform(0.07, 0.12)
    wall, inner, floor = (
        lathe([(r, h), (chance.uniform(0.75, 1) * r, 0)]),
        0.93 * r,
        0.006,
    )
    hollow = inside_out(lathe([(inner, h), (0.75 * inner, floor)]))
    rim = lathe([(inner, h), (r, h)])
    out, high = chance.uniform(0.02, 0.04), chance.uniform(0.3, 0.42) * h
    angle = np.linspace(-np.pi / 2, np.pi / 2, 12)
    x, z = 0.93 * r + out * np.cos(angle), 0.52 * h + high * np.sin(angle)
    handle = tube(np.stack([x, 0 * x, z], axis=1), chance.uniform(0.004, 0.008))
    mug = _of(wall, hollow, rim, move(disc(0.75 * inner), z=floor), handle)
    return _drop(mug, chance, 0.1)


_Group = list[tuple[ToyModel, float, float]]
"""Things and where they are, metres right and away of the middle of the group."""


def _stack(chance: Chance) -> _Group:
    """Two or three packs on each other, many of them with edges that are flush."""
    size = chance.uniform((0.09, 0.07, 0.02), (0.28, 0.20, 0.10))
    group: _Group = [(_of(*box(*size).values()), 0.0, 0.0)]
    x, y, height = 0.0, 0.0, size[2]
    for _ in range(int(chance.integers(1, 3))):
        if chance.random() < 0.25:
            small = a_mug(chance) if chance.random() < 0.5 else a_tin(chance)
            group.append((lift_model(small, height), x, y))
            break
        less = np.where(chance.random(2) < 0.35, 1.0, chance.uniform(0.55, 1.0, 2))
        upper = np.array([*(size[:2] * less), chance.uniform(0.02, 0.10)])
        room = (size[:2] - upper[:2]) / 2
        aside = np.where(
            chance.random(2) < 0.6, chance.choice([-1, 1], 2), chance.uniform(-1, 1, 2)
        )
        shift = room * aside + chance.normal(0, 0.004, 2)
        x, y = x + shift[0], y + shift[1]
        group.append((lift_model(_of(*box(*upper).values()), height), x, y))
        size, height = upper, height + upper[2]
        if height > _HIGHEST:
            break
    return group


def _row(chance: Chance) -> _Group:
    """Two or three packs side by side, most of them with fronts that are flush."""
    low, high = _BOXES[int(chance.integers(1, len(_BOXES)))]
    front, x = 0.0, 0.0
    group: _Group = []
    for _ in range(int(chance.integers(2, 4))):
        width, depth, height = chance.uniform(low, high)
        width *= 0.7
        flush = chance.random() < 0.7
        back = chance.normal(0, 0.003) if flush else chance.uniform(-0.04, 0.04)
        group.append(
            (
                _of(*box(width, depth, height).values()),
                x + width / 2,
                front + back + depth / 2,
            )
        )
        x += width + chance.uniform(0.0, 0.006)
    return [(model, right - x / 2, away) for model, right, away in group]


def a_bowl(chance: Chance) -> ToyModel:
    """A bowl or a deep plate."""
    r = chance.uniform(0.05, 0.13)
    h, foot = r * chance.uniform(0.3, 1.1), r * chance.uniform(0.35, 0.8)
    belly = (r + foot) / 2 + 0.1 * r
    outer = lathe(curve([(r, h), (belly, 0.45 * h), (foot, 0)], 10))
    profile = [(0.94 * r, h), (0.93 * belly, 0.47 * h), (0.9 * foot, 0.006)]
    hollow = inside_out(lathe(curve(profile, 10)))
    rim = lathe([(0.94 * r, h), (r, h)])
    return _of(outer, hollow, rim, move(disc(0.9 * foot), z=0.006))


def a_toy(chance: Chance) -> ToyModel:
    """A round body with round limbs."""
    body = chance.uniform(0.025, 0.07, 3)
    limbs = []
    for _ in range(int(chance.integers(2, 7))):
        way = chance.normal(size=3)
        way /= np.linalg.norm(way)
        x, y, z = body * way * chance.uniform(0.8, 1.15)
        radii = body.mean() * chance.uniform(0.25, 0.75, 3)
        limbs.append(move(ellipsoid(radii), x, y, z))
    return _of(ellipsoid(body), *limbs)


def turn_model(
    model: ToyModel, axis: tuple[float, float, float], degrees: float
) -> ToyModel:
    """The model turned about an axis and set down on z = 0."""
    turn = rotation(axis, degrees).astype(np.float32).T
    vertices = model.vertices @ turn
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    ground = np.array([(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2]])
    standing = (vertices - ground).astype(np.float32)
    return replace(model, vertices=standing, normals=model.normals @ turn)


def lift_model(model: ToyModel, height: float) -> ToyModel:
    """The model so much higher."""
    up = np.array([0, 0, height], np.float32)
    return replace(model, vertices=model.vertices + up)


def _drop(model: ToyModel, chance: Chance, share: float) -> ToyModel:
    return (
        turn_model(model, _level_axis(chance), 90) if chance.random() < share else model
    )


def _level_axis(chance: Chance) -> tuple[float, float, float]:
    angle = chance.uniform(0, 2 * np.pi)
    return float(np.cos(angle)), float(np.sin(angle)), 0.0


def _of(*sheets: Grid) -> ToyModel:
    return assemble([Sheet(sheet, _PLAIN) for sheet in sheets])


def _measure(depth: Depth, camera: SimulatedCamera, chance: Chance) -> Depth:
    """The depth as matching windows of dots gives it.

    Its noise is mostly alike in neighbouring pixels, its steps are of the inverse
    depth, its edges are off by a pixel or two, and much is lost beside them.
    """
    inverse = (1 / depth).astype(np.float32)
    window = int(chance.choice([0, 3, 5]))
    if window:
        inverse = cv2.medianBlur(inverse, window).astype(np.float32)
    noise = chance.standard_normal(depth.shape, np.float32)
    if chance.random() < 0.7:
        blur = cv2.GaussianBlur(noise, (0, 0), chance.uniform(0.6, 2.0))
        noise = blur.astype(np.float32)
    inverse += noise / noise.std() * np.float32(chance.uniform(0.0006, 0.0018))
    inverse = np.maximum(np.rint(inverse / _STEP), 1) * np.float32(_STEP)
    lost = infrared_shadow(depth, camera.intrinsics.fx)
    if chance.random() < 0.5:
        lost |= lost_edges(depth_jumps(depth), chance)
    return np.where(lost, np.float32(np.nan), 1 / inverse).astype(np.float32)
