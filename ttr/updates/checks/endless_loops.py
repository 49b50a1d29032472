"""Repetitions that may go on for ever."""

from __future__ import annotations

from collections.abc import Iterator

from ttr.types.objects import Operation, Path
from ttr.updates.checks.effect_summaries import Write
from ttr.updates.checks.faults import Fault
from ttr.updates.checks.rulesets import RuleSet
from ttr.updates.checks.state_layout import Labels, leaf_fields, overlap
from ttr.updates.checks.untriggered_rules import may_set
from ttr.updates.rules import Rule
from ttr.updates.update_strategies import Algorithm, Repeat, rules_of, strategies_in

LONGEST = 60
"""How many characters the name of a repetition may have."""


def find_endless_loops(rules: RuleSet) -> Iterator[Fault]:
    """The repetitions without a measure or a bound that may go on for ever.

    A repetition surely ends if each of its rules makes its own condition false, or
    takes an element off a list, and no other rule undoes that. A rule in Python that
    may refuse, or whose source is not known, may stop by itself: that is a warning.
    """
    for loop in _unbounded_loops(rules.algorithm):
        going = _unending_rules(rules, rules_of(loop.part))
        sure = [rule for rule in going if not rules.summaries[rule].may_refuse]
        for rule in (sure or going)[:1]:
            hint = "say how often at most, or what gets smaller, as in repeat(…, qud)"
            if sure:
                why = f"{rule} leaves its own condition as it is"
                message = f"{_format_loop(loop)} need not end: {why}"
                yield Fault(rule, "endless", message, hint, rule.span)
            else:
                message = (
                    f"{_format_loop(loop)} may not end: nothing says when {rule} stops"
                )
                yield Fault(rule, "endless", message, hint, rule.span, "warning")


def _unending_rules(rules: RuleSet, members: tuple[Rule, ...]) -> tuple[Rule, ...]:
    """The rules that may go on for ever.

    Rules that surely end do not keep others going: they apply only finitely often.
    """
    going = tuple(rule for rule in members if not _surely_ends(rules, rule, members))
    return going if going == members else _unending_rules(rules, going)


def _format_loop(loop: Repeat) -> str:
    """A repetition as it is written; if that is long, its first rules."""
    written = str(loop)
    if len(written) <= LONGEST:
        return written
    names = ", ".join(map(str, rules_of(loop.part)[:3]))
    return f"the repetition of {names}, …"


def _unbounded_loops(algorithm: Algorithm) -> Iterator[Repeat]:
    """The repetitions in a strategy that have neither a measure nor a bound."""
    for one in strategies_in(algorithm):
        if isinstance(one, Repeat) and one.times is None and one.measure is None:
            yield one


def _surely_ends(rules: RuleSet, rule: Rule, members: tuple[Rule, ...]) -> bool:
    """Can a rule apply only finitely often, whatever the others do?"""
    if _shortens_a_list(rules, rule, members):
        return True
    return any(
        _always_sets(rules, rule, path)
        and not any(may_set(rules, one, path, T) for one in members)
        for path, T in leaf_fields(rule.when)
        if path
    )


def _shortens_a_list(rules: RuleSet, rule: Rule, members: tuple[Rule, ...]) -> bool:
    """Does a rule take elements off a list to which no rule adds any?"""
    return any(
        not any(_touches(rules, one, path) for one in members)
        for path in _shortened_lists(rules, rule)
    )


def _always_sets(rules: RuleSet, rule: Rule, path: Labels) -> bool:
    """Does a rule set a path, whatever comes of it?"""
    outcomes = rules.summaries[rule].outcomes
    return all(any(write.path == path for write in one) for one in outcomes)


def _shortened_lists(rules: RuleSet, rule: Rule) -> Iterator[Labels]:
    """The lists of the state whose first element a rule always takes off."""
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
    """May a rule set a list to anything other than its rest?"""
    summary = rules.summaries[rule]
    if not summary.complete:
        return True
    writes = any(overlap(write.path, path) for write in summary.writes)
    return writes and path not in _shortened_lists(rules, rule)
