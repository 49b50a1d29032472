"""What protocols and studies find out: tables, figures as plain numbers, and facts.

Nothing here draws or prints: a terminal, a page of HTML and a machine each show the
same result in their own way.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal, NamedTuple, TypeAlias

from ttr.hooks import hook
from ttr.showing import NotebookValue, Part

__all__ = [
    "Cell",
    "Estimate",
    "ExperimentError",
    "Figure",
    "Progress",
    "Result",
    "Table",
    "format_cell",
    "silent",
]


class Estimate(NamedTuple):
    """A number, its 95 % confidence interval, and with how many decimals it is shown.

    The ends of an interval that is not known are NaN.

    >>> format_cell(Estimate(0.5, 0.25, 0.75, decimals=2))
    '0.50 [0.25, 0.75]'
    """

    value: float
    low: float
    high: float
    decimals: int = 3


UNKNOWN = Estimate(math.nan, math.nan, math.nan)
"""The estimate of what there is nothing of."""

Cell: TypeAlias = str | float | int | Estimate | None
"""What a table has in one place: words, a number, or nothing.

>>> from kille.lab.results import Cell, Estimate, format_cell
>>> cells: list[Cell] = ["cup", 12, Estimate(0.5, 0.25, 0.75), None]
>>> [format_cell(cell) for cell in cells]
['cup', '12', '0.500 [0.250, 0.750]', '–']
"""

Kind: TypeAlias = Literal[
    "confusion",
    "curves",
    "bars",
    "map",
    "pictures",
    "points",
    "intervals",
    "reliability",
]

Progress: TypeAlias = Callable[[float, str], None]
"""Hears which share in [0, 1] is done, and what is being done now.

>>> from kille.lab.results import Progress, silent
>>> watch: Progress = lambda share, doing: print(f"{share:.0%} {doing}")
>>> watch(0.5, "playing")
50% playing
"""


class ExperimentError(Exception):
    """Nothing can be measured with this data or these methods: one line says why.

    >>> from kille.lab.theories.candidates import candidates
    >>> candidates(["protoype"], {"prototype": dict})
    Traceback (most recent call last):
        ...
    kille.lab.results.ExperimentError: there is no method protoype: did you mean
    prototype? Your own is named FILE.py:NAME or MODULE:NAME
    """


@dataclass(frozen=True)
class Table(NotebookValue):
    """Rows of numbers and words under the names of their columns.

    None is a value that is not known; the note is a sentence to show below the table.
    `links` says where a cell leads to on a page, by its row and column.

    >>> table = Table("Words", ("word", "right"), (("cup", 0.9), ("mug", None)))
    >>> table.has_numbers(1)
    True
    """

    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[Cell, ...], ...]
    note: str = ""
    links: Mapping[tuple[int, int], str] = field(default_factory=dict)

    def _shown_as_(self) -> Part:
        return shown_result(self)

    def has_numbers(self, column: int) -> bool:
        """Are all cells of a column numbers, or unknown?"""
        return all(
            isinstance(row[column], int | float | Estimate | None) for row in self.rows
        )


@dataclass(frozen=True, eq=False)
class Figure(NotebookValue):
    """What a figure shows, as plain numbers and lists; `data` by kind:

    - confusion: labels, counts (rows: the right word; columns: the answer); columns
      are the answers where these are more than the labels
    - curves: x, series {name: {mean, low, high}}, xlabel, ylabel; log names the axes
      that are logarithmic, as in ["x", "y"]
    - bars: labels, values, low and high (may be missing), ylabel
    - map: words, right, away, degrees {word: rows of degrees}; points may be missing
    - pictures: pictures (rows of RGB pixels), captions, good (may be missing)
    - points: series {name: {x, y}}, xlabel, ylabel; with intervals x_low, x_high,
      y_low, y_high, and with labels, if they are there
    - intervals: labels, series {name: {values, low, high}}, xlabel; zero is a line
      where it is given
    - reliability: series {name: {x, y, low, high, counts}}, xlabel, ylabel

    The note is a sentence to show below the figure.

    >>> bars = Figure("bars", "Words", {"labels": ["cup"], "values": [3]})
    >>> bars.data["labels"]
    ['cup']
    """

    kind: Kind
    title: str
    data: Mapping[str, Any]
    note: str = ""

    def _shown_as_(self) -> Part:
        return shown_result(self)


@hook
def shown_result(result: Result | Table | Figure) -> Part:
    """What a notebook shows of a result (`kille.lab.reports.shown_results`)."""
    raise NotImplementedError


@dataclass(frozen=True, eq=False)
class Result(NotebookValue):
    """All that was found out; `facts` are for machines only.

    The text says in a paragraph what there is to see.

    >>> table = Table("Words", ("word", "right"), (("cup", 0.9),))
    >>> [it.title for it in Result("What was found", (table,)).tables]
    ['Words']
    """

    title: str
    tables: tuple[Table, ...] = ()
    figures: tuple[Figure, ...] = ()
    facts: Mapping[str, Any] = field(default_factory=dict)
    text: str = ""

    def _shown_as_(self) -> Part:
        return shown_result(self)


def silent(share: float, doing: str) -> None:
    """Progress that nobody watches.

    >>> silent(0.5, "playing")
    """


def format_cell(cell: Cell) -> str:
    """Format a cell for people; a dash for a value that is not known.

    >>> format_cell(0.9254), format_cell(12), format_cell(None), format_cell(math.nan)
    ('0.925', '12', '–', '–')
    >>> format_cell(Estimate(0.5, -0.0001, 0.75))
    '0.500 [0.000, 0.750]'
    """
    match cell:
        case None:
            return "–"
        case float():
            return f"{cell:.3f}" if math.isfinite(cell) else "–"
        case Estimate():
            return _format_estimate(cell)
    return str(cell)


def _format_estimate(it: Estimate) -> str:
    if not math.isfinite(it.value):
        return "–"
    value, low, high = (
        f"{round(x, it.decimals) + 0.0:.{it.decimals}f}"  # no zero is below zero
        for x in (it.value, it.low, it.high)
    )
    has_interval = math.isfinite(it.low) and math.isfinite(it.high)
    return f"{value} [{low}, {high}]" if has_interval else value


def interval_series(
    estimates: Sequence[Estimate], name: str = "values"
) -> dict[str, list[float]]:
    """Estimates as figures draw them: values, under this name, and their intervals.

    >>> interval_series([Estimate(0.5, 0.25, 0.75)], "mean")
    {'mean': [0.5], 'low': [0.25], 'high': [0.75]}
    """
    return {
        name: [it.value for it in estimates],
        "low": [it.low for it in estimates],
        "high": [it.high for it in estimates],
    }
