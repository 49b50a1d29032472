"""Conditions that nothing ever brings about, and events that nobody sends."""

from __future__ import annotations

from collections.abc import Iterator

from ttr.types.paths import escaping
from ttr.types.printing import notation
from ttr.types.syntax import Path, Singleton, TypeNode
from ttr.updates.checks.effect_summaries import Write
from ttr.updates.checks.faults import Fault
from ttr.updates.checks.rulesets import Demand, RuleSet
from ttr.updates.checks.source_positions import place
from ttr.updates.checks.state_layout import Labels, Missing, Term, along, descend
from ttr.updates.rules import Rule

__all__ = ["sets", "unheard", "unset"]


def unset(rules: RuleSet) -> Iterator[Fault]:
    """The rules that wait for a state that nothing brings about, or for no event.

    A rule may fire if the start meets each thing it asks for, or another that may fire
    sets it. What waits only for a rule that waits itself is not told.
    """
    waiting = dict.fromkeys(rules.rules)
    firing: list[Rule] = []
    while waiting:
        more = [rule for rule in waiting if _first_unmet(rules, rule, firing) is None]
        if not more:
            told = _stuck(rules, list(waiting), firing)
            yield from told.values()
            more = list(told)
        firing += more
        for rule in more:
            del waiting[rule]


def _stuck(
    rules: RuleSet, waiting: list[Rule], firing: list[Rule]
) -> dict[Rule, Fault]:
    """The rules that no other could help; where each waits for another, the first."""
    found: dict[Rule, Fault] = {}
    for rule in waiting:
        others = [*firing, *(one for one in waiting if one is not rule)]
        unmet = _first_unmet(rules, rule, others)
        if unmet is not None:
            found[rule] = _fault(rules, rule, unmet)
    if found:
        return found
    unmet = _first_unmet(rules, waiting[0], firing)
    return {} if unmet is None else {waiting[0]: _fault(rules, waiting[0], unmet)}


def _first_unmet(rules: RuleSet, rule: Rule, firing: list[Rule]) -> Demand | None:
    """What keeps a rule from being the next one that fires for the first time.

    A demand at no path is that of an event.
    """
    if rule.on is not None and not _is_sent(rules, rule.on, firing):
        return (), rule.on
    for path, T in rules.demands[rule]:
        if not any(sets(rules, one, path, T) for one in firing):
            return path, T
    return None


def _fault(rules: RuleSet, rule: Rule, unmet: Demand) -> Fault:
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
    span = place(rule, path[-1], path, "when")
    return Fault(rule, "unset", message, f"let a rule set {at}", span)


# --- states --------------------------------------------------------------------------


def sets(rules: RuleSet, rule: Rule, path: Labels, T: TypeNode) -> bool:
    """Whether a rule may make a place to be of a type."""
    return rules.remembered((id(rule), path, T), lambda: _sets(rules, rule, path, T))


def _sets(rules: RuleSet, rule: Rule, path: Labels, T: TypeNode) -> bool:
    told = rules.summaries[rule]
    if rule.gives is not None:
        promised = along(rule.gives, path)
        if promised and all(rules.excludes(view, T) for view in promised):
            return False
    if not told.complete:
        return True
    return any(_brings(rules, rule, write, path, T) for write in told.writes)


def _brings(
    rules: RuleSet, rule: Rule, write: Write, path: Labels, T: TypeNode
) -> bool:
    shared = min(len(write.path), len(path))
    if write.path[:shared] != path[:shared]:
        return False
    views = rules.brought(rule, write)
    if not views or len(write.path) > len(path):
        return True
    rest = path[shared:]
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


def unheard(rules: RuleSet) -> Iterator[Fault]:
    """The types of events that the game says it hears, and that no rule takes."""
    taken = [rule.on for rule in rules.rules if rule.on is not None]
    for heard in rules.hears:
        if not any(rules.alike(heard, on) for on in taken):
            message = f"the game hears events of {heard}, which no rule takes"
            yield Fault(
                None, "unheard", message, "write a rule for them, or leave it out"
            )


def _is_sent(rules: RuleSet, on: TypeNode, firing: list[Rule]) -> bool:
    """Whether an event of a type may come from outside, or be a move of one's own."""
    if not rules.hears:
        return True
    if any(rules.alike(heard, on) for heard in rules.hears):
        return True
    if rules.agenda is None:
        return False
    planned = _planned(rules, rules.agenda, firing)
    return planned is None or any(rules.alike(move, on) for move in planned)


def _planned(
    rules: RuleSet, agenda: Labels, firing: list[Rule]
) -> list[TypeNode] | None:
    """The types of the moves that may be planned; None where they may be any."""
    start = along(Term(rules.start), agenda)
    values = [view.value for view in start if isinstance(view, Term)]
    for rule in firing:
        told = rules.summaries[rule]
        if not told.complete:
            return None
        for write in told.writes:
            shared = min(len(write.path), len(agenda))
            if write.path[:shared] != agenda[:shared]:
                continue
            if write.path != agenda or write.term is None or escaping(write.term.value):
                return None
            values.append(write.term.value)
    lists = (value for value in values if isinstance(value, tuple))
    return [move for moves in lists for move in moves if isinstance(move, TypeNode)]
