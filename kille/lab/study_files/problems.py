"""The lines that tell what is wrong with a study, each with its place in the file.

The standard reader of TOML gives values without places. So each statement, a header or
a key with its value, is read once more by itself: what it declares is on its line.
"""

from __future__ import annotations

import tomllib
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from kille.lab.settings import Key, Problem

_FIRST, _LAST = 200, 100
"""Characters of a long line; many a type is longer than anybody reads on one."""


def format_problems(found: Iterable[Problem], text: str, path: Path) -> tuple[str, ...]:
    """A line for each mistake in a text of this file, in the order of the text.

    >>> found = [Problem(("seeds",), "there is no seed")]
    >>> format_problems(found, "seeds = 0", "a.toml")
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
    """The text on one line, without its middle if it is long."""
    plain = " ".join(text.split())
    if len(plain) <= _FIRST + _LAST:
        return plain
    return f"{plain[:_FIRST].rstrip()} … {plain[-_LAST:].lstrip()}"


# --- where keys stand ----------------------------------------------------------------

_TRIED = 2_000_000
"""How many characters are read to find where statements end."""


def lines_of(text: str) -> Mapping[Key, int]:
    r"""The line of every key in a text that is TOML.

    >>> lines_of("title = 'a'\n[[phases]]\ndo = 'teach'\n[[phases]]\ndo = 'ask'")
    {('title',): 1, ('phases',): 2, ('phases', 0): 2, ('phases', 0, 'do'): 3, ...}
    """
    found: dict[Key, int] = {}
    here: Key = ()
    counts: Counter[Key] = Counter()
    for number, statement in _statements(text):
        if not statement.startswith("["):
            for key in _keys_in(tomllib.loads(statement)):
                found.setdefault((*here, *key), number)
            continue
        names = _header_names(tomllib.loads(statement))
        here = _numbered_key(names, counts, statement.startswith("[["))
        found.setdefault(names[:1], number)
        found.setdefault(here, number)
    return found


def line_of(lines: Mapping[Key, int], key: Key) -> int:
    """The line of a key, or of the nearest table around it; 1 if none is known.

    >>> line_of({("tutors", "Ann"): 4}, ("tutors", "Ann", "kind"))
    4
    """
    while key and key not in lines:
        key = key[:-1]
    return lines.get(key, 1)


def _statements(text: str) -> Iterator[tuple[int, str]]:
    """The statements, each with its first line; a value may span several lines.

    Whether it ends is tried at each of its lines; of a text that takes too long so,
    only the first statements are given.
    """
    began, so_far, tried = 0, "", 0
    for number, line in enumerate(text.replace("\r\n", "\n").split("\n"), start=1):
        if not so_far and (not line.strip() or line.lstrip().startswith("#")):
            continue
        began = began if so_far else number
        so_far = f"{so_far}\n{line}" if so_far else line.strip()
        tried += len(so_far)
        if tried > _TRIED:
            return
        if _is_whole(so_far):
            yield began, so_far
            so_far = ""


def _is_whole(statement: str) -> bool:
    try:
        tomllib.loads(statement)
    except tomllib.TOMLDecodeError:
        return False
    return True


def _keys_in(table: Mapping[str, Any]) -> Iterator[Key]:
    for name, value in table.items():
        yield (name,)
        if isinstance(value, dict):
            yield from ((name, *key) for key in _keys_in(value))


def _header_names(table: Any) -> tuple[str, ...]:
    """The names in a header, outermost first."""
    names: list[str] = []
    while table := table[0] if isinstance(table, list) else table:
        [(name, table)] = table.items()
        names.append(name)
    return tuple(names)


def _numbered_key(names: tuple[str, ...], counts: Counter[Key], is_listed: bool) -> Key:
    """The key of a header, with the numbers of the tables that are in a list."""
    here: Key = ()
    for place, name in enumerate(names, start=1):
        here = (*here, name)
        if is_listed and place == len(names):
            counts[here] += 1
        if counts[here]:
            here = (*here, counts[here] - 1)
    return here
