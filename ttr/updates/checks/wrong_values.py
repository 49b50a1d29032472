"""Values that are not of the type of the field that they are set to."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from ttr.building.merging import merge_meet
from ttr.errors import Span
from ttr.probability import REFUTED
from ttr.types.objects import Object, Operation, Path, Record
from ttr.types.paths import free_paths
from ttr.types.printing import notation
from ttr.types.records import field_at
from ttr.types.syntax import (
    Basic,
    ListOf,
    Meet,
    NonEmpty,
    RecordType,
    SetOf,
    Singleton,
    TypeNode,
)
from ttr.updates.checks.effect_summaries import Write
from ttr.updates.checks.faults import Fault
from ttr.updates.checks.rulesets import RuleSet
from ttr.updates.checks.source_positions import span_of_label
from ttr.updates.checks.state_layout import Labels, Term, View, leaf_fields
from ttr.updates.rules import Body, Rule


def find_wrong_values(rules: RuleSet) -> Iterator[Fault]:
    """Values of wrong types that rules set or promise, or that the start has."""
    yield from _wrong_start(rules)
    for rule in rules.rules:
        yield from _wrong_writes(rules, rule)
        yield from _wrong_promises(rules, rule)
        yield from _missing_fields(rules, rule)


def _wrong_start(rules: RuleSet) -> Iterator[Fault]:
    if rules.start is None:
        return
    why = rules.open_model.judge(rules.start, rules.type).why
    failed = why.failure()
    if why.p != REFUTED or failed is None:
        return
    claim = f"{notation(failed.sit)} : {failed.type}, {failed.rule}"
    where = f"at {why.path()}" if why.path() else "at the top"
    message = f"the state to start from is not of its type, {where}: {claim}"
    yield Fault(None, "misfit", message)


def _wrong_writes(rules: RuleSet, rule: Rule) -> Iterator[Fault]:
    for write in rules.summaries[rule].writes:
        wanted = field_at(rules.type, write.path)
        brought = rules.views_brought_by(rule, write)
        if wanted is None or not brought:
            continue
        if all(is_misfit(rules, view, wanted) for view in brought):
            found = _format_value(write.term, brought[0])
            fault = _misfit(rule, "sets", write.path, found, wanted, write.span)
            yield replace(fault, hint=_hint_to_merge(rules, brought[0], wanted))
        elif all(_lacks_brackets(rules, view, wanted) for view in brought):
            yield _bracket_warning(rule, write, brought[0], wanted)
        elif write.term is not None:
            yield from _unbracketed_parts(rules, rule, write, wanted)


def _lacks_brackets(rules: RuleSet, view: View, wanted: TypeNode) -> bool:
    """Is a list set to something of a basic type, or the other way round?

    A witness function of the basic type may judge lists; then nothing is known.
    """
    match view, wanted:
        case (Basic() as T, ListOf() | NonEmpty() | SetOf()):
            return T not in rules.model.facts.functions
        case (ListOf() | NonEmpty() | SetOf(), Basic() as T):
            return T not in rules.model.facts.functions
    return False


def _bracket_warning(rule: Rule, write: Write, found: View, wanted: TypeNode) -> Fault:
    path = ".".join(write.path)
    message = (
        f"the rule {rule} sets {path} to something of {found}, where {wanted} is due"
    )
    hint = "a list of one is written in brackets: [a]"
    if isinstance(wanted, Basic):
        hint = "the first of a list a is fst(a)"
    return Fault(rule, "misfit", message, hint, write.span, "warning")


def _unbracketed_parts(
    rules: RuleSet, rule: Rule, write: Write, wanted: TypeNode
) -> Iterator[Fault]:
    """The parts of a + b that are of a basic type, where a list is due."""
    value = write.term.value if write.term else None
    for part in value.args if isinstance(value, Operation) else ():
        if not isinstance(part, Path):
            continue
        found = rules.views_brought_by(rule, replace(write, term=Term(part), type=None))
        if found and all(_lacks_brackets(rules, view, wanted) for view in found):
            written = ".".join(part.labels)
            message = (
                f"the rule {rule} sets {'.'.join(write.path)} to a list and {written}, "
                f"which is of {found[0]}"
            )
            hint = f"a list of one is written in brackets: [{written}]"
            yield Fault(rule, "misfit", message, hint, write.span, "warning")


def _wrong_promises(rules: RuleSet, rule: Rule) -> Iterator[Fault]:
    for path, T in leaf_fields(rule.gives) if rule.gives else ():
        wanted = field_at(rules.type, path)
        if wanted is None or not path:
            continue
        for view in views_of(T):
            if is_misfit(rules, view, wanted):
                span = span_of_label(rule, path[-1], path, "gives")
                found = _format_value(None, view)
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


def _format_value(term: Term | None, view: View) -> str:
    if term is not None and not free_paths(term.value):
        return notation(term.value)
    if isinstance(view, Term):
        return notation(view.value)
    return f"something of {view}"


def _hint_to_merge(rules: RuleSet, found: View, wanted: TypeNode) -> str:
    """A hint for a value that would fit if its meets were merged."""
    merged = Term(_with_meets_merged(found.value)) if isinstance(found, Term) else found
    if is_misfit(rules, merged, wanted):
        return ""
    return "a meet of record types is none itself, merge(S, T) is"


def _with_meets_merged(value: Object) -> Object:
    """The value with record types merged in place of their meet."""
    match value:
        case tuple():
            return tuple(map(_with_meets_merged, value))
        case Meet():
            return merge_meet(value)
    return value


def _missing_fields(rules: RuleSet, rule: Rule) -> Iterator[Fault]:
    """The fields that are missing in a record that is to be the next state."""
    if not isinstance(rule.effect, Body) or not isinstance(rule.effect.value, Record):
        return
    for path in _paths_lacking(rule.effect.value, rules.type):
        message = f"the state that the rule {rule} gives has no {'.'.join(path)}"
        hint = "give a record type of what changes, and all else stays as it is"
        yield Fault(rule, "misfit", message, hint, rule.span)


def _paths_lacking(r: Record, T: RecordType, at: Labels = ()) -> Iterator[Labels]:
    for label, field in T.fields:
        if label not in r:
            yield (*at, label)
        elif isinstance(r[label], Record) and isinstance(field, RecordType):
            yield from _paths_lacking(r[label], field, (*at, label))


# --- what is of which type -----------------------------------------------------------


def views_of(T: TypeNode) -> tuple[View, ...]:
    """What a field says of its value: which object it is, and of which type."""
    if isinstance(T, Singleton):
        own = () if free_paths(T.value) else (Term(T.value),)
        return (*own, T.base)
    return (T,)


def is_misfit(rules: RuleSet, view: View, wanted: TypeNode) -> bool:
    """Can something with this view not be of a type, by what is known now?

    An object that is known to be of basic types is of no others, if no rule adds facts.
    """
    if rules.excludes(view, wanted):
        return True
    if not isinstance(view, Term) or rules.may_learn:
        return False
    match view.value, wanted:
        case tuple(elements), ListOf(T) | NonEmpty(T):
            return any(is_misfit(rules, Term(one), T) for one in elements)
    return isinstance(wanted, Basic) and _is_of_others(rules, view.value, wanted)


def _is_of_others(rules: RuleSet, value: Object, wanted: Basic) -> bool:
    if isinstance(value, TypeNode) or not rules.model.facts.types_of(value):
        return False
    return rules.model.judge(value, wanted).p == REFUTED
