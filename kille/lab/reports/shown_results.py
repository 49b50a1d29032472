"""Results as a notebook shows them: the text, the tables and the figures."""

from __future__ import annotations

from kille.lab.reports.drawing import MISSING, can_draw, svg
from kille.lab.results import Cell, Figure, Result, Table, format_cell, shown_result
from ttr.escapes import html_text
from ttr.showing import Figure as Picture
from ttr.showing import Part, Text, below, table

_INK = "#7a7a7a"
"""Legible on a light and on a dark page, as that of `ttr.display.notebook`."""

_WIDTH = 560  # pixels


@shown_result.provided_by
def _shown(result: Result | Table | Figure) -> Part:
    match result:
        case Table():
            return below(
                Text(result.title, "strong"),
                table(result.columns, result.rows, _cells),
                Text(result.note, "quiet") if result.note else None,
            )
        case Figure():
            return below(
                Text(result.title, "strong"),
                _drawing(result),
                Text(result.note, "quiet") if result.note else None,
            )
    return below(
        Text(result.title, "strong"),
        Text(result.text) if result.text else None,
        *map(_shown, result.tables),
        *map(_shown, result.figures),
    )


def _cells(row: tuple[Cell, ...]) -> tuple[Part, ...]:
    return tuple([Text(format_cell(cell)) for cell in row])


def _drawing(figure: Figure) -> Part:
    """The figure as SVG that stands alone, on the ground of the page around it."""
    if not can_draw():
        return Text(MISSING, "quiet")
    drawn = svg(figure).replace("currentColor", _INK)
    about = html_text(figure.title)
    head, _, inside = drawn.partition(">")
    whole = f'{head} role="img" aria-label="{about}">{inside}'
    return Picture(whole.encode(), "image/svg+xml", figure.title, _WIDTH)
