"""Where a word holds, and how surely: curves and maps of degrees, as SVG.

They have no ground of their own, and colours that are legible on a light and on a dark
page: a picture cannot know on which it will be.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import groupby, islice, pairwise

from ttr.escapes import html_text
from ttr.showing import Figure

CELLS = 24
"""A map has so many squares in each direction."""

POINTS = 120
"""A curve has a degree for each end of so many pieces."""

Interval = tuple[float, float]
"""A degree with its lower and its upper bound, which are the same if it is known."""

Point = tuple[float, float]

_SIZE, _HEIGHT = 192, 110  # pixels of a map and of the height of a curve
_LEFT, _TOP, _BELOW = 34, 18, 18
_INK, _SHADE, _LINE = "#7a7a7a", "#3d85c6", "#d97706"


def degree_map(
    degrees: Callable[[Sequence[Point]], Iterable[Interval]],
    reach: float,
    *,
    unit: str = "",
    about: str = "",
) -> Figure:
    """The degrees of the points (x, y) with |x|, |y| <= reach: the stronger, the surer.

    A square has the degree of its middle; of an interval, the middle of it. A line is
    drawn where that crosses a half. `degrees` is asked once, of all points.
    """
    middles = [reach * (2 * (k + 0.5) / CELLS - 1) for k in range(CELLS)]
    found = map(_middle, degrees([(x, y) for y in middles for x in middles]))
    rows = [[*islice(found, CELLS)] for _ in middles]
    side = _SIZE / CELLS
    squares = []
    for j, row in enumerate(rows):
        top, left = _TOP + _SIZE - (j + 1) * side, float(_LEFT)
        for shade, run in groupby(f"{it:.2f}" for it in row):
            width = len([*run]) * side
            if float(shade):
                squares.append(
                    f'<rect x="{left:g}" y="{top:g}" width="{width:g}" '
                    f'height="{side:g}" fill-opacity="{shade}"/>'
                )
            left += width
    border = "".join(
        f"M{_LEFT + (x + 0.5) * side:g},{_TOP + _SIZE - (y + 0.5) * side:g}"
        f"L{_LEFT + (u + 0.5) * side:g},{_TOP + _SIZE - (v + 0.5) * side:g}"
        for (x, y), (u, v) in _crossings(rows)
    )
    drawn = f'<g fill="{_SHADE}">{"".join(squares)}</g>{_frame(_SIZE)}{_border(border)}'
    labels = _labels(_SIZE, (-reach, reach), (-reach, reach), unit)
    said = about or "where it holds: the stronger the colour, the surer"
    return _figure(drawn + labels, _SIZE, said)


def degree_curve(
    degree: Callable[[float], Interval], low: float, high: float
) -> Figure:
    """The degrees of the numbers from low to high, as a curve between 0 and 1.

    An interval is a band. A line is drawn where its middle crosses a half.
    """
    numbers = [low + (high - low) * k / POINTS for k in range(POINTS + 1)]
    found = [degree(it) for it in numbers]

    def at(k: int, p: float) -> str:
        return f"{_LEFT + _SIZE * k / POINTS:.1f},{_TOP + _HEIGHT * (1 - p):.1f}"

    upper = [at(k, hi) for k, (_, hi) in enumerate(found)]
    lower = [at(k, lo) for k, (lo, _) in enumerate(found)]
    middles = [_middle(it) for it in found]
    borders = [
        _border_between(degree, low + (high - low) * k / POINTS, (high - low) / POINTS)
        for k, (one, other) in enumerate(pairwise(middles))
        if (one >= 0.5) != (other >= 0.5)
    ]
    places = [_LEFT + _SIZE * (it - low) / (high - low) for it in borders]
    border = "".join(f"M{x:.1f},{_TOP}V{_TOP + _HEIGHT}" for x in places)
    curve = " ".join(at(k, p) for k, p in enumerate(middles))
    drawn = (
        f'<polygon points="{" ".join([*upper, *reversed(lower)])}" fill="{_SHADE}" '
        f'fill-opacity="0.3"/>{_frame(_HEIGHT)}{_border(border)}'
        f'<polyline points="{curve}" fill="none" stroke="{_SHADE}" stroke-width="2"/>'
    )
    told = "".join(
        _label(x, _TOP - 5, "middle", _number(value, high - low), _LINE)
        for x, value in [*zip(places, borders, strict=True)][:2]
    )
    said = ", ".join(_number(it, high - low) for it in borders[:2])
    about = f"the higher, the surer; it crosses a half at {said or 'no place'}"
    labels = _labels(_HEIGHT, (low, high), (0, 1))
    return _figure(drawn + told + labels, _HEIGHT, about)


def _number(value: float, among: float) -> str:
    """A number as exactly as it can be told on an axis as long as this."""
    return f"{round(value, 2 - math.floor(math.log10(among))):.10g}"


def _middle(p: Interval) -> float:
    return (p[0] + p[1]) / 2


def _border_between(
    degree: Callable[[float], Interval], start: float, step: float
) -> float:
    """Where in a short interval the degree crosses a half."""
    begins = _middle(degree(start)) >= 0.5
    for _ in range(12):
        step /= 2
        if (_middle(degree(start + step)) >= 0.5) == begins:
            start += step
    return start


def _share(one: float, other: float) -> float:
    """Where between two places the degree is a half: 0 at the one, 1 at the other."""
    return (0.5 - one) / (other - one)


def _crossings(rows: list[list[float]]) -> Iterator[tuple[Point, Point]]:
    """Pieces of the line where degrees cross a half, by squares of four places."""
    for y in range(len(rows) - 1):
        for x in range(len(rows[y]) - 1):
            corners = ((x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1))
            ends = []
            for k, (u, v) in enumerate(corners):
                w, z = corners[(k + 1) % 4]
                one, other = rows[v][u], rows[z][w]
                if (one >= 0.5) != (other >= 0.5):
                    share = _share(one, other)
                    ends.append((u + share * (w - u), v + share * (z - v)))
            yield from zip(ends[::2], ends[1::2], strict=True)


def _frame(height: int) -> str:
    return (
        f'<rect x="{_LEFT}" y="{_TOP}" width="{_SIZE}" height="{height}" '
        f'fill="none" stroke="{_INK}" stroke-opacity="0.6"/>'
    )


def _border(path: str) -> str:
    return f'<path d="{path}" fill="none" stroke="{_LINE}" stroke-width="1.5"/>'


def _labels(height: int, across: Interval, upwards: Interval, unit: str = "") -> str:
    bottom = _TOP + height
    return "".join(
        [
            _label(_LEFT, bottom + 13, "start", f"{across[0]:.10g}"),
            _label(_LEFT + _SIZE, bottom + 13, "end", f"{across[1]:.10g}{unit}"),
            _label(_LEFT - 4, bottom, "end", f"{upwards[0]:g}"),
            _label(_LEFT - 4, _TOP + 9, "end", f"{upwards[1]:g}"),
        ]
    )


def _label(x: float, y: float, anchor: str, text: str, ink: str = _INK) -> str:
    return (
        f'<text x="{x:g}" y="{y:g}" text-anchor="{anchor}" fill="{ink}">'
        f"{html_text(text)}</text>"
    )


def _figure(drawn: str, height: int, about: str) -> Figure:
    width, whole = _LEFT + _SIZE + 12, _TOP + height + _BELOW
    svg = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{whole}" '
        f'viewBox="0 0 {width} {whole}" font-family="sans-serif" font-size="10.5">'
        f"{drawn}</svg>"
    )
    return Figure(svg.encode(), "image/svg+xml", about, width)
