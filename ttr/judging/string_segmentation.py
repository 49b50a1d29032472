"""Segmentation: how a string of events can be divided into pieces of given types."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from typing import overload

from ttr.computing.strings.automaton_runs import (
    Division,
    Piece,
    Stop,
    find_division,
    find_divisions,
)
from ttr.computing.strings.automaton_steps import Automaton
from ttr.judging.assignments import Assignment
from ttr.judging.automaton_filter import start_filter
from ttr.judging.judgements import Why, degree_if_decided
from ttr.judging.stated_dependence import Atom
from ttr.probability import CERTAIN, REFUTED, UNKNOWN, Degree
from ttr.safety.budgets import spend
from ttr.types.interning import identity
from ttr.types.objects import EventString, Object, UnresolvedError
from ttr.types.paths import mentions
from ttr.types.printing import notation
from ttr.types.substitution import Around, resolve_paths
from ttr.types.syntax import Application, Basic, Join, Meet, Negation, PType, TypeNode

Derives = Callable[[Object, TypeNode], Why]
"""Derives whether an object is of a type."""


@dataclass(frozen=True, eq=False)
class _LazyGrounds(Sequence[Why]):
    """The derivations for the events of a string, made when they are asked for."""

    derives: Derives
    events: Sequence[Object]
    types: Sequence[TypeNode]

    def __len__(self) -> int:
        return len(self.types)

    @overload
    def __getitem__(self, index: int) -> Why: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[Why]: ...
    def __getitem__(self, index: int | slice) -> Why | Sequence[Why]:
        if isinstance(index, slice):
            return _LazyGrounds(self.derives, self.events[index], self.types[index])
        return self.derives(self.events[index], self.types[index])


class Segmentation:
    """Judges the pieces of a string; `around` are the scopes around it.

    Where there are witness functions, derivations are kept, so that each function is
    asked once. Otherwise a derivation is made only where the facts do not decide.
    """

    def __init__(
        self, facts: Assignment, sit: EventString, derives: Derives, around: Around
    ) -> None:
        self._facts, self._events, self._around = facts, sit.items, around
        self._derives = derives
        self._known: dict[tuple[object, TypeNode], Why] = {}
        self._atoms: dict[TypeNode, Atom | None] = {}
        self._closed: dict[Atom, bool] = {}
        plain = facts.theory
        self._is_free = not (plain.axioms or plain.exclusions or facts.functions)

    def certain_way(self, found: Automaton) -> Sequence[Why] | None:
        """The grounds of a certain way to divide the string, if there is one."""
        length = len(self._events)
        if any(found.wholes.values()):
            ways = find_divisions(
                length, found, self._is_certain, self._is_certain_whole
            )
            return None if isinstance(ways, Stop) else self.grounds(ways.ways[0])
        way = find_division(length, found, self._is_certain)
        if isinstance(way, Stop):
            return None
        return _LazyGrounds(self._why, self._events, way)

    def possible_ways(self, found: Automaton) -> Division | Stop:
        """The ways to divide the string that are possible."""
        length = len(self._events)
        if not any(found.wholes.values()):
            way = find_division(length, found, self._may_be)
            if isinstance(way, Stop):
                return way
        return find_divisions(length, found, self._may_be, self._may_be_whole)

    def chance(self, found: Automaton) -> Degree:
        """The probability that there is a way to divide the string, or its bounds.

        It is unknown for an automaton that asks for pieces as wholes.
        """
        if any(found.wholes.values()):
            return UNKNOWN
        following = start_filter(found, bool(self._facts.links))
        for event in self._events:
            following = following.after(partial(self._why, event))
        return following.may_end

    def grounds(self, way: Iterable[Piece]) -> tuple[Why, ...]:
        """The derivations for the pieces of one way to divide the string."""
        return tuple(map(self._ground, way))

    def _ground(self, piece: Piece) -> Why:
        if piece.whole:
            return self._why_whole(piece.start, piece.end, piece.label)
        return self._why(self._events[piece.start], piece.label)

    # --- whole pieces ---

    def _is_certain_whole(self, start: int, end: int, T: TypeNode) -> bool:
        return self._why_whole(start, end, T).p == CERTAIN

    def _may_be_whole(self, start: int, end: int, T: TypeNode) -> bool:
        return self._why_whole(start, end, T).p != REFUTED

    def _why_whole(self, start: int, end: int, T: TypeNode) -> Why:
        return self._why(EventString(*self._events[start:end]), T)

    # --- events ---

    def _is_certain(self, number: int, T: TypeNode) -> bool:
        return self._degree(self._events[number], T) == CERTAIN

    def _may_be(self, number: int, T: TypeNode) -> bool:
        return self._degree(self._events[number], T) != REFUTED

    def _degree(self, event: Object, T: TypeNode) -> Degree:
        """The degree to which an event is of a type, by a derivation where needed."""
        plain = None if self._facts.functions else self._decide(event, T)
        return self._why(event, T).p if plain is None else plain

    def _decide(self, event: Object, T: TypeNode) -> Degree | None:
        """Certain or refuted where the facts alone decide; else None."""
        spend()
        match T:
            case Join(parts):
                return degree_if_decided("any", [self._decide(event, S) for S in parts])
            case Meet(parts):
                return degree_if_decided("all", [self._decide(event, S) for S in parts])
            case Negation(body):
                return degree_if_decided("none", [self._decide(event, body)])
        atom = self._atom(T)
        if atom is None:
            return None
        p = self._facts.told_degree(event, atom)
        if p is None and self._closed[atom]:
            return REFUTED
        if p != CERTAIN:
            p, _ = self._facts.degree_of(event, atom)
        return p if p in (CERTAIN, REFUTED) else None

    def _atom(self, T: TypeNode) -> Atom | None:
        """The atom that a type reduces to, if to one without applications."""
        if T not in self._atoms:
            atom = self._atoms[T] = self._reduce_to_atom(T)
            if atom is not None:
                self._closed[atom] = self._is_free and not self._facts.leaves_open(atom)
        return self._atoms[T]

    def _reduce_to_atom(self, T: TypeNode) -> Atom | None:
        with suppress(UnresolvedError):
            ground = resolve_paths(T, self._around) if isinstance(T, PType) else T
            if isinstance(ground, Basic | PType) and not mentions(ground, Application):
                return ground
        return None

    def _why(self, event: Object, T: TypeNode) -> Why:
        if not self._facts.functions:
            return self._derives(event, self._atoms.get(T) or T)
        key = (identity(event), T)
        known = self._known.get(key)
        if known is None:
            known = self._known[key] = self._derives(event, T)
        return known


def describe_stop(facts: Assignment, sit: EventString, stop: Stop) -> str:
    """Say where the division of a string stops, on what, and what was expected."""
    done = stop.furthest
    wanted = " or ".join(map(str, stop.expected)) or "no more events"
    if done == len(sit):
        what = f"it ends after {events_in_words(done)}" if done else "it is empty"
        return f"{what}; expected next: {wanted}"
    event = sit.items[done]
    kinds = " and ".join(sorted(str(kind) for kind in facts.types_of(event)))
    found = f"event {done + 1}, {notation(event)}, is of {kinds or 'nothing known'}"
    if done == 0:
        return f"{found}, expected: {wanted}"
    first = "event" if done == 1 else events_in_words(done)
    return f"it cannot be divided beyond its first {first}; {found}, expected: {wanted}"


def events_in_words(number: int) -> str:
    """So many events, in words: "1 event", "2 events"."""
    return "1 event" if number == 1 else f"{number} events"
