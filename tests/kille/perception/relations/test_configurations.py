"""From what is seen to a configuration: places, sizes, and how one holds another."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.perception.relations.bounding_boxes import Bounds, bounds_of, containment
from kille.perception.relations.configurations import configuration, configurations
from kille.perception.segment import region_of
from kille.scene import Configuration, Region
from kille.sensors.sensor import At
from kille.sensors.synthetic.sensor import open_synthetic

corners = st.lists(st.floats(-1, 1), min_size=3, max_size=3)
sides = st.lists(st.floats(0.01, 1), min_size=3, max_size=3)


def box(low: list[float], size: list[float]) -> Bounds:
    return Bounds(np.array(low), np.array(low) + np.array(size))


@given(corners, sides, corners, sides)
def test_a_hold_is_in_degrees(
    low: list[float], size: list[float], other: list[float], its: list[float]
) -> None:
    held = containment(box(low, size), box(other, its))
    for degree in (held.contact, held.support, held.containment):
        assert 0 <= degree <= 1


@given(corners, sides)
def test_a_thing_contains_and_touches_itself(
    low: list[float], size: list[float]
) -> None:
    held = containment(box(low, size), box(low, size))
    assert held.contact == 1
    assert held.containment == pytest.approx(1)


def test_on_beside_and_over() -> None:
    table = box([0, 0, 0], [1, 1, 0.2])
    on = containment(box([0.4, 0.4, 0.2], [0.1, 0.1, 0.1]), table)
    beside = containment(box([1.0, 0.4, 0], [0.1, 0.1, 0.1]), table)
    over = containment(box([0.4, 0.4, 0.6], [0.1, 0.1, 0.1]), table)
    assert (on.contact, on.support, on.containment) == (1, pytest.approx(1), 0)
    assert (beside.contact, beside.support) == (1, 0)
    assert (over.contact, over.support) == (0, 0)


def test_bounds_leave_out_strays_and_what_was_not_read() -> None:
    points = np.random.default_rng(0).uniform(0, 1, (500, 3))
    points[0], points[1] = 50.0, np.nan
    found = bounds_of(points, 0.02)
    assert found is not None
    assert found.high.max() < 1.01
    assert bounds_of(np.full((3, 3), np.nan)) is None


def seen(spot: At) -> Configuration:
    stage = open_synthetic("synthetic:empty?seed=7")
    stage.place("car", At(0.0, 0.1, 0.0))
    stage.place("book", spot)
    frame = stage.frame()
    book, car = (region_of(frame, frame.outlines[it]) for it in ("book", "car"))
    found = configuration(frame, book, car, [], stage.camera.up)
    assert found is not None
    return found


def test_a_book_beside_a_car() -> None:
    found = seen(At(-0.25, 0.1, 0.0))
    assert found.offset == pytest.approx((-0.25, 0.0, 0.0), abs=0.03)
    assert found.target_size == pytest.approx(0.22, abs=0.04)
    assert found.landmark_size == pytest.approx(0.19, abs=0.04)
    assert found.viewed is not None
    assert found.viewed[1] > 0.4
    assert found.viewed[2] < 0
    assert found.support == 0


def test_all_pairs_are_seen_as_each_of_them() -> None:
    stage = open_synthetic("synthetic:empty?seed=3")
    for thing, at in (("book", -0.2), ("cup", 0.0), ("car", 0.25)):
        stage.place(thing, At(at, 0.05))
    frame = stage.frame()
    regions = [region_of(frame, mask) for mask in frame.outlines.values()]
    regions.append(Region(regions[0].mask, regions[0].box, None))
    up = (0.0, -0.8, -0.6)
    pairs = configurations(frame, regions, up)
    assert pairs.keys() == {(i, j) for i in range(3) for j in range(3) if i != j}
    for (i, j), stand in pairs.items():
        others = [it for n, it in enumerate(regions) if n not in (i, j)]
        assert stand == configuration(frame, regions[i], regions[j], others, up)
