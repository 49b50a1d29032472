"""A theory while it is read: each statement adds to it, in time for that alone."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from ttr.signature.signature import (
    Axiom,
    Exclusion,
    Expected,
    Given,
    Opening,
    Signature,
)
from ttr.theories.queries import Check
from ttr.types.syntax import Basic, Object, Pred
from ttr.updates.algorithms import Algorithm
from ttr.updates.rules import Rule

if TYPE_CHECKING:
    from ttr.theories.theory import Theory

__all__ = ["Draft"]


@dataclass(eq=False)
class Draft:
    """What has been read of a theory: the fields are those of `Theory`, to be added to.

    `settled` are the names that statements rest on: a predicate among them has its
    final arities. `gathered` are the kinds of rules of which a strategy or a game has
    been made, with its name: no rule of them may follow.
    """

    source: str = "<text>"
    basics: dict[str, Basic] = field(default_factory=dict)
    predicates: dict[str, Pred] = field(default_factory=dict)
    definitions: dict[str, Object] = field(default_factory=dict)
    objects: set[str] = field(default_factory=set)
    opened: set[Basic | Pred] = field(default_factory=set)
    axioms: dict[Axiom, None] = field(default_factory=dict)
    exclusions: dict[Exclusion, None] = field(default_factory=dict)
    givens: list[Given | Expected] = field(default_factory=list)
    checks: list[Check] = field(default_factory=list)
    rules: dict[str, Rule] = field(default_factory=dict)
    strategies: dict[str, Algorithm] = field(default_factory=dict)
    openings: dict[str, Opening] = field(default_factory=dict)
    settled: set[str] = field(default_factory=set)
    gathered: dict[str, str] = field(default_factory=dict)

    @classmethod
    def of(cls, theory: Theory) -> Draft:
        """A draft that goes on from a theory."""
        return cls(
            source=theory.source,
            basics=dict(theory.basics),
            predicates=dict(theory.predicates),
            definitions=dict(theory.definitions),
            objects=set(theory.objects),
            opened=set(theory.opened),
            axioms=dict.fromkeys(theory.axioms),
            exclusions=dict.fromkeys(theory.exclusions),
            givens=list(theory.givens),
            checks=list(theory.checks),
            rules=dict(theory.rules),
            strategies=dict(theory.strategies),
            openings=dict(theory.openings),
        )

    @property
    def names(self) -> frozenset[str]:
        """Every name declared so far."""
        played = (self.rules, self.strategies, self.openings)
        return frozenset().union(
            self.objects, self.definitions, self.basics, self.predicates, *played
        )

    @property
    def signature(self) -> Signature:
        """The axioms: nothing else says whether a type is well-formed."""
        return Signature(tuple(self.axioms), exclusions=tuple(self.exclusions))
