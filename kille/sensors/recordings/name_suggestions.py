"""Names as people write, order and misspell them."""

from __future__ import annotations

import re
from collections.abc import Sequence

from ttr.misspellings import nearest_names


def natural_order(name: str) -> list[tuple[int, str]]:
    """A key for the order of names in which numbers count as numbers.

    >>> sorted(["cup10", "cup2", "cap"], key=natural_order)
    ['cap', 'cup2', 'cup10']
    >>> natural_order("2²3")
    [(2, ''), (-1, '²'), (3, '')]
    """
    parts = re.findall(r"\d+|\D+", name)
    return [(int(part), "") if part.isdecimal() else (-1, part) for part in parts]


def suggest_name(name: str, known: Sequence[str]) -> str:
    """A question after the known names that are near, or nothing.

    >>> suggest_name("kitchn", ["kitchen", "desk"])
    ' (did you mean kitchen?)'
    """
    close = nearest_names(name, known, most=3)
    return f" (did you mean {' or '.join(close)}?)" if close else ""


def first_names(names: Sequence[str]) -> str:
    """The first twelve names, and how many more there are."""
    few = ", ".join(names[:12])
    return few if len(names) <= 12 else f"{few} and {len(names) - 12} more"


def comparable_name(name: str) -> str:
    """The name as it is compared: `Rubber_duck` is `rubber duck`."""
    return name.replace("_", " ").casefold()
