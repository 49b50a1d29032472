"""The simulated Kinect as a sensor and a stage."""

from __future__ import annotations

import math
from itertools import pairwise

import cv2
import numpy as np
import pytest

from kille.sensors.sensor import At, Beside, SensorError, Stage
from kille.sensors.synthetic import Synthetic, open_synthetic
from kille.sensors.synthetic.catalogue import TOY_NAMES, toy_model
from kille.sensors.synthetic.specimens import specimen


def clean(scene: str = "empty", seed: int = 7) -> Synthetic:
    return open_synthetic(f"synthetic:{scene}?seed={seed}&faults=none")


def same(a: np.ndarray, b: np.ndarray) -> bool:
    return np.array_equal(a, b, equal_nan=a.dtype.kind == "f")


def test_it_is_a_stage_with_the_ten_objects() -> None:
    sensor = open_synthetic("synthetic")
    assert isinstance(sensor, Stage)
    assert sensor.things() == TOY_NAMES
    assert len(set(TOY_NAMES)) == 10


def test_a_frame_has_all_that_a_frame_has() -> None:
    frame = open_synthetic("synthetic").frame()
    assert frame.colour.shape == (480, 640, 3)
    assert frame.colour.dtype == np.uint8
    assert frame.depth is not None
    assert frame.depth.shape == (480, 640)
    assert frame.depth.dtype == np.float32
    assert frame.intrinsics is not None
    assert frame.intrinsics.fx == 525
    assert set(frame.outlines) == {"book", "cup", "car"}
    assert all(mask.dtype == bool for mask in frame.outlines.values())


@pytest.mark.parametrize("faults", ["all", "none"])
def test_same_seed_same_frames(faults: str) -> None:
    name = f"synthetic:desk?seed=11&faults={faults}"
    one, other = open_synthetic(name), open_synthetic(name)
    for _ in range(3):
        a, b = one.frame(), other.frame()
        assert a.depth is not None
        assert b.depth is not None
        assert same(a.colour, b.colour)
        assert same(a.depth, b.depth)
        assert a.time == b.time
        one.show("car")
        other.show("car")


def test_another_seed_another_scene() -> None:
    a, b = clean("desk", 1).frame(), clean("desk", 2).frame()
    assert not same(a.outlines["cup"], b.outlines["cup"])


def test_frames_of_one_scene_differ_by_noise_alone() -> None:
    noisy = open_synthetic("synthetic:desk?seed=3")
    one, two = noisy.frame(), noisy.frame()
    assert not same(one.colour, two.colour)
    assert one.outlines["cup"] is two.outlines["cup"]
    difference = one.colour.astype(int) - two.colour
    assert np.abs(difference.mean()) < 0.1
    assert difference.std() < 5
    still = clean("desk", 3)
    first, second = still.frame(), still.frame()
    assert same(first.colour, second.colour)
    assert second.time == pytest.approx(first.time + 1 / 30)


def test_frames_cannot_be_written() -> None:
    frame = clean("desk").frame()
    with pytest.raises(ValueError, match="read-only"):
        frame.colour[0, 0] = 0
    with pytest.raises(TypeError):
        frame.outlines["ghost"] = frame.outlines["cup"]  # type: ignore[index]


@pytest.mark.parametrize("name", TOY_NAMES)
def test_every_object_has_texture_enough_for_sift(name: str) -> None:
    sensor = open_synthetic("synthetic:empty?seed=1")
    sensor.place(name, At(0, 0))
    frame = sensor.frame()
    grey = cv2.cvtColor(frame.colour, cv2.COLOR_RGB2GRAY)
    inside = frame.outlines[name].astype(np.uint8)
    enough = 20 if name in ("apple", "banana") else 60
    assert len(cv2.SIFT_create().detect(grey, inside)) >= enough


@pytest.mark.parametrize("name", TOY_NAMES)
def test_show_shows_only_that_and_never_twice_the_same(name: str) -> None:
    sensor = clean("desk")
    masks = []
    for _ in range(4):
        sensor.show(name)
        frame = sensor.frame()
        assert set(frame.outlines) == {name}
        masks.append(frame.outlines[name])
        pose = sensor.bodies[name].pose
        assert max(abs(pose.right), abs(pose.away)) <= 0.05
        assert abs(pose.turn) <= 25
        rows, columns = np.nonzero(masks[-1])
        assert rows.min() > 0
        assert rows.max() < 479
        assert columns.min() > 0
        assert columns.max() < 639
    assert not any(same(a, b) for a, b in pairwise(masks))


def test_the_same_place_whatever_was_looked_at_before() -> None:
    watched, unwatched = clean(), clean()
    for _ in range(5):
        watched.frame()
    watched.show("cup")
    unwatched.show("cup")
    assert watched.bodies["cup"].pose == unwatched.bodies["cup"].pose


@pytest.mark.parametrize("name", ["apple", "book", "can of paint", "shoe-box"])
def test_the_outline_holds_the_true_place(name: str) -> None:
    sensor = clean()
    sensor.place(name, At(0.12, -0.07, 20))
    x, y, z = sensor.true_place(name)
    frame = sensor.frame()
    assert frame.intrinsics is not None
    lens = frame.intrinsics
    u, v = lens.fx * x / z + lens.cx, lens.fy * y / z + lens.cy
    assert frame.outlines[name][round(v), round(u)]
    assert frame.depth is not None
    assert abs(float(frame.depth[round(v), round(u)]) - z) < 0.15


@pytest.mark.parametrize(
    ("said", "meant"),
    [
        ("shoe box", "shoe-box"),
        ("Shoebox", "shoe-box"),
        ("the cup", "cup"),
        ("bear", "teddy bear"),
        ("a Teddy-Bear", "teddy bear"),
        ("paint", "can of paint"),
        ("the can of paint", "can of paint"),
    ],
)
def test_names_are_forgiving(said: str, meant: str) -> None:
    sensor = clean()
    sensor.show(said)
    assert list(sensor.bodies) == [meant]


@pytest.mark.parametrize(
    ("relation", "right", "away"),
    [
        ("left of", -1, 0),
        ("to the left of", -1, 0),
        ("right of", 1, 0),
        ("to the right of", 1, 0),
        ("in front of", 0, -1),
        ("behind", 0, 1),
    ],
)
@pytest.mark.parametrize("target", ["book", "cup", "shoe-box"])
@pytest.mark.parametrize("seed", [0, 1, 2])
def test_beside_is_on_the_right_side(
    relation: str, right: int, away: int, target: str, seed: int
) -> None:
    sensor = clean(seed=seed)
    sensor.place("car", At(0.0, 0.0))
    sensor.place(target, Beside(relation, "the car"))
    pose, car = sensor.bodies[target].pose, sensor.bodies["car"].pose
    dx, dy = pose.right - car.right, pose.away - car.away
    along = dx * right + dy * away
    across = abs(dx * away) + abs(dy * right)
    assert along > 0.05
    assert across < along * math.tan(math.radians(21))
    assert target in sensor.frame().outlines


@pytest.mark.parametrize("relation", ["near", "close to", "next to"])
def test_near_is_near(relation: str) -> None:
    sensor = clean()
    sensor.place("car", At(0.0, 0.0))
    sensor.place("apple", Beside(relation, "car"))
    pose = sensor.bodies["apple"].pose
    assert 0.05 < math.hypot(pose.right, pose.away) < 0.4


def test_the_distance_depends_on_both_sizes() -> None:
    def distance(target: str, landmark: str) -> float:
        sensor = clean(seed=5)
        sensor.place(landmark, At(0.0, 0.1))
        sensor.place(target, Beside("left of", landmark))
        return -sensor.bodies[target].pose.right

    small = distance("apple", "cup")
    assert distance("shoe-box", "cup") > small + 0.05
    assert distance("apple", "shoe-box") > small + 0.05


def test_placing_again_moves_and_leaves_the_others() -> None:
    sensor = clean("desk")
    before = dict(sensor.bodies)
    sensor.place("cup", At(0.02, -0.15))
    assert sensor.bodies["cup"].pose.away == -0.15
    assert sensor.bodies["book"] is before["book"]
    assert sensor.bodies["car"] is before["car"]


def test_removing_takes_away() -> None:
    sensor = clean("desk")
    sensor.remove("the cup")
    assert set(sensor.frame().outlines) == {"book", "car"}


def test_a_full_turn_changes_nothing() -> None:
    pictures = []
    for turn in (30.0, 390.0, -330.0, 120.0):
        sensor = clean()
        sensor.place("cup", At(0.05, 0.05, turn))
        pictures.append(sensor.frame().colour.astype(int))
    first, *same_turn, other = pictures
    for picture in same_turn:
        assert np.abs(first - picture).max() <= 1
    assert np.abs(first - other).max() > 50


def test_all_ten_fit_and_are_seen() -> None:
    frame = clean("all").frame()
    assert set(frame.outlines) == set(TOY_NAMES)
    assert min(mask.sum() for mask in frame.outlines.values()) > 1500


BAD = [
    (lambda s: s.show("cupp"), "no object 'cupp' .did you mean cup"),
    (lambda s: s.show(""), "no object ''"),
    (lambda s: s.remove("apple"), "the apple is not on the table: there is book, cup"),
    (lambda s: s.place("apple", Beside("left of", "shoe")), "shoe is not on the table"),
    (lambda s: s.place("apple", Beside("lef of", "cup")), "did you mean left of"),
    (lambda s: s.place("cup", Beside("left of", "cup")), "left of itself"),
    (lambda s: s.place("apple", At(3, 0)), "not stand on the table"),
    (lambda s: s.place("apple", At(0.65, -0.5)), "would not see all of it"),
    (lambda s: s.place("apple", At(-0.25, 0.10)), "would cut into the book"),
    (lambda s: s.place("cap", At(float("nan"), 0)), "not stand on the table"),
    (lambda s: s.place("/nowhere/x.obj", At(0, 0)), "no such mesh"),
    (lambda s: s.true_place("shoe"), "not on the table"),
]


@pytest.mark.parametrize(("mistake", "words"), BAD)
def test_a_mistake_is_one_clear_line_and_changes_nothing(mistake, words) -> None:
    sensor = clean("desk")
    before = dict(sensor.bodies)
    with pytest.raises(SensorError, match=words) as caught:
        mistake(sensor)
    assert "\n" not in str(caught.value)
    assert dict(sensor.bodies) == before


def test_no_room_is_said() -> None:
    sensor = clean()
    sensor.place("shoe-box", At(0.0, 0.38))
    with pytest.raises(SensorError, match="no room for the teddy bear behind the shoe"):
        sensor.place("teddy bear", Beside("behind", "shoe-box"))


def test_a_hidden_spot_is_refused() -> None:
    sensor = clean()
    sensor.place("shoe-box", At(0.0, 0.0))
    with pytest.raises(SensorError, match="it would be hidden"):
        sensor.place("banana", At(0.0, 0.15))


def test_closed_is_closed() -> None:
    sensor = clean()
    sensor.close()
    sensor.close()
    with pytest.raises(SensorError, match="closed"):
        sensor.frame()


@pytest.mark.parametrize("turn", [0, 30, 90, 200])
def test_things_never_stand_in_one_another(turn: float) -> None:
    sensor = clean()
    sensor.place("book", At(0, 0, turn))
    way = math.radians(turn)
    for distance, free in ((0.0, False), (0.1, False), (0.14, True)):
        spot = At(distance * math.cos(way), distance * math.sin(way))
        if free:
            sensor.place("apple", spot)
            continue
        with pytest.raises(SensorError, match="cut into the book"):
            sensor.place("apple", spot)


@pytest.mark.parametrize("name", TOY_NAMES)
def test_a_specimen_is_another_thing_of_its_kind(name: str) -> None:
    first, other = specimen(name, 0), specimen(name, 3)
    assert first is toy_model(name)
    assert not np.array_equal(first.texture, other.texture)
    assert np.all(other.size < 1.3 * first.size)
    assert np.all(other.size > first.size / 1.3)
    assert np.allclose(np.linalg.norm(other.normals, axis=1), 1, atol=1e-3)
    assert float(other.vertices[:, 2].min()) == pytest.approx(0, abs=1e-6)


def test_a_number_is_always_the_same_specimen() -> None:
    frames = []
    for _ in range(2):
        sensor = open_synthetic("synthetic:empty?seed=7&faults=none&specimen=3")
        sensor.show("cup")
        frames.append(sensor.frame().colour)
        specimen.cache_clear()
    assert same(*frames)
