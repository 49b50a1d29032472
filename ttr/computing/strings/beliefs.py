"""What may be so, and how probably: sets of states of an automaton with their degrees.

One of the sets is the set of states that are reached, or lies between two of them that
stand for it. Degrees are numbers where all that they come of is, else intervals.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import TypeAlias

from ttr.probability import CERTAIN, REFUTED, Degree

__all__ = ["NOWHERE", "Beliefs", "States", "frechet", "independent"]

SETS = 32
"""How many sets of states are told apart."""

States: TypeAlias = frozenset[int]

NOWHERE: States = frozenset()
"""No state: what was seen does not go on to anything that is expected."""

_Conjunction: TypeAlias = Callable[[Degree, Degree], Degree]
"""How probable two things are together."""


def independent(p: Degree, q: Degree) -> Degree:
    """How probable two things are together that do not depend on one another."""
    return Degree(p.lo * q.lo, p.hi * q.hi)


def frechet(p: Degree, q: Degree) -> Degree:
    """How probable two things are together, however they depend on one another.

    >>> print(frechet(Degree(0.75, 0.75), Degree(0.5, 0.5)))
    [0.25, 0.5]
    """
    return Degree(max(0.0, p.lo + q.lo - 1.0), min(p.hi, q.hi))


@dataclass(frozen=True)
class Beliefs:
    """Sets of states, one of which is reached, and how probable each of them is.

    >>> some, nothing = Degree(0.25, 0.5), Degree(0.5, 0.75)
    >>> print(Beliefs({frozenset((1,)): some, NOWHERE: nothing}).probability(bool))
    [0.25, 0.5]
    """

    degrees: Mapping[States, Degree]

    @classmethod
    def certain(cls, states: States) -> Beliefs:
        """That just these states are reached."""
        return cls({states: CERTAIN})

    def states(self) -> list[int]:
        """The states that may be reached, each once."""
        return sorted({state for states in self.degrees for state in states})

    def probability(self, holds: Callable[[States], bool]) -> Degree:
        """How probable it is that the set of states is such, as larger ones are, too.

        It is such, or it is not: so there are two ways to know each bound.
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
    """How probable it is that one of two things is so that cannot both be."""
    return Degree(min(1.0, p.lo + q.lo), min(1.0, p.hi + q.hi))


def _merge_unlikely(degrees: Mapping[States, Degree]) -> Mapping[States, Degree]:
    """The same with the least probable sets made two where there are too many.

    What is reached then lies between those two: what all have and what any has.
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
