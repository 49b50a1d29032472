"""The names that a text may use: what they are declared or defined as."""

from __future__ import annotations

from collections.abc import Mapping, Set
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Protocol

from ttr.errors import IllFormed
from ttr.signature.signature import Opening, Signature
from ttr.types.paths import occurring
from ttr.types.syntax import Basic, Object, Pred

if TYPE_CHECKING:
    from ttr.updates.algorithms import Algorithm
    from ttr.updates.rules import Rule

__all__ = ["Names", "Vocabulary", "is_declared", "meaning_of", "vocabulary_of"]


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


def meaning_of(theory: Names, name: str) -> Object | None:
    """What a name is defined or declared as, if it is no object."""
    for kind in (theory.definitions, theory.basics, theory.predicates):
        if name in kind:
            return kind[name]
    return None


@dataclass(frozen=True)
class Vocabulary:
    """Names of basic types, predicates and objects, and nothing defined by them."""

    basics: Mapping[str, Basic]
    predicates: Mapping[str, Pred]
    objects: Set[str]
    definitions: Mapping[str, Object] = field(default_factory=dict)
    rules: Mapping[str, Rule] = field(default_factory=dict)
    strategies: Mapping[str, Algorithm] = field(default_factory=dict)
    openings: Mapping[str, Opening] = field(default_factory=dict)
    signature: Signature = field(default_factory=Signature)

    @property
    def names(self) -> frozenset[str]:
        """All the names."""
        return frozenset().union(self.basics, self.predicates, self.objects)


def vocabulary_of(*values: object) -> Vocabulary:
    """The names of everything that occurs in some values.

    Raises `IllFormed` where two predicates of one name occur.

    >>> from ttr.types.syntax import Ind, Pred
    >>> sorted(vocabulary_of(Pred("dog", (Ind,))("fido")).names)
    ['Ind', 'dog', 'fido']
    """
    basics: dict[str, Basic] = {}
    predicates: dict[str, Pred] = {}
    objects: set[str] = set()
    for value in occurring(values):
        match value:
            case Basic(name):
                basics[name] = value
            case Pred(name, _):
                _same_predicate(predicates.setdefault(name, value), value)
            case str():
                objects.add(value)
    return Vocabulary(basics, predicates, objects)


def _same_predicate(known: Pred, found: Pred) -> None:
    if known is not found:
        raise IllFormed(
            f"two predicates are called {known.name}: {known!r} and {found!r}"
        )
