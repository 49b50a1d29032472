"""How much things stand out in a picture."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.perception.look import look
from kille.perception.prominence import prominences
from kille.scene import Box, Percept, Point, Region
from kille.sensors.sensor import At, Stage
from kille.sensors.sources import open_sensor

WIDTH, HEIGHT = 64, 48


def percept(box: tuple[int, int, int, int], away: float | None = None) -> Percept:
    """A thing that fills a box of the picture, so many metres away."""
    left, top, right, bottom = box
    mask = np.zeros((HEIGHT, WIDTH), bool)
    mask[top:bottom, left:right] = True
    place = None if away is None else Point(0.0, 0.0, away)
    return Percept(Region(mask, Box(*box), place), ())


def test_what_fills_the_picture_stands_out_most() -> None:
    [whole] = prominences([percept((0, 0, WIDTH, HEIGHT), 1.0)])
    assert whole == (1.0, 1.0, 1.0)


def test_size_is_beside_that_of_the_biggest() -> None:
    big, small = prominences([percept((0, 0, 20, 20)), percept((30, 30, 40, 40))])
    assert (big.size, small.size) == (1.0, 0.25)


def test_centrality_falls_from_the_middle_to_the_corner() -> None:
    boxes = [(28, 20, 36, 28), (40, 20, 48, 28), (56, 20, 64, 28), (60, 44, 64, 48)]
    found = [it.centrality for it in prominences([percept(it) for it in boxes])]
    assert found[0] == 1.0
    assert all(a > b for a, b in pairwise(found))
    assert found[-1] < 0.1


def test_nearness_is_beside_that_of_the_nearest() -> None:
    box = (0, 0, 8, 8)
    found = prominences([percept(box, 0.5), percept(box, 1.0), percept(box)])
    assert [it.nearness for it in found] == [1.0, 0.5, 0.5]


def test_in_a_flat_picture_nothing_is_near_or_far() -> None:
    found = prominences([percept((0, 0, 8, 8)), percept((8, 8, 16, 16))])
    assert {it.nearness for it in found} == {0.5}


def test_where_nothing_is_nothing_stands_out() -> None:
    assert prominences([]) == []


@given(
    st.lists(
        st.tuples(
            st.integers(0, WIDTH - 2),
            st.integers(0, HEIGHT - 2),
            st.integers(1, 20),
            st.none() | st.floats(0.3, 4.0),
        ),
        max_size=4,
    )
)
def test_they_are_degrees(things: list[tuple[int, int, int, float | None]]) -> None:
    percepts = [
        percept((left, top, min(WIDTH, left + side), min(HEIGHT, top + side)), away)
        for left, top, side, away in things
    ]
    for it in prominences(percepts):
        assert all(0.0 <= degree <= 1.0 for degree in it)


@pytest.fixture(scope="module")
def stage() -> Stage:
    found = open_sensor("synthetic:empty?seed=4")
    assert isinstance(found, Stage)
    found.place("car", At(-0.2, -0.1))
    found.place("book", At(0.2, 0.2))
    return found


def test_on_the_table_the_nearest_thing_is_near(stage: Stage) -> None:
    seen = look(stage, scans=1)
    near, far = prominences(seen.percepts)
    assert near.nearness == 1.0 > far.nearness
    assert max(near.size, far.size) == 1.0
