"""Figures of numbers with their intervals: in rows, as points, and of reliability."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from kille.lab.reports.figure_styles import (
    FAINT,
    INK,
    WIDTH,
    add_grid,
    add_legend,
    blank_drawing,
    hide_vertical_axis,
    name_axes,
    styles_of,
)
from kille.lab.reports.point_labels import label_points
from kille.lab.reports.row_figures import figure_height

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawing

_SQUARE = 4.8


def draw_intervals(data: Mapping[str, Any]) -> Drawing:
    """A row for each label, with a mark and an interval for each series."""
    labels, series = list(data["labels"]), data["series"]
    drawn, axes = blank_drawing(WIDTH, figure_height(len(labels), len(series)))
    apart = 0.62 / max(len(series), 1)
    for number, (name, it, hue, marker) in enumerate(styles_of(series)):
        places = np.arange(len(labels)) + (number - (len(series) - 1) / 2) * apart
        axes.hlines(places, it["low"], it["high"], color=hue, lw=1.6)
        axes.plot(
            it["values"], places, ls="", marker=marker, color=hue, ms=5.5, label=name
        )
    if "zero" in data:
        axes.axvline(data["zero"], color=INK, lw=0.8)
    axes.set_yticks(range(len(labels)), labels)
    axes.set_ylim(len(labels) - 0.4, -0.6)
    axes.set_xlabel(data.get("xlabel", ""))
    axes.locator_params(axis="x", nbins=6)
    axes.ticklabel_format(axis="x", style="plain", useOffset=False)
    hide_vertical_axis(axes)
    if len(series) > 1:
        add_legend(axes)
    return drawn


def draw_reliability(data: Mapping[str, Any]) -> Drawing:
    """The share that is right against the degree, above how often each was said.

    Source: Murphy and Winkler 1977; DeGroot and Fienberg 1983.
    """
    from matplotlib.figure import Figure as Drawing

    drawn = Drawing(figsize=(_SQUARE, 5.2), layout="constrained")
    axes, below = drawn.subplots(
        2, 1, sharex=True, gridspec_kw={"height_ratios": (4, 1)}
    )
    axes.plot([0, 1], [0, 1], color=FAINT, lw=1, ls=(0, (4, 3)))
    for name, it, hue, marker in styles_of(data["series"]):
        axes.vlines(it["x"], it["low"], it["high"], color=hue, lw=1.2)
        axes.plot(it["x"], it["y"], color=hue, marker=marker, ms=5, lw=1.4, label=name)
        below.plot(it["x"], it["counts"], color=hue, marker=marker, ms=3.5, lw=1)
    axes.set(xlim=(0, 1.02), ylim=(0, 1.02))
    name_axes(axes, {"ylabel": data.get("ylabel", "")})
    name_axes(below, {"xlabel": data.get("xlabel", ""), "ylabel": "answers"})
    below.set_ylim(bottom=0)
    for it in (axes, below):
        add_grid(it)
    add_legend(axes, _SQUARE)
    return drawn


def draw_points(data: Mapping[str, Any]) -> Drawing:
    """Points of each series, with intervals both ways and labels if there are any."""
    drawn, axes = blank_drawing(WIDTH, 3.6)
    series = data["series"]
    for name, it, hue, marker in styles_of(series):
        axes.scatter(
            it["x"], it["y"], s=16, color=hue, marker=marker, alpha=0.75, label=name
        )
        if "x_low" in it:
            axes.hlines(it["y"], it["x_low"], it["x_high"], color=hue, lw=1.2)
            axes.vlines(it["x"], it["y_low"], it["y_high"], color=hue, lw=1.2)
    name_axes(axes, data)
    axes.margins(0.12, 0.08)
    add_grid(axes)
    add_legend(axes)
    label_points(drawn, axes, series.values())
    return drawn
