"""Labels of points in a figure, each where it covers no point and no other label."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import product
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from kille.lab.reports.figure_styles import FAINT

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Drawing
    from matplotlib.text import Annotation
    from matplotlib.transforms import Bbox

_AWAY = (5, 13, 22, 32)
_SIDES = ((1, 1), (1, -1), (-1, 1), (-1, -1), (0, 1), (0, -1), (1, 0), (-1, 0))
"""Where a label may stand: so many points away from its point, on these sides of it."""
_LEADING = 10  # points: those farther away have a line to their point
_ACROSS = {1: "left", -1: "right", 0: "center"}
_UPRIGHT = {1: "bottom", -1: "top", 0: "center"}
_SIZE = 8
_AROUND = 1  # pixels about what is covered


class _Label(NamedTuple):
    """The name of a point, and where it is."""

    text: str
    at: tuple[float, float]


def label_points(
    drawn: Drawing, axes: Axes, series: Iterable[Mapping[str, Any]]
) -> None:
    """Write labels at the points of the series, one by one.

    Each stands at the first place where nothing is; if there is none, where it covers
    least. Everything else has to be drawn before.
    """
    every = list(series)
    labels = [
        _Label(text, (x, y))
        for it in every
        for x, y, text in zip(it["x"], it["y"], it.get("labels", ()), strict=False)
    ]
    if not labels:
        return
    drawn.draw_without_rendering()  # places are known only then
    taken = [box for it in every for box in _boxes_of(axes, it)]
    for label in labels:
        taken.append(_place_label(axes, label, taken))


def _boxes_of(axes: Axes, series: Mapping[str, Any]) -> Iterator[Bbox]:
    """The boxes that the points and intervals of a series cover, in pixels."""
    xs, ys = series["x"], series["y"]
    nothing = [float("nan")] * len(xs)
    lows, highs = (
        (series.get(f"x_{end}", nothing), series.get(f"y_{end}", nothing))
        for end in ("low", "high")
    )
    for i, (x, y) in enumerate(zip(xs, ys, strict=True)):
        yield from _box(axes, (x, y), (x, y))
        yield from _box(axes, (lows[0][i], y), (highs[0][i], y))
        yield from _box(axes, (x, lows[1][i]), (x, highs[1][i]))


def _box(axes: Axes, *corners: tuple[float, float]) -> Iterator[Bbox]:
    from matplotlib.transforms import Bbox

    pixels = axes.transData.transform(corners)
    if np.isfinite(pixels).all():
        yield Bbox(pixels).padded(_AROUND)


def _place_label(axes: Axes, label: _Label, taken: Sequence[Bbox]) -> Bbox:
    """Write the label where it covers least; returns its box."""
    from matplotlib.text import Text

    tried = []
    for away, side in product(_AWAY, _SIDES):
        drawn = _write_label(axes, label, away, side)
        drawn.get_window_extent()  # finds its place, and counts the line to its point
        box = Text.get_window_extent(drawn)
        cost = _covered_area(box, taken) + _area_outside(box, axes.bbox)
        tried.append((cost, box, drawn))
        if not cost:
            break
    best = min(tried, key=lambda it: it[0])
    for it in tried:
        if it is not best:
            it[2].remove()
    return best[1]


def _write_label(
    axes: Axes, label: _Label, away: float, side: tuple[int, int]
) -> Annotation:
    leading = {"arrowstyle": "-", "color": FAINT, "lw": 0.5, "shrinkA": 0, "shrinkB": 2}
    return axes.annotate(
        label.text,
        label.at,
        xytext=(away * side[0], away * side[1]),
        textcoords="offset points",
        ha=_ACROSS[side[0]],
        va=_UPRIGHT[side[1]],
        fontsize=_SIZE,
        arrowprops=leading if away > _LEADING else None,
    )


def _covered_area(box: Bbox, others: Iterable[Bbox]) -> float:
    """How many square pixels of a box are covered already."""
    return sum(_common_area(box, it) for it in others)


def _common_area(one: Bbox, other: Bbox) -> float:
    wide = min(one.x1, other.x1) - max(one.x0, other.x0)
    high = min(one.y1, other.y1) - max(one.y0, other.y0)
    return float(max(wide, 0.0) * max(high, 0.0))


def _area_outside(box: Bbox, frame: Bbox) -> float:
    return float(box.width * box.height) - _common_area(box, frame)
