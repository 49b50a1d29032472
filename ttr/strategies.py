"""Hypothesis strategies for property tests: types, objects, records and models.

They draw from few names, so that clashes happen, and reach every constructor: ptypes of
several arities, record types with dependent, manifest and nested fields, paths outwards
and circles, functions, lists, sets, strings, and what is computed from them. What they
draw is well-formed and shrinks to what is small.

>>> from hypothesis import given, settings
>>> from ttr import subtype
>>> @settings(max_examples=10, database=None)
... @given(types())
... def subtyping_is_reflexive(T):
...     assert subtype(T, T).yes
>>> subtyping_is_reflexive()
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import Any

try:
    from hypothesis import strategies as st
except ImportError as missing:
    raise ImportError(
        "ttr.strategies needs hypothesis: pip install 'kille[test]'"
    ) from missing

from ttr import arbitrary
from ttr.arbitrary import Words
from ttr.errors import IllFormed, Refused, TTRError
from ttr.models import Model
from ttr.objects import Unresolved
from ttr.strings.forms import string_of
from ttr.substitution import grounded
from ttr.syntax import (
    Basic,
    FiniteSet,
    FunType,
    Join,
    ListOf,
    Meet,
    NonEmpty,
    Object,
    Plus,
    PType,
    Record,
    RecordType,
    SetOf,
    Singleton,
    Str,
    TypeNode,
    Universe,
    as_type,
    kind_of,
)
from ttr.theories import Theory

__all__ = ["models", "objects", "record_types", "records", "types"]

DEPTH = 3
"""How deep what is drawn nests, if nothing else is asked for."""


# --- types and objects ---------------------------------------------------------------


def types(
    theory: Theory | None = None, *, depth: int = DEPTH
) -> st.SearchStrategy[TypeNode]:
    """Well-formed types of every constructor, over what a theory declares.

    Without a theory there are the basic types A, B and C, and predicates p, q and r of
    several arities. Constructors nest at most so deep. Raises `TTRError` for what is no
    theory or no depth.

    >>> from hypothesis import find
    >>> print(find(types(), lambda T: isinstance(T, RecordType) and len(T.labels) == 2))
    [x : A, y : A]
    """
    return arbitrary.types(Words.of(theory), (), _checked(depth))


def record_types(
    theory: Theory | None = None, *, depth: int = DEPTH
) -> st.SearchStrategy[RecordType]:
    """Well-formed record types, drawn as `types` does."""
    return arbitrary.record_types(Words.of(theory), (), _checked(depth))


def objects(
    theory: Theory | None = None, *, depth: int = DEPTH
) -> st.SearchStrategy[Object]:
    """Objects of every kind that has a notation, over what a theory declares.

    They are names, numbers, records, lists, sets, strings of events, functions, types.
    """
    return arbitrary.objects(Words.of(theory), (), _checked(depth))


def _checked(depth: object) -> int:
    if type(depth) is not int or depth < 0:
        raise TTRError(f"a depth is a whole number, 0 or more, found {depth!r}")
    return depth


# --- models --------------------------------------------------------------------------


def models(
    theory: Theory | None = None, *, degrees: st.SearchStrategy[Any] | None = None
) -> st.SearchStrategy[Model]:
    """Models of a theory with random facts about few objects.

    `degrees` draws how probable they are, as numbers or intervals; else all are
    certain.
    """
    if degrees is None:
        degrees = st.just(1.0)
    if not isinstance(degrees, st.SearchStrategy):
        raise TTRError(
            f"degrees are drawn by a strategy, as in st.floats(0, 1), found {degrees!r}"
        )
    return _models(Words.of(theory), theory, degrees)


@st.composite
def _models(
    draw: st.DrawFn,
    words: Words,
    theory: Theory | None,
    degrees: st.SearchStrategy[Any],
) -> Model:
    M = Model(theory)
    for T in words.basics:
        for name in draw(st.lists(st.sampled_from(words.names), unique=True)):
            M = _with_fact(M, name, T, draw(degrees))
    facts = st.tuples(st.sampled_from(words.names), arbitrary.ptypes(words, (), 0))
    for sit, ptype in draw(st.lists(facts, max_size=8)):
        M = _with_fact(M, sit, ptype, draw(degrees))
    return M


def _with_fact(M: Model, sit: Object, T: TypeNode, degree: object) -> Model:
    """The model with the fact, or without it where an axiom speaks against it."""
    if not isinstance(T, Basic | PType):
        return M
    try:
        return M.given(sit, T, degree)
    except Refused:
        return M


# --- records -------------------------------------------------------------------------


def records(T: TypeNode, model: Model | None = None) -> st.SearchStrategy[Any]:
    """Records for a record type, or for a meet or join of record types.

    With a model they have the shape of T, over the model's objects and new ones; many
    are of T, others nearly so. Without one they are pairs (record, model) in which the
    record is of T; drawing raises `Refused` where no such record can be made up. Raises
    `IllFormed` for what is no record type.

    >>> from hypothesis import find
    >>> from ttr.constructors import rectype
    >>> from ttr.syntax import Ind, Pred, this
    >>> T = rectype(x=Ind, c=Pred("dog", Ind)(this.x))
    >>> r, M = find(records(T), lambda pair: True)
    >>> M.judge(r, T).holds
    True
    """
    if not _is_of_records(as_type(T)):
        raise IllFormed(f"records are drawn for a record type, found {kind_of(T)}")
    if model is None:
        return _witnesses(T)
    if not isinstance(model, Model):
        raise TTRError(f"records are drawn over a model, found {kind_of(model)}")
    return _shaped(T, model)


def _is_of_records(T: TypeNode) -> bool:
    """Whether by its form only records are of it."""
    match T:
        case RecordType():
            return True
        case Singleton(base, _):
            return _is_of_records(base)
        case Meet(parts):
            return any(map(_is_of_records, parts))
        case Join(parts):
            return all(map(_is_of_records, parts))
    return False


@st.composite
def _witnesses(draw: st.DrawFn, T: TypeNode) -> tuple[Object, Model]:
    """A record of the shape of T that a model is told is of T; else one made up."""
    M = draw(_models(Words.of(Theory.of(T)), None, st.just(1.0)))
    told = _told(M, draw(_shaped(T, M)), T)
    if told is not None and draw(st.booleans()):
        return told
    for model in (M, Model()):
        with suppress(Refused):
            return model.create(T)
    return told or Model().create(T)


def _told(M: Model, r: Object, T: TypeNode) -> tuple[Object, Model] | None:
    """The record with the model in which it is of T, if it can be."""
    try:
        M = M.given(r, T)
        return (r, M) if M.judge(r, T).holds else None
    except TTRError:
        return None


def _shaped(T: TypeNode, M: Model) -> st.SearchStrategy[Object]:
    """Objects of the shape of T, over the names that the model knows and new ones."""
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
                fields[label] = draw(_shapes_in(fields, field, M, names))
            return Record(fields)
        case Meet(parts) if _is_of_records(T):
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
            return draw(arbitrary.forms(Words.of(Theory.of(T)), (), 1, T))
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
"""What makes an object of a type of collections."""


def _shapes_in(
    fields: Mapping[str, Object], T: TypeNode, M: Model, names: tuple[str, ...]
) -> st.SearchStrategy[Object]:
    """Objects of the shape of a field, in a record that has these fields already."""
    try:
        return _shapes(grounded(T, (fields,)), M, names)
    except Unresolved:
        return st.sampled_from(names)
