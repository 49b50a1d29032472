"""Accounts of effects that are written in the notation."""

from __future__ import annotations

from collections.abc import Iterator

from ttr.types.paths import escaping, replace_paths
from ttr.types.syntax import (
    Object,
    Path,
    Record,
    RecordType,
    Singleton,
    TypeNode,
)
from ttr.updates.checks.accounts import Access, Account, Write
from ttr.updates.checks.source_positions import place
from ttr.updates.checks.state_layout import Labels, Term
from ttr.updates.rules import Body, Rule

__all__ = ["written"]


def written(rule: Rule, body: Body) -> Account:
    """The account of an effect in the notation: it never refuses, and says it all."""
    value = body.value
    reads = tuple(_reads(rule, value))
    if not isinstance(value, RecordType | Record):
        return Account(reads, refuses=False)
    return Account(reads, (tuple(_writes(rule, value)),), True, False)


def _reads(rule: Rule, value: Object) -> Iterator[Access]:
    for path in sorted(escaping(value), key=lambda path: path.labels):
        variable, *labels = path.labels
        spans = [
            place(rule, label, path.labels[: i + 2]) for i, label in enumerate(labels)
        ]
        yield Access(variable, tuple(labels), tuple(spans))


def _writes(rule: Rule, value: Object, at: Labels = ()) -> Iterator[Write]:
    """What a record type or record sets, field by field."""
    match value:
        case RecordType(fields) if fields or not at:
            for label, field in fields:
                yield from _writes(rule, field, (*at, label))
        case Singleton(base, term):
            told = _outside(term, len(at))
            yield Write(at, told, base, place(rule, at[-1], at))
        case TypeNode():
            yield Write(at, None, value, place(rule, at[-1], at))
        case Record() if not at:
            for label in value:
                yield from _set(rule, value[label], (label,))


def _set(rule: Rule, value: Object, at: Labels) -> Iterator[Write]:
    """What a record that is the next state sets, field by field."""
    if isinstance(value, Record) and len(value):
        for label in value:
            yield from _set(rule, value[label], (*at, label))
        return
    yield Write(at, Term(value), None, place(rule, at[-1], at))


def _outside(term: Object, depth: int) -> Term | None:
    """An object that stands so many records further in, as it is seen from outside.

    None where it depends on what it stands beside.
    """
    if any(path.up < depth for path in escaping(term)):
        return None
    return Term(replace_paths(term, lambda path: Path(path.up - depth, path.labels)))
