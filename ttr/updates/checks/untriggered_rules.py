"""Rules that wait for a state that nothing brings about, or an event nobody sends."""

from __future__ import annotations

from collections.abc import Iterator

from ttr.types.objects import Path
from ttr.types.paths import free_paths
from ttr.types.printing import notation
from ttr.types.syntax import Singleton, TypeNode
from ttr.updates.checks.effect_summaries import Write
from ttr.updates.checks.faults import Fault
from ttr.updates.checks.rulesets import Demand, RuleSet
from ttr.updates.checks.source_positions import span_of_label
from ttr.updates.checks.state_layout import (
    Labels,
    Missing,
    Term,
    descend,
    overlap,
    views_along,
)
from ttr.updates.rules import Rule
from ttr.updates.update_strategies import event_types


def find_untriggered_rules(rules: RuleSet) -> Iterator[Fault]:
    """The rules that wait for what nothing brings about: a state or an event.

    A rule may fire if all that it asks for holds at the start or is set by a rule that
    may fire. Rules that wait only for such a rule are not reported.
    """
    waiting = dict.fromkeys(rules.rules)
    firing: list[Rule] = []
    while waiting:
        more = [rule for rule in waiting if _first_unmet(rules, rule, firing) is None]
        if not more:
            stuck = _stuck_rules(rules, list(waiting), firing)
            yield from stuck.values()
            more = list(stuck)
        firing += more
        for rule in more:
            del waiting[rule]


def _stuck_rules(
    rules: RuleSet, waiting: list[Rule], firing: list[Rule]
) -> dict[Rule, Fault]:
    """The rules that no other rule helps; if all wait for one another, the first."""
    found: dict[Rule, Fault] = {}
    for rule in waiting:
        others = [*firing, *(one for one in waiting if one is not rule)]
        unmet = _first_unmet(rules, rule, others)
        if unmet is not None:
            found[rule] = _untriggered_fault(rules, rule, unmet)
    if found:
        return found
    unmet = _first_unmet(rules, waiting[0], firing)
    return (
        {}
        if unmet is None
        else {waiting[0]: _untriggered_fault(rules, waiting[0], unmet)}
    )


def _first_unmet(rules: RuleSet, rule: Rule, firing: list[Rule]) -> Demand | None:
    """What a rule asks for that neither the start nor a rule that fires brings about.

    If it is an event, the path is empty.
    """
    if rule.on is not None and not _is_sent(rules, rule.on, firing):
        return (), rule.on
    for path, T in rules.demands[rule]:
        if not any(may_set(rules, one, path, T) for one in firing):
            return path, T
    return None


def _untriggered_fault(rules: RuleSet, rule: Rule, unmet: Demand) -> Fault:
    path, T = unmet
    if not path:
        message = f"the rule {rule} waits for an event of {T} that nobody sends"
        known = ", ".join(map(str, rules.hears))
        return Fault(rule, "unset", message, f"what is heard is {known}", rule.span)
    at = ".".join(path)
    asked = f"is {notation(T.value)}" if isinstance(T, Singleton) else f"is of {T}"
    message = (
        f"the rule {rule} can never fire: it waits until {at} {asked}, "
        "which neither the start nor any rule before it brings about"
    )
    span = span_of_label(rule, path[-1], path, "when")
    return Fault(rule, "unset", message, f"let a rule set {at}", span)


# --- states --------------------------------------------------------------------------


def may_set(rules: RuleSet, rule: Rule, path: Labels, T: TypeNode) -> bool:
    """May a rule set a path to something of a type?"""
    return rules.remember(
        (id(rule), path, T), lambda: _may_set_place(rules, rule, path, T)
    )


def _may_set_place(rules: RuleSet, rule: Rule, path: Labels, T: TypeNode) -> bool:
    summary = rules.summaries[rule]
    if rule.gives is not None:
        promised = views_along(rule.gives, path)
        if promised and all(rules.excludes(view, T) for view in promised):
            return False
    if not summary.complete:
        return True
    return any(_may_bring(rules, rule, write, path, T) for write in summary.writes)


def _may_bring(
    rules: RuleSet, rule: Rule, write: Write, path: Labels, T: TypeNode
) -> bool:
    if not overlap(write.path, path):
        return False
    views = rules.views_brought_by(rule, write)
    if not views or len(write.path) > len(path):
        return True
    rest = path[len(write.path) :]
    for view in views:
        found = descend((view,), rest)
        if isinstance(found, Missing):
            copied = write.term is not None and isinstance(write.term.value, Path)
            if copied:
                return True
            continue
        if not found or any(not rules.excludes(one, T) for one in found):
            return True
    return False


# --- events --------------------------------------------------------------------------


def find_untaken_events(rules: RuleSet) -> Iterator[Fault]:
    """The types of events that the game says it hears, but no rule takes."""
    taken = event_types(rules.rules)
    for heard in rules.hears:
        if not any(rules.may_coincide(heard, on) for on in taken):
            message = f"the game hears events of {heard}, which no rule takes"
            hint = "write a rule for them, or leave it out"
            yield Fault(None, "unheard", message, hint)


def _is_sent(rules: RuleSet, on: TypeNode, firing: list[Rule]) -> bool:
    """May an event of a type come from outside, or be a move of the game's own?"""
    if not rules.hears:
        return True
    if any(rules.may_coincide(heard, on) for heard in rules.hears):
        return True
    if rules.agenda is None:
        return False
    planned = _planned_moves(rules, rules.agenda, firing)
    return planned is None or any(rules.may_coincide(move, on) for move in planned)


def _planned_moves(
    rules: RuleSet, agenda: Labels, firing: list[Rule]
) -> list[TypeNode] | None:
    """The types of the moves that may be planned; None if they may be any."""
    start = views_along(Term(rules.start), agenda)
    values = [view.value for view in start if isinstance(view, Term)]
    for rule in firing:
        summary = rules.summaries[rule]
        if not summary.complete:
            return None
        for write in summary.writes:
            if not overlap(write.path, agenda):
                continue
            if (
                write.path != agenda
                or write.term is None
                or free_paths(write.term.value)
            ):
                return None
            values.append(write.term.value)
    lists = (value for value in values if isinstance(value, tuple))
    return [move for moves in lists for move in moves if isinstance(move, TypeNode)]
