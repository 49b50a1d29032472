"""Findings: is something derivable, and if not, why not."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from ttr.computing.generic_witness import Assumption

Where = tuple[str, ...]
"""The labels that lead from the witness to the field in question."""


@dataclass(frozen=True)
class Finding:
    """Is something derivable? If not, under which assumptions it failed.

    `reason` makes the reason in words, and is called only when somebody asks: to print
    types takes longer than to compare them.
    """

    yes: bool
    reason: Callable[[], str] | None = None
    assumed: tuple[Assumption, ...] = ()

    @property
    def why(self) -> str:
        """Why, or why not; the empty string where there is nothing to say."""
        return self.reason() if self.reason else ""


YES = Finding(True)


def no(where: Where, why: Callable[[], str]) -> Finding:
    """The finding that something is not derivable, and in which field.

    >>> no(("x", "y"), lambda: "Ind is not below A").why
    'in the field x.y, Ind is not below A'
    """
    if not where:
        return Finding(False, why)
    return Finding(False, lambda: f"in the field {'.'.join(where)}, {why()}")


def every(findings: Iterable[Finding]) -> Finding:
    """Yes if all findings are; else the first that is not."""
    return next((found for found in findings if not found.yes), YES)
