"""Faults of rules: what is wrong, where, and a way out."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from ttr.errors import Span
from ttr.updates.rules import Rule

Sort: TypeAlias = Literal[
    "missing",
    "unbound",
    "misfit",
    "dead",
    "disagreement",
    "unset",
    "unheard",
    "endless",
    "uncomputed",
]
"""What kind of fault it is: see the explanation *What the checker sees*."""

Severity: TypeAlias = Literal["error", "warning"]
"""A warning is about what may be meant, but rarely is."""


@dataclass(frozen=True)
class Fault:
    """Something wrong in a rule set, found without running it.

    `rule` is the rule to change; None if the fault is in no single rule. `hint` is a
    way out.

    >>> print(Fault(None, "endless", "repeat(go) need not end", "give it times="))
    repeat(go) need not end
    help: give it times=
    """

    rule: Rule | None
    sort: Sort
    message: str
    hint: str = ""
    span: Span | None = None
    severity: Severity = "error"

    def __str__(self) -> str:
        """The message, the place with its line underlined, and the way out."""
        lines = [self.message]
        if self.span:
            lines.append(str(self.span))
        if self.hint:
            lines.append(f"help: {self.hint}")
        return "\n".join(lines)
