r"""Merging by form alone: label by label, and with no question asked.

A merge inside a term may be computed before or after what it is applied to is known.
That both give the same, no axiom and no subtyping may be asked on the way, which
`ttr.building.merging.merge` does.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ttr.safety.budgets import spend, within_budget
from ttr.types.derived_types import order_fields
from ttr.types.interning import identity
from ttr.types.objects import Object, sort_canonically
from ttr.types.paths import merge_by_form
from ttr.types.syntax import (
    Application,
    Meet,
    Merge,
    RecordType,
    Singleton,
    TypeAt,
    TypeNode,
    as_type,
    meet,
)


@within_budget
def merge_terms(*parts: TypeNode) -> TypeNode:
    r"""The merge of types by their form: flat, each part once, in any order.

    Record types are merged label by label. Everything that is plain in the others is
    also said of a singleton: T@a merged with S is (T ∧ S)@a. Beside the value of a
    function that is not known yet they stay apart, in a `Merge`; else it is the meet.
    Laws: it is associative, commutative and idempotent, and merging after a
    substitution gives the same as before it.

    >>> from ttr import Basic, Ind, fun, rectype, this
    >>> from ttr.types import RecType
    >>> A = Basic("A")
    >>> print(merge_terms(rectype(x=Ind), rectype(x=A, y=A)))
    [x : A /\ Ind, y : A]
    >>> print(merge_terms(Ind @ "j", A))
    (A /\ Ind)@j
    >>> print(fun(f=Ind >> RecType)(merge_terms(this.f("j"), rectype(x=Ind))))
    \P:(Ind -> RecType). merge(P(j), [x : Ind])
    """
    types = dict.fromkeys(map(as_type, parts))
    if len(types) < 2:
        return meet(*types)
    values: dict[object, Object] = {}
    plain = dict.fromkeys(_plain_parts(types, values))
    open_ = [T for T in plain if isinstance(T, Application | TypeAt)]
    records = [T for T in plain if isinstance(T, RecordType)]
    others = [T for T in plain if not isinstance(T, Application | TypeAt | RecordType)]
    known = [*others, *((_merge_fields(records),) if records else ())]
    whole = [*open_, *((meet(*known),) if known else ())]
    base = whole[0] if len(whole) == 1 else Merge(tuple(sort_canonically(whole)))
    if not values:
        return base
    return meet(*[Singleton(base, value) for value in values.values()])


def _plain_parts(
    types: Iterable[TypeNode], values: dict[object, Object]
) -> Iterator[TypeNode]:
    """The parts of meets, and the bases of singletons, whose values are put aside."""
    for T in types:
        spend()
        match T:
            case Meet(parts):
                yield from _plain_parts(parts, values)
            case Singleton(base, value):
                values[identity(value)] = value
                yield from _plain_parts([base], values)
            case _:
                yield T


def _merge_fields(types: list[RecordType]) -> RecordType:
    """The record type with the merge of what each has at a label."""
    fields: dict[str, list[TypeNode]] = {}
    for T in types:
        for label, field in T.fields:
            fields.setdefault(label, []).append(field)
    return RecordType(order_fields({k: merge_terms(*v) for k, v in fields.items()}))


merge_by_form.provided_by(merge_terms)
