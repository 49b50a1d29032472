"""Figures with a row for each word, tutor, scene or pair of theories.

Rows that do not fit on a page of a paper follow in the next figure.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from kille.lab.reports.short_names import shorten_names
from kille.lab.results import Estimate, Figure, interval_series

_HIGHEST = 9.5
"""The height of a figure in inches, at the most."""
_AROUND, _ROW, _SERIES = 1.1, 0.2, 0.16
"""Inches taken by what is around the rows, by each row, and by each series."""


def interval_note(lows: Iterable[float]) -> str:
    """Say which intervals a figure shows, given their lower ends, NaN where missing.

    >>> interval_note([math.nan, 0.25]), interval_note([math.nan])
    ('95 % confidence intervals.', 'Too few dialogues for confidence intervals.')
    """
    if any(map(math.isfinite, lows)):
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
        data = {
            "labels": list(labels[rows]),
            "series": {name: interval_series(them) for name, them in shown.items()},
            **settings,
        }
        which = f" ({number} of {len(slices)})" if len(slices) > 1 else ""
        note = interval_note(it.low for them in shown.values() for it in them)
        yield Figure("intervals", f"{title}{which}", data, note)


def _page_slices(rows: int, series: int) -> Iterator[slice]:
    """Split the rows as evenly as possible, so that each part fits on a page."""
    fitting = max(1, int((_HIGHEST - _AROUND) / (_ROW + _SERIES * series)))
    size = math.ceil(rows / math.ceil(rows / fitting))
    for start in range(0, rows, size):
        yield slice(start, start + size)
