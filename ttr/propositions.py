"""Propositions: what can be true or false.

A type is a proposition that is true if something is of it. An Austinian proposition,
{sit = s, sit_type = T}, is about a situation as well, and true if s is of T.
"""

from __future__ import annotations

from ttr.errors import IllFormed
from ttr.objects import Object, Record, record
from ttr.syntax import TypeNode, as_type

__all__ = ["claim", "proposition"]


def proposition(sit: object, T: TypeNode) -> Record:
    """The Austinian proposition that a situation is of a type.

    >>> from ttr.syntax import Ind, Pred
    >>> print(proposition("s1", Pred("dog", Ind)("fido")))
    {sit = s1, sit_type = dog(fido)}
    """
    return record(sit=sit, sit_type=as_type(T))


def claim(p: object) -> tuple[Object, TypeNode]:
    """The situation and the type of an Austinian proposition; else `IllFormed`."""
    if isinstance(p, Record) and set(p) >= {"sit", "sit_type"}:
        return p.sit, as_type(p.sit_type)
    raise IllFormed(
        f"a proposition is a type or a record {{sit = s, sit_type = T}}, found {p}"
    )
