"""What is wrong with a study, and the lines that tell it."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from kille.lab.study_files.lines import Key, line_of, lines_of

_FIRST, _LAST = 200, 100
"""Characters of a long line; many a type is longer than anybody reads on one."""


class Trouble(NamedTuple):
    """What is wrong: the key of the study that says so, and where, if elsewhere."""

    key: Key
    what: str
    at: str = ""


def told(found: Iterable[Trouble], text: str, path: Path) -> tuple[str, ...]:
    """A line for each mistake in a text of this file, in the order of the text.

    >>> told([Trouble(("seeds",), "there is no seed")], "seeds = 0", "a.toml")
    ('a.toml:1: there is no seed',)
    """
    lines = lines_of(text)
    ordered = sorted(found, key=lambda it: line_of(lines, it.key))
    each = (
        f"{it.at or f'{path}:{line_of(lines, it.key)}'}: {_on_one_line(it.what)}"
        for it in ordered
    )
    return tuple(dict.fromkeys(each))


def _on_one_line(text: str) -> str:
    """The text, if long without its middle: what is wrong is often told at its end."""
    plain = " ".join(text.split())
    if len(plain) <= _FIRST + _LAST:
        return plain
    return f"{plain[:_FIRST].rstrip()} … {plain[-_LAST:].lstrip()}"
