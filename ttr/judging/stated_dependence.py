"""Links: what was said of how judgements depend on one another.

A conditional p(a : T | b : S, …) is about particular objects, p(T || S, …) about every
object. What is said of a particular object goes before what is said of every object.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, TypeAlias

from ttr.persistent_maps import Map
from ttr.probability import Degree
from ttr.types.interning import identity
from ttr.types.objects import Object
from ttr.types.printing import notation
from ttr.types.syntax import Basic, PType

Atom: TypeAlias = Basic | PType
"""The types that are judged by themselves: an assignment gives them witnesses."""

Key: TypeAlias = tuple[object, Atom]
"""The identity of an object, and a type."""


@dataclass(frozen=True, eq=False)
class Claim:
    """The claim that an object is of a basic type or a ptype."""

    sit: Object
    type: Atom

    @property
    def key(self) -> Key:
        """The key by which claims are equal."""
        return identity(self.sit), self.type

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Claim) and self.key == other.key

    def __hash__(self) -> int:
        return hash(self.key)

    def __str__(self) -> str:
        return f"{notation(self.sit)} : {self.type}"


@dataclass(frozen=True, eq=False)
class Conditioned:
    """p(target | condition), where each claim of the condition holds, or does not."""

    target: Claim
    condition: tuple[tuple[Claim, bool], ...]
    p: Degree

    def claims(self) -> tuple[Claim, ...]:
        """The target and what it depends on."""
        return self.target, *[claim for claim, _ in self.condition]

    def concerns(self) -> tuple[object, object]:
        """What it says something of: a later one that concerns the same replaces it."""
        return self.target.key, frozenset((c.key, so) for c, so in self.condition)


@dataclass(frozen=True, eq=False)
class Expectation:
    """p(T || S, …): the probability of T for every object of the conditions."""

    type: Atom
    condition: tuple[tuple[Atom, bool], ...]
    p: Degree

    def of(self, sit: Object) -> Conditioned:
        """The conditional that it implies for one object."""
        on = tuple([(Claim(sit, T), so) for T, so in self.condition])
        return Conditioned(Claim(sit, self.type), on, self.p)

    def concerns(self) -> tuple[object, object]:
        """What it says something of: a later one that concerns the same replaces it."""
        return self.type, frozenset(self.condition)


_EMPTY: Map[Any, Any] = Map()


@dataclass(frozen=True, eq=False)
class Links:
    """All that was said of dependence, indexed by what it is about; immutable."""

    conditioned: Map[Key, tuple[Conditioned, ...]] = _EMPTY
    expected: Map[Atom, tuple[Expectation, ...]] = _EMPTY
    dependent: Map[Key, tuple[Claim, ...]] = _EMPTY
    about: Map[object, tuple[Claim, ...]] = _EMPTY
    unknown: Map[Key, tuple[tuple[Claim, ...], ...]] = _EMPTY

    def __bool__(self) -> bool:
        return bool(self.conditioned or self.expected or self.unknown)

    def of(self, claim: Claim) -> tuple[Conditioned, ...]:
        """The conditionals that were stated of this claim."""
        return self.conditioned.get(claim.key, ())

    def in_general(self, claim: Claim) -> tuple[Conditioned, ...]:
        """The conditionals of every object, applied to the claim."""
        return tuple([one.of(claim.sit) for one in self.expected.get(claim.type, ())])

    def on(self, claim: Claim) -> tuple[Claim, ...]:
        """The claims that have conditionals on this one."""
        return self.dependent.get(claim.key, ())

    def claims_about(self, sit: Object) -> list[Claim]:
        """The claims of an object that some conditional is about."""
        general = [
            Claim(sit, T)
            for several in self.expected.values()
            for one in several
            for T in (one.type, *[kind for kind, _ in one.condition])
        ]
        return list(dict.fromkeys((*self.about.get(identity(sit), ()), *general)))

    def with_conditioned(self, new: Conditioned) -> Links:
        """The links with a conditional, in place of one that concerns the same."""
        key = new.target.key
        dependent = self.dependent
        for claim, _ in new.condition:
            others = dependent.get(claim.key, ())
            if key not in [other.key for other in others]:
                dependent = dependent.set(claim.key, (*others, new.target))
        kept = [
            one
            for one in self.conditioned.get(key, ())
            if one.concerns() != new.concerns()
        ]
        conditioned = self.conditioned.set(key, (*kept, new))
        about = self.about
        for claim in new.claims():
            others = about.get(claim.key[0], ())
            if claim not in others:
                about = about.set(claim.key[0], (*others, claim))
        return replace(self, conditioned=conditioned, dependent=dependent, about=about)

    def with_expected(self, new: Expectation) -> Links:
        """The links with a conditional of every object."""
        kept = [
            one
            for one in self.expected.get(new.type, ())
            if one.concerns() != new.concerns()
        ]
        return replace(self, expected=self.expected.set(new.type, (*kept, new)))

    def with_unknown(self, claims: tuple[Claim, ...]) -> Links:
        """The links where it is unknown how these claims depend on one another."""
        unknown = self.unknown
        for claim in claims:
            others = unknown.get(claim.key, ())
            unknown = unknown.set(claim.key, (*others, claims))
        return replace(self, unknown=unknown)
