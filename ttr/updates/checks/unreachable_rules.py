"""Rules that can never fire: impossible conditions, and cases that come too late."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from itertools import chain

from ttr.probability import CERTAIN
from ttr.types.paths import escaping
from ttr.types.printing import notation
from ttr.types.syntax import Path, Singleton, TypeNode, meet
from ttr.updates.algorithms import (
    Algorithm,
    All,
    Ask,
    ByClass,
    First,
    Maybe,
    Repeat,
    Seq,
    places_of,
)
from ttr.updates.checks.faults import Fault
from ttr.updates.checks.rulesets import RuleSet
from ttr.updates.checks.source_positions import place
from ttr.updates.checks.state_layout import Labels, Missing, Term, leaves
from ttr.updates.checks.wrong_values import declared, misfit, views_of
from ttr.updates.rules import Rule

__all__ = ["dead"]


def dead(rules: RuleSet) -> Iterator[Fault]:
    """The rules that no state or event lets fire, and those that others forestall."""
    impossible = {rule: _impossible(rules, rule) for rule in rules.rules}
    yield from (fault for fault in impossible.values() if fault is not None)
    late: dict[Rule, list[Fault]] = {}
    for rule, fault in _forestalled(rules, rules.algorithm):
        late.setdefault(rule, []).append(fault)
    places = Counter(places_of(rules.algorithm))
    for rule, told in late.items():
        if impossible[rule] is None and len(told) == places[rule]:
            yield told[0]


# --- conditions that nothing meets ---------------------------------------------------


def _impossible(rules: RuleSet, rule: Rule) -> Fault | None:
    """That nothing can be what a rule asks of state, event or bindings."""
    ways = (
        _of_state(rules, rule),
        _of_event(rules, rule),
        _of_bindings(rules, rule),
        _of_effect(rules, rule),
    )
    return next(chain(*ways), None)


def _of_state(rules: RuleSet, rule: Rule) -> Iterator[Fault]:
    for path, T in leaves(rule.when):
        wanted = declared(rules, path)
        if wanted is None or not path:
            continue
        for view in views_of(T):
            if misfit(rules, view, wanted):
                at = ".".join(path)
                found = notation(view.value) if isinstance(view, Term) else view
                asked = "be" if isinstance(view, Term) else "be of"
                why = f"it asks that {at} {asked} {found}, but {at} is of {wanted}"
                yield _never(rule, why, path)
    if not rules.together(rules.type, rule.when):
        yield _never(rule, f"nothing can be a state and of {rule.when}")


def _of_event(rules: RuleSet, rule: Rule) -> Iterator[Fault]:
    if rule.on is not None and not rules.together(rule.on):
        yield _never(rule, f"no event can be of {rule.on}")


def _of_bindings(rules: RuleSet, rule: Rule) -> Iterator[Fault]:
    """Bindings that are set to what cannot be of their types."""
    for label, field in rule.where.fields if rule.where else ():
        match field:
            case Singleton(base, Path(1, (variable, *labels))) if not escaping(base):
                found = rules.led(rule, variable, tuple(labels))
            case _:
                continue
        if isinstance(found, Missing) or not found:
            continue
        types = [T for T in found if isinstance(T, TypeNode)]
        if types and all(rules.excludes(T, base) for T in types):
            source = ".".join((variable, *labels))
            why = f"it takes {source} to be of {base}, but that is of {types[0]}"
            yield _never(rule, why, (label,), "where")


def _of_effect(rules: RuleSet, rule: Rule) -> Iterator[Fault]:
    """That the effect gives nothing in any case, as where a `return` is forgotten."""
    told = rules.summaries[rule]
    if told.complete and not told.outcomes:
        yield _never(rule, "it gives no next state, as nothing is returned")


def _never(rule: Rule, why: str, path: Labels = (), role: str = "when") -> Fault:
    span = place(rule, path[-1], path, role) if path else rule.span
    return Fault(rule, "dead", f"the rule {rule} can never fire: {why}", "", span)


# --- cases that come too late ---------------------------------------------------------


Late = tuple[Rule, Fault]
"""A rule that comes too late in one of the places where it stands, and why."""


def _forestalled(rules: RuleSet, algorithm: Algorithm) -> Iterator[Late]:
    match algorithm:
        case Rule() | ByClass():
            return
        case Maybe(part) | Repeat(part):
            yield from _forestalled(rules, part)
        case First(parts):
            for i, part in enumerate(parts):
                yield from _covered(rules, algorithm, parts[:i], part)
                yield from _forestalled(rules, part)
        case Seq(parts) | All(parts) | Ask(parts):
            for part in parts:
                yield from _forestalled(rules, part)


def _covered(
    rules: RuleSet, among: First, earlier: tuple[Algorithm, ...], part: Algorithm
) -> Iterator[Late]:
    """The rules that begin a part of `first`, where an earlier part always applies."""
    sure = [(one, case) for one in earlier for case in _sure(rules, one)]
    for rule in _beginning(part):
        for one, case in sure:
            if _is_covered(rules, rule, case):
                before = f"the rule {one}" if isinstance(one, Rule) else str(one)
                why = f"{before} comes first, and applies wherever {rule} would"
                message = f"the rule {rule} can never fire: {why}"
                hint = f"put {rule} before {one}" if isinstance(one, Rule) else ""
                yield rule, Fault(rule, "dead", message, hint, rule.span)
                break


def _sure(rules: RuleSet, part: Algorithm) -> Iterator[Rule | None]:
    """Rules of which each makes a part apply whenever its condition holds.

    None says that the part applies always.
    """
    match part:
        case Rule():
            if part.where is None and not rules.summaries[part].may_refuse:
                yield part
        case Maybe():
            yield None
        case First(parts) | All(parts):
            for one in parts:
                yield from _sure(rules, one)
        case Repeat(one):
            yield from _sure(rules, one)
        case Seq((one, *others)) if all(isinstance(p, Maybe) for p in others):
            yield from _sure(rules, one)
        case ByClass(classes):
            for _, members in classes:
                for rule in members:
                    yield from _sure(rules, rule)


def _beginning(part: Algorithm) -> Iterator[Rule]:
    """The rules that are tried first in a part, in the state that it is tried in."""
    match part:
        case Rule():
            yield part
        case First(parts) | Ask(parts):
            for one in parts:
                yield from _beginning(one)
        case Seq((one, *_)) | All((one, *_)) | Repeat(one) | Maybe(one):
            yield from _beginning(one)


def _is_covered(rules: RuleSet, rule: Rule, case: Rule | None) -> bool:
    """Whether wherever a rule is tried with success, a case applies, too."""
    if case is None:
        return True
    if not _event_covered(rules, rule, case) or not rules.alike(case.when, rule.when):
        return False
    return rules.covers(case.when, meet(rules.type, rule.when))


def _event_covered(rules: RuleSet, rule: Rule, case: Rule) -> bool:
    if case.on is None:
        return True
    if rule.on is None or not case.p.lo <= rule.p.lo:
        return False
    if rule.on is case.on:
        return rule.p.hi <= case.p.hi
    return case.p.hi == CERTAIN.hi and rules.covers(case.on, rule.on)
