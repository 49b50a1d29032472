"""How recordings are played: in order, in time, from anywhere, over and over."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.scene import Frame, Intrinsics
from kille.sensors.recordings.moments import Moment, RecordedMoments, remark_on
from kille.sensors.recordings.pairing import pair_times
from kille.sensors.recordings.playback import (
    PlaybackClock,
    Recording,
    RecordingOverError,
    due,
    latest,
)
from kille.sensors.recordings.playback_options import Options, split_options
from kille.sensors.sensor import SensorError

TIMES = (100.0, 100.1, 100.25, 100.3)
"""Of four frames, on a clock that does not begin at 0; a lap is 0.4 seconds."""


def moment(number: int, time: float) -> Moment:
    colour = np.full((2, 2, 3), number, np.uint8)
    return Moment(time, lambda: Frame(colour, None, None, time, {}))


REEL = RecordedMoments(
    "test", [moment(number, time) for number, time in enumerate(TIMES)]
)


@dataclass
class Hours:
    """A clock that goes on only when it is waited for, and tells how long it was."""

    time: float = 7.0
    waits: list[float] = field(default_factory=list)

    @property
    def clock(self) -> PlaybackClock:
        return PlaybackClock(lambda: self.time, self.wait)

    def wait(self, seconds: float) -> None:
        self.waits.append(seconds)
        self.time += seconds


def shown(recording: Recording) -> int:
    return int(recording.frame().colour[0, 0, 0])


def test_frames_come_in_order_and_begin_again() -> None:
    recording = Recording("r", REEL, Options())
    assert [shown(recording) for _ in range(6)] == [0, 1, 2, 3, 0, 1]


def test_time_goes_on_when_the_recording_begins_again() -> None:
    recording = Recording("r", REEL, Options())
    times = [recording.frame().time for _ in range(6)]
    assert times == pytest.approx([0, 0.1, 0.25, 0.3, 0.4, 0.5])


def test_without_loop_it_is_over_after_the_last_frame() -> None:
    recording = Recording("r", REEL, Options(loop=False))
    assert [shown(recording) for _ in range(4)] == [0, 1, 2, 3]
    for _ in range(2):
        with pytest.raises(
            RecordingOverError, match="r: the recording is over after its 4"
        ):
            recording.frame()
    recording.seek(0.1)
    assert shown(recording) == 1


@pytest.mark.parametrize(("start", "first"), [(0, 0), (0.1, 1), (0.11, 2), (0.3, 3)])
def test_start_and_seek_go_to_the_first_frame_from_there(
    start: float, first: int
) -> None:
    recording = Recording("r", REEL, Options(start=start))
    assert shown(recording) == first
    recording.seek(start)
    assert shown(recording) == first
    assert [it.time for it in recording.rest] == list(TIMES[first + 1 :] or TIMES)


def test_a_start_behind_the_end_says_how_long_it_is() -> None:
    with pytest.raises(SensorError, match=r"start=0.5 is behind the end; .* 0.30 sec"):
        Recording("r", REEL, Options(start=0.5))


def test_at_speed_1_the_next_frame_is_waited_for() -> None:
    hours = Hours()
    recording = Recording("r", REEL, Options(speed=1), hours.clock)
    began = hours.time
    seen = [(shown(recording), hours.time - began) for _ in range(5)]
    assert [number for number, _ in seen] == [0, 1, 2, 3, 0]
    assert [time for _, time in seen] == pytest.approx([0, 0.1, 0.25, 0.3, 0.4])


def test_at_speed_2_it_takes_half_the_time() -> None:
    hours = Hours()
    recording = Recording("r", REEL, Options(speed=2, loop=False), hours.clock)
    began = hours.time
    assert [shown(recording) for _ in range(4)] == [0, 1, 2, 3]
    assert hours.time - began == pytest.approx(0.15)


def test_the_clock_begins_with_the_first_frame_and_anew_after_a_seek() -> None:
    hours = Hours()
    recording = Recording("r", REEL, Options(speed=1), hours.clock)
    hours.time += 0.26
    assert [shown(recording), shown(recording)] == [0, 1]
    recording.seek(0.25)
    hours.time += 60
    assert [shown(recording), shown(recording)] == [2, 3]


def test_who_is_slow_misses_what_came_meanwhile() -> None:
    hours = Hours()
    recording = Recording("r", REEL, Options(speed=1), hours.clock)
    assert shown(recording) == 0
    hours.time += 0.26
    assert shown(recording) == 2
    hours.time += 10 * 0.4
    frame = recording.frame()
    assert frame.time == pytest.approx(0.25 + 10 * 0.4)


def test_who_is_slow_sees_the_last_frame_before_the_end() -> None:
    hours = Hours()
    recording = Recording("r", REEL, Options(speed=1, loop=False), hours.clock)
    assert shown(recording) == 0
    hours.time += 60
    assert shown(recording) == 3
    with pytest.raises(RecordingOverError):
        recording.frame()


@given(st.lists(st.integers(1, 50), max_size=6), st.floats(0, 100))
def test_the_latest_is_due_and_the_next_is_not(gaps: list[int], now: float) -> None:
    times = np.cumsum([0, *gaps]) / 10
    reel = RecordedMoments("r", [moment(0, float(time)) for time in times])
    number = latest(reel, now)
    assert due(reel, number) <= now + 1e-9
    assert due(reel, number + 1) > now - 1e-9


@given(st.lists(st.integers(1, 50), max_size=6))
def test_times_rise_over_all_laps(gaps: list[int]) -> None:
    times = np.cumsum([0, *gaps]) / 10
    reel = RecordedMoments("r", [moment(0, float(time)) for time in times])
    row = [due(reel, number) for number in range(3 * len(times))]
    assert all(a < b for a, b in pairwise(row))


def test_real_time_is_kept() -> None:
    from time import monotonic

    recording = Recording("r", REEL, Options(speed=4, loop=False))
    began = monotonic()
    while recording.rest:
        recording.frame()
    assert monotonic() - began >= 0.3 / 4


# --- options -------------------------------------------------------------------------


def test_options_follow_a_question_mark() -> None:
    path, options = split_options(
        "~/walk?speed=0.5&loop=no&start=3.5&intrinsics=525,524,3,2"
    )
    assert path == Path.home() / "walk"
    lens = Intrinsics(525, 524, 3, 2)
    assert options == Options(0.5, False, 3.5, lens)
    assert split_options("walk?colour=/a/b&depth=/c")[1] == Options(
        colour="/a/b", depth="/c"
    )
    assert split_options("walk?")[1] == Options()


def test_a_path_with_a_question_mark_is_a_path(tmp_path: Path) -> None:
    odd = tmp_path / "why?speed=2"
    odd.mkdir()
    assert split_options(str(odd)) == (odd, Options())
    path, options = split_options(f"{odd}?speed=3")
    assert (path, options.speed) == (odd, 3)


@pytest.mark.parametrize(
    ("query", "told"),
    [
        ("sped=1", r"there is no option sped \(did you mean speed\?\)"),
        ("x=1", "there is no option x; there are speed, loop, start"),
        ("speed", "option speed has no value"),
        ("speed=0", "a speed is a number above 0"),
        ("speed=nan", "a speed is a number above 0"),
        ("speed=fast", "speed=fast: a speed is a number above 0"),
        ("loop=never", "write loop=yes or loop=no"),
        ("start=-1", "a number of seconds from 0"),
        ("intrinsics=1,2,3", "write fx,fy,cx,cy in pixels"),
        ("intrinsics=1,2,3,inf", "write fx,fy,cx,cy in pixels"),
    ],
)
def test_an_option_that_is_not_understood(query: str, told: str) -> None:
    with pytest.raises(SensorError, match=rf"walk\?{query}.*{told}"):
        split_options(f"walk?{query}")


# --- pairs ---------------------------------------------------------------------------

ROWS = st.lists(st.integers(0, 2000), max_size=30).map(
    lambda row: [it / 1000 for it in sorted(row)]
)


@given(ROWS, ROWS)
def test_pairs_are_in_order_near_and_each_taken_once(
    first: list[float], second: list[float]
) -> None:
    pairs = list(pair_times(first, second))
    assert all(abs(first[i] - second[j]) <= 0.02 for i, j in pairs)
    for (i, j), (k, m) in pairwise(pairs):
        assert i < k
        assert j < m


@given(ROWS.map(lambda row: sorted(set(row))))
def test_what_has_the_same_times_is_paired_whole(row: list[float]) -> None:
    assert list(pair_times(row, row)) == [(i, i) for i in range(len(row))]


@given(st.lists(st.booleans(), max_size=40), st.floats(-0.016, 0.016))
def test_streams_at_30_a_second_lose_only_what_is_missing(
    there: list[bool], late: float
) -> None:
    first = [number / 30 for number in range(len(there))]
    second = [time + late for time, it in zip(first, there, strict=True) if it]
    pairs = list(pair_times(first, second))
    assert [i for i, _ in pairs] == [i for i, it in enumerate(there) if it]


def test_what_is_lost_is_told_in_one_line() -> None:
    assert remark_on([], 9) == ""
    assert "2 of 9 files are missing or not whole (a and others)" in remark_on(
        ["a", "b"], 9
    )
