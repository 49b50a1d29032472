"""Beliefs about the state of an automaton: sets of states with their probabilities.

One of the sets is the set of states that are reached, or it lies between two of them.
A degree is a number if all that it is computed from are numbers, else an interval.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import TypeAlias

from ttr.probability import CERTAIN, REFUTED, Degree

SETS = 32
"""How many sets of states are distinguished."""

States: TypeAlias = frozenset[int]

NOWHERE: States = frozenset()
"""No state: the events that were seen begin no string of the type."""

_Conjunction: TypeAlias = Callable[[Degree, Degree], Degree]
"""The probability of a conjunction, from those of its two parts."""


@dataclass(frozen=True)
class Beliefs:
    """Sets of states, one of which is reached, with their probabilities.

    >>> some, nothing = Degree(0.25, 0.5), Degree(0.5, 0.75)
    >>> print(Beliefs({frozenset((1,)): some, NOWHERE: nothing}).probability(bool))
    [0.25, 0.5]
    """

    degrees: Mapping[States, Degree]

    @classmethod
    def certain(cls, states: States) -> Beliefs:
        """The belief that exactly these states are reached."""
        return cls({states: CERTAIN})

    def states(self) -> list[int]:
        """The states that may be reached, each once."""
        return sorted({state for states in self.degrees for state in states})

    def probability(self, holds: Callable[[States], bool]) -> Degree:
        """How probable it is that a condition holds of the set of states.

        If it holds of a set, it must hold of larger ones. Each bound is found in two
        ways: from the sets where it holds, and from those where it does not.
        """
        one, other = REFUTED, REFUTED
        for states, p in self.degrees.items():
            if holds(states):
                one = _disjoint_sum(one, p)
            else:
                other = _disjoint_sum(other, p)
        low = min(1.0, max(one.lo, 1.0 - other.hi))
        return Degree(low, max(low, min(one.hi, 1.0 - other.lo)))

    def after(
        self,
        steps: Callable[[States], Iterable[tuple[States, Degree]]],
        together: _Conjunction,
    ) -> Beliefs:
        """The beliefs after an event, which leads from each set to others."""
        found: dict[States, Degree] = {}
        for states, p in self.degrees.items():
            for reached, q in steps(states):
                both = together(p, q)
                found[reached] = _disjoint_sum(found.get(reached, REFUTED), both)
        return Beliefs(_merge_unlikely(found))


def _disjoint_sum(p: Degree, q: Degree) -> Degree:
    """p + q: the probability of one of two events that exclude each other."""
    return Degree(min(1.0, p.lo + q.lo), min(1.0, p.hi + q.hi))


def _merge_unlikely(degrees: Mapping[States, Degree]) -> Mapping[States, Degree]:
    """The same degrees, with the least probable sets merged into two if too many.

    The set that is reached lies between those two, their intersection and union.
    """
    if len(degrees) <= SETS:
        return degrees
    ordered = sorted(degrees, key=lambda states: (-degrees[states].hi, sorted(states)))
    kept = {states: degrees[states] for states in ordered[: SETS - 2]}
    others = ordered[SETS - 2 :]
    least, whole = frozenset.intersection(*others), frozenset.union(*others)
    most = min(1.0, sum(degrees[states].hi for states in others))
    for states in (whole, least):
        kept[states] = _disjoint_sum(kept.get(states, REFUTED), Degree(0.0, most))
    return kept
