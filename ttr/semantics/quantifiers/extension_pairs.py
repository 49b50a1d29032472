"""Two extensions compared: the P that are Q, those that are not, and the uncertain.

Who they are is kept as keys, and looked up when it is asked for: counting is quick.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from ttr.judging.judgements import Why
from ttr.probability import CERTAIN, REFUTED, Degree
from ttr.probability.degrees import frechet_conjunction
from ttr.semantics.quantifiers.counting import Chances, independent_chances
from ttr.semantics.quantifiers.degrees_of_truth import Atoms
from ttr.semantics.quantifiers.extensions import Member
from ttr.types.objects import Missing, Object

Members = Mapping[object, Member]


class Case(NamedTuple):
    """One of P, with what is known of its being Q.

    >>> from ttr.semantics.quantifiers import Extension, every, quantify
    >>> dogs, barkers = Extension.of(["fido", "rex"]), Extension.of(["fido"])
    >>> [case.sit for case in quantify(every, dogs, barkers).refset]
    ['fido']
    """

    sit: Object
    chances: Chances
    situation: Object
    why: Why | None = None


@dataclass(frozen=True, eq=False)
class Split:
    """The members of P by what is known of their being Q, as keys."""

    P: Members
    Q: Members
    inside: Sequence[object]
    outside: Sequence[object]
    open_: Sequence[object]

    def cases(self, keys: Sequence[object]) -> tuple[Case, ...]:
        """The things with these keys, with what is known of them."""
        return tuple([_case(self.P[key], self.Q.get(key)) for key in keys])

    @property
    def atoms(self) -> list[Atoms]:
        """The uncertain judgements that each of the uncertain rests on."""
        found = [(self.P[key], self.Q.get(key)) for key in self.open_]
        return [one.atoms | (two.atoms if two else _NO_ATOMS) for one, two in found]


_NO_ATOMS: Atoms = frozenset()


def split_by(P: Members, Q: Members) -> Split:
    """The members of P, each looked up in Q."""
    inside, outside, open_ = list[object](), list[object](), list[object]()
    for key, one in P.items():
        other = Q.get(key)
        if one.p != CERTAIN:
            open_.append(key)
        elif other is None or other.p == REFUTED:
            outside.append(key)
        elif other.p == CERTAIN:
            inside.append(key)
        else:
            open_.append(key)
    return Split(P, Q, inside, outside, open_)


_IS = Chances(CERTAIN, CERTAIN, REFUTED)
_IS_NOT = Chances(CERTAIN, REFUTED, CERTAIN)
_NOTHING = Missing()


def _case(one: Member, other: Member | None) -> Case:
    """What is known of one of P's being Q; `other` is it as one of Q, if it may be."""
    if other is None:
        return Case(one.sit, _only(one.p), _NOTHING, None)
    why = other.found.why if other.found else None
    if other.p == REFUTED:
        return Case(one.sit, _only(one.p), _NOTHING, why)
    if one.p == other.p == CERTAIN:
        return Case(one.sit, _IS, other.situation, why)
    return Case(one.sit, _chances(one, other), other.situation, why)


def _only(p: Degree) -> Chances:
    return _IS_NOT if p == CERTAIN else Chances(p, REFUTED, p)


def _chances(one: Member, other: Member) -> Chances:
    """The chances of independent or equal members, else bounds on them."""
    p, q = one.p, other.p
    if one is other:
        return Chances(p, p, REFUTED)
    if one.atoms.isdisjoint(other.atoms):
        return independent_chances(p, q)
    only = Degree(max(0.0, p.lo - q.hi), min(p.hi, 1.0 - q.lo))
    return Chances(p, frechet_conjunction(p, q), only)
