"""Strategies for information states, and for the events that are played to them."""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from math import prod
from typing import Self

from hypothesis import strategies as st

from ttr.building.constructors import rectype
from ttr.computing.subtyping import subtype
from ttr.errors import IllFormedError, TTRError
from ttr.judging.models import Model, as_model
from ttr.testing.strategies.random_records import objects_of_shape, records, with_fact
from ttr.types.interning import identity
from ttr.types.objects import Object, Record
from ttr.types.paths import free_paths
from ttr.types.syntax import (
    Basic,
    Join,
    PType,
    RecordType,
    Singleton,
    TypeNode,
    as_type,
    kind_of,
)
from ttr.updates.games import Game
from ttr.updates.update_strategies import event_types

KNOWN = 6
"""How many of the known objects a field of an event may be set to."""

TRIED = 100
"""How many ways to set the fields of an event are tried at most."""


def states(
    T: RecordType, model: Model | None = None
) -> st.SearchStrategy[tuple[Record, Model]]:
    """Pairs (state, model) in which the state certainly is of the record type.

    States have objects of the model and new ones, about which the model of the pair
    knows more. Raises `IllFormedError` for what is no record type; drawing raises
    `RefusedError` if no state can be created.

    >>> from hypothesis import find
    >>> from ttr import Ind, ListOf
    >>> Board = rectype(speaker=Ind, agenda=ListOf(Ind))
    >>> state, M = find(states(Board), lambda pair: len(pair[0].agenda) == 2)
    >>> M.judge(state, Board).holds
    True
    """
    if not isinstance(T, RecordType):
        raise IllFormedError(f"states are drawn for a record type, found {kind_of(T)}")
    return records(T) if model is None else _states_over_model(T, as_model(model))


@st.composite
def _states_over_model(
    draw: st.DrawFn, T: RecordType, M: Model
) -> tuple[Object, Model]:
    """A state with what the model knows; one that is created if that is of no use."""
    state = with_fact(M, draw(objects_of_shape(T, M)), T)
    return state if state is not None else M.create(T)


# --- events --------------------------------------------------------------------------


def events(
    source: Game | Iterable[TypeNode], model: Model | None = None
) -> st.SearchStrategy[Object]:
    """Events of the types that a game hears, or of these types; a game can take each.

    Most are drawn as *types* of events with some fields set to objects that the model
    knows, such as `[x = fido : Ind, c : bark(x)]`: the game creates an event of the
    type. For a type that is no record type, known objects are drawn as well. Raises
    `TTRError` if there is no type to draw events of.

    >>> from hypothesis import find
    >>> from ttr import Ind, Pred, this
    >>> M = Model().given("fido", Ind)
    >>> Barking = rectype(x=Ind, c=Pred("bark", Ind)(this.x))
    >>> print(find(events([Barking], M), lambda event: event is not Barking))
    [x = fido : Ind, c : bark(x)]
    """
    if isinstance(source, Game):
        kinds, model = heard_by(source), model or source.model
    else:
        kinds = tuple(map(as_type, source))
    if not kinds:
        raise TTRError("events are drawn of a type at least, and there is none")
    model = Model() if model is None else as_model(model)
    return st.one_of([event_of(T, model) for T in kinds])


@lru_cache(maxsize=64)
def heard_by(game: Game) -> tuple[TypeNode, ...]:
    """The types of the events that a game hears: by default, all that its rules take.

    A rule that takes S ∨ T takes events of S and events of T. More specific types that
    the game's theory defines are among them, such as asking whether it rains if a rule
    takes any asking.
    """
    taken = tuple(T for on in event_types(game.rules) for T in _alternatives(on))
    defined = game.theory.definitions.values() if game.theory else ()
    special = (
        T
        for T in defined
        if isinstance(T, RecordType) and any(_is_below(T, on, game) for on in taken)
    )
    heard = tuple(T for on in game.hears for T in _alternatives(on))
    return heard or tuple(dict.fromkeys((*taken, *special)))


def _alternatives(T: TypeNode) -> tuple[TypeNode, ...]:
    """The parts of a join; of any other type, the type alone."""
    return T.parts if isinstance(T, Join) else (T,)


def _is_below(T: RecordType, on: TypeNode, game: Game) -> bool:
    """Is T a subtype of another record type?"""
    return isinstance(on, RecordType) and subtype(T, on, game.theory).yes


def event_of(
    T: TypeNode, M: Model, about: Record | None = None
) -> st.SearchStrategy[Object]:
    """Events of one type: the type itself, or with fields set to known objects.

    With `about`, these are objects that occur in that state, if any is of a right type.
    """
    ways = _Ways.of(T, M, about)
    if ways.number == 1:
        return st.just(T)
    return st.integers(0, ways.number - 1).map(ways)


def variants(T: TypeNode, M: Model, about: Record) -> Iterator[Object]:
    """Events of one type that are about a state, the type itself first."""
    ways = _Ways.of(T, M, about)
    return map(ways, range(min(ways.number, TRIED)))


@dataclass(frozen=True)
class _Ways:
    """The ways to set fields of a type, by number; way 0 sets none."""

    T: TypeNode
    open_fields: Mapping[tuple[str, ...], tuple[Object, ...]]

    @classmethod
    def of(cls, T: TypeNode, M: Model, about: Record | None) -> Self:
        if not isinstance(T, RecordType):
            return cls(T, {(): _known_objects(T, M)})
        if about is not None:
            among = set(map(identity, _names_in(about)))
            settable = dict(_settable(T, M, (), among))
            if settable:
                return cls(T, settable)
        return cls(T, dict(_settable(T, M, (), None)))

    @cached_property
    def number(self) -> int:
        """How many ways there are."""
        return prod(1 + len(values) for values in self.open_fields.values())

    def __call__(self, way: int) -> Object:
        """The type with its fields set in this way, or a known object of it."""
        if not isinstance(self.T, RecordType):
            return (self.T, *self.open_fields[()])[way]
        return _type_in_way(self.T, self.open_fields, way)


def _names_in(value: Object) -> Iterator[Object]:
    """The names that occur in the records and lists of a state."""
    match value:
        case str():
            yield value
        case Record():
            for inner in value._fields.values():
                yield from _names_in(inner)
        case tuple():
            for inner in value:
                yield from _names_in(inner)


def _settable(
    T: RecordType, M: Model, path: tuple[str, ...], among: Container[object] | None
) -> Iterator[tuple[tuple[str, ...], tuple[Object, ...]]]:
    """The paths of fields that depend on nothing, with known objects of their types."""
    for label, field in T.fields:
        if isinstance(field, RecordType):
            yield from _settable(field, M, (*path, label), among)
        elif values := _known_objects(field, M, among):
            yield (*path, label), values


def _known_objects(
    T: TypeNode, M: Model, among: Container[object] | None = None
) -> tuple[Object, ...]:
    """Objects that the model knows of a type; of many, the first and the last ones."""
    if not isinstance(T, Basic | PType) or free_paths(T):
        return ()
    found = M.witnesses(T)
    if among is not None:
        found = tuple(one for one in found if identity(one) in among)
    return (
        found if len(found) <= KNOWN else (*found[: KNOWN // 2], *found[-KNOWN // 2 :])
    )


def _type_in_way(
    T: RecordType, fields: Mapping[tuple[str, ...], tuple[Object, ...]], way: int
) -> RecordType:
    """The type with the fields set in one of the possible ways."""
    for path, values in fields.items():
        way, choice = divmod(way, 1 + len(values))
        if choice:
            T = _with_value(T, path, values[choice - 1])
    return T


def _with_value(T: RecordType, path: tuple[str, ...], value: Object) -> RecordType:
    label, *rest = path
    field = T[label]
    if rest and isinstance(field, RecordType):
        inner: TypeNode = _with_value(field, tuple(rest), value)
    else:
        inner = Singleton(field, value)
    return rectype({**dict(T.fields), label: inner})
