"""Degrees of truth with their reasons, and how to combine several."""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from dataclasses import dataclass
from typing import TypeAlias

from ttr.judging.judgements import Why
from ttr.judging.models import Model
from ttr.probability import CERTAIN, REFUTED, Degree
from ttr.probability.degrees import (
    frechet_conjunction,
    frechet_disjunction,
    independent_conjunction,
    independent_disjunction,
)
from ttr.signature.signature import head
from ttr.types.interning import identity
from ttr.types.objects import Missing, Object, Record
from ttr.types.syntax import Basic, PType, RecordType, TypeNode

Atoms: TypeAlias = frozenset[Hashable]
"""The uncertain judgements that something rests on, or what stands for several."""

SHOWN = 5
"""The number of grounds of one kind that are shown."""


@dataclass(frozen=True)
class Truth:
    """How certain something is, why, and on which uncertain judgements it rests.

    What has none of these `atoms` in common is independent.

    >>> from ttr import Ind, Model
    >>> from ttr.semantics.quantifiers.truth import truth
    >>> print(truth(Model().given("fido", Ind, 0.7), Ind).p)
    0.7
    """

    p: Degree
    why: Why
    atoms: Atoms = frozenset()

    def __str__(self) -> str:
        return str(self.why)

    @property
    def witness(self) -> Object:
        """What is of the type, as far as something is."""
        return self.why.sit


def own_atoms(M: Model, p: Degree, T: TypeNode) -> Atoms:
    """The atoms of a type that is uncertain by itself: the type alone."""
    if p in (CERTAIN, REFUTED):
        return frozenset()
    return frozenset({_atom(M, Missing(), T)})


def truth_of_derivation(M: Model, why: Why) -> Truth:
    """The truth that a derivation gives, with the uncertain judgements in it."""
    steps = why.uncertain()
    atoms = frozenset(_atom(M, identity(step.sit), step.type) for step in steps)
    return Truth(why.p, why, atoms)


def _atom(M: Model, sit: object, T: TypeNode) -> Hashable:
    """A judgement, or what stands for all that may depend on it.

    Where the model states how judgements depend on one another, it is one for all; of
    an object and the types that an axiom or an exclusion is about, it is one, too.
    """
    if M.facts.links:
        return "linked"
    if isinstance(T, Basic | PType) and head(T) in M.theory.axiom_heads:
        return sit, frozenset(T.args) if isinstance(T, PType) else "related"
    return sit, T


def conjoin_fields(T: RecordType, parts: list[tuple[str, Truth]]) -> Truth:
    """The truth of a record type from the truths of its fields."""
    p, atoms = all_true([found for _, found in parts])
    sit = Record({label: found.witness for label, found in parts})
    whys = tuple(_at(label, found.why) for label, found in parts)
    return Truth(p, Why(sit, T, p, "field by field", whys), atoms)


def _at(label: str, why: Why) -> Why:
    return Why(why.sit, why.type, why.p, why.rule, why.parts, label, why.how, why.facts)


def all_true(grounds: list[Truth]) -> tuple[Degree, Atoms]:
    """How certain it is that all hold; bounds where they share judgements."""
    degrees = [found.p for found in grounds]
    atoms = frozenset[Hashable]().union(*(found.atoms for found in grounds))
    if REFUTED in degrees:
        return REFUTED, frozenset()
    apart = _are_independent(grounds, atoms)
    conjunction = independent_conjunction if apart else frechet_conjunction
    return conjunction(*degrees), atoms


def one_true(T: TypeNode, truths: Iterable[Truth], rule: str) -> Truth:
    """How certain it is that one holds; bounds where they share judgements."""
    grounds = list(truths)
    sure = next((found for found in grounds if found.p == CERTAIN), None)
    if sure is not None:
        return Truth(CERTAIN, _sum_up(T, sure, CERTAIN, rule, [sure]))
    atoms = frozenset[Hashable]().union(*(found.atoms for found in grounds))
    apart = _are_independent(grounds, atoms)
    disjunction = independent_disjunction if apart else frechet_disjunction
    p = disjunction(*[found.p for found in grounds])
    best = max(grounds, key=lambda found: found.p.lo, default=None)
    shown = sorted(grounds, key=lambda found: -found.p.hi)[:SHOWN]
    return Truth(p, _sum_up(T, best, p, rule, shown), atoms)


def _are_independent(grounds: list[Truth], atoms: Atoms) -> bool:
    return len(atoms) == sum(len(found.atoms) for found in grounds)


def _sum_up(
    T: TypeNode, best: Truth | None, p: Degree, rule: str, grounds: list[Truth]
) -> Why:
    whys = tuple(found.why for found in grounds)
    if len(whys) == 1 and whys[0].type is T:
        return whys[0]
    sit = best.witness if best is not None and p != REFUTED else Missing()
    return Why(sit, T, p, rule, whys, how="any")
