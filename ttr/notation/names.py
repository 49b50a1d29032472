"""The names that a text may use, and what each is declared or defined as."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Set
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Protocol

from ttr.errors import IllFormedError
from ttr.signature.signature import Opening, Signature
from ttr.types.objects import Object
from ttr.types.paths import subterms
from ttr.types.syntax import Basic, Pred

if TYPE_CHECKING:
    from ttr.updates.rules import Rule
    from ttr.updates.update_strategies import Algorithm


class Names(Protocol):
    """What a reader needs of a theory, whether or not all of it has been read."""

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
        """All declared names; `is_declared` is the quick way to look for one."""

    @property
    def signature(self) -> Signature:
        """The axioms, which subtyping needs."""


def is_declared(theory: Names, name: str) -> bool:
    """Is this name declared in the theory?"""
    return any(name in kind for kind in _kinds(theory))


def all_names(theory: Names) -> frozenset[str]:
    """Every name that is declared in the theory."""
    return frozenset().union(*_kinds(theory))


def _kinds(theory: Names) -> tuple[Collection[str], ...]:
    """The names of each kind."""
    terms = (theory.objects, theory.definitions, theory.basics, theory.predicates)
    return (*terms, theory.rules, theory.strategies, theory.openings)


def meaning_of(theory: Names, name: str) -> Object | None:
    """The definition, basic type or predicate of this name; None if there is none."""
    for kind in (theory.definitions, theory.basics, theory.predicates):
        if name in kind:
            return kind[name]
    return None


@dataclass(frozen=True)
class Vocabulary:
    """The names of basic types, predicates and objects, with no definitions."""

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
        return all_names(self)


def vocabulary_of(*values: object) -> Vocabulary:
    """The names of the basic types, predicates and objects that occur in the values.

    Raises `IllFormedError` where two predicates of one name occur.

    >>> from ttr import Ind, Pred
    >>> sorted(vocabulary_of(Pred("dog", (Ind,))("fido")).names)
    ['Ind', 'dog', 'fido']
    """
    basics: dict[str, Basic] = {}
    predicates: dict[str, Pred] = {}
    objects: set[str] = set()
    for value in subterms(values):
        match value:
            case Basic(name):
                basics[name] = value
            case Pred(name, _):
                _check_same(predicates.setdefault(name, value), value)
            case str():
                objects.add(value)
    return Vocabulary(basics, predicates, objects)


def format_predicate(pred: Pred) -> str:
    """The statement that declares a predicate.

    >>> from ttr import Ind
    >>> format_predicate(Pred("dog", Ind))
    'pred dog(Ind)'
    """
    arities = [", ".join(map(str, arity)) for arity in pred.arities]
    return f"pred {', '.join(f'{pred.name}({arity})' for arity in arities)}"


def _check_same(known: Pred, found: Pred) -> None:
    if known is not found:
        raise IllFormedError(
            f"two predicates are called {known.name}: {known!r} and {found!r}"
        )
