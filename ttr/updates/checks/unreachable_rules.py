"""Rules that can never fire: their conditions are impossible, or they come too late."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from itertools import chain

from ttr.probability import CERTAIN
from ttr.types.objects import Path
from ttr.types.paths import free_paths
from ttr.types.printing import notation
from ttr.types.records import field_at
from ttr.types.syntax import Singleton, TypeNode, meet
from ttr.updates.checks.faults import Fault
from ttr.updates.checks.rulesets import RuleSet
from ttr.updates.checks.source_positions import span_of_label
from ttr.updates.checks.state_layout import Labels, Missing, Term, leaf_fields
from ttr.updates.checks.wrong_values import is_misfit, views_of
from ttr.updates.rules import Rule
from ttr.updates.update_strategies import (
    Algorithm,
    All,
    Ask,
    ByClass,
    First,
    Maybe,
    Repeat,
    Seq,
    rule_occurrences,
    strategies_in,
)


def find_unreachable_rules(rules: RuleSet) -> Iterator[Fault]:
    """The rules with impossible conditions, and those that earlier ones forestall."""
    impossible = {rule: _why_impossible(rules, rule) for rule in rules.rules}
    yield from (fault for fault in impossible.values() if fault is not None)
    late: dict[Rule, list[Fault]] = {}
    for rule, fault in _forestalled_rules(rules, rules.algorithm):
        late.setdefault(rule, []).append(fault)
    places = Counter(rule_occurrences(rules.algorithm))
    for rule, faults in late.items():
        if impossible[rule] is None and len(faults) == places[rule]:
            yield faults[0]


# --- impossible conditions -----------------------------------------------------------


def _why_impossible(rules: RuleSet, rule: Rule) -> Fault | None:
    """That no state, event or binding can be what a rule asks for, if so."""
    ways = (
        _impossible_states(rules, rule),
        _impossible_events(rules, rule),
        _impossible_bindings(rules, rule),
        _empty_effects(rules, rule),
    )
    return next(chain(*ways), None)


def _impossible_states(rules: RuleSet, rule: Rule) -> Iterator[Fault]:
    for path, T in leaf_fields(rule.when):
        wanted = field_at(rules.type, path)
        if wanted is None or not path:
            continue
        for view in views_of(T):
            if is_misfit(rules, view, wanted):
                at = ".".join(path)
                found = notation(view.value) if isinstance(view, Term) else view
                asked = "be" if isinstance(view, Term) else "be of"
                why = f"it asks that {at} {asked} {found}, but {at} is of {wanted}"
                yield _never_fires(rule, why, path)
    if not rules.are_compatible(rules.type, rule.when):
        yield _never_fires(rule, f"nothing can be a state and of {rule.when}")


def _impossible_events(rules: RuleSet, rule: Rule) -> Iterator[Fault]:
    if rule.on is not None and not rules.are_compatible(rule.on):
        yield _never_fires(rule, f"no event can be of {rule.on}")


def _impossible_bindings(rules: RuleSet, rule: Rule) -> Iterator[Fault]:
    """Bindings that are set to something that cannot be of their types."""
    for label, field in rule.where.fields if rule.where else ():
        match field:
            case Singleton(base, Path(1, (variable, *labels))) if not free_paths(base):
                found = rules.views_at(rule, variable, tuple(labels))
            case _:
                continue
        if isinstance(found, Missing) or not found:
            continue
        types = [T for T in found if isinstance(T, TypeNode)]
        if types and all(rules.excludes(T, base) for T in types):
            source = ".".join((variable, *labels))
            why = f"it takes {source} to be of {base}, but that is of {types[0]}"
            yield _never_fires(rule, why, (label,), "where")


def _empty_effects(rules: RuleSet, rule: Rule) -> Iterator[Fault]:
    """Effects that never return a state, for example if `return` was forgotten."""
    summary = rules.summaries[rule]
    if summary.complete and not summary.outcomes:
        yield _never_fires(rule, "it gives no next state, as nothing is returned")


def _never_fires(rule: Rule, why: str, path: Labels = (), role: str = "when") -> Fault:
    span = span_of_label(rule, path[-1], path, role) if path else rule.span
    return Fault(rule, "dead", f"the rule {rule} can never fire: {why}", "", span)


# --- rules that come too late --------------------------------------------------------


_Late = tuple[Rule, Fault]
"""A rule that comes too late at one of its places in the strategy, and why."""


def _forestalled_rules(rules: RuleSet, algorithm: Algorithm) -> Iterator[_Late]:
    for one in strategies_in(algorithm):
        if isinstance(one, First):
            for i, part in enumerate(one.parts):
                yield from _rules_covered_by(rules, one, one.parts[:i], part)


def _rules_covered_by(
    rules: RuleSet, among: First, earlier: tuple[Algorithm, ...], part: Algorithm
) -> Iterator[_Late]:
    """The rules at the start of a part of `first` that an earlier part forestalls."""
    sure = [
        (one, case) for one in earlier for case in _rules_surely_applied(rules, one)
    ]
    for rule in _first_rules(part):
        for one, case in sure:
            if _is_covered(rules, rule, case):
                before = f"the rule {one}" if isinstance(one, Rule) else str(one)
                why = f"{before} comes first, and applies wherever {rule} would"
                message = f"the rule {rule} can never fire: {why}"
                hint = f"put {rule} before {one}" if isinstance(one, Rule) else ""
                yield rule, Fault(rule, "dead", message, hint, rule.span)
                break


def _rules_surely_applied(rules: RuleSet, part: Algorithm) -> Iterator[Rule | None]:
    """The rules that make a part apply whenever their condition holds.

    None means that the part always applies.
    """
    match part:
        case Rule():
            if part.where is None and not rules.summaries[part].may_refuse:
                yield part
        case Maybe():
            yield None
        case First(parts) | All(parts):
            for one in parts:
                yield from _rules_surely_applied(rules, one)
        case Repeat(one):
            yield from _rules_surely_applied(rules, one)
        case Seq((one, *others)) if all(isinstance(p, Maybe) for p in others):
            yield from _rules_surely_applied(rules, one)
        case ByClass(classes):
            for _, members in classes:
                for rule in members:
                    yield from _rules_surely_applied(rules, rule)


def _first_rules(part: Algorithm) -> Iterator[Rule]:
    """The rules of a part that are tried in the same state as the part itself."""
    match part:
        case Rule():
            yield part
        case First(parts) | Ask(parts):
            for one in parts:
                yield from _first_rules(one)
        case Seq((one, *_)) | All((one, *_)) | Repeat(one) | Maybe(one):
            yield from _first_rules(one)


def _is_covered(rules: RuleSet, rule: Rule, case: Rule | None) -> bool:
    """Does the case apply wherever the rule would?

    Conditions that exclude each other, as most do, are quickly told apart.
    """
    if case is None:
        return True
    return (
        _is_event_covered(rules, rule, case)
        and rules.are_compatible(case.when, rule.when)
        and rules.covers(case.when, meet(rules.type, rule.when))
    )


def _is_event_covered(rules: RuleSet, rule: Rule, case: Rule) -> bool:
    if case.on is None:
        return True
    if rule.on is None or not case.p.lo <= rule.p.lo:
        return False
    if rule.on is case.on:
        return rule.p.hi <= case.p.hi
    return case.p.hi == CERTAIN.hi and rules.covers(case.on, rule.on)
