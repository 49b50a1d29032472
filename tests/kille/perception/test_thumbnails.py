"""Evidence: what is kept of a frame shows what was seen, and can be measured again."""

from __future__ import annotations

import math

import numpy as np
import pytest

from kille.memory import Crop, Picture
from kille.perception.cues import CUES, measure_cues
from kille.perception.look import look
from kille.perception.thumbnails import (
    decode_picture,
    evidence_of,
    outline_things,
    restore_crop,
)
from kille.scene import Box, Frame, Intrinsics, Percept, Region
from kille.sensors.synthetic import open_synthetic


@pytest.fixture(scope="module")
def cup() -> Percept:
    stage = open_synthetic("synthetic:empty?seed=3")
    stage.show("cup")
    return look(stage, 1).percepts[0]


def frame_of(percept: Percept) -> Frame:
    assert percept.frame is not None
    return percept.frame


def crop_of(picture: Picture) -> Crop:
    assert picture.crop is not None
    return picture.crop


def test_the_thing_is_where_its_box_is(cup: Percept) -> None:
    picture = evidence_of(frame_of(cup), cup.region)
    (box,) = picture.boxes
    assert decode_picture(picture.frame).shape == (120, 160, 3)
    assert [4 * it for it in box] == pytest.approx(list(cup.region.box), abs=4)
    marked = outline_things(picture).astype(int) - decode_picture(picture.frame)
    rows, columns = np.nonzero(np.abs(marked).sum(axis=2))
    assert (columns.min(), rows.min()) == (box.left, box.top)
    assert (columns.max(), rows.max()) == (box.right - 1, box.bottom - 1)


def test_what_is_kept_is_small(cup: Percept) -> None:
    picture = evidence_of(frame_of(cup), cup.region)
    crop = crop_of(picture)
    assert crop.depth is not None
    parts = picture.frame, crop.colour, crop.mask, crop.depth
    assert sum(map(len, parts)) < 30_000


def test_what_is_kept_can_be_measured_again(cup: Percept) -> None:
    frame = frame_of(cup)
    again, region = restore_crop(crop_of(evidence_of(frame, cup.region)))
    assert region.mask.sum() == cup.region.mask.sum()
    assert cup.region.place is not None
    assert region.place == pytest.approx(cup.region.place, abs=0.001)
    before, after = measure_cues(frame, cup.region), measure_cues(again, region)
    assert after.keys() == before.keys()
    assert after["size"] == pytest.approx(before["size"], abs=0.02)
    for cue in before.keys() & {"colour", "shape", "outline"}:
        assert CUES[cue].length == len(after[cue])
        apart = np.linalg.norm(after[cue] - before[cue])
        assert apart < 0.15 * max(1.0, float(np.linalg.norm(before[cue])))


def test_two_things_are_shown_in_their_frame(cup: Percept) -> None:
    mask = np.zeros_like(cup.region.mask)
    mask[0:40, 600:640] = True
    other = Region(mask, Box(600, 0, 640, 40), None)
    picture = evidence_of(frame_of(cup), cup.region, other)
    assert len(picture.boxes) == 2
    assert picture.boxes[1] == Box(150, 0, 160, 10)
    assert picture.crop is None


def region_in(height: int, width: int, box: Box) -> Region:
    mask = np.zeros((height, width), np.bool_)
    mask[box.top : box.bottom, box.left : box.right] = True
    return Region(mask, box, None)


@pytest.mark.parametrize(
    ("height", "width", "box"),
    [
        (1, 1, Box(0, 0, 1, 1)),
        (4320, 7680, Box(0, 0, 7680, 4320)),
        (3, 2000, Box(5, 0, 1990, 3)),
        (480, 640, Box(639, 479, 640, 480)),
    ],
)
def test_pictures_of_any_size(height: int, width: int, box: Box) -> None:
    colour = np.full((height, width, 3), 77, np.uint8)
    lens = Intrinsics(500.0, 500.0, width / 2, height / 2)
    depth = np.full((height, width), 1.0, np.float32)
    frame = Frame(colour, depth, lens, 0.0, {})
    picture = evidence_of(frame, region_in(height, width, box))
    again, region = restore_crop(crop_of(picture))
    assert max(again.colour.shape) <= 640
    assert max(decode_picture(picture.frame).shape) <= 160
    assert again.depth is not None
    assert again.depth.shape == region.mask.shape == again.colour.shape[:2]
    assert region.mask.any()
    # Wherever it is cut and however it is shrunk, the camera sees it where it was.
    assert again.intrinsics is not None
    assert region.place is not None
    u, v = (box.left + box.right - 1) / 2, (box.top + box.bottom - 1) / 2
    there = (u - width / 2) / 500, (v - height / 2) / 500, 1.0
    assert region.place == pytest.approx(there, abs=0.02)


def test_depth_that_tells_nothing_comes_back_as_nothing() -> None:
    box = Box(0, 0, 8, 1)
    strange = [math.nan, math.inf, -math.inf, 0.0, -1.0, 70.0, 0.5, 65.535]
    depth = np.array([strange], np.float32)
    frame = Frame(np.zeros((1, 8, 3), np.uint8), depth, None, 0.0, {})
    again, _ = restore_crop(crop_of(evidence_of(frame, region_in(1, 8, box))))
    assert again.depth is not None
    assert np.isnan(again.depth[0, :6]).all()
    assert again.depth[0, 6:] == pytest.approx([0.5, 65.535])


def test_all_is_kept_of_a_picture_without_depth() -> None:
    colour = np.zeros((30, 40, 3), np.uint8)
    frame = Frame(colour, None, None, 0.0, {})
    crop = crop_of(evidence_of(frame, region_in(30, 40, Box(10, 10, 20, 20))))
    again, region = restore_crop(crop)
    assert again.colour.shape == colour.shape
    assert region.box == Box(10, 10, 20, 20)
    assert (again.depth, again.intrinsics) == (None, None)


def test_pictures_that_cannot_be_decoded_are_named(cup: Percept) -> None:
    crop = crop_of(evidence_of(frame_of(cup), cup.region))
    broken = Crop(crop.colour[:40], crop.mask)
    with pytest.raises(ValueError, match="cannot be decoded"):
        restore_crop(broken)
    with pytest.raises(ValueError, match="cannot be decoded"):
        decode_picture(b"")
    other = evidence_of(frame_of(cup), region_in(480, 640, Box(0, 0, 9, 9)))
    with pytest.raises(ValueError, match="does not fit the crop"):
        restore_crop(Crop(crop.colour, crop_of(other).mask))


def test_a_region_of_nothing_has_no_crop() -> None:
    frame = Frame(
        np.zeros((9, 9, 3), np.uint8), np.ones((9, 9), np.float32), None, 0, {}
    )
    nothing = Region(np.zeros((9, 9), np.bool_), Box(0, 0, 0, 0), None)
    picture = evidence_of(frame, nothing)
    assert decode_picture(picture.frame).shape == (9, 9, 3)
    assert picture.crop is None
