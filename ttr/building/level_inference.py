"""Superscripts that were left out, filled in: the least levels that are consistent.

Papers write `Type` where they mean Typeⁿ for some n that makes sense (typical
ambiguity). Here a bare `Type` is of level 0; these functions give the reading that a
writer who left the superscripts out had in mind. What they give has its levels: nothing
in it is a type of itself.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple

from ttr.computing.universe_levels import level_of
from ttr.errors import IllFormedError
from ttr.safety.budgets import spend, within_budget
from ttr.types.objects import (
    BOUND,
    EventString,
    FiniteSet,
    Object,
    Path,
    Record,
    freeze,
)
from ttr.types.paths import free_paths, map_parts
from ttr.types.records import field_at
from ttr.types.syntax import (
    Application,
    Function,
    FunType,
    ListOf,
    Meet,
    NonEmpty,
    Plus,
    RecordType,
    SetOf,
    Singleton,
    Str,
    TypeNode,
    Universe,
    as_type,
    meet,
)

__all__ = ["levelled_judgement", "with_levels", "without_levels"]

_Scopes = tuple[Mapping[str, TypeNode], ...]
"""The types of the fields that paths may start from, innermost scope first."""


class _Placed(NamedTuple):
    """A value and the scopes around it."""

    value: Object
    around: _Scopes


@within_budget
def with_levels(T: TypeNode, /) -> TypeNode:
    """T with the least superscripts at which each manifest field is of its type.

    A superscript that is written stays; raises `IllFormedError` where it is too low. An
    argument of a function that is written out is made to fit its domain as well. Which
    part of a join is meant is not known, so joins stay as they are.
    Source: Russell's typical ambiguity; Cooper 2023 for the levels.

    >>> from ttr import RecType, Type, rectype, this
    >>> print(with_levels(rectype(T=Type @ rectype(x=Type))))
    [T = [x : Type] : Type^1]
    >>> print(with_levels(rectype(x=Type @ Type, y=Type @ this.x)))
    [x = Type : Type^1, y = x : Type^1]
    >>> with_levels(Universe("Type", 1) @ Universe("Type", 1))
    Traceback (most recent call last):
    ttr.errors.IllFormedError: what is of level 2 is too high for Type^1
    help: write Type^2, or leave the superscript out
    """
    return as_type(_infer_levels(as_type(T), ()))


@within_budget
def levelled_judgement(sit: object, T: TypeNode, /) -> tuple[Object, TypeNode]:
    """The judgement sit : T with the least superscripts at which it makes sense.

    Law: where sit is a type and T is `Type` without a superscript, the judgement that
    it gives holds. Raises `IllFormedError` where a superscript that is written is too
    low.

    >>> from ttr import Type
    >>> levelled_judgement(Type, Type)
    (Type, Universe('Type', 1))
    """
    found = _infer_levels(freeze(sit), ())
    raised = _raise_levels(as_type(T), [_Placed(found, ())])
    return found, as_type(_infer_levels(raised, ()))


@within_budget
def without_levels(T: TypeNode, /) -> TypeNode:
    """T with every superscript left out.

    Law: without_levels(with_levels(T)) is without_levels(T).

    >>> print(without_levels(Universe("Type", 2) @ Universe("RecType", 1)))
    Type@RecType
    """
    return as_type(_drop_levels(as_type(T)))


def _drop_levels(value: Object) -> Object:
    spend()
    if isinstance(value, Universe):
        return Universe(value.name)
    return map_parts(value, lambda part, _: _drop_levels(part))


# --- reading -------------------------------------------------------------------------


def _infer_levels(value: Object, around: _Scopes) -> Object:
    """The value with levels filled in; fields are read in order of dependency."""
    spend()
    match value:
        case RecordType(fields):
            scope = dict(fields)
            for label, field in fields:
                scope[label] = as_type(_infer_levels(field, (scope, *around)))
            return RecordType(tuple(scope.items()))
        case Function(domain, inside) | FunType(domain, inside):
            read = as_type(_infer_levels(domain, around))
            return type(value)(read, _infer_levels(inside, ({BOUND: read}, *around)))
        case Singleton(base, obj):
            found = _Placed(_infer_levels(obj, around), around)
            return Singleton(
                _infer_levels(_raise_levels(base, [found]), around), found.value
            )
        case Application(Function(domain, body), argument):
            found = _Placed(_infer_levels(argument, around), around)
            wider = Function(_raise_levels(domain, [found]), body)
            return Application(_infer_levels(wider, around), found.value)
    return map_parts(value, lambda part, _: _infer_levels(part, around))


def _raise_levels(T: TypeNode, values: list[_Placed]) -> TypeNode:
    """T with the least superscripts at which the values can be of it."""
    spend()
    if not values:
        return T
    match T:
        case Universe():
            return _at_least(T, max(_level(one) for one in values))
        case ListOf(item) | NonEmpty(item) | SetOf(item) | Plus(item):
            return type(T)(_raise_levels(item, list(_elements_of(values))))
        case Str(items):
            return Str(
                *[_raise_levels(T, _items_at(i, values)) for i, T in enumerate(items)]
            )
        case RecordType(fields):
            return RecordType(
                tuple(
                    [
                        (label, _raise_levels(T, _fields_at(label, values)))
                        for label, T in fields
                    ]
                )
            )
        case Singleton(base, obj):
            return Singleton(_raise_levels(base, values), obj)
        case Meet(kinds):
            return meet(*[_raise_levels(kind, values) for kind in kinds])
        case FunType(domain, result):
            return FunType(domain, _raise_levels(result, list(_results_of(values))))
    return T


def _at_least(universe: Universe, level: int) -> Universe:
    """The universe at this level, unless it has a superscript already."""
    if universe.level == 0:
        return Universe(universe.name, level)
    if level <= universe.level:
        return universe
    raise IllFormedError(
        f"what is of level {level} is too high for {universe}",
        hint=f"write {universe.name}^{level}, or leave the superscript out",
    )


def _level(one: _Placed) -> int:
    """The level of a value; a path has the highest level that its field may hold."""
    reached = [_path_level(path, one.around) for path in free_paths(one.value)]
    return max(level_of(one.value), *reached, 0)


def _path_level(path: Path, around: _Scopes) -> int:
    """The highest level that what a path leads to may have."""
    field = _field(path, around)
    if isinstance(field, Singleton) and not free_paths(field.value):
        return level_of(field.value)
    while isinstance(field, Singleton):
        field = field.base
    return field.level if isinstance(field, Universe) else 0


def _field(path: Path, around: _Scopes) -> TypeNode | None:
    """The type of the field that a path leads to, where that is plain."""
    if path.up >= len(around):
        return None
    first, *rest = path.labels
    here = around[path.up].get(first)
    return None if here is None else field_at(here, rest)


# --- what the values of a constructor are made of ------------------------------------


def _elements_of(values: list[_Placed]) -> Iterator[_Placed]:
    """The elements of the values that are lists, sets or strings."""
    for value, around in values:
        if isinstance(value, tuple | FiniteSet | EventString):
            yield from (_Placed(item, around) for item in value)


def _items_at(place: int, values: list[_Placed]) -> list[_Placed]:
    """The items at a position of those values that are strings of that length."""
    return [
        _Placed(value.items[place], around)
        for value, around in values
        if isinstance(value, EventString) and place < len(value)
    ]


def _fields_at(label: str, values: list[_Placed]) -> list[_Placed]:
    """The values of a field, in those values that are records with it."""
    return [
        _Placed(value[label], around)
        for value, around in values
        if isinstance(value, Record) and label in value
    ]


def _results_of(values: list[_Placed]) -> Iterator[_Placed]:
    """The bodies of those values that are functions."""
    for value, around in values:
        if isinstance(value, Function):
            yield _Placed(value.body, ({BOUND: value.domain}, *around))
