"""Names short enough for a figure, and still told apart."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from itertools import count

_MOST = 28
"""Letters for which there is room beside a figure."""


def short(names: Iterable[str], most: int = _MOST) -> dict[str, str]:
    """What each is called where there is little room: the middle of it is left out.

    >>> short(["driven", "says all that it thinks without any hedges"], 20)["driven"]
    'driven'
    >>> list(short(["says all that it thinks", "says all that he thinks"], 14).values())
    ['says all…hinks', 'says all…hinks (2)']
    """
    found: dict[str, str] = {}
    for name in dict.fromkeys(names):
        found[name] = _told_apart(_cut(name, most), found.values())
    return found


def _cut(name: str, most: int) -> str:
    if len(name) <= most:
        return name
    end = (most - 1) * 2 // 5
    return f"{name[: most - 1 - end]}…{name[-end:]}"


def _told_apart(text: str, others: Collection[str]) -> str:
    if text not in others:
        return text
    numbered = (f"{text} ({number})" for number in count(2))
    return next(it for it in numbered if it not in others)
