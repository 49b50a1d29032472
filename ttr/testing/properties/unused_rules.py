"""Every rule is applied in some dialogue: P6, checked over all dialogues together."""

from __future__ import annotations

from ttr.testing.coverage import Coverage
from ttr.testing.properties.property import Property

ENOUGH = 5000
"""Turns after which a rule that was never applied counts as dead."""


def _why_dead(coverage: Coverage) -> str:
    if coverage.turns < ENOUGH or not coverage.missed_rules:
        return ""
    names = ", ".join(coverage.missed_rules)
    verb = "is" if len(coverage.missed_rules) == 1 else "are"
    return f"{names} {verb} never applied in {coverage.turns:,} turns"


def _missing_turns(coverage: Coverage) -> str:
    if coverage.turns >= ENOUGH or not coverage.missed_rules:
        return ""
    return f"{coverage.turns:,} of {ENOUGH:,} turns"


NO_DEAD_RULE = Property(
    "P6",
    "no dead rule",
    "every rule is applied in some dialogue.",
    overall=_why_dead,
    shortfall=_missing_turns,
)
