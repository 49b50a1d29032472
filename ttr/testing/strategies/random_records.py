"""Strategies for records of a type."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import Any

from hypothesis import strategies as st

from ttr.computing.strings.pieces import string_of
from ttr.errors import IllFormedError, RefusedError, TTRError
from ttr.judging.models import Model
from ttr.testing.strategies import random_types
from ttr.testing.strategies.random_models import facts
from ttr.testing.strategies.random_types import Words
from ttr.theories.theory import Theory
from ttr.types.objects import FiniteSet, Object, Record, UnresolvedError
from ttr.types.substitution import resolve_paths
from ttr.types.syntax import (
    Basic,
    FunType,
    Join,
    ListOf,
    Meet,
    NonEmpty,
    Plus,
    PType,
    RecordType,
    SetOf,
    Singleton,
    Str,
    TypeNode,
    Universe,
    as_type,
    kind_of,
)


def records(T: TypeNode, model: Model | None = None) -> st.SearchStrategy[Any]:
    """Records for a record type, or for a meet or join of record types.

    With a model they have the shape of T, with objects of the model and new ones: many
    are of T, others nearly. Without a model they are pairs (record, model) in which the
    record is of T; drawing raises `RefusedError` if no such record can be created.
    Raises `IllFormedError` for what is no record type.

    >>> from hypothesis import find
    >>> from ttr import Ind, Pred, rectype, this
    >>> T = rectype(x=Ind, c=Pred("dog", Ind)(this.x))
    >>> r, M = find(records(T), lambda pair: True)
    >>> M.judge(r, T).holds
    True
    """
    if not has_only_records(as_type(T)):
        raise IllFormedError(f"records are drawn for a record type, found {kind_of(T)}")
    if model is None:
        return _witnesses(T)
    if not isinstance(model, Model):
        raise TTRError(f"records are drawn over a model, found {kind_of(model)}")
    return objects_of_shape(T, model)


def has_only_records(T: TypeNode) -> bool:
    """Does its form alone say that only records are of this type?"""
    match T:
        case RecordType():
            return True
        case Singleton(base, _):
            return has_only_records(base)
        case Meet(parts):
            return any(map(has_only_records, parts))
        case Join(parts):
            return all(map(has_only_records, parts))
    return False


@st.composite
def _witnesses(draw: st.DrawFn, T: TypeNode) -> tuple[Object, Model]:
    """A record of the shape of T in a model that says it is of T; or one created."""
    M = draw(facts(Words.of(Theory.of(T)), None, st.just(1.0)))
    witness = with_fact(M, draw(objects_of_shape(T, M)), T)
    if witness is not None and draw(st.booleans()):
        return witness
    for model in (M, Model()):
        with suppress(RefusedError):
            return model.create(T)
    return witness or Model().create(T)


def with_fact(M: Model, r: Object, T: TypeNode) -> tuple[Object, Model] | None:
    """The record with a model in which it is of T; None if there is none."""
    try:
        M = M.given(r, T)
        return (r, M) if M.judge(r, T).holds else None
    except TTRError:
        return None


def objects_of_shape(T: TypeNode, M: Model) -> st.SearchStrategy[Object]:
    """Objects of the shape of T, with names that the model knows and new ones."""
    known = [name for name in M.facts.known if isinstance(name, str)]
    names = [*sorted(known), *(f"new{number}" for number in range(1, 4))]
    return _shapes(T, M, tuple(names))


@st.composite
def _shapes(draw: st.DrawFn, T: TypeNode, M: Model, names: tuple[str, ...]) -> Object:
    """Objects of the shape of T; mostly of T, where it is a basic type or a ptype."""
    match T:
        case RecordType(kinds):
            fields: dict[str, Object] = {}
            for label, field in kinds:
                fields[label] = draw(_shapes_of_field(fields, field, M, names))
            return Record(fields)
        case Meet(parts) if has_only_records(T):
            whole = [draw(_shapes(part, M, names)) for part in parts]
            several = [r for r in whole if isinstance(r, Record)]
            return Record({k: v for r in several for k, v in r._fields.items()})
        case Meet(parts) | Join(parts):
            return draw(_shapes(draw(st.sampled_from(parts)), M, names))
        case Singleton(_, value):
            return value
        case Str(kinds):
            return string_of(kinds, [draw(_shapes(kind, M, names)) for kind in kinds])
        case Plus(item):
            found = draw(st.lists(_shapes(item, M, names), min_size=1, max_size=2))
            return string_of([item] * len(found), found)
        case ListOf(item) | NonEmpty(item) | SetOf(item):
            least = int(isinstance(T, NonEmpty))
            found = draw(st.lists(_shapes(item, M, names), min_size=least, max_size=2))
            return _MADE_OF[type(T)](*found)
        case FunType() | Universe():
            return draw(random_types.forms(Words.of(Theory.of(T)), (), 1, T))
        case Basic() | PType() if M.witnesses(T):
            likely = st.sampled_from(M.witnesses(T))
            return draw(st.one_of(likely, likely, likely, st.sampled_from(names)))
    return draw(st.sampled_from(names))


def _tuple(*items: Object) -> Object:
    return items


_MADE_OF: dict[type[TypeNode], Callable[..., Object]] = {
    ListOf: _tuple,
    NonEmpty: _tuple,
    SetOf: FiniteSet,
}
"""Constructors of the objects of collection types."""


def _shapes_of_field(
    fields: Mapping[str, Object], T: TypeNode, M: Model, names: tuple[str, ...]
) -> st.SearchStrategy[Object]:
    """Objects of the shape of a field, in a record that already has other fields."""
    try:
        return _shapes(resolve_paths(T, (fields,)), M, names)
    except UnresolvedError:
        return st.sampled_from(names)
