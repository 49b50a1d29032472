"""Drawing figures with matplotlib, which comes with the extra `plots`.

Ink has a colour of its own, for which a page puts the colour of its text, by day and by
night.
"""

from __future__ import annotations

import io
import re
import warnings
from collections.abc import Callable, Mapping
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

import numpy as np

from kille.lab.reports.figure_styles import (
    FAINT,
    INK,
    RIGHT,
    WIDTH,
    WRONG,
    add_grid,
    add_legend,
    blank_drawing,
    hide_vertical_axis,
    name_axes,
    styles_of,
)
from kille.lab.reports.interval_figures import (
    draw_intervals,
    draw_points,
    draw_reliability,
)
from kille.lab.results import Figure
from ttr.escapes import terminal_line

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Drawing

__all__ = ["MISSING", "can_draw", "drawing", "jpeg", "pdf", "svg"]

MISSING = "no figures: they need matplotlib, pip install 'kille[plots]'"
"""What is said where figures cannot be drawn.

>>> from kille.lab.reports.drawing import MISSING
>>> print(MISSING)
no figures: they need matplotlib, pip install 'kille[plots]'
"""

_TICKS = 13  # up to this many measured places each have a number on the axis
_SETTINGS: Any = {
    "svg.fonttype": "none",
    "pdf.fonttype": 42,  # letters that remain letters
    "text.parse_math": False,  # a dollar in a word is a dollar
    "text.usetex": False,  # a matplotlibrc in the working directory starts no LaTeX
    "font.size": 10,
    "font.family": "sans-serif",
    "axes.titlesize": 10,
    **dict.fromkeys(
        ("text.color", "axes.edgecolor", "axes.labelcolor", "xtick.color"), INK
    ),
    "ytick.color": INK,
    "axes.facecolor": "none",
    "figure.facecolor": "none",
    "legend.frameon": False,
    "axes.spines.top": False,
    "axes.spines.right": False,
}


def can_draw() -> bool:
    """Is matplotlib installed?

    >>> can_draw() in (True, False)
    True
    """
    return find_spec("matplotlib") is not None


def drawing(figure: Figure) -> Drawing:
    """The figure drawn, without its title; ImportError without matplotlib.

    >>> from kille.lab.results import Figure
    >>> counts = {"labels": ["cup"], "values": [3], "ylabel": ""}
    >>> bars = Figure("bars", "Words", counts)
    >>> drawing(bars) is not None
    True
    """
    from matplotlib import rc_context

    with rc_context(_SETTINGS):
        return _DRAW[figure.kind](_make_visible(figure.data))


def _make_visible(data: Any) -> Any:
    """The data with the invisible characters of their words made visible."""
    match data:
        case str():
            return terminal_line(data)
        case list() | tuple():
            return [_make_visible(it) for it in data]
        case Mapping():
            return {_make_visible(key): _make_visible(it) for key, it in data.items()}
    return data


def svg(figure: Figure, number: int = 0) -> str:
    """The figure as SVG, to be figure `number` of a page.

    The ink is `currentColor`. The same figure is the same text.

    >>> from kille.lab.results import Figure
    >>> counts = {"labels": ["cup"], "values": [3], "ylabel": ""}
    >>> bars = Figure("bars", "Words", counts)
    >>> "<svg" in svg(bars)
    True
    """
    from matplotlib import rc_context

    text = io.StringIO()
    with (
        rc_context({**_SETTINGS, "svg.hashsalt": f"figure {number}"}),
        warnings.catch_warnings(),
    ):
        # An odd word makes an odd figure: a box for what the font lacks, no room left.
        warnings.simplefilter("ignore", UserWarning)
        drawing(figure).savefig(text, format="svg", metadata={"Date": None})
    inner = text.getvalue()[text.getvalue().index("<svg") :]
    inner = re.sub(r"<metadata>.*?</metadata>\s*", "", inner, flags=re.DOTALL)
    inner = re.sub(r'(<(?:g|svg)\b[^>]*?) id="[^"]*"', r"\1", inner)
    return inner.replace(INK, "currentColor")


def pdf(figure: Figure) -> bytes:
    """The figure as a PDF file for a paper; ImportError without matplotlib.

    The same figure is the same file.

    >>> from kille.lab.results import Figure
    >>> counts = {"labels": ["cup"], "values": [3], "ylabel": ""}
    >>> bars = Figure("bars", "Words", counts)
    >>> pdf(bars)[:5]
    b'%PDF-'
    """
    from matplotlib import rc_context

    file = io.BytesIO()
    with rc_context(_SETTINGS), warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        drawing(figure).savefig(file, format="pdf", metadata={"CreationDate": None})
    return file.getvalue()


def jpeg(picture: Any) -> bytes:
    """A picture (H, W, 3) of RGB as a JPEG file; ImportError without matplotlib.

    >>> import numpy as np
    >>> jpeg(np.zeros((8, 8, 3), np.uint8))[:2].hex()
    'ffd8'
    """
    from matplotlib.image import imsave

    file, pixels = io.BytesIO(), np.ascontiguousarray(picture, np.uint8)
    imsave(file, pixels, format="jpeg", pil_kwargs={"quality": 88})
    return file.getvalue()


def _draw_confusion(data: Mapping[str, Any]) -> Drawing:
    """Right answers are blue and on the diagonal, wrong ones are red."""
    rows = list(data["labels"])
    columns = list(data.get("columns", rows))
    counts = np.asarray(data["counts"], float)
    share = counts / np.maximum(counts.sum(axis=1, keepdims=True), 1)
    cell = 0.42
    drawn, axes = blank_drawing(2.2 + cell * len(columns), 1.8 + cell * len(rows))
    for i, row in enumerate(rows):
        for j, column in enumerate(columns):
            if counts[i, j]:
                hue = RIGHT if row == column else WRONG
                alpha = 0.12 + 0.58 * share[i, j]
                axes.add_patch(_square(j, i, hue, alpha))
                axes.text(j, i, f"{counts[i, j]:g}", ha="center", va="center")
    axes.set_xlim(-0.5, len(columns) - 0.5)
    axes.set_ylim(len(rows) - 0.5, -0.5)
    axes.set_aspect("equal")
    axes.set_xticks(
        range(len(columns)), columns, rotation=50, ha="right", rotation_mode="anchor"
    )
    axes.set_yticks(range(len(rows)), rows)
    axes.set_xlabel("answer")
    axes.set_ylabel("right word")
    axes.tick_params(length=0)
    axes.spines[:].set_visible(False)
    for edge in range(len(rows) + 1):
        axes.axhline(edge - 0.5, color=FAINT, lw=0.3)
    for edge in range(len(columns) + 1):
        axes.axvline(edge - 0.5, color=FAINT, lw=0.3)
    return drawn


def _square(column: int, row: int, hue: str, alpha: float) -> Any:
    from matplotlib.patches import Rectangle

    return Rectangle((column - 0.5, row - 0.5), 1, 1, color=hue, alpha=alpha, lw=0)


def _draw_curves(data: Mapping[str, Any]) -> Drawing:
    """Means with a mark at each measured place, and their intervals."""
    drawn, axes = blank_drawing(WIDTH, 3.8)
    series = data["series"]
    top = 0.0
    for name, it, hue, marker in styles_of(series):
        x = it.get("x", data.get("x"))
        axes.plot(x, it["mean"], color=hue, marker=marker, ms=5, lw=1.8, label=name)
        if it.get("low") is not None and it.get("high") is not None:
            axes.fill_between(x, it["low"], it["high"], color=hue, alpha=0.18, lw=0)
        top = max([top, *(value for value in it["mean"] if value is not None)])
    log = data.get("log", ())
    if "x" in log:
        axes.set_xscale("log")
    if "y" in log:
        axes.set_yscale("log")
        _set_decades(axes)
    elif top <= 1:
        axes.set_ylim(0, 1.03)
    if 0 < len(data.get("x", ())) <= _TICKS:
        axes.set_xticks(list(data["x"]), [f"{it:,g}" for it in data["x"]])
        axes.set_xticks([], minor=True)
    name_axes(axes, data)
    add_grid(axes)
    add_legend(axes)
    return drawn


def _set_decades(axes: Axes) -> None:
    """Label the logarithmic vertical axis with powers of ten, in plain numbers."""
    low, high = np.log10(axes.get_ylim())
    powers = 10.0 ** np.arange(np.floor(low), np.ceil(high) + 1)
    axes.set_ylim(powers[0], powers[-1])
    axes.set_yticks(powers, [f"{it:,g}" for it in powers])


def _draw_bars(data: Mapping[str, Any]) -> Drawing:
    """Horizontal bars, the first on top; those below 0 are red."""
    labels, values = list(data["labels"]), np.asarray(data["values"], float)
    drawn, axes = blank_drawing(WIDTH, 0.9 + 0.3 * len(labels))
    places = np.arange(len(labels))
    hues = [RIGHT if value >= 0 else WRONG for value in values]
    axes.barh(places, values, color=hues, alpha=0.75, height=0.68)
    if data.get("low") is not None and data.get("high") is not None:
        axes.hlines(places, data["low"], data["high"], color=INK, lw=1.2)
    axes.set_yticks(places, labels)
    axes.invert_yaxis()
    axes.axvline(0, color=INK, lw=0.8)
    low = min(0.0, *values, *(data.get("low") or [0.0]))
    high = max(*values, *(data.get("high") or [0.0]), 0.0)
    axes.set_xlim(low * 1.05, 1.03 if 0.5 < high <= 1 else high * 1.05 or 1)
    axes.set_xlabel(data.get("ylabel", ""))
    hide_vertical_axis(axes)
    return drawn


def _draw_map(data: Mapping[str, Any]) -> Drawing:
    """The degree of each word at each place around the landmark, seen from above."""
    from matplotlib.figure import Figure as Drawing

    words = list(data["words"])
    columns = min(len(words), 3)
    rows = -(-len(words) // columns)
    drawn = Drawing(figsize=(2.5 * columns + 0.7, 2.5 * rows), layout="constrained")
    grid = drawn.subplots(rows, columns, squeeze=False, sharex=True, sharey=True)
    every = list(grid.ravel())
    for axes, word in zip(every, words, strict=False):
        image = _draw_word(axes, data, word)
    for axes in every[len(words) :]:
        axes.set_visible(False)
    drawn.supxlabel(data.get("xlabel", "right"))
    drawn.supylabel(data.get("ylabel", "away"))
    drawn.colorbar(image, ax=every, label="degree", shrink=0.8)
    return drawn


def _draw_word(axes: Axes, data: Mapping[str, Any], word: str) -> Any:
    """Draw the degrees of one word, with the line of .5, the landmark and lessons."""
    x, y = np.asarray(data["right"], float), np.asarray(data["away"], float)
    degrees = np.asarray(data["degrees"][word], float)
    look: Any = {"cmap": "cividis", "shading": "nearest", "rasterized": True}
    image = axes.pcolormesh(x, y, degrees, vmin=0, vmax=1, **look)
    if np.nanmin(degrees) < 0.5 < np.nanmax(degrees):
        axes.contour(x, y, degrees, levels=[0.5], colors="#ffffff", linewidths=1)
    axes.plot(0, 0, marker="s", ms=7, color=WRONG, mec="#ffffff")
    for place in (data.get("points") or {}).get(word, ()):
        axes.plot(*place, marker="o", ms=3, color="#ffffff", mec=INK, mew=0.5)
    axes.set_title(word)
    axes.set_aspect("equal")
    return image


def _draw_pictures(data: Mapping[str, Any]) -> Drawing:
    """Pictures in rows with their captions; those that are not good are framed red."""
    from matplotlib.figure import Figure as Drawing

    pictures, captions = list(data["pictures"]), list(data["captions"])
    good = list(data.get("good") or [True] * len(pictures))
    columns = min(max(len(pictures), 1), 5)
    rows = max(-(-len(pictures) // columns), 1)
    drawn = Drawing(figsize=(1.7 * columns, 2.1 * rows), layout="constrained")
    every = drawn.subplots(rows, columns, squeeze=False).ravel()
    for axes in every:
        axes.set_axis_off()
    for axes, picture, caption, fine in zip(
        every, pictures, captions, good, strict=False
    ):
        axes.set_axis_on()
        axes.imshow(np.asarray(picture, np.uint8))
        axes.set(xticks=[], yticks=[])
        axes.spines[:].set_visible(True)
        axes.spines[:].set(color=FAINT if fine else WRONG, lw=1 if fine else 2.5)
        axes.set_title(caption, fontsize=8)
    return drawn


_DRAW: Mapping[str, Callable[[Mapping[str, Any]], Drawing]] = {
    "confusion": _draw_confusion,
    "curves": _draw_curves,
    "bars": _draw_bars,
    "map": _draw_map,
    "pictures": _draw_pictures,
    "points": draw_points,
    "intervals": draw_intervals,
    "reliability": draw_reliability,
}
