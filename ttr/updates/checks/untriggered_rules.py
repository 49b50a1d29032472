"""Rules that wait for a state that nothing brings about, or an event nobody sends."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias

from ttr.types.objects import Object, Operation, Path
from ttr.types.paths import free_paths
from ttr.types.printing import notation
from ttr.types.syntax import RecordType, Singleton, TypeNode
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
        message = (
            f"the rule {rule} waits for an event of {rules.name_of(T)} "
            "that nobody sends"
        )
        known = ", ".join(map(rules.name_of, rules.hears))
        planning = [one for one in rules.left_out if _may_plan(rules, one, T)]
        hint = _hint_left_out(rules, planning, "plans one")
        hint = hint or f"what is heard is {known}"
        return Fault(rule, "unset", message, hint, rule.span)
    at = ".".join(path)
    asked = f"is {notation(T.value)}" if isinstance(T, Singleton) else f"is of {T}"
    message = (
        f"the rule {rule} can never fire: it waits until {at} {asked}, "
        "which neither the start nor any rule before it brings about"
    )
    span = span_of_label(rule, path[-1], path, "when")
    setting = [
        one
        for one in rules.left_out
        if rules.summary_of(one).complete and may_set(rules, one, path, T)
    ]
    hint = _hint_left_out(rules, setting, f"sets {at}") or f"let a rule set {at}"
    return Fault(rule, "unset", message, hint, span)


def _hint_left_out(rules: RuleSet, helpful: list[Rule], does: str) -> str:
    """A hint to a rule that would help, but is in no strategy of the game."""
    if not helpful:
        return ""
    return f"{helpful[0]} {does}, but is not in {rules.game}: add it to the strategy"


# --- states --------------------------------------------------------------------------


def may_set(rules: RuleSet, rule: Rule, path: Labels, T: TypeNode) -> bool:
    """May a rule set a path to something of a type?"""
    return rules.remember(
        (id(rule), path, T), lambda: _may_set_place(rules, rule, path, T)
    )


def _may_set_place(rules: RuleSet, rule: Rule, path: Labels, T: TypeNode) -> bool:
    summary = rules.summary_of(rule)
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
    for number, heard in enumerate(rules.hears):
        if any(rules.may_coincide(heard, on) for on in taken):
            continue
        message = (
            f"the game hears events of {rules.name_of(heard)}, which no rule takes"
        )
        taking = [
            rule
            for rule in rules.left_out
            if rule.on is not None and rules.may_coincide(heard, rule.on)
        ]
        hint = _hint_left_out(rules, taking, "takes them")
        hint = hint or "write a rule for them, or leave it out"
        span = rules.heard_at[number] if rules.heard_at else None
        yield Fault(None, "unheard", message, hint, span)


def _is_sent(rules: RuleSet, on: TypeNode, firing: list[Rule]) -> bool:
    """May an event of a type come from outside, or be a move of the game's own?"""
    if not rules.hears:
        return True
    if any(rules.may_coincide(heard, on) for heard in rules.hears):
        return True
    if rules.agenda is None:
        return False
    begun = views_along(Term(rules.start), rules.agenda)
    values = [view.value for view in begun if isinstance(view, Term)]
    if any(_may_be_one(rules, _moves_in(value, None), on) for value in values):
        return True
    return any(_may_plan(rules, rule, on) for rule in firing)


def _may_plan(rules: RuleSet, rule: Rule, on: TypeNode) -> bool:
    """May a rule plan a move of a type?"""
    return rules.agenda is not None and _may_be_one(
        rules, _moves_planned_by(rules, rule, rules.agenda), on
    )


_Moves: TypeAlias = tuple[TypeNode, ...] | None
"""Types of moves; None if they may be any."""


def _may_be_one(rules: RuleSet, moves: _Moves, on: TypeNode) -> bool:
    return moves is None or any(rules.may_coincide(move, on) for move in moves)


def _moves_planned_by(rules: RuleSet, rule: Rule, agenda: Labels) -> _Moves:
    """The types of the moves that a rule may put on the agenda.

    What depends on the state or the event is left out of them.
    """
    summary = rules.summary_of(rule)
    if not summary.complete:
        return None
    planned: list[TypeNode] = []
    for write in summary.writes:
        if not overlap(write.path, agenda):
            continue
        if write.path != agenda or write.term is None:
            return None
        moves = _moves_in(write.term.value, Path(0, (rule.names[0], *agenda)))
        if moves is None:
            return None
        planned += moves
    return tuple(planned)


def _moves_in(value: Object, agenda: Path | None) -> _Moves:
    """The types of moves in a list; what is on the agenda already adds none."""
    match value:
        case Operation("+", parts):
            found = [_moves_in(part, agenda) for part in parts]
        case Operation("rst", (rest,)):
            return _moves_in(rest, agenda)
        case tuple():
            found = [_wider_move(one) for one in value]
        case _:
            return () if agenda is not None and value == agenda else None
    if any(moves is None for moves in found):
        return None
    return tuple(move for moves in found for move in moves or ())


def _wider_move(value: Object) -> _Moves:
    T = _independent_type(value, 0) if isinstance(value, TypeNode) else None
    return None if T is None else (T,)


def _independent_type(T: TypeNode, depth: int) -> TypeNode | None:
    """A type that all of T is of, whatever the variables of the rule are.

    T stands `depth` record types further in. None if no such type is known.
    """
    if all(path.up < depth for path in free_paths(T)):
        return T
    match T:
        case RecordType(fields):
            wider = [(label, _independent_type(F, depth + 1)) for label, F in fields]
            return RecordType(tuple((label, F) for label, F in wider if F is not None))
        case Singleton(base, _):
            return _independent_type(base, depth)
    return None
