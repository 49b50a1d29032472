"""Underspecified contents: a content with a store of quantifiers (Cooper storage).

A sentence with quantifiers has one underspecified content: what is said of some
variables, and for each variable the quantifier in store that is to bind it. Each way to
retrieve them, one after the other, is a reading; what is retrieved last has the widest
scope. Variables are objects by name.

>>> from ttr import Pred
>>> from ttr.semantics.quantifiers import every, exist
>>> poet, poem = Pred("poet", Ind), Pred("poem", Ind)
>>> recite = Pred("recite", Ind, Ind)
>>> every_poet = StoredQuantifier("a", every, poet("a"))
>>> a_poem = StoredQuantifier("b", exist, poem("b"))
>>> sentence = Underspecified(recite("a", "b"), (every_poet, a_poem))
>>> for reading in readings(sentence):
...     print(reading)
every(\\x:Ind. poet(x), \\y:Ind. exist(\\x:Ind. poem(x), \\x:Ind. recite(y, x)))
exist(\\x:Ind. poem(x), \\y:Ind. every(\\x:Ind. poet(x), \\x:Ind. recite(x, y)))

Sources: Cooper 2023, on underspecification; Keller 1988 for stores inside others.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

from ttr.computing.normalisation import normal_form
from ttr.errors import IllFormedError
from ttr.safety.budgets import spend, within_budget
from ttr.signature.signature import Signature
from ttr.types.interning import identity
from ttr.types.objects import BOUND, Object
from ttr.types.paths import subterms
from ttr.types.substitution import replace_name
from ttr.types.syntax import (
    Function,
    Ind,
    Singleton,
    Type,
    TypeNode,
    as_type,
    join,
    kind_of,
)

__all__ = ["StoredQuantifier", "Underspecified", "readings", "type_of_readings"]

Quantifying: TypeAlias = Callable[..., TypeNode]
"""A determiner, of a restrictor and a scope; or a quantifier, of a scope alone."""


@dataclass(frozen=True)
class Underspecified:
    """A content with a store: what is said of the variables, and what binds them.

    The store is in the order of the sentence: of two quantifiers, the first has wide
    scope in the first reading. Raises `IllFormedError` for two with one variable.

    >>> from ttr import Pred
    >>> from ttr.semantics.quantifiers import every, exist
    >>> dog, cat, chase = Pred("dog", Ind), Pred("cat", Ind), Pred("chase", Ind, Ind)
    >>> sentence = Underspecified(
    ...     chase("x", "y"),
    ...     (
    ...         StoredQuantifier("x", every, dog("x")),
    ...         StoredQuantifier("y", exist, cat("y")),
    ...     ),
    ... )
    >>> len(readings(sentence)), sentence.is_plugged
    (2, False)
    """

    content: TypeNode
    store: tuple[StoredQuantifier, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "content", as_type(self.content))
        object.__setattr__(self, "store", tuple(self.store))
        for one in self.store:
            if not isinstance(one, StoredQuantifier):
                raise IllFormedError(
                    f"a store has stored quantifiers, found {kind_of(one)}",
                    hint='write StoredQuantifier("x", every, dog("x"))',
                )
        names = [one.variable for one in _all_stored(self.store)]
        twice = next((name for name in names if names.count(name) > 1), None)
        if twice is not None:
            raise IllFormedError(f"two quantifiers in store are to bind {twice}")

    @property
    def is_plugged(self) -> bool:
        """Is nothing in store? Then it is its only reading."""
        return not self.store


@dataclass(frozen=True)
class StoredQuantifier:
    r"""A quantifier in store, and the variable that it is to bind.

    The quantifier is a `Determiner`, a function of a theory, as in
    \P:(Ind -> Type). \Q:(Ind -> Type). …, or any Python function of properties.
    Without a restrictor it takes the scope alone. The restrictor is a type, or a
    content with a store of its own, whose quantifiers take scope inside it or are in
    store where it is retrieved. Raises `IllFormedError` where the variable is no name
    or the quantifier no function.

    >>> from ttr import Pred
    >>> from ttr.semantics.quantifiers import every
    >>> stored = StoredQuantifier("x", every, Pred("dog", Ind)("x"))
    >>> print(stored.restriction.content)
    dog(x)
    """

    variable: str
    quantifier: Quantifying
    restrictor: TypeNode | Underspecified | None = None
    domain: TypeNode = Ind

    def __post_init__(self) -> None:
        if not isinstance(self.variable, str):
            raise IllFormedError(
                f"a variable is a name, found {kind_of(self.variable)}"
            )
        if not callable(self.quantifier):
            raise IllFormedError(
                "a quantifier is a function of properties, "
                f"found {kind_of(self.quantifier)}"
            )
        object.__setattr__(self, "domain", as_type(self.domain))

    @cached_property
    def restriction(self) -> Underspecified | None:
        """The restrictor as a content with its store."""
        if self.restrictor is None or isinstance(self.restrictor, Underspecified):
            return self.restrictor
        return Underspecified(self.restrictor)


@within_budget
def readings(
    sentence: Underspecified, /, theory: Signature | None = None
) -> tuple[TypeNode, ...]:
    r"""The readings of an underspecified content: what its retrievals compute to.

    Each is there once, the one with the scopes of the sentence first. A retrieval that
    leaves a variable free is none: a quantifier whose variable stands in the restrictor
    of another one is retrieved after it, or inside the restrictor. Raises
    `IllFormedError` as `normal_form`, and `TooLargeError` for too many.

    >>> from ttr import Pred
    >>> from ttr.semantics.quantifiers import every, exist
    >>> dog, cat, chase = Pred("dog", Ind), Pred("cat", Ind), Pred("chase", Ind, Ind)
    >>> every_dog = StoredQuantifier("x", every, dog("x"))
    >>> some_cat = StoredQuantifier("y", exist, cat("y"))
    >>> for reading in readings(Underspecified(chase("x", "y"), (every_dog, some_cat))):
    ...     print(reading)
    every(\x:Ind. dog(x), \y:Ind. exist(\x:Ind. cat(x), \x:Ind. chase(y, x)))
    exist(\x:Ind. cat(x), \y:Ind. every(\x:Ind. dog(x), \x:Ind. chase(x, y)))
    """
    variables = frozenset(one.variable for one in _all_stored(sentence.store))
    found: dict[object, TypeNode] = {}
    for content, left in _retrievals(sentence.content, sentence.store):
        if left or not variables.isdisjoint(_names_in(content)):
            continue
        reading = as_type(normal_form(content, theory))
        found.setdefault(identity(reading), reading)
    return tuple(found.values())


def type_of_readings(
    sentence: Underspecified, /, theory: Signature | None = None
) -> TypeNode:
    """The type of the readings: a content is of it iff it is one of them.

    >>> print(type_of_readings(Underspecified(Ind)))
    Type@Ind
    """
    return join(*[Singleton(Type, one) for one in readings(sentence, theory)])


def _retrievals(
    content: TypeNode, store: tuple[StoredQuantifier, ...]
) -> Iterator[tuple[TypeNode, tuple[StoredQuantifier, ...]]]:
    """What becomes of a content after some retrievals, with what is left in store."""
    spend()
    yield content, store
    for number in reversed(range(len(store))):
        one = store[number]
        rest = (*store[:number], *store[number + 1 :])
        if any(one.variable in _names_of(other) for other in rest):
            continue
        for restrictor, lifted in _restrictors(one):
            kept = (*rest[:number], *lifted, *rest[number:])
            yield from _retrievals(_bind(one, restrictor, content), kept)


def _restrictors(
    one: StoredQuantifier,
) -> Iterator[tuple[TypeNode | None, tuple[StoredQuantifier, ...]]]:
    """The contents of a restrictor, each with what is lifted from its store."""
    if one.restriction is None:
        yield None, ()
    else:
        yield from _retrievals(one.restriction.content, one.restriction.store)


def _bind(
    one: StoredQuantifier, restrictor: TypeNode | None, scope: TypeNode
) -> TypeNode:
    """The quantifier of the restrictor and the scope, as properties of the variable."""
    parts = [scope] if restrictor is None else [restrictor, scope]
    properties = [
        Function(one.domain, replace_name(part, one.variable, BOUND)) for part in parts
    ]
    return as_type(one.quantifier(*properties))


def _all_stored(store: tuple[StoredQuantifier, ...]) -> Iterator[StoredQuantifier]:
    """The quantifiers in a store, and in the stores of their restrictors."""
    for one in store:
        spend()
        yield one
        if one.restriction is not None:
            yield from _all_stored(one.restriction.store)


def _names_of(one: StoredQuantifier) -> frozenset[str]:
    """The names in the restrictor of a stored quantifier, and in its own store."""
    if one.restriction is None:
        return frozenset()
    inside = (_names_of(other) for other in one.restriction.store)
    return _names_in(one.restriction.content).union(*inside)


def _names_in(T: Object) -> frozenset[str]:
    return frozenset(part for part in subterms([T]) if isinstance(part, str))
