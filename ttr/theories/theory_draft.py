"""A theory while it is being read, to which each statement adds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from ttr.errors import Span
from ttr.notation.names import all_names
from ttr.signature.signature import (
    Axiom,
    Exclusion,
    Expected,
    Given,
    Opening,
    Signature,
)
from ttr.types.interning import Node
from ttr.types.objects import Object
from ttr.types.printing import Written
from ttr.types.syntax import Basic, Pred, TypeNode
from ttr.updates.rules import Rule
from ttr.updates.update_strategies import Algorithm

if TYPE_CHECKING:
    from ttr.theories.queries import Check
    from ttr.theories.theory import Theory


@dataclass(eq=False)
class Draft:
    """The part of a theory read so far; its fields are those of `Theory`, but mutable.

    `used` are the names that statements have mentioned: a predicate among them cannot
    get another arity. `gathered` says which strategy or game has gathered all rules of
    a kind: no rule of this kind may follow. `written` says of each definition how it is
    written: the order of its fields, the names of its variables; `defined_at` where.
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
    used: set[str] = field(default_factory=set)
    gathered: dict[str, str] = field(default_factory=dict)
    declared: dict[str, TypeNode] = field(default_factory=dict)
    written: dict[str, Mapping[Node, Written]] = field(default_factory=dict)
    defined_at: dict[str, Span] = field(default_factory=dict)

    @classmethod
    def of(cls, theory: Theory) -> Draft:
        """A draft to which statements are added that follow a theory."""
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
            declared=dict(theory.declared),
            written=dict(theory.written),
            defined_at=dict(theory.defined_at),
        )

    @property
    def names(self) -> frozenset[str]:
        """Every name declared so far."""
        return all_names(self)

    @property
    def signature(self) -> Signature:
        """The axioms and declared objects, all that well-formedness depends on."""
        return Signature(
            tuple(self.axioms),
            exclusions=tuple(self.exclusions),
            declared=self.declared,
        )
