"""What a user's own function did wrong, as one line that names it."""

from __future__ import annotations

from collections.abc import Callable
from types import TracebackType

from ttr.errors import RuleFailed, TTRError

__all__ = ["failing", "in_short"]

LONGEST = 200
"""How many characters of a value or of somebody else's error a line repeats."""


class failing:
    """Turns what goes wrong inside into one line about what failed.

    A class, as one made of a generator takes twice the time, and every rule is in one.

    >>> with failing("the rule hear"):
    ...     1 / 0
    Traceback (most recent call last):
    ttr.errors.RuleFailed: the rule hear failed: ZeroDivisionError: division by zero
    """

    __slots__ = ("_told",)

    def __init__(self, *what: object) -> None:
        self._told = what

    @property
    def _what(self) -> str:
        return " ".join(map(str, self._told))

    def __enter__(self) -> None:
        return None

    def __exit__(
        self, kind: object, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if not isinstance(error, Exception):
            return
        if isinstance(error, TTRError):
            raise RuleFailed(f"{self._what} failed: {error}") from error
        told = in_short(error, str)
        fault = f"{type(error).__name__}: {told}" if told else type(error).__name__
        raise RuleFailed(f"{self._what} failed: {fault}") from error


def in_short(value: object, shown: Callable[[object], str] = repr) -> str:
    """A value on one line, cut where it is long, even if it cannot print itself.

    >>> in_short([1, 2]), in_short("a\\nb"), len(in_short("a" * 1000))
    ('[1, 2]', "'a\\\\nb'", 201)
    """
    try:
        text = " ".join(shown(value).split())
    except Exception:
        return f"a {type(value).__name__}"
    return text if len(text) <= LONGEST else f"{text[:LONGEST]}…"
