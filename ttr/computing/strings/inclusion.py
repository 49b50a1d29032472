"""Is every string of a type one of another? Two automata are followed side by side.

A state of the one is followed with all states that the other may be in for the same
events. A function says whether events of a type are surely of another. It may not know:
so a yes holds under every assignment, while a counterexample has to be checked.

Source: the subset construction of Rabin and Scott 1959, with the smallest sets only, as
in De Wulf and others 2006; types as labels are distinguished only as far as needed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TypeAlias

from ttr.computing.strings.automaton_steps import Automaton, Edges
from ttr.safety.budgets import spend
from ttr.types.syntax import TypeNode, meet

PAIRS = 1024
"""How many pairs of a state and a set of states are followed at most."""

TOLD_APART = 6
"""How many types an event may be of or not, if its cases are to be distinguished."""

_Below: TypeAlias = Callable[[TypeNode, tuple[TypeNode, ...]], bool]
"""Is an event of a type surely of one of others? If none: can there be no event?"""


@dataclass(frozen=True)
class Inclusion:
    """Is every string of the one type of the other, as far as is derivable?

    If not, `against` has the event types of a possible counterexample, or is None if
    none was found.
    """

    yes: bool
    against: tuple[TypeNode, ...] | None = None


def check_inclusion(S: Automaton, T: Automaton | None, below: _Below) -> Inclusion:
    """Are the strings of S among those of T? Without T: are there none?

    >>> from ttr import Basic, Plus, Str
    >>> from ttr.computing.strings.automata import automaton
    >>> A = Basic("A")
    >>> pairs, some = automaton(Plus(Str(A, A))), automaton(Plus(A))
    >>> same = lambda event, types: event in types
    >>> check_inclusion(pairs, some, same).yes
    True
    >>> [str(one) for one in check_inclusion(some, pairs, same).against]
    ['A']
    """
    return _InclusionSearch(S, T, below).all()


_Pair: TypeAlias = tuple[int, frozenset[int]]
_Predecessors: TypeAlias = dict[_Pair, tuple[_Pair, TypeNode] | None]


class _InclusionSearch:
    """Follows pairs of a state of S and the states that T may be in, shortest first."""

    def __init__(self, S: Automaton, T: Automaton | None, below: _Below) -> None:
        self._S, self._T, self._below = S, T, below
        self._known: dict[tuple[TypeNode, tuple[TypeNode, ...]], bool] = {}

    def all(self) -> Inclusion:
        start = (self._S.start, frozenset((self._T.start,) if self._T else ()))
        came: _Predecessors = {start: None}
        smallest: dict[int, list[frozenset[int]]] = {start[0]: [start[1]]}
        waiting = [start]
        for pair in waiting:  # grows on the way
            if len(waiting) > PAIRS:
                return Inclusion(False)
            state, others = pair
            if state in self._S.final and not self._ends(others):
                return Inclusion(False, _word_to(came, pair))
            for after, label in self._successors(state, others):
                seen = smallest.setdefault(after[0], [])
                if any(fewer <= after[1] for fewer in seen):
                    continue
                seen.append(after[1])
                came[after] = (pair, label)
                waiting.append(after)
        return Inclusion(True)

    def _ends(self, others: frozenset[int]) -> bool:
        return self._T is not None and not others.isdisjoint(self._T.final)

    def _successors(
        self, state: int, others: frozenset[int]
    ) -> Iterator[tuple[_Pair, TypeNode]]:
        """The pairs reached by an event of S, or by a string taken as a whole."""
        for steps in (_edges_of, _wholes_of):
            theirs = [
                edge for q in sorted(others) if self._T for edge in steps(self._T)[q]
            ]
            labels = tuple(dict.fromkeys(edge.label for edge in theirs))
            for label, target in steps(self._S)[state]:
                for denied in self._deniable_labels(label, labels):
                    after = frozenset(
                        edge.target for edge in theirs if edge.label not in denied
                    )
                    event = meet(label, *[~one for one in denied])
                    yield (target, after), event

    def _deniable_labels(
        self, label: TypeNode, labels: tuple[TypeNode, ...]
    ) -> list[tuple[TypeNode, ...]]:
        """The largest sets of labels of which an event of the type may be none.

        Smaller sets are no better counterexamples.
        """
        open_ones = tuple([one for one in labels if not self._is_below(label, (one,))])
        found: list[tuple[TypeNode, ...]] = []
        waiting = [open_ones]
        seen = {open_ones}
        for denied in waiting:  # grows on the way
            if any(set(denied) <= set(more) for more in found):
                continue
            if not self._is_below(label, denied):
                found.append(denied)
                continue
            if len(open_ones) > TOLD_APART:
                return [open_ones]
            fewer = [tuple([x for x in denied if x is not one]) for one in denied]
            new = [one for one in fewer if one not in seen]
            seen.update(new)
            waiting += new
        return found

    def _is_below(self, label: TypeNode, labels: tuple[TypeNode, ...]) -> bool:
        spend()
        if label in labels:
            return True
        asked = (label, labels)
        if asked not in self._known:
            self._known[asked] = self._below(label, labels)
        return self._known[asked]


def _edges_of(one: Automaton) -> Edges:
    return one.edges


def _wholes_of(one: Automaton) -> Edges:
    return one.wholes


def _word_to(came: _Predecessors, pair: _Pair) -> tuple[TypeNode, ...]:
    """The types of the events on the way to a pair."""
    labels = []
    step = came[pair]
    while step is not None:
        pair, label = step
        labels.append(label)
        step = came[pair]
    return tuple(reversed(labels))
