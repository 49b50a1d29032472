"""Paths that no state has, and names that nothing binds."""

from __future__ import annotations

from collections.abc import Iterator

from ttr.errors import Span, suggestion
from ttr.types.objects import Object, Record
from ttr.types.paths import free_paths
from ttr.types.syntax import Meet, RecordType, Singleton
from ttr.updates.checks.effect_summaries import Access, Built
from ttr.updates.checks.faults import Fault
from ttr.updates.checks.rulesets import RuleSet
from ttr.updates.checks.source_positions import span_of_label
from ttr.updates.checks.state_layout import Labels, Missing
from ttr.updates.rules import Body, Rule
from ttr.updates.update_strategies import Repeat, strategies_in


def find_missing_paths(rules: RuleSet) -> Iterator[Fault]:
    """The paths that rules ask for, read, write or promise, but that lead nowhere."""
    for rule in rules.rules:
        yield from _missing_labels(rules, rule, rule.when, "asks for", "when")
        yield from _misread_paths(rules, rule)
        if isinstance(rule.effect, Body):
            yield from _missing_labels(rules, rule, rule.effect.value, "writes", "")
        for built in rules.summaries[rule].built:
            yield from _missing_in_built(rules, rule, built)
        for access in rules.summaries[rule].replaced:
            yield from _missing_label(rules, rule, access, "replaces")
        if rule.gives is not None:
            yield from _missing_labels(rules, rule, rule.gives, "promises", "gives")
    for one in strategies_in(rules.algorithm):
        if isinstance(one, Repeat) and isinstance(one.measure, str):
            claim = f"a repetition is measured by {one.measure}"
            yield from _missing_from_state(rules, one.measure, claim)
    if rules.agenda is not None:
        path = ".".join(rules.agenda)
        yield from _missing_from_state(rules, path, f"moves are planned at {path}")


def find_misread_paths(rules: RuleSet) -> Iterator[Fault]:
    """The paths that rules read, but that lead nowhere."""
    for rule in rules.rules:
        yield from _misread_paths(rules, rule)


def _misread_paths(rules: RuleSet, rule: Rule) -> Iterator[Fault]:
    for access in (*_paths_in_bindings(rule), *rules.summaries[rule].reads):
        yield from _missing_label(rules, rule, access, "reads")


def _paths_in_bindings(rule: Rule) -> Iterator[Access]:
    """The paths in the bindings of a rule; they start at its other variables."""
    for path in sorted(free_paths(rule.where), key=lambda path: path.labels):
        variable, *labels = path.labels
        steps = [path.labels[: i + 2] for i in range(len(labels))]
        spans = [span_of_label(rule, step[-1], step, "where") for step in steps]
        yield Access(variable, tuple(labels), tuple(spans))


def _missing_label(
    rules: RuleSet, rule: Rule, access: Access, does: str
) -> Iterator[Fault]:
    found = rules.views_at(rule, access.variable, access.path)
    if not isinstance(found, Missing):
        return
    path = ".".join((access.variable, *access.path))
    whole = ".".join((access.variable, *found.path[:-1]))
    message = f"the rule {rule} {does} {path}, but {whole} has no {found.label}"
    span = access.spans[len(found.path) - 1]
    yield Fault(rule, "missing", message, _hint(found, whole), span)


def _missing_labels(
    rules: RuleSet, rule: Rule, value: Object, does: str, role: str
) -> Iterator[Fault]:
    """The labels in a type or record that no state has."""
    for found, path in _labels_astray(rules, value):
        span = span_of_label(rule, found.label, path, role)
        yield _missing_path(rule, does, path, found, span)


def _missing_path(
    rule: Rule, does: str, path: Labels, found: Missing, span: Span | None
) -> Fault:
    whole = found.place or "a state"
    message = (
        f"the rule {rule} {does} {'.'.join(path)}, but {whole} has no {found.label}"
    )
    return Fault(rule, "missing", message, _hint(found), span)


def _missing_in_built(rules: RuleSet, rule: Rule, built: Built) -> Iterator[Fault]:
    """The labels in a type built by a Python effect that no state has."""
    places = dict(built.places)
    for found, path in _labels_astray(rules, built.type):
        yield _missing_path(rule, "writes", path, found, places[path])


def _labels_astray(
    rules: RuleSet, value: Object, at: Labels = ()
) -> Iterator[tuple[Missing, Labels]]:
    """The labels in a type or record that lead nowhere.

    A type with all the labels of its field, and more, counts as a more specific type.
    """
    if value is rules.type:
        return
    inner = dict(_fields_of(value))
    for label, part in inner.items():
        path = (*at, label)
        found = rules.views_in_state(path)
        if not isinstance(found, Missing):
            yield from _labels_astray(rules, part, path) if found else ()
        elif not at or not set(found.known) <= inner.keys():
            yield found, path


def _fields_of(value: Object) -> Iterator[tuple[str, Object]]:
    match value:
        case RecordType(fields):
            yield from fields
        case Singleton(base, _):
            yield from _fields_of(base)
        case Meet(parts):
            for part in parts:
                yield from _fields_of(part)
        case Record():
            yield from ((label, value[label]) for label in value)


def _missing_from_state(rules: RuleSet, path: str, claim: str) -> Iterator[Fault]:
    found = rules.views_in_state(tuple(path.split(".")))
    if isinstance(found, Missing):
        message = f"{claim}, but {found.place or 'a state'} has no {found.label}"
        yield Fault(None, "missing", message, _hint(found))


def _hint(found: Missing, place: str = "") -> str:
    near = suggestion(found.label, found.known)
    whole = place or found.place or "a state"
    return near or f"{whole} has {', '.join(found.known)}"


# --- names ---------------------------------------------------------------------------


def find_unbound_names(rules: RuleSet) -> Iterator[Fault]:
    """The names in rules that are not their variables and that nothing else binds."""
    for rule in rules.rules:
        bound = (*rule.names[: 1 + (rule.on is not None)], *(rule.where or ()))
        summary = rules.summaries[rule]
        for access in (*_paths_in_bindings(rule), *summary.reads):
            if access.variable not in bound:
                span = span_of_label(rule, access.variable, (), "where")
                yield _unbound_name(rule, access.variable, bound, span)
        for name, span in summary.undefined:
            yield _unbound_name(rule, name, bound, span)


def _unbound_name(
    rule: Rule, name: str, bound: tuple[str, ...], span: Span | None
) -> Fault:
    message = f"the rule {rule} uses {name}, which nothing binds"
    hint = suggestion(name, bound) or f"bind it with where, or use {', '.join(bound)}"
    return Fault(rule, "unbound", message, hint, span)
