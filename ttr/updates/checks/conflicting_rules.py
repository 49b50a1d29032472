"""Rules that set a path to different values, though their order should not matter."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from ttr.types.interning import identity
from ttr.types.paths import free_paths
from ttr.types.printing import notation
from ttr.updates.checks.effect_summaries import Write
from ttr.updates.checks.faults import Fault, Severity
from ttr.updates.checks.rulesets import RuleSet
from ttr.updates.rules import Rule
from ttr.updates.update_strategies import Algorithm, All, ByClass, strategies_in

_Group = tuple[str, Severity, tuple[Rule, ...]]
"""Rules whose order should not matter: their description, severity of a conflict, and
the rules."""


def find_conflicts(rules: RuleSet) -> Iterator[Fault]:
    """The pairs of rules that may both apply, but set a path to different values."""
    for what, severity, members in _unordered_groups(rules.algorithm):
        for one, other in combinations(members, 2):
            if _may_both_apply(rules, one, other):
                yield from _conflicting_writes(rules, one, other, what, severity)


def _unordered_groups(algorithm: Algorithm) -> Iterator[_Group]:
    for one in strategies_in(algorithm):
        match one:
            case ByClass(classes):
                for kind, members in classes:
                    yield f"the class {kind}", "error", members
            case All(parts):
                members = tuple(part for part in parts if isinstance(part, Rule))
                yield str(one), "warning", members


def _may_both_apply(rules: RuleSet, one: Rule, other: Rule) -> bool:
    """May both rules apply to the same state and event?"""
    if not rules.may_coincide(one.when, other.when):
        return False
    if (
        one.on is not None
        and other.on is not None
        and not rules.may_coincide(one.on, other.on)
    ):
        return False
    return rules.are_compatible(rules.type, one.when, other.when)


def _conflicting_writes(
    rules: RuleSet, one: Rule, other: Rule, what: str, severity: Severity
) -> Iterator[Fault]:
    for mine in rules.summaries[one].writes:
        for theirs in rules.summaries[other].writes:
            if mine.path == theirs.path and _surely_differ(rules, mine, theirs):
                path = ".".join(mine.path)
                message = (
                    f"the rules {one} and {other} in {what} may both apply, but set "
                    f"{path} to {_format_write(mine)} and to {_format_write(theirs)}"
                )
                hint = "make their conditions exclude each other, or put them in first"
                span = theirs.span or other.span
                yield Fault(other, "disagreement", message, hint, span, severity)


def _surely_differ(rules: RuleSet, one: Write, other: Write) -> bool:
    """Do two writes surely set different values?"""
    if one.term is not None and other.term is not None:
        if free_paths(one.term.value) or free_paths(other.term.value):
            return False
        return identity(one.term.value) != identity(other.term.value)
    if one.type is None or other.type is None:
        return False
    closed = not free_paths(one.type) and not free_paths(other.type)
    return closed and not rules.are_compatible(one.type, other.type)


def _format_write(write: Write) -> str:
    if write.term is not None and not free_paths(write.term.value):
        return notation(write.term.value)
    return f"something of {write.type}"
