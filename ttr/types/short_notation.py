"""Notation in as many columns as there are: what is deepest in brackets is left out."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

_TOKEN = re.compile(
    r"""'(?:\\.|[^'\\])*' | "(?:\\.|[^"\\])*" | [\[\]{}()] | [^\[\]{}()'",]+ | .""",
    re.VERBOSE | re.DOTALL,
)
_SHORT = 16
"""What is in brackets and has no more letters than this stays as it is."""


def shorten_notation(text: str, room: int) -> str:
    """The notation of a value in `room` columns, as far as that is possible.

    What is deepest in brackets becomes an ellipsis first, level by level; then the last
    fields or elements of the outermost brackets are left out, and it is said how many.

    >>> T = "[x : Ind, y : [a : Ind, b : hug(a, x), c : dog(a), d : dog(x)]]"
    >>> shorten_notation(T, 80) == T, shorten_notation(T, 40)
    (True, '[x : Ind, y : […]]')
    >>> shorten_notation("{a = fido, b = sam, c = rex, d = bella}", 32)
    '{a = fido, b = sam, … 2 more}'
    """
    if len(text) <= room:
        return text
    parts = _group_brackets(_TOKEN.findall(text))
    for depth in range(_depth(parts) - 1, 0, -1):
        if len(shown := _write(parts, depth)) <= room:
            return shown
    shown = _write(parts, 1)
    for group in [it for it in parts if isinstance(it, _Group)]:
        beside = len(shown) - len(_write([group], 1))
        shown = shown.replace(_write([group], 1), _first_items(group, room - beside), 1)
        if len(shown) <= room:
            break
    return min(text, shown, key=len)


@dataclass(frozen=True)
class _Group:
    """What stands in brackets."""

    opening: str
    parts: Sequence[str | _Group]
    closing: str


_Parts = Sequence[str | _Group]


def _group_brackets(tokens: Sequence[str]) -> _Parts:
    """The tokens, with a group for each pair of brackets."""
    around: list[list[str | _Group]] = [[]]
    openings: list[str] = []
    for token in tokens:
        if token in "[{(":
            openings.append(token)
            around.append([])
        elif token in "]})" and openings:
            inside = around.pop()
            around[-1].append(_Group(openings.pop(), inside, token))
        else:
            around[-1].append(token)
    while openings:  # brackets that nothing closes
        inside = around.pop()
        around[-1] += [openings.pop(), *inside]
    return around[0]


def _depth(parts: _Parts) -> int:
    inside = (1 + _depth(it.parts) for it in parts if isinstance(it, _Group))
    return max(inside, default=0)


def _write(parts: _Parts, depth: int) -> str:
    """The parts, with an ellipsis in brackets that stand in so many others."""
    written = []
    for part in parts:
        if isinstance(part, str):
            written.append(part)
            continue
        inside = _write(part.parts, depth - 1)
        if depth < 1 and len(inside) > _SHORT:
            inside = "…"
        written.append(f"{part.opening}{inside}{part.closing}")
    return "".join(written)


def _first_items(group: _Group, room: int) -> str:
    """A group with as many of its items as there is room for; one at least."""
    items = [*_items(group.parts)]
    for count in range(len(items) - 1, 0, -1):
        more = f", … {len(items) - count:,} more"
        shown = f"{group.opening}{', '.join(items[:count])}{more}{group.closing}"
        if len(shown) <= room or count == 1:
            return shown
    return _write([group], 1)


def _items(parts: _Parts) -> Iterator[str]:
    """What stands between the commas of a group, shortened."""
    item: list[str | _Group] = []
    for part in [*parts, ","]:
        if part == ",":
            yield _write(item, 0).strip()
            item = []
        else:
            item.append(part)
