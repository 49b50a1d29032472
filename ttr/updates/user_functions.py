"""Reporting errors in a user's own functions as one line that names the function."""

from __future__ import annotations

from collections.abc import Callable
from types import TracebackType

from ttr.errors import RuleFailedError, TTRError

LONGEST = 200
"""How many characters of a value, or of an error, a message repeats."""


class blame:
    """A context that turns any error inside into one line that says what failed.

    It is a class, as every rule runs in one, and a generator would take twice the time.

    >>> with blame("the rule hear"):
    ...     1 / 0
    Traceback (most recent call last):
    ttr...RuleFailedError: the rule hear failed: ZeroDivisionError: division by zero
    """

    __slots__ = ("_parts",)

    def __init__(self, *what: object) -> None:
        self._parts = what

    @property
    def _what(self) -> str:
        return " ".join(map(str, self._parts))

    def __enter__(self) -> None:
        return None

    def __exit__(
        self, kind: object, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if not isinstance(error, Exception):
            return
        if isinstance(error, TTRError):
            raise RuleFailedError(f"{self._what} failed: {error}") from error
        text = excerpt(error, str)
        fault = f"{type(error).__name__}: {text}" if text else type(error).__name__
        raise RuleFailedError(f"{self._what} failed: {fault}") from error


def excerpt(value: object, shown: Callable[[object], str] = repr) -> str:
    """A value on one line, cut if it is long; its class, if it cannot print itself.

    >>> excerpt([1, 2]), excerpt("a\\nb"), len(excerpt("a" * 1000))
    ('[1, 2]', "'a\\\\nb'", 201)
    """
    try:
        text = " ".join(shown(value).split())
    except Exception:
        return f"a {type(value).__name__}"
    return text if len(text) <= LONGEST else f"{text[:LONGEST]}…"
