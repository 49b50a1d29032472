"""Where in a plane of percepts a word holds, and how surely: a picture as SVG."""

from __future__ import annotations

from collections.abc import Callable
from itertools import product

from ttr.probability import Degree
from ttr.showing import Figure

CELLS = 24
"""The picture has so many squares in each direction."""

_SIZE, _MARGIN = 192, 22  # pixels

Point = tuple[float, ...]


def degree_map(degree: Callable[[Point], Degree], reach: float, word: str) -> Figure:
    """The degrees of the points (x, y) with |x|, |y| <= reach, the darker the higher.

    A square has the degree of its middle; of an interval, the middle of it.
    """
    side = _SIZE / CELLS
    squares = []
    for i, j in product(range(CELLS), repeat=2):
        x, y = (reach * (2 * (k + 0.5) / CELLS - 1) for k in (i, j))
        p = degree((x, y))
        shade = (p.lo + p.hi) / 2
        left, top = _MARGIN + i * side, _MARGIN / 2 + _SIZE - (j + 1) * side
        squares.append(
            f'<rect x="{left:g}" y="{top:g}" width="{side:g}" height="{side:g}" '
            f'fill-opacity="{shade:.2f}"/>'
        )
    low = _MARGIN / 2 + _SIZE
    label = '<text x="{}" y="{}" text-anchor="{}">{}</text>'
    labels = [
        label.format(_MARGIN, low + 12, "start", f"{-reach:g}"),
        label.format(_MARGIN + _SIZE, low + 12, "end", f"{reach:g}"),
        label.format(_MARGIN - 3, low, "end", f"{-reach:g}"),
        label.format(_MARGIN - 3, _MARGIN / 2 + 9, "end", f"{reach:g}"),
    ]
    width, height = _SIZE + 1.5 * _MARGIN, _SIZE + 1.5 * _MARGIN
    svg = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:g}" '
        f'height="{height:g}" viewBox="0 0 {width:g} {height:g}">'
        f'<rect x="0" y="0" width="{width:g}" height="{height:g}" fill="#fff"/>'
        f'<g fill="#1f5fa8">{"".join(squares)}</g>'
        f'<rect x="{_MARGIN}" y="{_MARGIN / 2:g}" width="{_SIZE}" height="{_SIZE}" '
        'fill="none" stroke="#888"/>'
        f'<g font-family="sans-serif" font-size="10" fill="#333">{"".join(labels)}</g>'
        "</svg>"
    )
    about = f"where {word} holds: the darker, the surer"
    return Figure(svg.encode(), "image/svg+xml", about, round(width))
