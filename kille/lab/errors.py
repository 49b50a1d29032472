"""What is wrong with a study, all of it at once."""

from __future__ import annotations

from collections.abc import Iterable


class StudyError(Exception):
    """A study that cannot be played: a line for every mistake in it.

    >>> print(StudyError(["a.toml:2: …", "a.toml:7: …"]))
    a.toml:2: …
    a.toml:7: …
    """

    def __init__(self, faults: Iterable[str]) -> None:
        self.faults = tuple(faults)
        super().__init__("\n".join(self.faults))

    def __reduce__(self) -> tuple[object, ...]:
        return StudyError, (self.faults,)


class TheoryError(Exception):
    """A part of a theory cannot be used: why, and where if that is known."""

    def __init__(self, message: str, at: str = "") -> None:
        super().__init__(message, at)
        self.message, self.at = message, at

    def __str__(self) -> str:
        return self.message
