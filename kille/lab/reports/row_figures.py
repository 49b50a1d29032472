"""Figures with a row for each word, tutor, scene or pair of theories.

Rows that do not fit on a page of a paper follow in the next figure.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import chain
from typing import Any

from kille.lab.reports.short_names import shorten_names
from kille.lab.results import Estimate, Figure, interval_series

_HIGHEST = 9.5
"""The height of a figure in inches, at the most."""
_AROUND, _ROW, _SERIES = 1.1, 0.2, 0.16
"""Inches taken by what is around the rows, by each row, and by each series."""


def figure_height(rows: int, series: int) -> float:
    """The height in inches of a figure of so many rows, each of so many series."""
    return _AROUND + (_ROW + _SERIES * series) * rows


def interval_note(series: Iterable[Mapping[str, Any]]) -> str:
    """Say whether a figure of these series shows intervals; missing ends are NaN.

    >>> interval_note([{"mean": [0.5], "low": [math.nan]}, {"mean": [1], "low": [0.2]}])
    '95 % confidence intervals.'
    >>> interval_note([{"mean": [0.5], "low": [math.nan]}])
    'Too few dialogues for confidence intervals.'
    """
    lows = (it[key] for it in series for key in it if key.endswith("low"))
    if any(map(math.isfinite, chain.from_iterable(lows))):
        return "95 % confidence intervals."
    return "Too few dialogues for confidence intervals."


def row_figures(
    title: str,
    labels: Sequence[str],
    series: Mapping[str, Sequence[Estimate]],
    settings: Mapping[str, Any],
) -> Iterator[Figure]:
    """Figures with a row for each label, in which each series has an estimate.

    `settings` are further data of the figures, such as `xlabel`. Names of series are
    shortened. Without labels or series there is no figure.
    """
    if not labels or not series:
        return
    short_name = shorten_names(series)
    slices = list(_page_slices(len(labels), len(series)))
    for number, rows in enumerate(slices, start=1):
        shown = {short_name[name]: list(them[rows]) for name, them in series.items()}
        data: dict[str, Any] = {
            "labels": list(labels[rows]),
            "series": {name: interval_series(them) for name, them in shown.items()},
            **settings,
        }
        which = f" ({number} of {len(slices)})" if len(slices) > 1 else ""
        note = interval_note(data["series"].values())
        yield Figure("intervals", f"{title}{which}", data, note)


def _page_slices(rows: int, series: int) -> Iterator[slice]:
    """Split the rows as evenly as possible, so that each part fits on a page."""
    fitting = max(1, int((_HIGHEST - _AROUND) / (_ROW + _SERIES * series)))
    size = math.ceil(rows / math.ceil(rows / fitting))
    for start in range(0, rows, size):
        yield slice(start, start + size)
