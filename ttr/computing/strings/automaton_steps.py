"""Automata, and their intersection: the automata of meets of types."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from itertools import product
from typing import NamedTuple, TypeAlias

from ttr.errors import UnsupportedError
from ttr.types.syntax import TypeNode, join, meet

EDGES = 4096
"""How many edges the automaton of a meet may have."""

DENIED = 6
"""How many event types a denied type of strings may distinguish in a state."""


class Edge(NamedTuple):
    """A step of an automaton: the type it takes, and the state it leads to."""

    label: TypeNode
    target: int


Edges: TypeAlias = Mapping[int, tuple[Edge, ...]]


@dataclass(frozen=True, eq=False)
class Automaton:
    """The states of a type of strings, and the steps between them.

    `edges` take one event of a type; `wholes` take several events that as one string
    are of a type. In a `final` state the string may end, and one can be reached from
    every state. `rest_of` gives the type of the strings from a state to the end.
    """

    start: int
    edges: Edges
    wholes: Edges
    final: frozenset[int]
    rest_of: Callable[[int], TypeNode]

    @property
    def empty(self) -> bool:
        """Is no string of the type, by its form?"""
        return not (
            self.start in self.final
            or self.edges.get(self.start)
            or self.wholes.get(self.start)
        )

    def labels(self, state: int) -> tuple[TypeNode, ...]:
        """The types that may come next in a state, each once."""
        steps = (*self.edges.get(state, ()), *self.wholes.get(state, ()))
        return tuple(dict.fromkeys(edge.label for edge in steps))


def trim(found: Automaton) -> Automaton:
    """The automaton without steps that lead to no final state."""
    before: dict[int, list[int]] = {}
    for steps in (found.edges, found.wholes):
        for state, edges in steps.items():
            for edge in edges:
                before.setdefault(edge.target, []).append(state)
    useful = set(found.final)
    waiting = list(found.final)
    while waiting:
        new = [one for one in before.get(waiting.pop(), ()) if one not in useful]
        useful.update(new)
        waiting += new
    if len(useful) == len(found.edges):
        return found
    kept = useful | {found.start}

    def within(steps: Edges) -> Edges:
        return {
            state: tuple([edge for edge in edges if edge.target in useful])
            for state, edges in steps.items()
            if state in kept
        }

    events, wholes = within(found.edges), within(found.wholes)
    return Automaton(found.start, events, wholes, found.final, found.rest_of)


# --- several at once -----------------------------------------------------------------

_ProductState: TypeAlias = tuple[tuple[int, ...], tuple[frozenset[int], ...]]
"""A state of each part of a meet, and the set of states of each denied part."""


def intersect(plain: list[Automaton], denied: list[Automaton]) -> Automaton:
    """The automaton of the strings of all `plain` automata and of none `denied`.

    For those that are denied all possible states are followed, so that an event of a
    label is distinguished from one that is not. Raises `UnsupportedError` if there are
    too many edges.
    """
    return _Product(plain, denied).all()


class _Product:
    """The states of several automata at once, numbered as they are reached."""

    def __init__(self, plain: list[Automaton], denied: list[Automaton]) -> None:
        self._plain, self._denied = plain, denied
        self._states: list[_ProductState] = []
        self._numbers: dict[_ProductState, int] = {}

    def all(self) -> Automaton:
        """The automaton of all states that are reached, built step by step."""
        starts = tuple([one.start for one in self._plain])
        denied = tuple([frozenset((one.start,)) for one in self._denied])
        start = self._number((starts, denied))
        edges: dict[int, tuple[Edge, ...]] = {}
        count = 0
        for both in self._states:  # grows on the way
            found = tuple(dict.fromkeys(self._steps(both)))
            edges[len(edges)] = found
            count += len(found)
            if count > EDGES:
                raise too_many_states(self.rest_of(start))
        final = frozenset(
            i for i, both in enumerate(self._states) if self._is_final(both)
        )
        wholes: Edges = dict.fromkeys(edges, ())
        return trim(Automaton(start, edges, wholes, final, self.rest_of))

    def rest_of(self, state: int) -> TypeNode:
        """The type of the strings that lead from a state to the end."""
        plain, denied = self._states[state]
        rests = [one.rest_of(q) for one, q in zip(self._plain, plain, strict=True)]
        for one, several in zip(self._denied, denied, strict=True):
            if several:
                rests.append(~join(*map(one.rest_of, sorted(several))))
        return meet(*rests)

    def _number(self, both: _ProductState) -> int:
        number = self._numbers.setdefault(both, len(self._states))
        if number == len(self._states):
            self._states.append(both)
        return number

    def _is_final(self, both: _ProductState) -> bool:
        plain = zip(self._plain, both[0], strict=True)
        denied = zip(self._denied, both[1], strict=True)
        return all(state in one.final for one, state in plain) and not any(
            several & one.final for one, several in denied
        )

    def _steps(self, both: _ProductState) -> Iterator[Edge]:
        choices = [
            one.edges[state] for one, state in zip(self._plain, both[0], strict=True)
        ]
        cases = [
            tuple(_distinguish_events(one, several))
            for one, several in zip(self._denied, both[1], strict=True)
        ]
        for edges in product(*choices):
            targets = tuple([edge.target for edge in edges])
            labels = [edge.label for edge in edges]
            for case in product(*cases):
                known = [label for more, _ in case for label in more]
                if any(~label in known for label in (*labels, *known)):
                    continue
                after = tuple([several for _, several in case])
                yield Edge(meet(*labels, *known), self._number((targets, after)))


def _distinguish_events(
    one: Automaton, several: frozenset[int]
) -> Iterator[tuple[tuple[TypeNode, ...], frozenset[int]]]:
    """The cases of an event that matter to a denied type in its states.

    Each comes with the states that it leads to.
    """
    edges = [edge for state in sorted(several) for edge in one.edges.get(state, ())]
    labels = tuple(dict.fromkeys(edge.label for edge in edges))
    if len(labels) > DENIED:
        raise too_many_states(join(*map(one.rest_of, sorted(several))))
    for case in product((True, False), repeat=len(labels)):
        so = dict(zip(labels, case, strict=True))
        known = tuple([label if so[label] else ~label for label in labels])
        yield known, frozenset(edge.target for edge in edges if so[edge.label])


def too_many_states(T: TypeNode) -> UnsupportedError:
    """The error that a type has too many cases."""
    return UnsupportedError(
        f"{T} has too many cases to be followed event by event",
        hint="ask for its parts one by one",
    )
