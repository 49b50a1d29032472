"""Times of frames, and which of them belong together."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.sensors.kinect.clock import DeviceClock
from kille.sensors.kinect.packets import RawFrame
from kille.sensors.kinect.pairing import NEAR, first_pair

PERIOD = 1 / 30
DELAYS = st.lists(st.floats(0, 0.2), min_size=1, max_size=50)


def frame(time: float, late: float = 0.0, began: int = 0) -> RawFrame:
    """A frame of that time, told that much later; its clock began with those ticks."""
    ticks = (round(time * 60_000_000) + began) % 2**32
    return RawFrame(np.empty(0, np.uint8), ticks, time + late)


@given(DELAYS, st.integers(0, 2**32 - 1))
def test_a_time_is_late_by_the_least_delay_so_far(
    delays: list[float], start: int
) -> None:
    clock = DeviceClock()
    for number, delay in enumerate(delays):
        ticks = (start + number * 2_000_000) % 2**32
        told = clock.at(ticks, 100 + number * PERIOD + delay)
        late = told - (100 + number * PERIOD)
        assert late == pytest.approx(min(delays[: number + 1]), abs=1e-6)


@given(st.lists(st.integers(0, 2**32 - 1), min_size=1, max_size=80))
def test_a_clock_out_of_its_mind_is_not_believed_for_long(ticks: list[int]) -> None:
    clock = DeviceClock()
    for number, told in enumerate(ticks):
        arrived = number * PERIOD
        assert arrived - 0.5 <= clock.at(told, arrived) <= arrived + 1e-6


@given(
    st.floats(0, PERIOD),
    st.sets(st.integers(1, 20)),
    st.sets(st.integers(1, 20)),
)
def test_pairs_are_near_and_no_frame_is_in_two(
    phase: float, no_colour: set[int], no_depth: set[int]
) -> None:
    colours = [frame(it * PERIOD + phase) for it in range(1, 21) if it not in no_colour]
    depths = [frame(it * PERIOD) for it in range(1, 21) if it not in no_depth]
    used: list[float] = []
    while (pair := first_pair(colours, depths)) is not None:
        assert abs(pair.colour.time - pair.depth.time) <= NEAR
        used += [pair.colour.time, -pair.depth.time]
        colours = [it for it in colours if it.time > pair.colour.time]
        depths = [it for it in depths if it.time > pair.depth.time]
    assert len(used) == len(set(used))
    lost = len(no_colour) + len(no_depth)
    assert len(used) // 2 >= 20 - 1 - lost


def test_of_two_near_pictures_the_nearer_is_taken() -> None:
    pictures = [frame(1.0), frame(1.017), frame(1.05)]
    pair = first_pair(pictures, [frame(1.016)])
    assert pair is not None
    assert pair.colour is pictures[1]
    assert first_pair(pictures, [frame(1.2)]) is None


@given(st.integers(0, 2**32 - 1), st.floats(0, 0.45), st.floats(0, 0.45))
def test_pairs_are_right_though_one_camera_is_late(
    began: int, early: float, late: float
) -> None:
    pictures = [frame(it * PERIOD + 0.01, early, began) for it in range(8)]
    depths = [frame(it * PERIOD, late, began) for it in range(8)]
    for place, depth in enumerate(depths):
        pair = first_pair(pictures, [depth])
        assert pair is not None
        assert pair.colour is pictures[place]


@given(st.integers(60_000_000, 2**32 - 60_000_000))
def test_clocks_of_their_own_are_not_compared(apart: int) -> None:
    pictures = [frame(it * PERIOD + 0.01) for it in range(8)]
    depths = [frame(it * PERIOD, began=apart) for it in range(8)]
    for place, depth in enumerate(depths):
        pair = first_pair(pictures, [depth])
        assert pair is not None
        assert pair.colour is pictures[place]
