"""Running an automaton over a string of events: the ways to divide it into pieces.

The types of events are asked of functions, so this knows nothing of models. One way is
found in one pass, which asks for each event and type once at most.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from itertools import islice
from typing import Any, NamedTuple, TypeAlias

from ttr.computing.strings.automata import automaton_above
from ttr.computing.strings.automaton_steps import Automaton, Edge, Edges
from ttr.errors import UnsupportedError
from ttr.types.syntax import TypeNode, join

WAYS = 64
"""How many ways to divide a string are listed."""

FOLLOWED = 4096
"""How many beginnings of strings are followed to find the shortest ones."""

_Fits: TypeAlias = Callable[[int, TypeNode], bool]
"""Is the event with this number of a type of events?"""

_FitsWhole: TypeAlias = Callable[[int, int, TypeNode], bool]
"""Are the events from start to end, as one string, of a type?"""


@dataclass(frozen=True)
class Stop:
    """Where a string fails: after how many events, and which types could have come.

    `may_end`: could the string have ended there?
    """

    furthest: int
    expected: tuple[TypeNode, ...]
    may_end: bool


class Piece(NamedTuple):
    """A piece of a string: events start to end, of a type.

    If it is not `whole`, it is one event of that type.
    """

    start: int
    end: int
    label: TypeNode
    whole: bool


@dataclass(frozen=True)
class Division:
    """Ways to divide a string, at most `WAYS`; `all` says if there are no others."""

    ways: tuple[tuple[Piece, ...], ...]
    all: bool


# --- one way -------------------------------------------------------------------------


@dataclass(frozen=True)
class _Step:
    """A step between sets of states; `back` has the edge by which each is reached."""

    states: tuple[int, ...]
    back: dict[int, tuple[int, TypeNode]]


class _States:
    """The steps from sets of states, each computed once."""

    def __init__(self, automaton: Automaton) -> None:
        self._edges = automaton.edges
        self._steps: dict[tuple[tuple[int, ...], tuple[bool, ...]], _Step] = {}
        self._labels: dict[tuple[int, ...], tuple[TypeNode, ...]] = {}

    def labels(self, states: tuple[int, ...]) -> tuple[TypeNode, ...]:
        """The types of events that may come next in some of the states."""
        found = self._labels.get(states)
        if found is None:
            edges = (edge for state in states for edge in self._edges[state])
            found = tuple(dict.fromkeys(edge.label for edge in edges))
            self._labels[states] = found
        return found

    def step(self, states: tuple[int, ...], fits: tuple[bool, ...]) -> _Step:
        """The step with an event; `fits` says for each label if it fits."""
        found = self._steps.get((states, fits))
        if found is None:
            so = dict(zip(self.labels(states), fits, strict=True))
            back: dict[int, tuple[int, TypeNode]] = {}
            for state in states:
                for label, target in self._edges[state]:
                    if so[label]:
                        back.setdefault(target, (state, label))
            found = self._steps[states, fits] = _Step(tuple(back), back)
        return found


def find_division(
    length: int, automaton: Automaton, fits: _Fits
) -> tuple[TypeNode, ...] | Stop:
    """The types of the events of a string, one by one, or where it fails.

    The automaton must have no wholes. The time is linear in the length.

    >>> from ttr import Basic, Plus, Str
    >>> from ttr.computing.strings.automata import automaton
    >>> A, B = Basic("A"), Basic("B")
    >>> ends_in_B = automaton(Str(Plus(A), B))
    >>> print(*find_division(3, ends_in_B, lambda number, T: T is (A, A, B)[number]))
    A A B
    >>> find_division(3, ends_in_B, lambda number, T: T is A).furthest
    3
    """
    states = _States(automaton)
    here: tuple[int, ...] = (automaton.start,)
    steps: list[_Step] = []
    for number in range(length):
        labels = states.labels(here)
        step = states.step(here, tuple([fits(number, label) for label in labels]))
        if not step.states:
            return _stop_at(number, here, automaton)
        steps.append(step)
        here = step.states
    ending = [state for state in here if state in automaton.final]
    if not ending:
        return _stop_at(length, here, automaton)
    state, way = ending[0], []
    for step in reversed(steps):
        state, label = step.back[state]
        way.append(label)
    return tuple(reversed(way))


def _stop_at(number: int, states: tuple[int, ...], automaton: Automaton) -> Stop:
    labels = [label for state in states for label in automaton.labels(state)]
    may_end = any(state in automaton.final for state in states)
    return Stop(number, tuple(dict.fromkeys(labels)), may_end)


# --- all ways ------------------------------------------------------------------------


def find_divisions(
    length: int, automaton: Automaton, fits: _Fits, fits_whole: _FitsWhole
) -> Division | Stop:
    """The ways to divide a string into pieces of types, or where it fails."""
    came = _Arrivals(length, automaton, fits, fits_whole).all()
    ending = [state for state in came[length] if state in automaton.final]
    if not ending:
        furthest = max(number for number, states in enumerate(came) if states)
        return _stop_at(furthest, tuple(came[furthest]), automaton)
    found = _walk_back(came, automaton.start, frozenset(ending))
    ways = tuple(map(tuple, islice(found, WAYS + 1)))
    return Division(ways[:WAYS], len(ways) <= WAYS)


class _Arrival(NamedTuple):
    """How a state is reached: from where, after how many events, by which label."""

    start: int
    source: int
    label: TypeNode
    whole: bool = False


_ArrivalTable: TypeAlias = list[dict[int, list[_Arrival]]]
"""How each state is reached after so many events."""


class _Arrivals:
    """Finds how states are reached, forwards."""

    def __init__(
        self, length: int, automaton: Automaton, fits: _Fits, fits_whole: _FitsWhole
    ) -> None:
        self._length, self._automaton = length, automaton
        self._fits, self._fits_whole = fits, fits_whole
        self._came: _ArrivalTable = [{} for _ in range(length + 1)]
        self._came[0][automaton.start] = []

    def all(self) -> _ArrivalTable:
        """How each state is reached after each number of events."""
        edges = _join_parallel_edges(self._automaton.edges)
        has_wholes = any(self._automaton.wholes.values())
        for number, states in enumerate(self._came):
            if has_wholes:
                self._take_wholes(number)
            for state in states if number < self._length else ():
                self._take_events(number, state, edges[state])
        return self._came

    def _take_events(self, number: int, state: int, edges: tuple[Edge, ...]) -> None:
        for label, target in edges:
            if self._fits(number, label):
                arrival = _Arrival(number, state, label)
                self._came[number + 1].setdefault(target, []).append(arrival)

    def _take_wholes(self, number: int) -> None:
        """Note where strings that begin here may end, if they are taken as a whole."""
        waiting = list(self._came[number])
        for state in waiting:  # grows on the way
            for label, target in self._automaton.wholes[state]:
                ends = self._ends(label, number)
                if number in ends and target not in self._came[number]:
                    waiting.append(target)
                for end in ends:
                    arrival = _Arrival(number, state, label, True)
                    self._came[end].setdefault(target, []).append(arrival)

    def _ends(self, T: TypeNode, start: int) -> list[int]:
        """The ends of the strings of a type that begin after so many events."""
        possible: Iterable[int] = range(start, self._length + 1)
        with suppress(UnsupportedError):
            possible = self._ends_of_runs(automaton_above(T), start)
        return [end for end in possible if self._fits_whole(start, end, T)]

    def _ends_of_runs(self, above: Automaton, start: int) -> Iterator[int]:
        """The ends of the strings of an automaton that begin after so many events."""
        states = {above.start}
        for number in range(start, self._length + 1):
            if not states.isdisjoint(above.final):
                yield number
            if number < self._length:
                edges = [
                    edge for state in sorted(states) for edge in above.edges[state]
                ]
                states = {to for label, to in edges if self._fits(number, label)}


def _join_parallel_edges(edges: Edges) -> Edges:
    """The edges, with those between the same states joined into one."""
    found: dict[int, tuple[Edge, ...]] = {}
    for state, several in edges.items():
        labels: dict[int, list[TypeNode]] = {}
        for label, target in several:
            labels.setdefault(target, []).append(label)
        found[state] = tuple([Edge(join(*of), to) for to, of in labels.items()])
    return found


def _walk_back(
    came: _ArrivalTable, start: int, ending: frozenset[int]
) -> Iterator[list[Piece]]:
    """The ways from the start to the end, found backwards; without recursion."""
    # A way so far is a linked list, so that ways share what they have in common. What
    # was passed without an event is not passed again.
    waiting: list[_Way] = [(len(came) - 1, ending, frozenset(), None)]
    while waiting:
        end, states, passed, rest = waiting.pop()
        if end == 0 and start in states:
            yield _unlink(rest)
        before: dict[Piece, list[int]] = {}
        for state in sorted(states - passed):
            for begin, source, label, whole in came[end][state]:
                piece = Piece(begin, end, label, whole)
                before.setdefault(piece, []).append(source)
        for piece, sources in before.items():
            still = passed | states if piece.start == end else frozenset()
            waiting.append((piece.start, frozenset(sources), still, (piece, rest)))


_Way: TypeAlias = tuple[int, frozenset[int], frozenset[int], Any]
"""The events so far, the states, those passed without an event, and the rest."""


def _unlink(way: Any) -> list[Any]:
    found = []
    while way is not None:
        piece, way = way
        found.append(piece)
    return found


# --- whether there is a way ----------------------------------------------------------


def accepts(length: int, automaton: Automaton, fits: _Fits) -> bool:
    """Does the automaton accept so many events? `fits` says what they are of.

    >>> from ttr import Ind, Plus, Str
    >>> from ttr.computing.strings.automata import automaton
    >>> pairs = automaton(Plus(Str(Ind, Ind)))
    >>> accepts(4, pairs, lambda number, T: True)
    True
    >>> accepts(3, pairs, lambda number, T: True)
    False
    """
    states = {automaton.start}
    for number in range(length):
        edges = [edge for state in sorted(states) for edge in automaton.edges[state]]
        asked = {label: fits(number, label) for label, _ in dict.fromkeys(edges)}
        states = {target for label, target in edges if asked[label]}
    return not states.isdisjoint(automaton.final)


# --- strings of a type ---------------------------------------------------------------


def shortest_words(
    automaton: Automaton, length: int = 0
) -> Iterator[tuple[TypeNode, ...]]:
    """The event types of the strings of a type, shortest first.

    Strings of at least `length` events come first, if there are any.

    >>> from ttr import Basic, Plus, Str
    >>> from ttr.computing.strings.automata import automaton
    >>> A, B = Basic("A"), Basic("B")
    >>> for labels in islice(shortest_words(automaton(Str(Plus(A), B)), 3), 2):
    ...     print(*labels)
    A A B
    A A A B
    """
    waiting: deque[tuple[int, int, Any]] = deque([(automaton.start, 0, None)])
    shorter: list[tuple[TypeNode, ...]] = []
    followed = 0
    while waiting and followed < FOLLOWED:
        followed += 1
        state, size, way = waiting.popleft()
        if state in automaton.final:
            labels = tuple(reversed(_unlink(way)))
            if size >= length:
                yield labels
            else:
                shorter.append(labels)
        for label, target in automaton.edges[state]:
            waiting.append((target, size + 1, (label, way)))
    yield from reversed(shorter)
