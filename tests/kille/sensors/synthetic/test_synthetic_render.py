"""Rendering: depth, outlines and colour agree with the geometry."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kille.scene import Depth, Intrinsics
from kille.sensors.synthetic.catalogue import TOY_NAMES, toy_model
from kille.sensors.synthetic.posed_camera import SimulatedCamera
from kille.sensors.synthetic.render import Pose, PosedToy, render_scene
from kille.sensors.synthetic.room import room
from tools.modelling.shapes import box, ellipsoid
from tools.modelling.sheets import Sheet, assemble

CAMERA = SimulatedCamera()


def points(depth: Depth, lens: Intrinsics) -> np.ndarray:
    """The 3-D point (H, W, 3) of every pixel, in camera axes."""
    v, u = np.indices(depth.shape)
    return np.stack(
        [(u - lens.cx) / lens.fx * depth, (v - lens.cy) / lens.fy * depth, depth],
        axis=2,
    )


def painted(colour: tuple[int, int, int]) -> np.ndarray:
    return np.full((8, 8, 3), colour, np.uint8)


def test_table_pixels_lie_on_the_table() -> None:
    empty = room(CAMERA)
    image = render_scene(CAMERA, {"cup": PosedToy(toy_model("cup"), Pose(0, 0))})
    table = empty.table & ~image.outlines["cup"]
    heights = points(image.depth, CAMERA.intrinsics)[table] @ CAMERA.up + CAMERA.height
    assert table.sum() > 150_000
    assert np.abs(heights).max() < 0.001


def test_the_camera_stands_where_it_says() -> None:
    assert np.linalg.norm(CAMERA.position) == pytest.approx(0.9)
    assert CAMERA.point(np.zeros(3)) == pytest.approx((0, 0, 0.9))
    assert np.linalg.norm(CAMERA.up) == pytest.approx(1)
    assert CAMERA.up[1] < -0.8
    assert np.allclose(CAMERA.rotation @ CAMERA.rotation.T, np.eye(3))
    u, v = CAMERA.pixels(np.zeros((1, 3)))[0]
    assert (u, v) == pytest.approx((319.5, 239.5))


def test_a_box_has_the_depth_of_its_planes() -> None:
    sheets = [
        Sheet(sheet, painted((90, 90, 90))) for sheet in box(0.2, 0.1, 0.1).values()
    ]
    image = render_scene(
        CAMERA, {"box": PosedToy(assemble(sheets), Pose(0.05, 0.02, 30))}
    )
    seen = points(image.depth, CAMERA.intrinsics)[image.outlines["box"]]
    there = seen @ CAMERA.rotation + CAMERA.position - (0.05, 0.02, 0.0)
    sine, cosine = np.sin(np.radians(30)), np.cos(np.radians(30))
    x = cosine * there[:, 0] + sine * there[:, 1]
    y = -sine * there[:, 0] + cosine * there[:, 1]
    off = np.stack(
        [np.abs(np.abs(x) - 0.1), np.abs(np.abs(y) - 0.05), np.abs(there[:, 2] - 0.1)]
    )
    assert off.min(axis=0).max() < 1e-4


def test_things_are_nearer_than_the_room() -> None:
    empty = room(CAMERA)
    for name in TOY_NAMES:
        image = render_scene(CAMERA, {name: PosedToy(toy_model(name), Pose(0, 0, 40))})
        mask = image.outlines[name]
        assert (image.depth[mask] < empty.depth[mask] + 1e-3).all()
        assert np.abs(image.depth[~mask] - empty.depth[~mask]).max() < 1e-4


def test_the_nearer_thing_hides_the_farther() -> None:
    bodies = {
        "book": PosedToy(toy_model("book"), Pose(0, 0.15)),
        "shoe-box": PosedToy(toy_model("shoe-box"), Pose(0, -0.05)),
    }
    image = render_scene(CAMERA, bodies)
    book = render_scene(CAMERA, {"book": bodies["book"]}).outlines["book"]
    case = render_scene(CAMERA, {"shoe-box": bodies["shoe-box"]}).outlines["shoe-box"]
    assert (book & case).any()
    assert np.array_equal(image.outlines["shoe-box"], case)
    assert np.array_equal(image.outlines["book"], book & ~case)
    assert not (image.outlines["book"] & image.outlines["shoe-box"]).any()


def test_a_wholly_hidden_thing_has_no_outline() -> None:
    bodies = {
        "shoe-box": PosedToy(toy_model("shoe-box"), Pose(0, 0)),
        "apple": PosedToy(toy_model("apple"), Pose(0, 0)),
    }
    inside = assemble([Sheet(ellipsoid((0.02, 0.02, 0.02)), painted((0, 0, 0)))])
    image = render_scene(CAMERA, bodies | {"apple": PosedToy(inside, Pose(0, 0))})
    assert set(image.outlines) == {"shoe-box"}


def test_the_picture_on_a_thing_is_its_own() -> None:
    sides = {
        side: painted({"front": (250, 0, 0), "top": (0, 250, 0)}.get(side, (0, 0, 250)))
        for side in box(1, 1, 1)
    }
    faces = box(0.2, 0.2, 0.1)
    cube = assemble([Sheet(faces[side], sides[side]) for side in faces])
    image = render_scene(CAMERA, {"cube": PosedToy(cube, Pose(0, 0))})
    front = CAMERA.pixels(np.array([[0.0, -0.1, 0.05]]))[0].round().astype(int)
    top = CAMERA.pixels(np.array([[0.0, 0.0, 0.1]]))[0].round().astype(int)
    assert image.colour[front[1], front[0]].argmax() == 0
    assert image.colour[top[1], top[0]].argmax() == 1
    behind = render_scene(CAMERA, {"cube": PosedToy(cube, Pose(0, 0, 180))})
    assert behind.colour[front[1], front[0]].argmax() == 2


def test_letters_are_not_mirrored() -> None:
    left_half = painted((0, 0, 0))
    left_half[:, 4:] = 255
    for side, turn in (("front", 0), ("back", 180), ("left", 90), ("right", -90)):
        sheet = Sheet(box(0.1, 0.1, 0.1)[side], left_half)
        image = render_scene(
            CAMERA, {"sheet": PosedToy(assemble([sheet]), Pose(0, 0, turn))}
        )
        _, columns = np.nonzero(image.outlines["sheet"])
        row = np.nonzero(image.outlines["sheet"])[0].mean().astype(int)
        assert image.colour[row, columns.min() + 4].max() < 60
        assert image.colour[row, columns.max() - 4].min() > 60


@settings(max_examples=20)
@given(
    st.sampled_from(TOY_NAMES),
    st.floats(-0.2, 0.2),
    st.floats(-0.2, 0.2),
    st.floats(-180, 180),
)
def test_an_outline_stays_within_the_projected_vertices(
    name: str, right: float, away: float, turn: float
) -> None:
    body = PosedToy(toy_model(name), Pose(right, away, turn))
    rows, columns = np.nonzero(render_scene(CAMERA, {name: body}).outlines[name])
    pixels = CAMERA.pixels(body.pose.move_points(body.model.vertices))
    low, high = pixels.min(axis=0), pixels.max(axis=0)
    assert low[0] - 1 <= columns.min()
    assert columns.max() <= high[0] + 1
    assert low[1] - 1 <= rows.min()
    assert rows.max() <= high[1] + 1
    assert columns.min() - low[0] < 4
    assert high[0] - columns.max() < 4


@pytest.mark.parametrize("name", TOY_NAMES)
def test_models_stand_on_the_table_and_are_life_sized(name: str) -> None:
    made = toy_model(name)
    assert made.vertices[:, 2].min() == pytest.approx(0, abs=1e-6)
    middle = (made.vertices.min(axis=0) + made.vertices.max(axis=0))[:2] / 2
    assert middle == pytest.approx([0, 0], abs=1e-6)
    assert 0.07 < made.size.max() < 0.35
    lengths = np.linalg.norm(made.normals, axis=1)
    assert np.isclose(lengths, 1, atol=1e-3).mean() > 0.95
    height, width = made.texture.shape[:2]
    assert made.uv.min() >= 0
    assert (made.uv <= [width - 1, height - 1]).all()


def test_a_ball_is_lit_from_above_and_the_left() -> None:
    ball = assemble([Sheet(ellipsoid((0.08, 0.08, 0.08)), painted((150, 150, 150)))])
    image = render_scene(CAMERA, {"ball": PosedToy(ball, Pose(0, 0))})
    rows, columns = np.nonzero(image.outlines["ball"])
    grey = image.colour[..., 1].astype(float)
    middle_row, middle_column = int(rows.mean()), int(columns.mean())
    assert (
        grey[rows.min() + 8, middle_column] > grey[rows.max() - 8, middle_column] + 20
    )
    assert (
        grey[middle_row, columns.min() + 12] > grey[middle_row, columns.max() - 12] + 20
    )


def test_a_thing_casts_a_shadow_on_the_table_only() -> None:
    empty = room(CAMERA)
    image = render_scene(CAMERA, {"cup": PosedToy(toy_model("cup"), Pose(0, 0))})
    around = ~image.outlines["cup"]
    darker = (empty.colour.astype(int) - image.colour).max(axis=2) > 25
    assert (darker & around & empty.table).sum() > 400
    assert not (darker & ~empty.table & around).any()
