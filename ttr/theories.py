"""A theory: what is declared, defined, assumed and claimed, as one immutable value."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any, Protocol, overload

from immutables import Map

from ttr.consent import Consent
from ttr.errors import IllFormed, NotationError, Span, TTRError, suggestion
from ttr.escapes import json_text
from ttr.paths import occurring
from ttr.syntax import (
    Basic,
    Object,
    Path,
    Pred,
    PType,
    Record,
    RecordType,
    TypeNode,
    kind_of,
)

if TYPE_CHECKING:
    from ttr.queries import Check
    from ttr.updates.algorithms import Algorithm
    from ttr.updates.games import Game
    from ttr.updates.rules import Rule

__all__ = [
    "Axiom",
    "Exclusion",
    "Expected",
    "Given",
    "Interval",
    "Mistakes",
    "Opening",
    "Signature",
    "Theory",
    "load",
    "signature_of",
]

Interval = tuple[float, float]
"""An interval of probability [lo, hi] with 0 <= lo <= hi <= 1."""


@dataclass(frozen=True)
class Axiom:
    """A declared subtyping S <: T; paths in it are schematic variables.

    `right(x, y) <: left(y, x)` says that every situation in which x is right of y is
    one in which y is left of x, whatever x and y are.
    """

    lower: Basic | PType
    upper: Basic | PType

    def __str__(self) -> str:
        return f"{_schema(self.lower)} <: {_schema(self.upper)}"


@dataclass(frozen=True)
class Exclusion:
    """A declared S <: ~T: nothing is of both; paths in it are schematic variables.

    `dog(x) <: ~cat(x)` says that no situation makes x a dog and a cat.
    """

    left: Basic | PType
    right: Basic | PType

    def __str__(self) -> str:
        return f"{_schema(self.left)} <: ~{_schema(self.right)}"


def _schema(T: Basic | PType) -> str:
    """The type with its variables bare and the names of objects quoted."""
    if isinstance(T, Basic):
        return T.name
    return f"{T.pred.name}({', '.join(map(_schematic, T.args))})"


def _schematic(arg: Object) -> str:
    from ttr.printing import notation

    match arg:
        case Path(_, labels):
            return labels[0]
        case str():
            return json_text(arg)
    return notation(arg)


@dataclass(frozen=True)
class Given:
    """A judgement a theory starts from: a : T with a probability.

    Where `when` names other judgements, it is the probability if they hold.
    """

    sit: Object
    type: TypeNode
    p: Interval = (1.0, 1.0)
    span: Span | None = None
    when: tuple[tuple[Object, TypeNode], ...] = ()


@dataclass(frozen=True)
class Expected:
    """p(T || S₁, …): how probably whatever is of the conditions is of T, too."""

    type: TypeNode
    when: tuple[TypeNode, ...]
    p: Interval
    span: Span | None = None


@dataclass(frozen=True)
class Opening:
    """How a theory declares a game: all of it but the model in which it is played.

    `start` is its first state, of `type`; `agenda` the path of what it plans, `hears`
    the types of the events that come from outside, where it says which.
    """

    name: str
    type: RecordType
    start: Record
    algorithm: Algorithm
    agenda: str | None = None
    span: Span | None = None
    hears: tuple[TypeNode, ...] = ()


def _nothing() -> Mapping[str, Object]:
    return Map()


@dataclass(frozen=True, eq=False)
class Signature:
    """What models and subtyping need of a theory: axioms, open types, judgements."""

    axioms: tuple[Axiom, ...] = ()
    opened: frozenset[Basic | Pred] = frozenset()
    givens: tuple[Given | Expected, ...] = ()
    definitions: Mapping[str, Object] = field(default_factory=_nothing)
    exclusions: tuple[Exclusion, ...] = ()

    @cached_property
    def _memo(self) -> dict[object, Any]:
        """What follows from the axioms, once it was worked out (`ttr.axioms`)."""
        return {}

    @cached_property
    def related(self) -> frozenset[Basic | Pred]:
        """The basic types and predicates that an axiom or an exclusion is about."""
        axioms = [T for one in self.axioms for T in (one.lower, one.upper)]
        exclusions = [T for one in self.exclusions for T in (one.left, one.right)]
        types = (*axioms, *exclusions)
        return frozenset(T if isinstance(T, Basic) else T.pred for T in types)

    def __post_init__(self) -> None:
        if not isinstance(self.axioms, tuple):
            raise IllFormed(
                f"a theory is made of a tuple of axioms, found {kind_of(self.axioms)}",
                hint="to read a text, write Theory.parse(text)",
            )


def signature_of(theory: object) -> Signature:
    """The theory, or the empty one for None; raises `IllFormed` for what is none."""
    if theory is None:
        return Signature()
    if not isinstance(theory, Signature):
        raise IllFormed(f"expected a theory, found {kind_of(theory)}")
    return theory


class Mistakes(NotationError):
    """Several mistakes in one theory; `errors` are they, in the order of the text."""

    errors: tuple[TTRError, ...] = ()

    @classmethod
    def of(cls, errors: tuple[TTRError, ...]) -> Mistakes:
        """The mistakes as one error."""
        told = cls(f"{len(errors)} mistakes\n\n" + "\n\n".join(map(str, errors)))
        told.errors = errors
        return told

    def __reduce__(self) -> tuple[object, ...]:
        return Mistakes.of, (self.errors,)


class _ReadTheory(Protocol):
    def __call__(self, text: str, source: str = "<text>") -> Theory: ...


class _Parse:
    """Reads a theory when asked of the class, a type or object when asked of a theory.

    Both are what `parse` means there, `Theory.parse(file)` and `theory.parse(term)`;
    a descriptor is how one name can be a class method and a method.
    """

    @overload
    def __get__(self, theory: None, owner: type[Theory]) -> _ReadTheory: ...

    @overload
    def __get__(
        self, theory: Theory, owner: type[Theory]
    ) -> Callable[[str], Object]: ...

    def __get__(
        self, theory: Theory | None, owner: type[Theory]
    ) -> _ReadTheory | Callable[[str], Object]:
        if theory is None:
            return _parse_theory
        return lambda text: _parse_term(theory, text)


def _parse_theory(text: str, source: str = "<text>") -> Theory:
    """The theory that a text declares; raises `NotationError`, `IllFormed`, `Mistakes`.

    An `import` in it is relative to the working directory, and of what lies there or
    below.
    """
    from ttr.notation.loading import theory_of_text

    return theory_of_text(text, source)


def _parse_term(theory: Theory, text: str) -> Object:
    """The type or object that a text stands for in the theory."""
    from ttr.notation.reader import read

    return read(text, theory)


def load(
    path: str | os.PathLike[str], *, allow: Iterable[str | os.PathLike[str]] = ()
) -> Theory:
    """The theory in a file; raises `TTRError` where it cannot be read.

    An `import` in it is relative to the file, and of what lies in the file's folder or
    below; `allow` names other folders from which may be imported, too.
    """
    from ttr.notation.loading import theory_of_file

    if not isinstance(path, str | os.PathLike):
        raise TTRError(f"load takes the path of a file, found {kind_of(path)}")
    return theory_of_file(FilePath(path), Consent.of(allow))


@dataclass(frozen=True, eq=False)
class Theory(Signature):
    """A signature with the names declared in it, and the checks that it states.

    Its definitions, basic types and predicates are its items and its attributes; where
    a name is also the name of one of the attributes below, the item is meant.

    >>> kennel = Theory.parse('''
    ...     basic Ind
    ...     pred  dog(Ind), puppy(Ind)
    ...     Dog := [x : Ind, c : dog(x)]
    ...     puppy(x) <: dog(x)
    ... ''')
    >>> print(kennel.Dog)
    [x : Ind, c : dog(x)]
    >>> kennel.parse("[x : Ind, c : dog(x)]") is kennel["Dog"]
    True
    >>> kennel.Dgo
    Traceback (most recent call last):
    AttributeError: the theory has no Dgo: did you mean Dog?
    """

    basics: Mapping[str, Basic] = field(default_factory=dict)
    predicates: Mapping[str, Pred] = field(default_factory=dict)
    objects: frozenset[str] = frozenset()
    checks: tuple[Check, ...] = ()
    source: str = "<text>"
    rules: Mapping[str, Rule] = field(default_factory=dict)
    strategies: Mapping[str, Algorithm] = field(default_factory=dict)
    openings: Mapping[str, Opening] = field(default_factory=dict)

    parse = _Parse()

    @classmethod
    def of(cls, *values: object) -> Theory:
        """The theory that declares everything that occurs in the values, and no more.

        Law: Theory.of(T).parse(str(T)) is T. Raises `IllFormed` where two predicates of
        one name occur: no text could tell them apart.

        >>> from ttr.syntax import Ind
        >>> sorted(Theory.of(Pred("dog", Ind)("fido")).names)
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
        return cls(basics=basics, predicates=predicates, objects=frozenset(objects))

    @property
    def signature(self) -> Signature:
        """The theory without its names and checks."""
        return Signature(
            self.axioms, self.opened, self.givens, self.definitions, self.exclusions
        )

    @cached_property
    def games(self) -> Mapping[str, Game]:
        """The games, played in the model of the theory's givens.

        Raises `TTRError` where the givens contradict one another, or where the start of
        a game is not of its type.
        """
        from ttr.notation.openings import opened

        return opened(self)

    @property
    def names(self) -> frozenset[str]:
        """Every name declared in the theory, objects and rules too."""
        played = (self.rules, self.strategies, self.openings)
        return self.objects.union(
            self.definitions, self.basics, self.predicates, *played
        )

    def __getitem__(self, name: str) -> Object:
        if not isinstance(name, str):
            raise IllFormed(f"a theory is asked for a name, found {kind_of(name)}")
        for declared in (self.definitions, self.basics, self.predicates):
            if name in declared:
                return declared[name]
        raise KeyError(self._missing(name))

    def __contains__(self, name: object) -> bool:
        """Whether a definition, basic type or predicate has the name."""
        known = (self.definitions, self.basics, self.predicates)
        return any(name in declared for declared in known)

    def __getattr__(self, name: str) -> Object:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self[name]
        except KeyError:
            raise AttributeError(self._missing(name)) from None

    def _missing(self, name: str) -> str:
        played = {
            "rules": self.rules,
            "strategies": self.strategies,
            "games": self.openings,
        }
        for kind, names in played.items():
            if name in names:
                return f"{name} is one of the {kind}: theory.{kind}[{name!r}]"
        terms = [*self.definitions, *self.basics, *self.predicates]
        hint = suggestion(name, [*terms, *(one for k in played.values() for one in k)])
        return f"the theory has no {name}" + f": {hint}" * bool(hint)

    def __repr__(self) -> str:
        return f"<Theory {self.source}: {', '.join(sorted(self.names))}>"


def _same_predicate(known: Pred, found: Pred) -> None:
    if known is not found:
        raise IllFormed(
            f"two predicates are called {known.name}: {known!r} and {found!r}"
        )
