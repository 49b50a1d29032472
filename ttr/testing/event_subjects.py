"""What events are about, and whose they are, by their fields and their ptypes.

An event `{by = ann, t = rain, e = s1}` with s1 : ask(ann, rain) is Ann's, and about
rain. Nobody who acts in some event counts as what an event is about.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache

from ttr.judging.certainty import is_certain
from ttr.judging.models import Model
from ttr.testing.strategies.random_states import heard_by
from ttr.types.interning import identity
from ttr.types.objects import FiniteSet, Object, Path, Record
from ttr.types.paths import subterms
from ttr.types.printing import notation
from ttr.types.records import field_at, value_at
from ttr.types.syntax import (
    Basic,
    ListOf,
    NonEmpty,
    PType,
    RecordType,
    SetOf,
    Singleton,
    TypeNode,
)
from ttr.updates.games import Game
from ttr.updates.update_strategies import event_types

SPEAKERS = frozenset(
    ("spkr", "speaker", "by", "actor", "agent", "sender", "from", "said_by", "author")
)
"""Labels of an event under which stands whose event it is."""


def items_at(state: Record, path: str | None) -> tuple[Object, ...]:
    """The elements of the list or set at a path; anything else there is one item."""
    found = None if path is None else value_at(state, path)
    if isinstance(found, tuple):
        return found
    if isinstance(found, FiniteSet):
        return tuple(found.items)
    return () if found is None else (found,)


@lru_cache(maxsize=256)
def item_type(T: RecordType, path: str) -> TypeNode | None:
    """The type of the elements of the list or set at a path of a state."""
    found = field_at(T, path.split("."))
    if isinstance(found, Singleton):
        found = found.base
    return found.item if isinstance(found, ListOf | NonEmpty | SetOf) else None


def is_same(one: Object, other: Object) -> bool:
    """Are they the same object?"""
    return identity(one) == identity(other)


def items_not_in(some: Sequence[Object], others: Sequence[Object]) -> list[Object]:
    """The items of `some` that are not among the `others`.

    >>> items_not_in(["a", "b", "a"], ["b"])
    ['a', 'a']
    """
    if some is others:
        return []
    excluded = set(map(identity, others))
    return [one for one in some if identity(one) not in excluded]


def items_added(before: Sequence[Object], after: Sequence[Object]) -> list[Object]:
    """The items that occur more often than before, each as often as it was added.

    >>> items_added(["a"], ["a", "b", "a", "b"])
    ['b', 'a', 'b']
    """
    if before is after:
        return []
    had = Counter(map(identity, before))
    more: list[Object] = []
    for one in after:
        had[identity(one)] -= 1
        if had[identity(one)] < 0:
            more.append(one)
    return more


def format_objects(objects: Iterable[Object]) -> str:
    """The objects in the notation, with commas between them."""
    return ", ".join(map(notation, objects))


# --- who -----------------------------------------------------------------------------


@lru_cache(maxsize=64)
def agents_of(game: Game) -> frozenset[str]:
    """Who acts in some event of a game: by a label of speakers, or first in a ptype."""
    found: set[str] = set()
    for T in dict.fromkeys((*event_types(game.rules), *heard_by(game))):
        if isinstance(T, RecordType):
            found.update(_agents_in(T))
    return frozenset(found)


def _agents_in(T: RecordType) -> Iterator[str]:
    for label, field in T.fields:
        if isinstance(field, Singleton) and label in SPEAKERS:
            if isinstance(field.value, str):
                yield field.value
        elif isinstance(field, PType) and field.args:
            first = field.args[0]
            if isinstance(first, Path) and first.up == 0:
                named = T.get(first.labels[0])
                first = named.value if isinstance(named, Singleton) else None
            if isinstance(first, str):
                yield first


def speaker_of(event: Object, model: Model, agents: frozenset[str]) -> str | None:
    """Whose event it is; None if that is not clear."""
    if not isinstance(event, Record):
        return None
    named = {event[label] for label in SPEAKERS if label in event}
    if not named:
        made = (one.args[0] for one in _ptypes(event, model) if one.args)
        named = {one for one in made if isinstance(one, str) and one in agents}
    if len(named) != 1:
        return None
    (who,) = named
    return who if isinstance(who, str) else None


# --- what ----------------------------------------------------------------------------


def _ptypes(event: Record, model: Model) -> Iterator[PType]:
    """The ptypes that the proof objects of an event are known to be of."""
    for value in event._fields.values():
        if isinstance(value, str):
            for T in model.facts.types_of(value):
                if isinstance(T, PType):
                    yield T


def mentions(event: Object, model: Model) -> tuple[Object, ...]:
    """All that occurs in an event, and in the ptypes of its proof objects."""
    if not isinstance(event, Record):
        return tuple(_within((event,)))
    return tuple(_within((event, *_ptypes(event, model))))


def _within(values: Iterable[Object]) -> Iterator[Object]:
    for value in values:
        for part in subterms((value,)):
            if isinstance(part, str | TypeNode | Record):
                yield part


def mentions_of_sort(
    item: Object, T: TypeNode | None, event: Object, model: Model, game: Game
) -> tuple[Object, ...]:
    """What an event mentions that is of the same sort as an item, the basic type T.

    Those who act are of no sort here, as they may be mentioned anywhere. All record
    types are of one sort.
    """
    parts = mentions(event, model)
    if isinstance(item, str) and isinstance(T, Basic):
        agents = agents_of(game)
        if any(is_certain(model.facts, who, T) for who in agents):
            return ()
        named = (one for one in parts if isinstance(one, str))
        return tuple(
            dict.fromkeys(one for one in named if is_certain(model.facts, one, T))
        )
    if isinstance(item, RecordType):
        return tuple(part for part in parts if isinstance(part, RecordType))
    return ()
