"""What events are about, and who says them: read off their fields and their ptypes.

An event `{by = ann, t = rain, e = s1}` with s1 : ask(ann, rain) is Ann's, and about
rain. Who acts in some event is no subject of any.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import lru_cache

from ttr.judging.certainty import certainly
from ttr.judging.models import Model
from ttr.testing.strategies.discourse_roles import at
from ttr.testing.strategies.random_states import heard_by
from ttr.types.paths import occurring
from ttr.types.syntax import (
    Basic,
    FiniteSet,
    ListOf,
    NonEmpty,
    Object,
    Path,
    PType,
    Record,
    RecordType,
    SetOf,
    Singleton,
    TypeNode,
    identity,
)
from ttr.updates.games import Game

__all__ = [
    "agents_of",
    "field_at",
    "items_at",
    "item_type",
    "kin",
    "mentions",
    "names_in",
    "same",
    "speaker_of",
    "types_in",
]

SPEAKERS = frozenset(
    ("spkr", "speaker", "by", "actor", "agent", "sender", "from", "said_by", "author")
)
"""What the field of an event is called that says whose it is."""


def items_at(state: Record, path: str | None) -> tuple[Object, ...]:
    """What is in the list or set at a path; a type is what there is of itself."""
    found = None if path is None else at(state, path)
    if isinstance(found, tuple):
        return found
    if isinstance(found, FiniteSet):
        return tuple(found.items)
    return () if found is None else (found,)


def field_at(T: TypeNode, path: str) -> TypeNode | None:
    """The type of the field at a path of a record type, if it says what is there."""
    found: TypeNode | None = T
    for label in path.split("."):
        if not isinstance(found, RecordType) or label not in found:
            return None
        found = found[label]
    return found


@lru_cache(maxsize=256)
def item_type(T: RecordType, path: str) -> TypeNode | None:
    """The type of what is in the list or set at a path of a state."""
    found = field_at(T, path)
    if isinstance(found, Singleton):
        found = found.base
    return found.item if isinstance(found, ListOf | NonEmpty | SetOf) else None


def same(one: Object, other: Object) -> bool:
    """Whether two objects are the same one."""
    return identity(one) == identity(other)


# --- who -----------------------------------------------------------------------------


@lru_cache(maxsize=64)
def agents_of(game: Game) -> frozenset[str]:
    """Who acts in some event: named by a field for speakers, or first in a ptype."""
    taken = (rule.on for rule in game.rules if rule.on is not None)
    found: set[str] = set()
    for T in dict.fromkeys((*taken, *heard_by(game))):
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
                named = field_at(T, first.labels[0])
                first = named.value if isinstance(named, Singleton) else None
            if isinstance(first, str):
                yield first


def speaker_of(event: Object, model: Model, agents: frozenset[str]) -> str | None:
    """Whose event it is, if that is clear."""
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
    """What the proof objects of an event are known to be of."""
    for value in event._fields.values():
        if isinstance(value, str):
            for T in model.facts.types_of(value):
                if isinstance(T, PType):
                    yield T


def mentions(event: Object, model: Model) -> tuple[Object, ...]:
    """All that is in an event, and in what its proof objects are known to be of."""
    if not isinstance(event, Record):
        return tuple(_within((event,)))
    return tuple(_within((event, *_ptypes(event, model))))


def _within(values: Iterable[Object]) -> Iterator[Object]:
    for value in values:
        for part in occurring((value,)):
            if isinstance(part, str | TypeNode | Record):
                yield part


def names_in(value: Object) -> frozenset[str]:
    """The names of objects in a value."""
    return frozenset(part for part in _within((value,)) if isinstance(part, str))


def types_in(parts: Iterable[Object]) -> tuple[RecordType, ...]:
    """The record types among what an event mentions."""
    return tuple(part for part in parts if isinstance(part, RecordType))


def kin(
    item: Object, T: TypeNode | None, event: Object, model: Model, game: Game
) -> tuple[Object, ...]:
    """What an event mentions that is of the item's own sort; nothing if none is clear.

    A sort to which those belong who act is none: anybody may be mentioned anywhere.
    """
    parts = mentions(event, model)
    if isinstance(item, str) and isinstance(T, Basic):
        agents = agents_of(game)
        if any(certainly(model.facts, who, T) for who in agents):
            return ()
        named = (one for one in parts if isinstance(one, str))
        return tuple(
            dict.fromkeys(one for one in named if certainly(model.facts, one, T))
        )
    if isinstance(item, RecordType):
        return types_in(parts)
    return ()
