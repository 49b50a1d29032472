"""What a protocol hands back: tables, figures as plain numbers, and facts.

Nothing here draws or prints; a terminal, a page of HTML and a machine each read the
same result in their own way.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, NamedTuple, TypeAlias

__all__ = [
    "Cell",
    "Estimate",
    "ExperimentError",
    "Figure",
    "Progress",
    "Result",
    "Table",
    "silent",
]


class Estimate(NamedTuple):
    """A number, the band in which it may well lie, and how many decimals are told."""

    value: float
    low: float
    high: float
    decimals: int = 3


Cell: TypeAlias = str | float | int | Estimate | None

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
"""Is told the share in [0, 1] that is done, and what is being done now."""


class ExperimentError(Exception):
    """Data or methods that nothing can be measured with: one line says why."""


@dataclass(frozen=True)
class Table:
    """Rows of numbers and words under the names of their columns.

    None is what could not be told; the note is a sentence that goes under the table.
    `links` say where a cell leads to on a page, by its row and column.
    """

    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[Cell, ...], ...]
    note: str = ""
    links: Mapping[tuple[int, int], str] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class Figure:
    """What a figure shows, as plain numbers and lists; `data` by kind:

    - confusion: labels, counts (rows: the right word; columns: the answer); columns
      names the answers where they are more than the labels
    - curves: x, series {name: {mean, low, high}}, xlabel, ylabel; log names the axes
      that are logarithmic, as in ["x", "y"]
    - bars: labels, values, low and high (may be missing), ylabel
    - map: words, right, away, degrees {word: rows of degrees}; points may be missing
    - pictures: pictures (rows of RGB pixels), captions, good (may be missing)
    - points: series {name: {x, y}}, xlabel, ylabel; with bands x_low, x_high, y_low,
      y_high, and with labels, if they are there
    - intervals: labels, series {name: {values, low, high}}, xlabel; zero is a line
      where it is given
    - reliability: series {name: {x, y, low, high, counts}}, xlabel, ylabel

    The note is a sentence that goes under the figure.
    """

    kind: Kind
    title: str
    data: Mapping[str, Any]
    note: str = ""


@dataclass(frozen=True, eq=False)
class Result:
    """All that was found out; `facts` is what a machine is told besides.

    The text says in a paragraph what there is to see.
    """

    title: str
    tables: tuple[Table, ...] = ()
    figures: tuple[Figure, ...] = ()
    facts: Mapping[str, Any] = field(default_factory=dict)
    text: str = ""


def silent(share: float, doing: str) -> None:
    """Progress that nobody watches."""
