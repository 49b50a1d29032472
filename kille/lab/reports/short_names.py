"""Names that are short enough for a figure, and still all different."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from itertools import count

_MOST = 28
"""Letters for which there is room beside a figure."""


def shorten_names(names: Iterable[str], most: int = _MOST) -> dict[str, str]:
    """Short names of these names: the middle of those that are too long is left out.

    >>> shorten_names(["driven", "says what it thinks", "says what he thinks"], 12)
    {'driven': 'driven', 'says what it thinks': 'says wh…inks', ...}
    """
    found: dict[str, str] = {}
    for name in dict.fromkeys(names):
        found[name] = _make_unique(_shorten(name, most), found.values())
    return found


def _shorten(name: str, most: int) -> str:
    if len(name) <= most:
        return name
    end = (most - 1) * 2 // 5
    return f"{name[: most - 1 - end]}…{name[-end:]}"


def _make_unique(text: str, others: Collection[str]) -> str:
    if text not in others:
        return text
    candidates = (f"{text} ({number})" for number in count(2))
    return next(it for it in candidates if it not in others)
