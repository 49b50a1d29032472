"""Bindings that no search can find, and labels that stand for themselves."""

from __future__ import annotations

from collections.abc import Iterator

from ttr.computing.path_cycles import find_cycle
from ttr.judging.witnesses import can_be_listed
from ttr.types.objects import Object
from ttr.types.paths import subterms
from ttr.types.syntax import RecordType, Singleton
from ttr.updates.checks.faults import Fault
from ttr.updates.checks.rulesets import RuleSet
from ttr.updates.checks.source_positions import span_of_label
from ttr.updates.rules import Body, Rule


def find_unlistable_bindings(rules: RuleSet) -> Iterator[Fault]:
    """The bindings whose witnesses cannot be listed, as their type may have no end."""
    for rule in rules.rules:
        for label, field in rule.where.fields if rule.where else ():
            if isinstance(field, Singleton) or can_be_listed(field):
                continue
            message = (
                f"the rule {rule} looks for {label}, but what is of its type cannot be "
                "listed, as there may be infinitely many"
            )
            hint = f"say what {label} is, as in {label} = s.x : T, or leave it out"
            span = span_of_label(rule, label, (label,), "where")
            yield Fault(rule, "unbound", message, hint, span)


def find_circular_fields(rules: RuleSet) -> Iterator[Fault]:
    """The types in effects and bindings whose fields depend on themselves.

    Such types can be judged, but no witness can be created. Mostly a label hides the
    binding that is meant.
    """
    for rule in rules.rules:
        if isinstance(rule.effect, Body):
            yield from _find_cycle(rule, rule.effect.value, "")
        if rule.where is not None:
            yield from _find_cycle(rule, rule.where, "where")


def _find_cycle(rule: Rule, value: Object, role: str) -> Iterator[Fault]:
    types = (part for part in subterms([value]) if isinstance(part, RecordType))
    around = next(filter(None, map(find_cycle, types)), ())
    if not around:
        return
    (first, *others), cycle = around, " → ".join(around)
    if others == [first]:
        message = f"in the rule {rule} {first} is set to itself: {cycle}"
        hint = "give what where binds another name than the label"
    else:
        message = f"in the rule {rule} fields go in a circle: {cycle}"
        hint = "no witness of such a type can be created: leave one of them open"
    span = span_of_label(rule, first.rpartition(".")[2], (), role)
    yield Fault(rule, "unbound", message, hint, span, "warning")
