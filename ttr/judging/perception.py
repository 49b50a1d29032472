"""Perception: filling the missing fields of a record by witness functions."""

from __future__ import annotations

from ttr.errors import RefusedError
from ttr.judging.assignments import Assignment
from ttr.judging.evaluator import reduce_applications
from ttr.safety.budgets import spend
from ttr.types.objects import Object, Record, UnresolvedError
from ttr.types.substitution import resolve_paths
from ttr.types.syntax import Join, Meet, PType, RecordType, TypeNode


def fill_fields(
    facts: Assignment, sit: Record, T: TypeNode
) -> tuple[Record, Assignment]:
    """The record with the fields of T that it lacked and could perceive; the new facts.

    A missing field whose ptype has a witness function gets a new situation, which is of
    the ptype to the degree that the function gives. No path leads out of T.
    """
    spend()
    match T:
        case Meet(parts):
            for part in parts:
                sit, facts = fill_fields(facts, sit, part)
            return sit, facts
        case RecordType():
            return _fill_record(facts, sit, T)
    return sit, facts


def _fill_record(
    facts: Assignment, sit: Record, T: RecordType
) -> tuple[Record, Assignment]:
    fields = dict(sit._fields)
    for label, field in T.fields:
        try:
            ground = reduce_applications(facts, resolve_paths(field, (fields,)))
        except (UnresolvedError, RefusedError):
            continue
        seen, facts = _perceive_field(facts, fields.get(label), ground)
        if seen is not None:
            fields[label] = seen
    return Record(fields), facts


def _perceive_field(
    facts: Assignment, value: Object | None, T: TypeNode
) -> tuple[Object | None, Assignment]:
    """The value of a field after perception; None where nothing can be perceived."""
    if isinstance(value, Record):
        return fill_fields(facts, value, T)
    if value is not None:
        return value, facts
    perceptual = _perceptual(facts, T)
    if perceptual:
        return _new_situation(facts, perceptual)
    inner, seen = fill_fields(facts, Record({}), T)
    return (inner, seen) if len(inner) else (None, facts)


def _perceptual(facts: Assignment, T: TypeNode) -> tuple[PType, ...]:
    """The ptypes that T is the meet or join of, if all have witness functions."""
    parts = T.parts if isinstance(T, Meet | Join) else (T,)
    ptypes = tuple(part for part in parts if isinstance(part, PType))
    visible = all(ptype.pred in facts.functions for ptype in ptypes)
    return ptypes if visible and len(ptypes) == len(parts) else ()


def _new_situation(
    facts: Assignment, ptypes: tuple[PType, ...]
) -> tuple[Object, Assignment]:
    sit, facts = facts.with_new("e")
    for T in ptypes:
        facts = facts.with_perceived(sit, T)
    return sit, facts
