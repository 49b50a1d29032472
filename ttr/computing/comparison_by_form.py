"""Is a type below another just by going along with its form, part by part?

That takes as long as the types are written, also where the same part stands in many
places, and asks no axiom. Where it says no, nothing follows.
"""

from __future__ import annotations

from ttr.safety.budgets import spend
from ttr.types.interning import identity
from ttr.types.syntax import (
    FunType,
    Join,
    ListOf,
    Meet,
    Negation,
    NonEmpty,
    RecordType,
    SetOf,
    Singleton,
    TypeNode,
)

_Known = dict[tuple[TypeNode, TypeNode], bool]


def is_below_by_form(S: TypeNode, T: TypeNode) -> bool:
    """Is S below T by form? The paths in both are seen from the same place.

    >>> from ttr import Basic, ListOf, rectype
    >>> A, B = Basic("A"), Basic("B")
    >>> is_below_by_form(rectype(x=A & B, y=ListOf(A)), rectype(x=A, y=ListOf(A | B)))
    True
    """
    return _is_below(S, T, {})


def _is_below(S: TypeNode, T: TypeNode, known: _Known) -> bool:
    if S is T:
        return True
    found = known.get((S, T))
    if found is None:
        spend()
        found = known[S, T] = _compare(S, T, known)
    return found


def _compare(S: TypeNode, T: TypeNode, known: _Known) -> bool:
    match S, T:
        case _, Meet(parts):
            return all(_is_below(S, part, known) for part in parts)
        case Join(parts), _:
            return all(_is_below(part, T, known) for part in parts)
        case RecordType(), RecordType(fields):
            return all(k in S and _is_below(S[k], U, known) for k, U in fields)
        case (ListOf(one) | NonEmpty(one), ListOf(other)) | (
            (NonEmpty(one), NonEmpty(other)) | (SetOf(one), SetOf(other))
        ):
            return _is_below(one, other, known)
        case Negation(one), Negation(other):
            return _is_below(other, one, known)
        case FunType(), FunType():
            return _is_below(T.domain, S.domain, known) and _is_below(
                S.result, T.result, known
            )
        case Singleton(one, value), Singleton(other, wanted):
            return identity(value) == identity(wanted) and _is_below(one, other, known)
    return (
        (isinstance(T, Join) and any(_is_below(S, part, known) for part in T.parts))
        or (isinstance(S, Meet) and any(_is_below(part, T, known) for part in S.parts))
        or (isinstance(S, Singleton) and _is_below(S.base, T, known))
    )
