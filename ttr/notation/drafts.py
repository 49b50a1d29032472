"""A theory while it is read: each statement adds to it, in time for that alone."""

from __future__ import annotations

from collections.abc import Mapping, Set
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Protocol

from ttr.errors import IllFormed
from ttr.paths import occurring
from ttr.queries import Check
from ttr.signature import Axiom, Exclusion, Expected, Given, Opening, Signature
from ttr.syntax import Basic, Object, Pred
from ttr.updates.algorithms import Algorithm
from ttr.updates.rules import Rule

if TYPE_CHECKING:
    from ttr.theories import Theory

__all__ = ["Draft", "Names", "is_declared", "meaning"]


class Names(Protocol):
    """What a reader asks of a theory, finished or not."""

    @property
    def basics(self) -> Mapping[str, Basic]: ...  # noqa: D102

    @property
    def predicates(self) -> Mapping[str, Pred]: ...  # noqa: D102

    @property
    def definitions(self) -> Mapping[str, Object]: ...  # noqa: D102

    @property
    def objects(self) -> Set[str]: ...  # noqa: D102

    @property
    def rules(self) -> Mapping[str, Rule]: ...  # noqa: D102

    @property
    def strategies(self) -> Mapping[str, Algorithm]: ...  # noqa: D102

    @property
    def openings(self) -> Mapping[str, Opening]: ...  # noqa: D102

    @property
    def names(self) -> frozenset[str]:
        """Every name, listed: to ask for one of them there is `is_declared`."""

    @property
    def signature(self) -> Signature:
        """What subtyping needs, with the axioms."""


def is_declared(theory: Names, name: str) -> bool:
    """Whether a name is among those of a theory, without listing them all."""
    terms = (theory.objects, theory.definitions, theory.basics, theory.predicates)
    played = (theory.rules, theory.strategies, theory.openings)
    return any(name in kind for kind in (*terms, *played))


def meaning(theory: Names, name: str) -> Object | None:
    """What a name is defined or declared as, if it is no object."""
    for kind in (theory.definitions, theory.basics, theory.predicates):
        if name in kind:
            return kind[name]
    return None


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

    @classmethod
    def of_values(cls, *values: object) -> Draft:
        """A draft that declares everything that occurs in the values, and no more.

        Raises `IllFormed` where two predicates of one name occur.
        """
        draft = cls()
        for value in occurring(values):
            match value:
                case Basic(name):
                    draft.basics[name] = value
                case Pred(name, _):
                    _same_predicate(draft.predicates.setdefault(name, value), value)
                case str():
                    draft.objects.add(value)
        return draft

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


def _same_predicate(known: Pred, found: Pred) -> None:
    if known is not found:
        raise IllFormed(
            f"two predicates are called {known.name}: {known!r} and {found!r}"
        )
