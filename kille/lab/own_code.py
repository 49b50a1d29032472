"""Code of one's own that fails: what it raised, in words, and on which line."""

from __future__ import annotations

from traceback import extract_tb


def describe_exception(error: BaseException) -> str:
    """What was raised, and the first line of what it says.

    >>> describe_exception(ValueError("no weights")), describe_exception(SystemExit())
    ('ValueError: no weights', 'SystemExit')
    """
    first = next(iter(str(error).splitlines()), "")
    return f"{type(error).__name__}: {first}".removesuffix(": ")


def failing_line(path: str, error: BaseException | None) -> int:
    """The line of a file at which it failed, the last on the way there; or else 0."""
    if error is None:
        return 0
    if isinstance(error, SyntaxError) and error.filename == path:
        return error.lineno or 1
    passed = extract_tb(error.__traceback__)
    return next((it.lineno or 1 for it in passed[::-1] if it.filename == path), 0)
