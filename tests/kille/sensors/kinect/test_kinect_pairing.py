"""Times of frames, and which of them belong together."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.sensors.kinect.clock import Clock
from kille.sensors.kinect.packets import RawFrame
from kille.sensors.kinect.pairing import NEAR, first_pair

PERIOD = 1 / 30
DELAYS = st.lists(st.floats(0, 0.2), min_size=1, max_size=50)


def frame(time: float) -> RawFrame:
    return RawFrame(np.empty(0, np.uint8), 0, time)


@given(DELAYS, st.integers(0, 2**32 - 1))
def test_a_time_is_late_by_the_least_delay_so_far(
    delays: list[float], start: int
) -> None:
    clock = Clock()
    for number, delay in enumerate(delays):
        ticks = (start + number * 2_000_000) % 2**32
        told = clock.at(ticks, 100 + number * PERIOD + delay)
        late = told - (100 + number * PERIOD)
        assert late == pytest.approx(min(delays[: number + 1]), abs=1e-6)


@given(st.lists(st.integers(0, 2**32 - 1), min_size=1, max_size=80))
def test_a_clock_out_of_its_mind_is_not_believed_for_long(ticks: list[int]) -> None:
    clock = Clock()
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
