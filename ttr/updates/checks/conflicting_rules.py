"""Rules whose order is claimed not to matter, but that set one path differently."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from ttr.types.paths import escaping
from ttr.types.printing import notation
from ttr.types.syntax import identity
from ttr.updates.algorithms import Algorithm, All, ByClass, Maybe, Repeat
from ttr.updates.checks.effect_summaries import Write
from ttr.updates.checks.faults import Fault, Severity
from ttr.updates.checks.rulesets import RuleSet
from ttr.updates.rules import Rule

__all__ = ["disagreements"]

Group = tuple[str, Severity, tuple[Rule, ...]]
"""Rules that all may apply: what they are, how bad it is if they disagree, and they."""


def disagreements(rules: RuleSet) -> Iterator[Fault]:
    """The pairs of rules that may apply one after the other, but undo one another."""
    for what, severity, members in _groups(rules.algorithm):
        for one, other in combinations(members, 2):
            if _overlap(rules, one, other):
                yield from _differently(rules, one, other, what, severity)


def _groups(algorithm: Algorithm) -> Iterator[Group]:
    match algorithm:
        case ByClass(classes):
            for kind, members in classes:
                yield f"the class {kind}", "error", members
        case Maybe(part) | Repeat(part):
            yield from _groups(part)
        case All(parts):
            members = tuple(part for part in parts if isinstance(part, Rule))
            yield str(algorithm), "warning", members
            for part in parts:
                yield from _groups(part)
        case _ if not isinstance(algorithm, Rule):
            for part in algorithm.parts:
                yield from _groups(part)


def _overlap(rules: RuleSet, one: Rule, other: Rule) -> bool:
    """Whether both may apply to one state and one event."""
    if not rules.alike(one.when, other.when):
        return False
    if (
        one.on is not None
        and other.on is not None
        and not rules.alike(one.on, other.on)
    ):
        return False
    return rules.together(rules.type, one.when, other.when)


def _differently(
    rules: RuleSet, one: Rule, other: Rule, what: str, severity: Severity
) -> Iterator[Fault]:
    for mine in rules.summaries[one].writes:
        for theirs in rules.summaries[other].writes:
            if mine.path == theirs.path and _differ(rules, mine, theirs):
                path = ".".join(mine.path)
                message = (
                    f"the rules {one} and {other} in {what} may both apply, but set "
                    f"{path} to {_shown(mine)} and to {_shown(theirs)}"
                )
                hint = "make their conditions exclude each other, or put them in first"
                span = theirs.span or other.span
                yield Fault(other, "disagreement", message, hint, span, severity)


def _differ(rules: RuleSet, one: Write, other: Write) -> bool:
    """Whether what is set in two ways surely is not the same."""
    if one.term is not None and other.term is not None:
        if escaping(one.term.value) or escaping(other.term.value):
            return False
        return identity(one.term.value) != identity(other.term.value)
    if one.type is None or other.type is None:
        return False
    closed = not escaping(one.type) and not escaping(other.type)
    return closed and not rules.together(one.type, other.type)


def _shown(write: Write) -> str:
    if write.term is not None and not escaping(write.term.value):
        return notation(write.term.value)
    return f"something of {write.type}"
