"""Making up witnesses, and telling an assignment of what they are."""

from __future__ import annotations

from functools import partial, reduce
from typing import assert_never

from ttr.assignments import Assignment
from ttr.errors import Refused
from ttr.judging import derivation
from ttr.merging import merge
from ttr.printing import notation
from ttr.probability import CERTAIN
from ttr.substitution import Unresolved, grounded
from ttr.syntax import (
    Basic,
    ListOf,
    Meet,
    Object,
    PType,
    Rec,
    Record,
    RecordType,
    Singleton,
    TypeNode,
    Universe,
    identity,
)

__all__ = ["created", "told"]


def told(facts: Assignment, sit: Object, T: TypeNode) -> Assignment:
    """The assignment in which sit is of T, taken apart into its atoms.

    T has no paths that escape it. Raises `Refused` where sit cannot be of T.
    """
    match T:
        case Basic() | PType():
            return facts.with_fact(sit, T, CERTAIN)
        case Meet(parts):
            for part in parts:
                facts = told(facts, sit, part)
            return facts
        case Singleton(base, value) if identity(value) == identity(sit):
            return told(facts, sit, base)
        case ListOf(item) if isinstance(sit, tuple):
            for element in sit:
                facts = told(facts, element, item)
            return facts
        case RecordType() if isinstance(sit, Record):
            return _told_fields(facts, sit, T)
    why = derivation(facts, sit, T)
    if why.p != CERTAIN:
        raise Refused(f"{notation(sit)} : {T} cannot be given: {why.rule}")
    return facts


def _told_fields(facts: Assignment, sit: Record, T: RecordType) -> Assignment:
    for label, field in T.fields:
        if label not in sit:
            raise Refused(f"{notation(sit)} : {T} cannot be given: there is no {label}")
        try:
            ground = grounded(field, (sit._fields,))
        except Unresolved as unresolved:
            raise Refused(
                f"{notation(sit)} : {T} cannot be given: {unresolved.message}"
            ) from unresolved
        facts = told(facts, sit._fields[label], ground)
    return facts


def created(facts: Assignment, T: TypeNode) -> tuple[Object, Assignment]:
    """A fresh witness of T, and the assignment that has it.

    T has no paths that escape it. Raises `Refused` where none can be made up.
    """
    match T:
        case Basic():
            sit, facts = facts.with_new("a")
            return sit, told(facts, sit, T)
        case PType():
            sit, facts = facts.with_new("s")
            return sit, told(facts, sit, T)
        case Meet(parts):
            return _created_meet(facts, T, parts)
        case Singleton(base, value):
            return value, _surely(facts, value, base)
        case ListOf():
            return (), facts
        case RecordType():
            return _created_record(facts, T)
        case Universe():
            return Rec, facts
    raise assert_never(T)  # type: ignore[arg-type]


def _surely(facts: Assignment, sit: Object, T: TypeNode) -> Assignment:
    """The assignment itself if sit certainly is of T, else one told so."""
    if derivation(facts, sit, T).p == CERTAIN:
        return facts
    return told(facts, sit, T)


def _created_record(facts: Assignment, T: RecordType) -> tuple[Object, Assignment]:
    fields: dict[str, Object] = {}
    for label, field in T.fields:
        try:
            ground = grounded(field, (fields,))
        except Unresolved as unresolved:
            raise Refused(
                f"the field {label} cannot be created: {unresolved.message}",
                hint="fields on a cycle can be judged, but not created",
            ) from unresolved
        fields[label], facts = created(facts, ground)
    return Record(fields), facts


def _created_meet(
    facts: Assignment, T: TypeNode, parts: tuple[TypeNode, ...]
) -> tuple[Object, Assignment]:
    """A witness of what has a form, told to be also of the rest."""
    for part in parts:
        if isinstance(part, Singleton):
            return part.value, _surely(facts, part.value, T)
    shapes = [part for part in parts if not isinstance(part, Basic | PType)]
    if len({type(shape) for shape in shapes}) > 1:
        raise Refused(f"a witness of {T} cannot be made up, only be given")
    if all(isinstance(shape, RecordType) for shape in shapes):
        shapes = [reduce(partial(_merged, facts), shapes)] if shapes else []
    sit, facts = created(facts, (shapes or parts)[0])
    return sit, _surely(facts, sit, T)


def _merged(facts: Assignment, S: TypeNode, T: TypeNode) -> TypeNode:
    return merge(S, T, facts.theory)
