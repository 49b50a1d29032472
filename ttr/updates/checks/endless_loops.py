"""Repetitions that need not end."""

from __future__ import annotations

from collections.abc import Iterator

from ttr.types.objects import Operation
from ttr.types.syntax import Path, TypeNode
from ttr.updates.algorithms import Algorithm, ByClass, Maybe, Repeat, rules_of
from ttr.updates.checks.effect_summaries import Write
from ttr.updates.checks.faults import Fault
from ttr.updates.checks.rulesets import RuleSet
from ttr.updates.checks.state_layout import Labels, leaves
from ttr.updates.checks.untriggered_rules import sets
from ttr.updates.rules import Rule

__all__ = ["endless"]

LONGEST = 60
"""How many characters of a repetition are shown."""


def endless(rules: RuleSet) -> Iterator[Fault]:
    """The repetitions without a measure or a number of times that may go on for ever.

    A repetition surely ends where each of its rules makes its own condition false, or
    takes an element off a list, and none of them undoes that. A rule in Python that may
    refuse, or cannot be read, may be meant to stop by itself: that is a warning.
    """
    for loop in _loops(rules.algorithm):
        going = _going(rules, rules_of(loop.part))
        sure = [rule for rule in going if not rules.summaries[rule].may_refuse]
        for rule in (sure or going)[:1]:
            hint = "say how often at most, or what gets smaller, as in repeat(…, qud)"
            if sure:
                why = f"{rule} leaves its own condition as it is"
                message = f"{_named(loop)} need not end: {why}"
                yield Fault(rule, "endless", message, hint, rule.span)
            else:
                message = f"{_named(loop)} may not end: nothing says when {rule} stops"
                yield Fault(rule, "endless", message, hint, rule.span, "warning")


def _going(rules: RuleSet, members: tuple[Rule, ...]) -> tuple[Rule, ...]:
    """The rules that may go on for ever.

    Those that surely end cannot help others to go on: they do so only so often.
    """
    going = tuple(rule for rule in members if not _ends(rules, rule, members))
    return going if going == members else _going(rules, going)


def _named(loop: Repeat) -> str:
    """A repetition as it is written, if that is short."""
    written = str(loop)
    if len(written) <= LONGEST:
        return written
    names = ", ".join(map(str, rules_of(loop.part)[:3]))
    return f"the repetition of {names}, …"


def _loops(algorithm: Algorithm) -> Iterator[Repeat]:
    """The repetitions in a strategy that have neither measure nor number."""
    match algorithm:
        case Rule() | ByClass():
            return
        case Repeat(part, times, measure):
            if times is None and measure is None:
                yield algorithm
            yield from _loops(part)
        case Maybe(part):
            yield from _loops(part)
        case _:
            for part in algorithm.parts:
                yield from _loops(part)


def _ends(rules: RuleSet, rule: Rule, members: tuple[Rule, ...]) -> bool:
    """Whether a rule can apply only so often, whatever the others do."""
    if not rules.summaries[rule].complete:
        return False
    if _shortens(rules, rule, members):
        return True
    return any(
        _denies(rules, rule, path, T)
        and not any(sets(rules, one, path, T) for one in members)
        for path, T in leaves(rule.when)
        if path
    )


def _shortens(rules: RuleSet, rule: Rule, members: tuple[Rule, ...]) -> bool:
    """Whether a rule takes elements off a list that none of the others sets."""
    return any(
        not any(_touches(rules, one, path) for one in members)
        for path in _lists(rules, rule)
    )


def _denies(rules: RuleSet, rule: Rule, path: Labels, T: TypeNode) -> bool:
    """Whether a rule always leaves a place as it surely is not of a type."""
    outcomes = rules.summaries[rule].outcomes
    return all(
        any(_excludes(rules, rule, write, T) for write in outcome if write.path == path)
        for outcome in outcomes
    )


def _excludes(rules: RuleSet, rule: Rule, write: Write, T: TypeNode) -> bool:
    brought = rules.brought(rule, write)
    return bool(brought) and all(rules.excludes(view, T) for view in brought)


def _lists(rules: RuleSet, rule: Rule) -> Iterator[Labels]:
    """The lists of the state that a rule always takes the first element off."""
    outcomes = rules.summaries[rule].outcomes
    for write in rules.summaries[rule].writes:
        if all(any(_is_rest(rule, w, write.path) for w in one) for one in outcomes):
            yield write.path


def _is_rest(rule: Rule, write: Write, path: Labels) -> bool:
    match write.term and write.term.value:
        case Operation("rst", (Path(_, (variable, *labels)),)):
            return write.path == path == tuple(labels) and variable == rule.names[0]
    return False


def _touches(rules: RuleSet, rule: Rule, path: Labels) -> bool:
    """Whether a rule may set a list in another way than to take off its first."""
    told = rules.summaries[rule]
    if not told.complete:
        return True
    shared = (
        write.path[: len(path)] == path[: len(write.path)] for write in told.writes
    )
    return any(shared) and path not in _lists(rules, rule)
