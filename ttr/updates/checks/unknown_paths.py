"""Paths that the type of states lacks, and names that nothing binds."""

from __future__ import annotations

from collections.abc import Iterator

from ttr.errors import Span, suggestion
from ttr.types.paths import escaping
from ttr.types.syntax import Meet, Object, Record, RecordType, Singleton
from ttr.updates.algorithms import Algorithm, ByClass, Maybe, Repeat
from ttr.updates.checks.effect_summaries import Access, Built
from ttr.updates.checks.faults import Fault
from ttr.updates.checks.rulesets import RuleSet
from ttr.updates.checks.source_positions import place
from ttr.updates.checks.state_layout import Labels, Missing
from ttr.updates.rules import Body, Rule

__all__ = ["misread", "missing", "unbound"]


def missing(rules: RuleSet) -> Iterator[Fault]:
    """The paths that are asked for, read, written or promised, but lead nowhere."""
    for rule in rules.rules:
        yield from _typed(rules, rule, rule.when, "asks for", "when")
        yield from _read(rules, rule)
        if isinstance(rule.effect, Body):
            yield from _typed(rules, rule, rule.effect.value, "writes", "")
        for built in rules.summaries[rule].built:
            yield from _written(rules, rule, built)
        for access in rules.summaries[rule].replaced:
            yield from _accessed(rules, rule, access, "replaces")
        if rule.gives is not None:
            yield from _typed(rules, rule, rule.gives, "promises", "gives")
    for path in _measures(rules.algorithm):
        yield from _led_from(rules, path, f"a repetition is measured by {path}")
    if rules.agenda is not None:
        path = ".".join(rules.agenda)
        yield from _led_from(rules, path, f"moves are planned at {path}")


def misread(rules: RuleSet) -> Iterator[Fault]:
    """The paths that are read, but lead nowhere."""
    for rule in rules.rules:
        yield from _read(rules, rule)


def _read(rules: RuleSet, rule: Rule) -> Iterator[Fault]:
    for access in (*_bindings(rule), *rules.summaries[rule].reads):
        yield from _accessed(rules, rule, access, "reads")


def _bindings(rule: Rule) -> Iterator[Access]:
    """The paths in what a rule binds, which begin with other variables of it."""
    for path in sorted(escaping(rule.where), key=lambda path: path.labels):
        variable, *labels = path.labels
        steps = [path.labels[: i + 2] for i in range(len(labels))]
        spans = [place(rule, step[-1], step, "where") for step in steps]
        yield Access(variable, tuple(labels), tuple(spans))


def _accessed(rules: RuleSet, rule: Rule, access: Access, does: str) -> Iterator[Fault]:
    found = rules.led(rule, access.variable, access.path)
    if not isinstance(found, Missing):
        return
    path = ".".join((access.variable, *access.path))
    whole = ".".join((access.variable, *found.path[:-1]))
    message = f"the rule {rule} {does} {path}, but {whole} has no {found.label}"
    span = access.spans[len(found.path) - 1]
    yield Fault(rule, "missing", message, _way_out(found, whole), span)


def _typed(
    rules: RuleSet, rule: Rule, value: Object, does: str, role: str
) -> Iterator[Fault]:
    """The labels of a type or record of states that no state has."""
    for found, path in _astray(rules, value):
        span = place(rule, found.label, path, role)
        yield _lost(rule, does, path, found, span)


def _lost(
    rule: Rule, does: str, path: Labels, found: Missing, span: Span | None
) -> Fault:
    whole = found.place or "a state"
    message = (
        f"the rule {rule} {does} {'.'.join(path)}, but {whole} has no {found.label}"
    )
    return Fault(rule, "missing", message, _way_out(found), span)


def _written(rules: RuleSet, rule: Rule, built: Built) -> Iterator[Fault]:
    """The labels that no state has, of a type that an effect in Python builds."""
    places = dict(built.places)
    for found, path in _astray(rules, built.type):
        yield _lost(rule, "writes", path, found, places[path])


def _astray(
    rules: RuleSet, value: Object, at: Labels = ()
) -> Iterator[tuple[Missing, Labels]]:
    """The labels in a type or record that lead nowhere.

    A type that has all the labels of the field that it is for, and more, is meant to
    be a more specific one.
    """
    if value is rules.type:
        return
    inner = dict(_fields(value))
    for label, part in inner.items():
        path = (*at, label)
        found = rules.leads(path)
        if not isinstance(found, Missing):
            yield from _astray(rules, part, path) if found else ()
        elif not at or not set(found.known) <= inner.keys():
            yield found, path


def _fields(value: Object) -> Iterator[tuple[str, Object]]:
    match value:
        case RecordType(fields):
            yield from fields
        case Singleton(base, _):
            yield from _fields(base)
        case Meet(parts):
            for part in parts:
                yield from _fields(part)
        case Record():
            yield from ((label, value[label]) for label in value)


def _measures(algorithm: Algorithm) -> Iterator[str]:
    match algorithm:
        case Rule() | ByClass():
            return
        case Repeat(part, _, str(measure)):
            yield measure
            yield from _measures(part)
        case Repeat(part) | Maybe(part):
            yield from _measures(part)
        case _:
            for part in algorithm.parts:
                yield from _measures(part)


def _led_from(rules: RuleSet, path: str, claim: str) -> Iterator[Fault]:
    found = rules.leads(tuple(path.split(".")))
    if isinstance(found, Missing):
        message = f"{claim}, but {found.place or 'a state'} has no {found.label}"
        yield Fault(None, "missing", message, _way_out(found))


def _way_out(found: Missing, place: str = "") -> str:
    near = suggestion(found.label, found.known)
    whole = place or found.place or "a state"
    return near or f"{whole} has {', '.join(found.known)}"


# --- names ---------------------------------------------------------------------------


def unbound(rules: RuleSet) -> Iterator[Fault]:
    """The names in rules that are no variables of them and that nothing else binds."""
    for rule in rules.rules:
        bound = (*rule.names[: 1 + (rule.on is not None)], *(rule.where or ()))
        told = rules.summaries[rule]
        for access in (*_bindings(rule), *told.reads):
            if access.variable not in bound:
                span = place(rule, access.variable, (), "where")
                yield _unbound(rule, access.variable, bound, span)
        for name, span in told.undefined:
            yield _unbound(rule, name, bound, span)


def _unbound(rule: Rule, name: str, bound: tuple[str, ...], span: Span | None) -> Fault:
    message = f"the rule {rule} uses {name}, which nothing binds"
    hint = suggestion(name, bound) or f"bind it with where, or use {', '.join(bound)}"
    return Fault(rule, "unbound", message, hint, span)
