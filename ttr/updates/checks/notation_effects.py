"""What effects written in the notation read and write."""

from __future__ import annotations

from collections.abc import Iterator

from ttr.types.objects import Object, Path, Record
from ttr.types.paths import free_paths, replace_paths
from ttr.types.syntax import RecordType, Singleton, TypeNode
from ttr.updates.checks.effect_summaries import Access, EffectSummary, Write
from ttr.updates.checks.source_positions import span_of_label
from ttr.updates.checks.state_layout import Labels, Term
from ttr.updates.rules import Body, Rule


def summarise_notation(rule: Rule, body: Body) -> EffectSummary:
    """Summarise an effect in the notation: it never refuses, and nothing is hidden."""
    value = body.value
    reads = tuple(_reads(rule, value))
    if not isinstance(value, RecordType | Record):
        return EffectSummary(reads, may_refuse=False)
    outcomes = (tuple(_writes(rule, value)),)
    return EffectSummary(reads, outcomes, complete=True, may_refuse=False)


def _reads(rule: Rule, value: Object) -> Iterator[Access]:
    for path in sorted(free_paths(value), key=lambda path: path.labels):
        variable, *labels = path.labels
        spans = [
            span_of_label(rule, label, path.labels[: i + 2])
            for i, label in enumerate(labels)
        ]
        yield Access(variable, tuple(labels), tuple(spans))


def _writes(rule: Rule, value: Object, at: Labels = ()) -> Iterator[Write]:
    """What a record type or record sets, field by field."""
    match value:
        case RecordType(fields) if fields or not at:
            for label, field in fields:
                yield from _writes(rule, field, (*at, label))
        case Singleton(base, term):
            outside = _seen_from_outside(term, len(at))
            yield Write(at, outside, base, span_of_label(rule, at[-1], at))
        case TypeNode():
            yield Write(at, None, value, span_of_label(rule, at[-1], at))
        case Record() if not at:
            for label in value:
                yield from _writes_of_state(rule, value[label], (label,))


def _writes_of_state(rule: Rule, value: Object, at: Labels) -> Iterator[Write]:
    """What a record that is the next state sets, field by field."""
    if isinstance(value, Record) and len(value):
        for label in value:
            yield from _writes_of_state(rule, value[label], (*at, label))
        return
    yield Write(at, Term(value), None, span_of_label(rule, at[-1], at))


def _seen_from_outside(term: Object, depth: int) -> Term | None:
    """A term that is `depth` records further in, with its paths counted from outside.

    None where it depends on other fields of these records.
    """
    if any(path.up < depth for path in free_paths(term)):
        return None
    return Term(replace_paths(term, lambda path: Path(path.up - depth, path.labels)))
