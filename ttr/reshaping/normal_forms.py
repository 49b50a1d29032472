"""Normal forms: a type as a meet of joins, or as a join of meets.

Negations are pushed inwards by the laws of De Morgan: only what is no meet, join or
negation is negated. Nothing else is taken apart: the fields of record types, say,
stay as they are.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeAlias

from ttr.errors import Unsupported, following_nesting
from ttr.syntax import Join, Meet, Negation, TypeNode, as_type, join, meet

__all__ = ["join_normal_form", "meet_normal_form"]

LIMIT = 4096
"""How many parts a normal form may have; there can be exponentially many."""

_Part: TypeAlias = frozenset[TypeNode]
"""The types in one of the joins of a meet, or in one of the meets of a join."""


@following_nesting
def meet_normal_form(T: TypeNode, /) -> TypeNode:
    r"""The type as a meet of joins: (A ∧ B) ∨ C becomes (A ∨ C) ∧ (B ∨ C).

    A join that another one is part of is left out, as it says nothing more. Raises
    `Unsupported` where there are more than 4,096 parts.
    Law: a is of it iff a : T, under every assignment.

    >>> from ttr.syntax import Basic
    >>> A, B, C = map(Basic, "ABC")
    >>> print(meet_normal_form(A & B | C))
    (A \/ C) /\ (B \/ C)
    >>> print(meet_normal_form(~(A | B & C)))
    ~A /\ (~B \/ ~C)
    """
    found = _parts(_inwards(as_type(T)), Meet)
    return meet(*[join(*part) for part in found])


@following_nesting
def join_normal_form(T: TypeNode, /) -> TypeNode:
    r"""The type as a join of meets: A ∧ (B ∨ C) becomes (A ∧ B) ∨ (A ∧ C).

    A meet that another one is part of is left out, as nothing more is of it. Raises
    `Unsupported` where there are more than 4,096 parts.
    Law: a is of it iff a : T, under every assignment.

    >>> from ttr.syntax import Basic
    >>> A, B, C = map(Basic, "ABC")
    >>> print(join_normal_form(A & (B | ~~C)))
    (A /\ B) \/ (A /\ C)
    """
    found = _parts(_inwards(as_type(T)), Join)
    return join(*[meet(*part) for part in found])


def _inwards(T: TypeNode) -> TypeNode:
    """The type with negations only before what is no meet, join or negation."""
    match T:
        case Meet(parts):
            return meet(*map(_inwards, parts))
        case Join(parts):
            return join(*map(_inwards, parts))
        case Negation(Negation(body)):
            return _inwards(body)
        case Negation(Meet(parts)):
            return join(*[_inwards(Negation(part)) for part in parts])
        case Negation(Join(parts)):
            return meet(*[_inwards(Negation(part)) for part in parts])
    return T


def _parts(T: TypeNode, outer: type[Meet] | type[Join]) -> list[_Part]:
    """The parts of T as a meet of joins, or as a join of meets: `outer` is outside."""
    if not isinstance(T, Meet | Join):
        return [frozenset((T,))]
    inner = [_parts(part, outer) for part in T.parts]
    if isinstance(T, outer):
        return _needed(part for parts in inner for part in parts)
    spread: list[_Part] = [frozenset()]
    for parts in inner:
        spread = _needed(one | other for one in spread for other in parts)
    return spread


def _needed(parts: Iterable[_Part]) -> list[_Part]:
    """The parts that no other one is in; a limited number of them."""
    once: dict[_Part, None] = {}
    for part in parts:
        once[part] = None
        if len(once) > LIMIT:
            raise Unsupported(
                f"this has a normal form of more than {LIMIT:,} parts",
                hint="take apart a smaller type",
            )
    kept: list[_Part] = []
    smaller: list[_Part] = []
    for part in sorted(once, key=len):
        if kept and len(part) > len(kept[-1]):
            smaller = kept.copy()
        if not any(less <= part for less in smaller):
            kept.append(part)
    return kept
