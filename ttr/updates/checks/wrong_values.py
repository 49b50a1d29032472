"""Values that are not of the type of the place that they are set to."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import reduce

from ttr.building.merging import merge
from ttr.errors import Span
from ttr.probability import REFUTED
from ttr.types.paths import escaping
from ttr.types.printing import notation
from ttr.types.syntax import (
    Basic,
    ListOf,
    Meet,
    NonEmpty,
    Object,
    Record,
    RecordType,
    SetOf,
    Singleton,
    TypeNode,
)
from ttr.updates.checks.effect_summaries import Write
from ttr.updates.checks.faults import Fault
from ttr.updates.checks.rulesets import RuleSet
from ttr.updates.checks.source_positions import place
from ttr.updates.checks.state_layout import Labels, Term, View, leaves
from ttr.updates.rules import Body, Rule

__all__ = ["misfits"]


def misfits(rules: RuleSet) -> Iterator[Fault]:
    """What rules set, or promise to set, and what states start with, of wrong types."""
    yield from _start(rules)
    for rule in rules.rules:
        yield from _written(rules, rule)
        yield from _promised(rules, rule)
        yield from _left_out(rules, rule)


def _start(rules: RuleSet) -> Iterator[Fault]:
    if rules.start is None:
        return
    why = rules.opened.judge(rules.start, rules.type).why
    failed = why.failure()
    if why.p != REFUTED or failed is None:
        return
    claim = f"{notation(failed.sit)} : {failed.type}, {failed.rule}"
    where = f"at {why.path()}" if why.path() else "at the top"
    message = f"the state to start from is not of its type, {where}: {claim}"
    yield Fault(None, "misfit", message)


def _written(rules: RuleSet, rule: Rule) -> Iterator[Fault]:
    for write in rules.summaries[rule].writes:
        wanted = declared(rules, write.path)
        brought = rules.brought(rule, write)
        if wanted is None or not brought:
            continue
        if all(misfit(rules, view, wanted) for view in brought):
            found = _told(write.term, brought[0])
            fault = _misfit(rule, "sets", write.path, found, wanted, write.span)
            yield replace(fault, hint=_way_out(rules, brought[0], wanted))
        elif all(_is_odd(rules, view, wanted) for view in brought):
            yield _odd(rule, write, brought[0], wanted)


def _is_odd(rules: RuleSet, view: View, wanted: TypeNode) -> bool:
    """Whether a list would have to be of a basic type that nobody can see it is of."""
    match view, wanted:
        case (Basic() as T, ListOf() | NonEmpty() | SetOf()):
            return T not in rules.model.facts.functions
        case (ListOf() | NonEmpty() | SetOf(), Basic() as T):
            return T not in rules.model.facts.functions
    return False


def _odd(rule: Rule, write: Write, found: View, wanted: TypeNode) -> Fault:
    path = ".".join(write.path)
    message = (
        f"the rule {rule} sets {path} to something of {found}, where {wanted} is due"
    )
    hint = "a list of one is written in brackets: [a]"
    if isinstance(wanted, Basic):
        hint = "the first of a list a is fst(a)"
    return Fault(rule, "misfit", message, hint, write.span, "warning")


def _promised(rules: RuleSet, rule: Rule) -> Iterator[Fault]:
    for path, T in leaves(rule.gives) if rule.gives else ():
        wanted = declared(rules, path)
        if wanted is None or not path:
            continue
        for view in views_of(T):
            if misfit(rules, view, wanted):
                span = place(rule, path[-1], path, "gives")
                found = _told(None, view)
                yield _misfit(rule, "promises to set", path, found, wanted, span)
                break


def _misfit(
    rule: Rule,
    does: str,
    path: Labels,
    found: str,
    wanted: TypeNode,
    span: Span | None,
) -> Fault:
    message = (
        f"the rule {rule} {does} {'.'.join(path)} to {found}, which is no {wanted}"
    )
    return Fault(rule, "misfit", message, "", span)


def _told(term: Term | None, view: View) -> str:
    if term is not None and not escaping(term.value):
        return notation(term.value)
    if isinstance(view, Term):
        return notation(view.value)
    return f"something of {view}"


def _way_out(rules: RuleSet, found: View, wanted: TypeNode) -> str:
    """What to do about a value that would fit if its meets were merged."""
    merged = Term(_merged(found.value)) if isinstance(found, Term) else found
    if misfit(rules, merged, wanted):
        return ""
    return "a meet of record types is none itself, merge(S, T) is"


def _merged(value: Object) -> Object:
    """The value with the merge of record types in place of their meet."""
    match value:
        case tuple():
            return tuple(map(_merged, value))
        case Meet(parts) if all(isinstance(part, RecordType) for part in parts):
            return reduce(merge, parts)
    return value


def _left_out(rules: RuleSet, rule: Rule) -> Iterator[Fault]:
    """The fields that a record which is to be the next state lacks."""
    if not isinstance(rule.effect, Body) or not isinstance(rule.effect.value, Record):
        return
    for path in _lacking(rule.effect.value, rules.type):
        message = f"the state that the rule {rule} gives has no {'.'.join(path)}"
        hint = "give a record type of what changes, and all else stays as it is"
        yield Fault(rule, "misfit", message, hint, rule.span)


def _lacking(r: Record, T: RecordType, at: Labels = ()) -> Iterator[Labels]:
    for label, field in T.fields:
        if label not in r:
            yield (*at, label)
        elif isinstance(r[label], Record) and isinstance(field, RecordType):
            yield from _lacking(r[label], field, (*at, label))


# --- what is of which type -----------------------------------------------------------


def declared(rules: RuleSet, path: Labels) -> TypeNode | None:
    """What the type of states says of a place."""
    T: TypeNode | None = rules.type
    for label in path:
        T = T.get(label) if isinstance(T, RecordType) else None
    return T


def views_of(T: TypeNode) -> tuple[View, ...]:
    """What a field says of its place: an object and a type, or the type alone."""
    if isinstance(T, Singleton):
        own = () if escaping(T.value) else (Term(T.value),)
        return (*own, T.base)
    return (T,)


def misfit(rules: RuleSet, view: View, wanted: TypeNode) -> bool:
    """Whether what is known of a place cannot be of a type, as far as is known now.

    An object that is known to be of basic types is of no others, where no rule learns.
    """
    if rules.excludes(view, wanted):
        return True
    if not isinstance(view, Term) or rules.learns:
        return False
    match view.value, wanted:
        case tuple(elements), ListOf(T) | NonEmpty(T):
            return any(misfit(rules, Term(one), T) for one in elements)
    return isinstance(wanted, Basic) and _is_of_others(rules, view.value, wanted)


def _is_of_others(rules: RuleSet, value: Object, wanted: Basic) -> bool:
    if isinstance(value, TypeNode) or not rules.model.facts.types_of(value):
        return False
    return rules.model.judge(value, wanted).p == REFUTED
