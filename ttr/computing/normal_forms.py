"""Normal forms: a type as a meet of joins, or as a join of meets.

Negations are pushed inwards by the laws of De Morgan: only what is no meet, join or
negation is negated. Nothing else is taken apart: the fields of record types, say,
stay as they are.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeAlias

from ttr.errors import UnsupportedError
from ttr.safety.budgets import spend, within_budget
from ttr.types.syntax import Join, Meet, Negation, TypeNode, as_type, join, meet

LIMIT = 4096
"""How many parts a normal form may have; there can be exponentially many."""

_Part: TypeAlias = frozenset[TypeNode]
"""The types in one of the joins of a meet, or in one of the meets of a join."""


@within_budget
def meet_normal_form(T: TypeNode, /, limit: int = LIMIT) -> TypeNode:
    r"""The type as a meet of joins: (A ∧ B) ∨ C becomes (A ∨ C) ∧ (B ∨ C).

    A join that another one is part of is left out, as it says nothing more. Raises
    `UnsupportedError` where there are more parts than the limit.
    Law: a is of it iff a : T, under every assignment.

    >>> from ttr import Basic
    >>> A, B, C = map(Basic, "ABC")
    >>> print(meet_normal_form(A & B | C))
    (A \/ C) /\ (B \/ C)
    >>> print(meet_normal_form(~(A | B & C)))
    ~A /\ (~B \/ ~C)
    """
    found = _find_parts(push_negations_inwards(as_type(T)), Meet, limit)
    return meet(*[join(*part) for part in found])


@within_budget
def join_normal_form(T: TypeNode, /, limit: int = LIMIT) -> TypeNode:
    r"""The type as a join of meets: A ∧ (B ∨ C) becomes (A ∧ B) ∨ (A ∧ C).

    A meet that another one is part of is left out, as nothing more is of it. Raises
    `UnsupportedError` where there are more parts than the limit.
    Law: a is of it iff a : T, under every assignment.

    >>> from ttr import Basic
    >>> A, B, C = map(Basic, "ABC")
    >>> print(join_normal_form(A & (B | ~~C)))
    (A /\ B) \/ (A /\ C)
    """
    found = _find_parts(push_negations_inwards(as_type(T)), Join, limit)
    return join(*[meet(*part) for part in found])


def push_negations_inwards(T: TypeNode) -> TypeNode:
    """The type with negations only before what is no meet, join or negation."""
    spend()
    match T:
        case Meet(parts):
            return meet(*map(push_negations_inwards, parts))
        case Join(parts):
            return join(*map(push_negations_inwards, parts))
        case Negation(Negation(body)):
            return push_negations_inwards(body)
        case Negation(Meet(parts)):
            return join(*[push_negations_inwards(Negation(part)) for part in parts])
        case Negation(Join(parts)):
            return meet(*[push_negations_inwards(Negation(part)) for part in parts])
    return T


def _find_parts(T: TypeNode, outer: type[Meet] | type[Join], limit: int) -> list[_Part]:
    """The parts of T as a meet of joins, or as a join of meets: `outer` is outside."""
    spend()
    if not isinstance(T, Meet | Join):
        return [frozenset((T,))]
    inner = [_find_parts(part, outer, limit) for part in T.parts]
    if isinstance(T, outer):
        return _drop_redundant((part for parts in inner for part in parts), limit)
    spread: list[_Part] = [frozenset()]
    for parts in inner:
        both = (one | other for one in spread for other in parts)
        spread = _drop_redundant(both, limit)
    return spread


def _drop_redundant(parts: Iterable[_Part], limit: int) -> list[_Part]:
    """The parts that no other one is in; a limited number of them."""
    once: dict[_Part, None] = {}
    for part in parts:
        spend()
        once[part] = None
        if len(once) > limit:
            raise UnsupportedError(
                f"this has a normal form of more than {limit:,} parts",
                hint="take apart a smaller type",
            )
    kept: list[_Part] = []
    smaller: list[_Part] = []
    for part in sorted(once, key=len):
        if kept and len(part) > len(kept[-1]):
            smaller = kept.copy()
        spend(1 + len(smaller) // 8)  # of these comparisons many go in one step
        if not any(less <= part for less in smaller):
            kept.append(part)
    return kept
