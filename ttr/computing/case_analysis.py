"""Taking joins and negations apart: the cases of a type, and its clauses.

A type is the join of its cases, which have no join where one can be taken out; and the
meet of its clauses, each a join of types that are neither meets nor joins. In both,
negations are pushed inwards: ¬(S ∧ T) is ¬S ∨ ¬T, and ¬¬T is T.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial
from itertools import chain, product
from math import prod

from ttr.computing.normal_forms import meet_normal_form, push_negations_inwards
from ttr.computing.strings.pieces import is_of_strings
from ttr.errors import UnsupportedError
from ttr.safety.budgets import spend
from ttr.types.derived_types import order_fields
from ttr.types.interning import cache_on_node
from ttr.types.syntax import (
    Join,
    Meet,
    Negation,
    RecordType,
    Singleton,
    Str,
    TypeNode,
    meet,
)

_CASES = 256
"""How many cases or clauses a type may have; with more it is not divided."""

Clause = tuple[TypeNode, ...]


@cache_on_node
def has_cases(T: TypeNode) -> bool:
    """Has T a join or a negation that can be split into cases?"""
    match T:
        case Join() | Negation():
            return True
        case Meet(parts):
            return any(map(has_cases, parts))
        case Str(parts):
            return any(has_cases(part) for part in parts if not is_of_strings(part))
        case RecordType(fields):
            return any(has_cases(field) for _, field in fields)
        case Singleton(base, _):
            return has_cases(base)
    return False


def cases(T: TypeNode) -> tuple[TypeNode, ...] | None:
    """The types of which T is the join, or None where they are too many.

    A record type has a case for each way to choose a case of each field.

    >>> from ttr import Basic
    >>> A, B, C = map(Basic, "ABC")
    >>> print(*cases(A & (B | ~~C)), sep="; ")
    A /\\ B; A /\\ C
    """
    spend()
    if not has_cases(T):
        return (T,)
    match T:
        case Join(parts):
            return _all_cases(tuple(map(cases, parts)))
        case Negation():
            inner = push_negations_inwards(T)
            return (T,) if inner is T else cases(inner)
        case Singleton(base, value):
            found = cases(base)
            return found and tuple([Singleton(case, value) for case in found])
        case Meet(parts):
            return _combine_cases(map(cases, parts), meet)
        case Str(parts):
            # A piece that may be a string of several events stays whole.
            kept = [(p,) if is_of_strings(p) else cases(p) for p in parts]
            return _combine_cases(kept, Str)
        case RecordType(fields):
            kept = [cases(field) for _, field in fields]
            return _combine_cases(kept, partial(_record_type_of, T.labels))
    return (T,)


def cases_or_whole(T: TypeNode) -> tuple[TypeNode, ...]:
    """The cases of a type, or the type itself where they are too many."""
    return cases(T) or (T,)


def _record_type_of(labels: Iterable[str], *types: TypeNode) -> RecordType:
    return RecordType(order_fields(dict(zip(labels, types, strict=True))))


def _combine_cases(
    parts: Iterable[tuple[TypeNode, ...] | None], whole: Callable[..., TypeNode]
) -> tuple[TypeNode, ...] | None:
    """A case of the whole for each way to choose a case of each part."""
    found = list(parts)
    if prod(len(choices or ()) for choices in found) > _CASES or None in found:
        return None
    return tuple([whole(*choice) for choice in product(*filter(None, found))])


def _all_cases(
    found: tuple[tuple[TypeNode, ...] | None, ...],
) -> tuple[TypeNode, ...] | None:
    """All cases, each once; None if they are too many."""
    if None in found:
        return None
    once = tuple(dict.fromkeys(chain.from_iterable(filter(None, found))))
    return once if len(once) <= _CASES else None


def clauses(T: TypeNode) -> tuple[Clause, ...] | None:
    """The clauses of which T is the meet, or None where they are too many.

    >>> from ttr import Basic
    >>> A, B, C = map(Basic, "ABC")
    >>> [" or ".join(map(str, clause)) for clause in clauses((A & B) | ~(A & C))]
    ['A or ~A or ~C', 'B or ~A or ~C']
    """
    if not isinstance(T, Meet | Join | Negation):
        return ((T,),)
    try:
        T = meet_normal_form(T, _CASES)
    except UnsupportedError:
        return None
    whole = T.parts if isinstance(T, Meet) else (T,)
    return tuple([one.parts if isinstance(one, Join) else (one,) for one in whole])
