"""Labels of points stand beside them, and cover nothing."""

from __future__ import annotations

from itertools import combinations
from random import Random
from typing import Any

import pytest

from kille.lab.reports.drawing import drawing
from kille.lab.results import Figure

pytest.importorskip("matplotlib")


def points(*places: tuple[float, float], wide: float = 0.0) -> Figure:
    """A series of points with bands, each called by its number."""
    xs, ys = ([place[axis] for place in places] for axis in (0, 1))
    series = {
        "x": xs,
        "y": ys,
        "x_low": [x - wide for x in xs],
        "x_high": [x + wide for x in xs],
        "y_low": [y - wide / 500 for y in ys],
        "y_high": [y + wide / 500 for y in ys],
        "labels": [f"tutor {number}" for number in range(len(places))],
    }
    return Figure("points", "", {"series": {"a": series}})


def boxes(figure: Figure) -> dict[str, Any]:
    """What each label covers, in pixels."""
    from matplotlib.text import Annotation, Text

    drawn = drawing(figure)
    drawn.draw_without_rendering()
    (axes,) = drawn.axes
    found = [it for it in axes.texts if isinstance(it, Annotation)]
    return {it.get_text(): Text.get_window_extent(it) for it in found}


def test_labels_of_points_that_lie_close_do_not_cover_each_other() -> None:
    chance = Random(1)
    places = [(chance.uniform(430, 460), chance.uniform(0.88, 0.92)) for _ in range(6)]
    far = [(200.0, 0.2), (700.0, 1.0)]
    found = boxes(points(*places, *far, wide=8.0))
    assert len(found) == 8
    for one, other in combinations(found.values(), 2):
        assert not one.overlaps(other)


def test_labels_cover_no_point_and_stay_inside() -> None:
    places = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0), (1.0, 0.97)]
    figure = points(*places)
    drawn = drawing(figure)
    drawn.draw_without_rendering()
    (axes,) = drawn.axes
    pixels = axes.transData.transform(places)
    for box in boxes(figure).values():
        assert not any(box.contains(*it) for it in pixels)
        assert axes.bbox.contains(box.x0, box.y0)
        assert axes.bbox.contains(box.x1, box.y1)


def test_points_without_labels_have_none() -> None:
    series = {"a": {"x": [1.0], "y": [2.0]}, "b": {"x": [1.0], "y": [2.0]}}
    assert not boxes(Figure("points", "", {"series": series}))
