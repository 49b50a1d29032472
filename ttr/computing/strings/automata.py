"""Automata of types of strings, built from partial derivatives.

A state is a type of strings, those that may still come; an edge is labelled with the
type of an event and leads to what may come after it. There are no more states than
events in the type, except for meets, whose states are combined. Building them takes no
recursion over the length.

Source: Antimirov 1996 for partial derivatives; Fernando 2007 for strings of events.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import NamedTuple, TypeAlias

from ttr.computing.strings.automaton_steps import (
    Automaton,
    Edge,
    intersect,
    too_many_states,
    trim,
)
from ttr.computing.strings.pieces import (
    alternatives,
    is_of_strings,
    is_regular,
    regular_above,
)
from ttr.errors import UnsupportedError
from ttr.safety.budgets import spend
from ttr.types.derived_types import star
from ttr.types.syntax import Join, Meet, Negation, Plus, Str, TypeNode


def automaton(T: TypeNode) -> Automaton:
    """The automaton of a type of strings.

    A meet in it that has too many states is taken as a whole.

    >>> from ttr import Basic
    >>> A, B = Basic("A"), Basic("B")
    >>> one = automaton(Str(Plus(A), B))
    >>> (first,) = one.edges[one.start]
    >>> print(first.label, "then", one.rest_of(first.target))
    A then str(plus(A) \\/ str(), B)
    """
    return _Builder(_identity).of(T)


def automaton_above(T: TypeNode) -> Automaton:
    """An automaton without wholes, of all strings of a type and perhaps more.

    Raises `UnsupportedError` if a meet in the type has too many states.
    """
    found = _Builder(regular_above).of(T)
    if any(found.wholes.values()):
        raise too_many_states(T)
    return found


def _identity(T: TypeNode) -> TypeNode:
    return T


class _Repeated(NamedTuple):
    """A head of a state: any number of pieces of a type."""

    item: TypeNode


class _Inside(NamedTuple):
    """A head of a state: what remains in a state of another automaton."""

    automaton: Automaton
    state: int


_Head: TypeAlias = TypeNode | _Repeated | _Inside
_Left: TypeAlias = tuple[_Head, int]
"""The head of a state, what comes next; and the number of the state after that."""

_END = 0
"""The state in which nothing more comes."""


class _Builder:
    """Numbers the states of a type, and finds their steps.

    `regular` replaces a type of strings that is not regular; if the replacement is not
    regular either, a string is taken as a whole.
    """

    def __init__(self, regular: Callable[[TypeNode], TypeNode]) -> None:
        self._regular = regular
        self._numbers: dict[_Left, int] = {}
        self._left: list[_Left | None] = [None]
        self._intersections: dict[TypeNode, Automaton | None] = {}

    def of(self, T: TypeNode) -> Automaton:
        """The automaton of T, without states that lead nowhere."""
        start = self._state(T, _END)
        edges: dict[int, tuple[Edge, ...]] = {}
        wholes: dict[int, tuple[Edge, ...]] = {}
        final: set[int] = set()
        waiting = [start]
        while waiting:
            state = waiting.pop()
            if state in edges:
                continue
            edges[state], wholes[state] = self._steps_from(state, final)
            waiting += [edge.target for edge in (*edges[state], *wholes[state])]
        return trim(Automaton(start, edges, wholes, frozenset(final), self._rest_of))

    def _state(self, head: _Head, then: int) -> int:
        left = (head, then)
        number = self._numbers.setdefault(left, len(self._left))
        if number == len(self._left):
            self._left.append(left)
        return number

    def _steps_from(
        self, start: int, final: set[int]
    ) -> tuple[tuple[Edge, ...], tuple[Edge, ...]]:
        """The steps from a state, also through empty pieces; notes if it is final."""
        edges: dict[Edge, None] = {}
        wholes: dict[Edge, None] = {}
        waiting, seen = [start], {start}
        while waiting:
            left = self._left[waiting.pop()]
            if left is None:
                final.add(start)
                continue
            found = [
                number
                for number in self._expand(left, edges, wholes)
                if number not in seen
            ]
            seen.update(found)
            waiting += reversed(found)
        return tuple(edges), tuple(wholes)

    def _expand(
        self, left: _Left, edges: dict[Edge, None], wholes: dict[Edge, None]
    ) -> Iterator[int]:
        """The states reached without an event; notes the steps with one."""
        spend()
        head, then = left
        match head:
            case _Repeated(item):
                yield self._state(item, self._numbers[left])
                yield then
            case _Inside(inner, state):
                for label, target in inner.edges[state]:
                    edges[Edge(label, self._state(_Inside(inner, target), then))] = None
                if state in inner.final:
                    yield then
            case Str(items):
                for item in reversed(items):
                    then = self._state(item, then)
                yield then
            case Plus(item):
                yield self._state(item, self._state(_Repeated(item), then))
            case _ if not is_of_strings(head):
                edges[Edge(head, then)] = None
            case _:
                yield from self._expand_alternatives(head, then, wholes)

    def _expand_alternatives(
        self, T: TypeNode, then: int, wholes: dict[Edge, None]
    ) -> Iterator[int]:
        """Expands a join, a meet or a singleton of strings."""
        parts = alternatives(T)
        if parts != (T,):
            yield from [self._state(part, then) for part in parts]
            return
        T = self._regular(T)
        if isinstance(T, Str | Plus | Join):
            yield self._state(T, then)
            return
        inner = self._intersection(T)
        if inner is None:
            wholes[Edge(T, then)] = None
        else:
            yield self._state(_Inside(inner, inner.start), then)

    def _intersection(self, T: TypeNode) -> Automaton | None:
        """The automaton of a meet; None if it has to be taken as a whole."""
        if T not in self._intersections:
            self._intersections[T] = None
            with suppress(UnsupportedError):
                self._intersections[T] = _product(T, self)
        return self._intersections[T]

    def part(self, T: TypeNode) -> Automaton | None:
        """The automaton of a part of a meet; None if it has wholes."""
        found = _Builder(self._regular).of(T)
        return None if any(found.wholes.values()) else found

    def _rest_of(self, state: int) -> TypeNode:
        """The type of the strings that lead from a state to the end."""
        spend()
        pieces = []
        left = self._left[state]
        while left is not None:
            head, state = left
            match head:
                case _Repeated(item):
                    pieces.append(star(item))
                case _Inside(inner, inside):
                    pieces.append(inner.rest_of(inside))
                case _:
                    pieces.append(head)
            left = self._left[state]
        one_string = len(pieces) == 1 and is_of_strings(pieces[0])
        return pieces[0] if one_string else Str(*pieces)


def _product(T: TypeNode, building: _Builder) -> Automaton | None:
    """The automaton of a meet of regular types, if each part has one."""
    if not isinstance(T, Meet) or not is_regular(T):
        return None
    plain = [building.part(p) for p in T.parts if not isinstance(p, Negation)]
    denied = [automaton(p.body) for p in T.parts if isinstance(p, Negation)]
    asked = [one for one in plain if one is not None]
    if None in plain or any(any(one.wholes.values()) for one in denied):
        return None
    return intersect(asked, denied)
