"""Checks of arguments: a plain message where something else is given than expected."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeVar

from ttr.errors import TTRError
from ttr.types.objects import freeze
from ttr.types.printing import notation

T = TypeVar("T")


def as_tuple(values: Iterable[T], what: str) -> tuple[T, ...]:
    """The values of a list or another iterable; `TTRError` for a text or a single one.

    >>> as_tuple(3, "situations")
    Traceback (most recent call last):
    ttr.errors.TTRError: expected a list of situations, found 3
    """
    if isinstance(values, Iterable) and not isinstance(values, str | bytes):
        try:
            return tuple(values)
        except TypeError:
            pass
    raise TTRError(f"expected a list of {what}, found {in_notation(values)}")


def missing_methods(value: object, *names: str) -> list[str]:
    """Those of some methods that a value lacks.

    >>> missing_methods([], "append", "learn")
    ['learn']
    """
    return [name for name in names if not callable(getattr(value, name, None))]


def in_notation(value: object) -> str:
    """A value as the notation writes it, also where it is a list or a dictionary.

    >>> in_notation({"x": [1, 2]})
    '{x = [1, 2]}'
    """
    return notation(freeze(value))


def in_one_line(value: object) -> str:
    """The `repr` of a value in one line; that of an array has several."""
    return " ".join(repr(value).split())
