"""A noun phrase taken apart: what it says of its thing, and of what it stands beside.

The parts of a record type are independent judgements, so the degree of the whole is the
product of the degrees of its parts. Each part is judged once of each thing, and not
again for every combination of the others.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TypeVar

from ttr import Pred, RecordType
from ttr.types import Meet, PType, Singleton, TypeNode
from ttr.types.objects import Object, Path

_Some = TypeVar("_Some")

Claim = tuple[Pred, tuple[Object, ...]]
"""A predicate and the objects that it is said of."""

THING, LOOK, FRONT, OTHER = ("x",), ("look",), ("frame",), ("landmark", "x")
"""Where a phrase has its thing, the look, the perspective, and what it is beside."""

THIRD = ("landmark", "landmark", "x")
"""Where it has the second of two things that its thing is between."""


@dataclass(frozen=True)
class PhraseParts:
    """What a phrase says: of its thing, of the thing and its landmark, of the talk.

    `qualities` are those of the predicates that are adjectives.
    """

    thing: str | None
    claims: tuple[PType, ...]
    qualities: frozenset[Pred]
    relations: tuple[PType, ...]
    choices: tuple[Pred, ...]
    landmark: PhraseParts | None

    def said_of(self, x: str, look: str) -> Iterator[Claim]:
        """The claims about the thing alone, if it is x."""
        return _ground(self.claims, {THING: x, LOOK: look})

    def said_of_both(
        self, x: str, y: str, look: str, front: str, third: str = ""
    ) -> Iterator[Claim]:
        """The claims about the thing and its landmark, if they are x and y.

        `third` is the landmark of the landmark, where something is between the two.
        """
        places = {THING: x, OTHER: y, LOOK: look, FRONT: front, THIRD: third}
        return _ground(self.relations, places)


def put_together(*parts: PhraseParts) -> PhraseParts:
    """The parts of several phrases together: those of the merge of their types."""
    beside = [part.landmark for part in parts if part.landmark is not None]
    return PhraseParts(
        thing=next((it.thing for it in parts if it.thing is not None), None),
        claims=_all(part.claims for part in parts),
        qualities=frozenset().union(*(part.qualities for part in parts)),
        relations=_all(part.relations for part in parts),
        choices=_all(part.choices for part in parts),
        landmark=put_together(*beside) if beside else None,
    )


def _all(several: Iterable[tuple[_Some, ...]]) -> tuple[_Some, ...]:
    return tuple(dict.fromkeys(it for some in several for it in some))


@lru_cache(1024)
def take_apart(
    phrase: RecordType, choosing: frozenset[Pred] = frozenset()
) -> PhraseParts:
    """The parts of a phrase; predicates that choose among things are kept apart."""
    landmark = phrase.get("landmark")
    said = [T for _, field in phrase.fields for T in _ptypes(field)]
    plain = [T for T in said if T.pred not in choosing]
    x = phrase["x"]
    beside = (
        take_apart(landmark, choosing) if isinstance(landmark, RecordType) else None
    )
    if beside is not None and any(_mentions(T, THIRD) for T in plain):
        beside = _with_second(beside)
    return PhraseParts(
        thing=str(x.value) if isinstance(x, Singleton) else None,
        claims=tuple(T for T in plain if not _mentions(T, OTHER)),
        qualities=frozenset(T.pred for T in _ptypes(phrase.get("a"))),
        relations=tuple(T for T in plain if _mentions(T, OTHER)),
        choices=tuple(T.pred for T in said if T.pred in choosing),
        landmark=beside,
    )


def _with_second(flank: PhraseParts) -> PhraseParts:
    """One of two things that something is between, with the other as its landmark.

    The other is described in the same way if it is not described: "between the cups".
    """
    other = flank.landmark
    if other is None or other.claims or other.choices or other.landmark or other.thing:
        return flank
    return replace(flank, landmark=replace(flank, landmark=None))


def _ptypes(field: TypeNode | None) -> Iterator[PType]:
    """The ptypes that a field is the meet of."""
    if isinstance(field, PType):
        yield field
    elif isinstance(field, Meet):
        for part in field.parts:
            yield from _ptypes(part)


def _mentions(T: PType, place: tuple[str, ...]) -> bool:
    return any(isinstance(arg, Path) and arg.labels == place for arg in T.args)


def _ground(
    claims: tuple[PType, ...], places: Mapping[tuple[str, ...], Object]
) -> Iterator[Claim]:
    """The claims, with the objects at these places in place of their paths."""
    for T in claims:
        args = [places[a.labels] if isinstance(a, Path) else a for a in T.args]
        yield T.pred, tuple(args)
