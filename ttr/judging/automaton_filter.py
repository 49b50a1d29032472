"""Filtering: the states an automaton may be in after events that may be uncertain."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from itertools import product
from typing import TypeAlias

from ttr.computing.strings.automaton_steps import Automaton
from ttr.computing.strings.uncertain_states import (
    NOWHERE,
    Beliefs,
    States,
)
from ttr.judging.judgements import Why
from ttr.persistent_maps import Map
from ttr.probability import CERTAIN, REFUTED, UNKNOWN, Degree
from ttr.probability.degrees import frechet_conjunction, independent_conjunction
from ttr.types.interning import identity
from ttr.types.syntax import TypeNode, meet

TOLD_APART = 4
"""The number of uncertain types of one event for which all cases are distinguished."""

Reads: TypeAlias = Callable[[TypeNode], Why]
"""Derives whether the event that was observed is of a type."""

_NOTHING: Map[object, bool] = Map()


@dataclass(frozen=True, eq=False)
class AutomatonFilter:
    """The states an automaton may be in, with their degrees; made by `start_filter`.

    `doubted` are the objects of which something uncertain was asked. Uncertain
    judgements of different objects are independent, unless they are `linked`.
    """

    automaton: Automaton
    linked: bool
    beliefs: Beliefs
    doubted: Map[object, bool] = _NOTHING

    @property
    def goes_on(self) -> Degree:
        """The probability that the events so far begin a string of the automaton."""
        return self.beliefs.probability(bool)

    @property
    def may_end(self) -> Degree:
        """The probability that the events so far are a string of the automaton."""
        final = self.automaton.final
        return self.beliefs.probability(lambda states: not states.isdisjoint(final))

    def after(self, reads: Reads) -> AutomatonFilter:
        """The filter after one more event, which may lead nowhere."""
        event = _Event(reads)
        steps = partial(self._steps, event)
        for states in self.beliefs.degrees:
            list(steps(states))  # so that it is known what is doubted
        again = any(sit in self.doubted for sit in event.doubted)
        apart = not again and not (self.linked and self.doubted)
        doubted = self.doubted.update(dict.fromkeys(event.doubted, True))
        beliefs = self.beliefs.after(
            steps, independent_conjunction if apart else frechet_conjunction
        )
        return replace(self, beliefs=beliefs, doubted=doubted)

    def _steps(self, event: _Event, states: States) -> Iterator[tuple[States, Degree]]:
        """The sets of states that an event leads to, each with its degree."""
        edges = [edge for q in sorted(states) for edge in self.automaton.edges[q]]
        labels = dict.fromkeys(edge.label for edge in edges)
        for fitting, p in event.cases(list(labels)):
            yield frozenset(edge.target for edge in edges if edge.label in fitting), p


def start_filter(automaton: Automaton, linked: bool) -> AutomatonFilter:
    """The filter before the first event, for an automaton that asks for no wholes."""
    start = NOWHERE if automaton.empty else frozenset((automaton.start,))
    return AutomatonFilter(automaton, linked, Beliefs.certain(start))


class _Event:
    """The degrees of one event for each type; every type is asked for once."""

    def __init__(self, reads: Reads) -> None:
        self._reads = reads
        self._known: dict[TypeNode, Degree] = {}
        self.doubted: dict[object, None] = {}

    def cases(
        self, labels: list[TypeNode]
    ) -> Iterator[tuple[frozenset[TypeNode], Degree]]:
        """The sets of labels that the event may be of, each with its degree.

        Where too many labels are uncertain, these are the two extremes only, of unknown
        degree.
        """
        certain = [T for T in labels if self._degree(T) == CERTAIN]
        possible = [T for T in labels if self._degree(T) not in (CERTAIN, REFUTED)]
        if len(possible) > TOLD_APART:
            yield frozenset((*certain, *possible)), UNKNOWN
            yield frozenset(certain), UNKNOWN
            return
        for case in product((True, False), repeat=len(possible)):
            so = dict(zip(possible, case, strict=True))
            parts = [T if so[T] else ~T for T in possible]
            p = self._degree(meet(*parts)) if parts else CERTAIN
            if p != REFUTED:
                yield frozenset((*certain, *(T for T in possible if so[T]))), p

    def _degree(self, T: TypeNode) -> Degree:
        if T not in self._known:
            why = self._reads(T)
            self._known[T] = why.p
            self.doubted.update({identity(one.sit): None for one in why.uncertain()})
        return self._known[T]
