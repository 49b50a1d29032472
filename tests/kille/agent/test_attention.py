"""What is looked at: things keep their numbers from look to look."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

from kille.agent.attention import AttentiveSensor, NumberedLook
from kille.perception.picture_sheet import overview
from kille.scene import Frame
from kille.sensors.sensor import SensorError

sys.path.append(str(Path(__file__).parents[1] / "perception"))

from tabletop import Camera, Card, frame_of, share

NEAR, MIDDLE, FAR = Card(0.15, 0.7), Card(-0.15, 0.8), Card(0.02, 1.0)
NEW = Card(0.0, 0.62, width=0.06, height=0.06)


def gaze_at(*scenes: tuple[Card, ...]) -> AttentiveSensor:
    """A gaze at a table on which things come and go from look to look."""
    return AttentiveSensor(Camera(*(frame_of(*cards) for cards in scenes)), scans=1)


def numbers(view: NumberedLook, frame: Frame) -> list[int]:
    """The number in view of each thing in the frame, in the order of its outlines."""
    return [
        1 + int(np.argmax([share(mask, it.region) for it in view.look.percepts]))
        for mask in frame.outlines.values()
    ]


def test_things_are_numbered_by_nearness_at_first() -> None:
    gaze = gaze_at((FAR, NEAR, MIDDLE))
    view = gaze.look()
    assert numbers(view, view.look.frame) == [3, 1, 2]
    assert view.focus == 1


def test_what_stays_keeps_its_number_when_something_new_comes() -> None:
    gaze = gaze_at((NEAR, MIDDLE), (NEAR, MIDDLE, NEW))
    gaze.look()
    view = gaze.look()
    assert numbers(view, view.look.frame) == [1, 2, 3]
    assert view.focus == 3


def test_what_is_new_gets_the_number_of_what_went() -> None:
    gaze = gaze_at((NEAR, MIDDLE, FAR), (NEW, MIDDLE, FAR))
    gaze.look()
    view = gaze.look()
    assert numbers(view, view.look.frame) == [1, 2, 3]


def test_later_things_move_up_when_one_goes() -> None:
    gaze = gaze_at((NEAR, MIDDLE, FAR), (NEAR, FAR))
    gaze.look()
    view = gaze.look()
    assert numbers(view, view.look.frame) == [1, 2]


def test_the_focus_stays_where_it_was_while_the_same_things_are_in_view() -> None:
    level = Card(0.15, 0.8), Card(-0.15, 0.8)
    gaze = AttentiveSensor(
        Camera(*(frame_of(*level, noise=0.004, seed=i) for i in range(6))), 1
    )
    views = [gaze.look() for _ in range(6)]
    assert {view.focus for view in views} == {views[0].focus}
    assert all(numbers(it, it.look.frame) == [1, 2] for it in views) or all(
        numbers(it, it.look.frame) == [2, 1] for it in views
    )


def test_pointing_by_number_is_at_the_thing_of_the_latest_view() -> None:
    gaze = gaze_at((NEAR, MIDDLE), (NEAR, MIDDLE, NEW), (NEAR, MIDDLE, NEW))
    gaze.look()
    gaze.look()
    gaze.point("#2")
    view = gaze.look()
    assert view.focus == 2
    assert numbers(view, view.look.frame) == [1, 2, 3]


def test_there_is_nothing_to_point_at_on_an_empty_table() -> None:
    gaze = gaze_at(())
    assert gaze.look().focus is None
    with pytest.raises(SensorError, match="nothing is in view"):
        gaze.point("1")


def test_pointing_by_a_box_is_at_the_region_that_was_drawn() -> None:
    gaze = gaze_at((MIDDLE, FAR))
    gaze.look()
    gaze.point("20 30 80 90")
    view = gaze.look()
    assert view.focus is not None
    assert view.pointed
    region = view.look.percepts[view.focus - 1].region
    assert region.box == (20, 30, 80, 90)


@pytest.mark.parametrize("box", ["20 30 24 34", "80 90 20 30", "9000 0 9100 90"])
def test_a_box_without_pixels_is_nothing_to_point_at(box: str) -> None:
    gaze = gaze_at((MIDDLE,))
    with pytest.raises(SensorError, match="too small to point at"):
        gaze.point(box)


def test_a_second_thing_is_pointed_at_until_what_was_said_is_taken_in() -> None:
    gaze = gaze_at((NEAR, MIDDLE, FAR))
    gaze.look()
    gaze.point("2")
    gaze.point("that 3")
    looks = [gaze.look(), gaze.look()]
    assert [(it.focus, it.pointed, it.second) for it in looks] == [(2, True, 3)] * 2
    assert looks[0].roles == {2: "this", 3: "that"}
    gaze.settle()
    after = gaze.look()
    assert (after.focus, after.pointed, after.second) == (2, False, None)
    assert after.roles == {2: "this"}


def test_a_picture_marks_what_this_and_that_are() -> None:
    gaze = gaze_at((NEAR, MIDDLE, FAR))
    one = gaze.look()
    gaze.point("2")
    gaze.point("that 3")
    both = gaze.look()
    shown = both._repr_html_()
    assert "2 is “this”; 3 is “that”" in shown
    assert ">that<" in shown
    assert "“" not in one._repr_html_()
    pictures = [overview(both.look, roles=it) for it in ({}, both.roles)]
    assert not np.array_equal(*pictures)


def test_pointing_at_one_thing_drops_the_second() -> None:
    gaze = gaze_at((NEAR, MIDDLE, FAR))
    gaze.look()
    for target in ("2", "that 3", "1"):
        gaze.point(target)
    view = gaze.look()
    assert (view.focus, view.second) == (1, None)


def test_a_second_thing_is_another_one() -> None:
    gaze = gaze_at((NEAR, MIDDLE, FAR))
    gaze.look()
    gaze.point("2")
    with pytest.raises(SensorError, match="#2 is pointed at as “this” already"):
        gaze.point("that 2")
    with pytest.raises(SensorError, match="no thing #9"):
        gaze.point("that 9")
    view = gaze.look()
    assert (view.focus, view.second) == (2, None)
