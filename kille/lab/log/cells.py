"""Turns and answers as cells of tables, and back again.

What columns there are, and of what they are, follows from the fields of `Turn` and
`Answer`; so they are named, and read, in one place.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from typing import Any, NamedTuple, TypeAlias, TypeVar, get_origin, get_type_hints

Cell: TypeAlias = str | int | float | None
"""What a database holds; no number is None."""

Row = TypeVar("Row", bound=tuple[Any, ...])


class Column(NamedTuple):
    """A column: its name, what SQLite calls its type, and how values go in and out."""

    name: str
    kind: str
    to: Callable[[Any], Cell]
    back: Callable[[Any], Any]


@lru_cache
def columns(of: type) -> tuple[Column, ...]:
    """The columns for values of a class of named tuples.

    >>> from kille.lab.dialogues import Answer
    >>> [column.name for column in columns(Answer)][:4]
    ['turn', 'phase', 'kind', 'right']
    """
    hints = get_type_hints(of)
    return tuple(_column(name, hints[name]) for name in getattr(of, "_fields", ()))


def cells(value: tuple[Any, ...]) -> tuple[Cell, ...]:
    """The cells of a turn or an answer, in the order of its columns.

    >>> from kille.lab.dialogues import Answer
    >>> cells(Answer(1, "test", "noun", "cup", "mug", "hedge", degrees={"cup": 0.5}))
    (1, 'test', 'noun', 'cup', 'mug', 'hedge', None, '{"cup": 0.5}', 0, ...)
    """
    parts = zip(columns(type(value)), value, strict=True)
    return tuple(column.to(it) for column, it in parts)


def read_cells(of: type[Row], found: Sequence[Any]) -> Row:
    """Make a turn or an answer of its cells.

    >>> from kille.lab.dialogues import Turn
    >>> turn = Turn(1, "first", "Ann", "instruct", "This is a cup.", "OK.", 4)
    >>> read_cells(Turn, cells(turn)) == turn
    True
    """
    parts = zip(columns(of), found, strict=True)
    return of(*(column.back(it) for column, it in parts))


def _column(name: str, hint: Any) -> Column:
    kind, to, back = _KINDS[get_origin(hint) or hint]
    return Column(name, kind, to, back)


def _format_number(value: float) -> float | None:
    return None if math.isnan(value) else float(value)


def _read_number(cell: float | None) -> float:
    return math.nan if cell is None else cell


def _format_list(value: Sequence[str]) -> str:
    return json.dumps(list(value), ensure_ascii=False)


def _read_list(cell: str) -> tuple[str, ...]:
    return tuple(json.loads(cell))


def _format_mapping(value: Mapping[str, float]) -> str:
    found = {word: float(p) for word, p in value.items()}
    return json.dumps(found, ensure_ascii=False)


_KINDS: Mapping[Any, tuple[str, Callable[[Any], Cell], Callable[[Any], Any]]] = {
    str: ("TEXT", str, str),
    int: ("INTEGER", int, int),
    bool: ("INTEGER", int, bool),
    float: ("REAL", _format_number, _read_number),
    tuple: ("TEXT", _format_list, _read_list),
    Mapping: ("TEXT", _format_mapping, json.loads),
}
