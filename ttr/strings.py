"""Dividing a string of events into pieces of the types that a type of strings names."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, Generic, Protocol, TypeVar

from ttr.syntax import Join, Meet, Plus, Singleton, Str, TypeNode

__all__ = ["Division", "Judge", "Piece", "covers", "divided", "is_of_strings"]

Ground = TypeVar("Ground")
Ground_co = TypeVar("Ground_co", covariant=True)

WAYS = 64
"""How many ways to divide a string are told apart."""


def is_of_strings(T: TypeNode) -> bool:
    """Whether T by its form is a type of strings, rather than of events."""
    match T:
        case Str() | Plus():
            return True
        case Join(parts) | Meet(parts):
            return any(map(is_of_strings, parts))
        case Singleton(base, _):
            return is_of_strings(base)
    return False


@dataclass(frozen=True)
class Piece(Generic[Ground]):
    """Events start to end of a string, and the grounds on which they are of a type."""

    start: int
    end: int
    grounds: tuple[Ground, ...]


Form = tuple[TypeNode, ...] | TypeNode
"""Types of one event after the other, or a type of strings judged as a whole."""

Way = tuple[Piece[Ground], ...]
"""A string divided into pieces, one after the other."""


@dataclass(frozen=True)
class Division(Generic[Ground]):
    """The ways to divide a string, at most `WAYS`, and whether those are all.

    `furthest` is how many events could be divided where there is no way at all.
    """

    ways: tuple[Way[Ground], ...]
    all: bool
    furthest: int


class Judge(Protocol[Ground_co]):
    """On what grounds parts of a string are of types."""

    def event(self, number: int, T: TypeNode) -> Ground_co:
        """The ground on which an event of the string is of a type of events."""

    def string(self, start: int, end: int, T: TypeNode) -> Ground_co:
        """The ground on which events start to end are of a type of strings."""


def divided(
    length: int,
    item: TypeNode,
    judge: Judge[Ground],
    possible: Callable[[Ground], bool],
) -> Division[Ground]:
    """The ways to divide a string into pieces of a type, each a string or an event.

    The time taken grows with the length of the string, unless the type repeats a meet
    of strings that are repeated themselves.
    """
    pieces = _Pieces(length, judge, possible)
    reached: dict[int, list[Piece[Ground]]] = {}
    waiting, seen, furthest = [0], {0}, 0
    while waiting:
        start = waiting.pop()
        for piece in pieces.of(item, start):
            furthest = max(furthest, piece.end)
            reached.setdefault(piece.end, []).append(piece)
            if piece.end not in seen:
                seen.add(piece.end)
                waiting.append(piece.end)
    ways = _ways(length, reached)
    found = tuple(way for _, way in zip(range(WAYS + 1), ways, strict=False))
    return Division(found[:WAYS], len(found) <= WAYS, furthest)


def _ways(
    length: int, reached: dict[int, list[Piece[Ground]]]
) -> Iterator[Way[Ground]]:
    """The ways from the start to the end, found backwards; without recursion."""
    if length == 0:
        return
    # A way so far is a linked list, so that ways share what they have in common.
    waiting: list[tuple[int, Any]] = [(length, None)]
    while waiting:
        at, rest = waiting.pop()
        if at == 0:
            yield _unlinked(rest)
            continue
        waiting += ((piece.start, (piece, rest)) for piece in reached.get(at, ()))


def _unlinked(way: Any) -> tuple[Piece[Any], ...]:
    found = []
    while way is not None:
        piece, way = way
        found.append(piece)
    return tuple(found)


def _forms(T: TypeNode) -> tuple[Form, ...]:
    """The forms that a piece of T may have."""
    match T:
        case Join(parts) if is_of_strings(T):
            return tuple(form for part in parts for form in _forms(part))
        case Plus(item):
            # One or more of one or more: the pieces can as well be smaller.
            return _forms(item)
        case Str(items):
            return (items,)
        case _ if is_of_strings(T):
            return (T,)
    return ((T,),)


class _Pieces(Generic[Ground]):
    """The pieces of a type that begin at an event."""

    def __init__(
        self, length: int, judge: Judge[Ground], possible: Callable[[Ground], bool]
    ) -> None:
        self._length, self._judge, self._possible = length, judge, possible
        self._forms: dict[TypeNode, tuple[Form, ...]] = {}

    def of(self, T: TypeNode, start: int) -> Iterator[Piece[Ground]]:
        """Pieces of T, none of them empty."""
        if T not in self._forms:
            self._forms[T] = _forms(T)
        for form in self._forms[T]:
            if isinstance(form, tuple):
                yield from self._events(form, start)
            else:
                yield from self._strings(form, start)

    def _strings(self, T: TypeNode, start: int) -> Iterator[Piece[Ground]]:
        """Pieces of a meet or singleton: what is of its form and of all of it."""
        for end in sorted(self._ends(T, start)):
            ground = self._judge.string(start, end, T)
            if self._possible(ground):
                yield Piece(start, end, (ground,))

    def _ends(self, T: TypeNode, start: int) -> set[int]:
        """Where the strings of a type that begin at an event may end."""
        match T:
            case Meet(parts):
                return self._ends(next(filter(is_of_strings, parts)), start)
            case Singleton(base, _):
                return self._ends(base, start)
            case Join(parts):
                strings = filter(is_of_strings, parts)
                return set().union(*[self._ends(part, start) for part in strings])
            case Plus(item):
                return self._repeated_ends(item, start)
        return {piece.end for piece in self.of(T, start)}

    def _repeated_ends(self, item: TypeNode, start: int) -> set[int]:
        found: set[int] = set()
        waiting = [start]
        while waiting:
            new = {piece.end for piece in self.of(item, waiting.pop())} - found
            found |= new
            waiting += new
        return found

    def _events(
        self, items: tuple[TypeNode, ...], start: int
    ) -> Iterator[Piece[Ground]]:
        if not items or start + len(items) > self._length:
            return
        grounds = []
        for number, item in enumerate(items, start):
            ground = self._judge.event(number, item)
            if not self._possible(ground):
                return
            grounds.append(ground)
        yield Piece(start, start + len(items), tuple(grounds))


def covers(T: TypeNode, length: int, asked: Callable[[int, TypeNode], bool]) -> bool:
    """Whether a string of so many events surely is of a type of strings.

    `asked` says whether an event, by its number, surely is of a type of events.

    >>> from ttr.syntax import Ind
    >>> covers(Plus(Str(Ind, Ind)), 4, lambda number, T: True)
    True
    >>> covers(Plus(Str(Ind, Ind)), 3, lambda number, T: True)
    False
    """

    def ends(start: int, U: TypeNode) -> set[int]:
        match U:
            case Join(parts):
                return set().union(*[ends(start, part) for part in parts])
            case Str(items):
                stop = start + len(items)
                fits = stop <= length and all(
                    asked(start + i, item) for i, item in enumerate(items)
                )
                return {stop} if fits else set()
            case Plus(item):
                return repeated(start, item)
        if is_of_strings(U):
            return set()
        return {start + 1} if start < length and asked(start, U) else set()

    def repeated(start: int, U: TypeNode) -> set[int]:
        found: set[int] = set()
        waiting = [start]
        while waiting:
            new = ends(waiting.pop(), U) - found
            found |= new
            waiting += new
        return found

    return length in ends(0, T)
