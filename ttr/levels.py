"""Stratification: which types are of `Type` and of `RecType`."""

from __future__ import annotations

from collections.abc import Iterable

from ttr.syntax import (
    ListOf,
    Meet,
    Object,
    PType,
    Record,
    RecordType,
    Singleton,
    TypeNode,
    Universe,
)

__all__ = ["level_of", "why_outside"]


def why_outside(value: Object, universe: Universe) -> str:
    """Why the object is not of a type of types, or the empty string where it is.

    >>> from ttr.syntax import Ind, RecType, Type, rectype
    >>> why_outside(rectype(x=Ind), RecType), why_outside(Type, Universe("Type", 1))
    ('', '')
    >>> why_outside(Type, Type), why_outside(Ind, RecType)
    ('it is of level 1', 'it is no record type')
    """
    if not isinstance(value, TypeNode):
        return "it is no type"
    level = level_of(value)
    if level > universe.level:
        return f"it is of level {level}"
    if universe.name == "RecType" and not isinstance(value, RecordType):
        return "it is no record type"
    return ""


def level_of(value: Object) -> int:
    """The level of a type or object: one above the highest Typeⁿ that it mentions.

    >>> from ttr.syntax import Ind, RecType, rectype
    >>> level_of(Ind), level_of(RecType), level_of(rectype(T=Universe("Type", 1)))
    (0, 1, 2)
    """
    match value:
        case Universe(_, level):
            return level + 1
        case RecordType(fields):
            return _highest(field for _, field in fields)
        case Singleton(base, obj):
            return max(level_of(base), level_of(obj))
        case PType(_, args) | Meet(args):
            return _highest(args)
        case ListOf(item):
            return level_of(item)
        case tuple():
            return _highest(value)
        case Record():
            return _highest(value._fields.values())
    return 0


def _highest(values: Iterable[Object]) -> int:
    return max(map(level_of, values), default=0)
