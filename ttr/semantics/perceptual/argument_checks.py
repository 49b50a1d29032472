"""What functions over meanings are given: told plainly where it is something else."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeVar

from ttr.errors import TTRError
from ttr.types.printing import notation
from ttr.types.syntax import freeze

__all__ = ["in_one_line", "several", "shown"]

T = TypeVar("T")


def several(values: Iterable[T], what: str) -> tuple[T, ...]:
    """The values of a list or another iterable; `TTRError` for a text or a single one.

    >>> several(3, "situations")
    Traceback (most recent call last):
    ttr.errors.TTRError: the situations are several, found 3
    """
    if isinstance(values, Iterable) and not isinstance(values, str | bytes):
        try:
            return tuple(values)
        except TypeError:
            pass
    raise TTRError(f"the {what} are several, found {shown(values)}")


def shown(value: object) -> str:
    """A value as notation has it."""
    return notation(freeze(value))


def in_one_line(value: object) -> str:
    """A value as Python writes it; arrays do so in several lines."""
    return " ".join(repr(value).split())
