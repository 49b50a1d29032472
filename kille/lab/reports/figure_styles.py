"""The style of all figures: hues, markers, an empty drawing, a legend.

Hues are those of Okabe and Ito 2008, which people with any colour vision tell apart;
series differ in their markers too.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import cycle
from typing import TYPE_CHECKING, Any, Literal

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Drawing

HUES = ("#0072B2", "#E69F00", "#009E73", "#CC79A7", "#56B4E9", "#D55E00")
MARKERS = ("o", "s", "^", "D", "v", "P", "X")
RIGHT, WRONG = HUES[0], HUES[5]

INK = "#0a0b0c"
"""Stands for the colour of the text."""

FAINT = "#7f7f7f"

WIDTH = 6.4
"""Inches that most drawings are wide."""

_LETTERS = 11  # an inch
_HANDLE = 9  # letters that the line and the space beside a name take
_COLUMNS = 3


def blank_drawing(width: float, height: float) -> tuple[Drawing, Axes]:
    """An empty drawing, whose size is in inches, with its axes."""
    from matplotlib.figure import Figure as Drawing

    drawn = Drawing(figsize=(width, height), layout="constrained")
    return drawn, drawn.subplots()


def styles_of(
    series: Mapping[str, Mapping[str, Any]],
) -> Iterator[tuple[str, Mapping[str, Any], str, str]]:
    """Each series by its name, with its hue and its marker."""
    for (name, it), hue, marker in zip(
        series.items(), cycle(HUES), cycle(MARKERS), strict=False
    ):
        yield name, it, hue, marker


def add_grid(axes: Axes, axis: Literal["x", "both"] = "both") -> None:
    """Draw faint lines at the ticks."""
    axes.grid(axis=axis, color=FAINT, alpha=0.25, lw=0.6)


def hide_vertical_axis(axes: Axes) -> None:
    """Leave only the labels of the vertical axis."""
    axes.tick_params(axis="y", length=0)
    axes.spines["left"].set_visible(False)
    add_grid(axes, "x")


def add_legend(axes: Axes, width: float = WIDTH) -> None:
    """Put a legend above the axes, in as many columns as fit.

    The width is that of the drawing, in inches.
    """
    names = axes.get_legend_handles_labels()[1]
    longest = max(map(len, names), default=0)
    fitting = int(width * _LETTERS) // (longest + _HANDLE)
    columns = max(1, min(len(names), _COLUMNS, fitting))
    axes.legend(
        loc="lower left", bbox_to_anchor=(0, 1), ncols=columns, borderaxespad=0.2
    )


def name_axes(axes: Axes, data: Mapping[str, Any]) -> None:
    """Label the axes as the data says."""
    axes.set_xlabel(data.get("xlabel", ""))
    axes.set_ylabel(data.get("ylabel", ""))
