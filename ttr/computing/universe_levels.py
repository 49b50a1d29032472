"""Stratification: which types are of `Type` and of `RecType`."""

from __future__ import annotations

from collections.abc import Callable

from ttr.types.interning import cache_on_node
from ttr.types.objects import Object
from ttr.types.paths import parts
from ttr.types.syntax import RecordType, TypeNode, Universe


def why_outside(value: Object, universe: Universe) -> str:
    """Why the object is not of a universe; the empty string if it is.

    >>> from ttr import Ind, RecType, Type, rectype
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

    >>> from ttr import Ind, RecType, rectype
    >>> level_of(Ind), level_of(RecType), level_of(rectype(T=Universe("Type", 1)))
    (0, 1, 2)
    """
    return _of_type(value) if isinstance(value, TypeNode) else _level(value)


def _level(value: Object) -> int:
    if isinstance(value, Universe):
        return value.level + 1
    if type(value) is str:
        return 0
    same, inner = parts(value)
    return max(map(level_of, (*same, *inner)), default=0)


_of_type: Callable[[TypeNode], int] = cache_on_node(_level)
