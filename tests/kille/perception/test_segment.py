"""Regions from depth: which things stand on the table, and in which order."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tabletop import LENS, SHAPE, UP, Card, frame_of, share

from kille.perception.geometry import CAMERA_UP, offset, table_axes
from kille.perception.segment import overlap, region_of, segment
from kille.scene import Frame, Point
from kille.sensors.recordings import open_recording
from kille.sensors.synthetic import open_synthetic

THREE = (Card(-0.15, 0.75), Card(0.12, 0.65, width=0.08), Card(0.05, 1.0, seed=2))


@pytest.mark.parametrize("noise", [0.0, 0.0015])
def test_each_thing_on_the_table_is_a_region_nearest_first(noise: float) -> None:
    scene = segment(frame := frame_of(*THREE, noise=noise))
    order = [1, 0, 2]
    assert len(scene.regions) == 3
    for number, region in zip(order, scene.regions, strict=True):
        assert share(frame.outlines[str(number)], region) > 0.85
    assert np.dot(scene.up, UP) > 0.999


def test_a_region_knows_its_box_and_its_place() -> None:
    frame = frame_of(Card(-0.1, 0.8))
    (region,) = segment(frame).regions
    rows, columns = np.nonzero(region.mask)
    left, top, right, bottom = region.box
    assert (left, right) == (columns.min(), columns.max() + 1)
    assert (top, bottom) == (rows.min(), rows.max() + 1)
    assert region.place is not None
    seen = table_axes(UP) @ np.array(region.place)
    assert seen[:2] == pytest.approx([-0.1, 0.8], abs=0.01)


def test_one_thing_before_another_is_parted_from_it() -> None:
    frame = frame_of(Card(0, 0.9, width=0.2, height=0.2), Card(0.02, 0.8, seed=1))
    scene = segment(frame)
    assert len(scene.regions) == 2
    assert share(frame.outlines["1"], scene.regions[0]) > 0.85
    assert share(frame.outlines["0"], scene.regions[1]) > 0.85


def test_an_empty_table_has_no_regions() -> None:
    assert segment(frame_of()).regions == ()


def test_specks_are_no_things() -> None:
    assert segment(frame_of(Card(0, 0.8, width=0.015, height=0.03))).regions == ()


def test_things_beyond_the_table_are_left_out() -> None:
    frame = frame_of(Card(-0.1, 0.8), Card(0.3, 1.3, width=0.2, height=0.3, seed=1))
    assert frame.depth is not None
    without_far_table = frame.depth.copy()
    without_far_table[:170][~frame.outlines["1"][:170]] = np.nan
    (region,) = segment(replace(frame, depth=without_far_table)).regions
    assert share(frame.outlines["0"], region) > 0.85


def test_without_depth_the_whole_picture_is_one_region_somewhere() -> None:
    frame = replace(frame_of(Card(0, 0.8)), depth=None, intrinsics=None)
    scene = segment(frame)
    (region,) = scene.regions
    assert region.mask.all()
    assert region.place is None
    assert scene.up == CAMERA_UP


def test_without_a_table_what_is_near_is_a_thing() -> None:
    frame = frame_of(Card(0, 0.7), Card(0.3, 0.9, seed=1), table=False)
    scene = segment(frame)
    assert len(scene.regions) == 2
    assert scene.up == CAMERA_UP


def test_a_wall_is_no_thing() -> None:
    depth = np.full(SHAPE, 1.0, np.float32)
    frame = Frame(np.zeros((*SHAPE, 3), np.uint8), depth, LENS, 0.0, {})
    assert segment(frame).regions == ()


def test_no_reading_at_all_is_nothing_in_view() -> None:
    depth = np.full(SHAPE, np.nan, np.float32)
    frame = Frame(np.zeros((*SHAPE, 3), np.uint8), depth, LENS, 0.0, {})
    assert segment(frame).regions == ()


@pytest.mark.parametrize("shape", [(120, 160), (241, 321), (1, 1)])
def test_pictures_of_any_size(shape: tuple[int, int]) -> None:
    full = frame_of(Card(0, 0.8))
    assert full.depth is not None
    rows = np.linspace(0, SHAPE[0] - 1, shape[0]).astype(int)
    columns = np.linspace(0, SHAPE[1] - 1, shape[1]).astype(int)
    small = np.ix_(rows, columns)
    for region in segment(
        replace(full, colour=full.colour[small], depth=full.depth[small])
    ).regions:
        assert region.mask.shape == shape


def test_the_same_frame_has_the_same_regions() -> None:
    frame = frame_of(*THREE, noise=0.002)
    once, again = segment(frame), segment(frame)
    assert once.up == again.up
    for one, other in zip(once.regions, again.regions, strict=True):
        assert np.array_equal(one.mask, other.mask)


def test_an_outline_is_a_region() -> None:
    frame = frame_of(Card(0.1, 0.8))
    region = region_of(frame, frame.outlines["0"])
    assert region.place is not None
    assert overlap(region, region) == 1.0
    assert region_of(replace(frame, depth=None), region.mask).place is None


directions = st.tuples(*[st.floats(-1, 1)] * 3).filter(
    lambda it: np.hypot(it[1], it[2]) > 0.1
)
points = st.tuples(*[st.floats(-2, 2)] * 3).map(lambda it: Point(*it))


@given(directions)
def test_table_axes_are_orthonormal_and_right_handed(
    up: tuple[float, float, float],
) -> None:
    axes = table_axes(up)
    assert axes @ axes.T == pytest.approx(np.eye(3), abs=1e-9)
    assert np.linalg.det(axes) == pytest.approx(1)
    assert axes[2] == pytest.approx(np.array(up) / np.linalg.norm(up))


@given(points, points, directions)
def test_an_offset_keeps_the_distance_and_turns_round(
    target: Point, landmark: Point, up: tuple[float, float, float]
) -> None:
    there, back = offset(target, landmark, up), offset(landmark, target, up)
    apart = np.linalg.norm(np.subtract(target, landmark))
    assert np.linalg.norm(there) == pytest.approx(apart, abs=1e-5)
    assert there == pytest.approx(np.negative(back), abs=1e-5)


def test_nothing_is_level_when_up_is_to_the_right() -> None:
    with pytest.raises(ValueError, match="nothing is level"):
        table_axes((1.0, 0.0, 0.0))


def test_most_boxes_of_real_scenes_are_found(data: Path) -> None:
    found = total = 0
    for name in ("learn00", "learn04", "learn08", "learn12", "learn16"):
        frame = open_recording(str(data / "mosd_scenes" / name)).frame()
        regions = segment(frame).regions
        total += len(frame.outlines)
        found += sum(
            any(share(mask, region) > 0.5 for region in regions)
            for mask in frame.outlines.values()
        )
    assert found == total


def test_every_labelled_thing_of_a_real_scene_is_found(data: Path) -> None:
    frame = open_recording(str(data / "ycbv_scenes" / "0050")).frame()
    regions = segment(frame).regions
    for name, mask in frame.outlines.items():
        assert max(share(mask, region) for region in regions) > 0.5, name


def test_a_thing_that_hides_a_part_of_itself_is_one_thing() -> None:
    body, brim = Card(0, 0.83, height=0.12, seed=4), Card(0, 0.8, height=0.05, seed=4)
    frame = frame_of(body, brim)
    (region,) = segment(frame).regions
    assert share(frame.outlines["0"] | frame.outlines["1"], region) > 0.85


@pytest.mark.parametrize("thing", ["teddy bear", "car", "cup", "can of paint"])
def test_a_synthetic_thing_is_one_region(thing: str) -> None:
    stage = open_synthetic("synthetic:empty?seed=11")
    stage.show(thing)
    frame = stage.frame()
    (region,) = segment(frame).regions
    assert share(frame.outlines[thing], region) > 0.8
