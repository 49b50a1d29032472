"""Figures with a row for each word, tutor, scene or two theories.

What does not fit on a page of a paper goes on in the next figure.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from kille.lab.reports.short_names import short
from kille.lab.results import Estimate, Figure

_BANDS = "Bands of 95 %."
_NO_BANDS = "Too few dialogues for bands."

_HIGHEST = 9.5
"""Inches that a figure may be high."""
_AROUND, _ROW, _SERIES = 1.1, 0.2, 0.16
"""Inches that are taken by what is around the rows, by a row, and by each series."""


def as_drawn(estimates: Sequence[Estimate], name: str = "values") -> dict[str, Any]:
    """Estimates as figures draw them: numbers, by this name, with their bands.

    >>> as_drawn([Estimate(0.5, 0.25, 0.75)], "mean")
    {'mean': [0.5], 'low': [0.25], 'high': [0.75]}
    """
    return {
        name: [it.value for it in estimates],
        "low": [it.low for it in estimates],
        "high": [it.high for it in estimates],
    }


def bands(lows: Iterable[float]) -> str:
    """What is told of bands by their lower ends, which are no numbers without a band.

    >>> bands([math.nan, 0.25]), bands([math.nan])
    ('Bands of 95 %.', 'Too few dialogues for bands.')
    """
    return _BANDS if any(map(math.isfinite, lows)) else _NO_BANDS


def in_rows(
    title: str,
    labels: Sequence[str],
    series: Mapping[str, Sequence[Estimate]],
    told: Mapping[str, Any],
) -> Iterator[Figure]:
    """The estimates of each series, as many as there are labels; nothing of none.

    `told` is what else the figures are given, such as `xlabel`. Names of series are cut
    to the room that there is.
    """
    if not labels or not series:
        return
    called = short(series)
    parts = list(_parts(len(labels), len(series)))
    for number, part in enumerate(parts, start=1):
        some = {called[name]: list(them[part]) for name, them in series.items()}
        data = {
            "labels": list(labels[part]),
            "series": {name: as_drawn(them) for name, them in some.items()},
            **told,
        }
        which = f" ({number} of {len(parts)})" if len(parts) > 1 else ""
        note = bands(it.low for them in some.values() for it in them)
        yield Figure("intervals", f"{title}{which}", data, note)


def _parts(rows: int, series: int) -> Iterator[slice]:
    """The rows parted as evenly as they can be, so that each part fits on a page."""
    fitting = max(1, int((_HIGHEST - _AROUND) / (_ROW + _SERIES * series)))
    size = math.ceil(rows / math.ceil(rows / fitting))
    for start in range(0, rows, size):
        yield slice(start, start + size)
