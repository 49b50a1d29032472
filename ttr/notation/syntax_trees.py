"""Syntax trees: what was written, before anything is known about the names in it.

Each part knows its place in the text, so that an error found later can be underlined.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields, replace
from functools import cache, cached_property
from typing import TypeVar, dataclass_transform

from ttr.errors import NotationError, Span

UNNAMED = "<text>"
"""The source of a text that is given as a string in Python."""


@dataclass(frozen=True)
class Source:
    """A text and where it came from."""

    text: str
    name: str = UNNAMED

    @classmethod
    def of(cls, text: object, name: str) -> Source:
        """The text with plain line ends; raises `NotationError` if it is no string."""
        if not isinstance(text, str):
            found = type(text).__name__
            raise NotationError(f"expected a text to read, found {found}")
        return cls(text.replace("\r\n", "\n"), name)

    @cached_property
    def _starts(self) -> list[int]:
        """The places where lines start."""
        return [0, *(found.end() for found in re.finditer("\n", self.text))]

    def line(self, at: int) -> int:
        """The number of the line of a place, from 1."""
        return bisect_right(self._starts, at)

    def span(self, part: Part) -> Span:
        """The place of a part, to be shown in an error."""
        line = self.line(part.start)
        start, *end = self._starts[line - 1 : line + 1]
        text = self.text[start : end[0] - 1 if end else None]
        found = Span.of(self.name, text, part.start - start, part.end - start)
        return replace(found, line=line)


_T = TypeVar("_T")


@dataclass_transform(frozen_default=True)
def _part(cls: type[_T]) -> type[_T]:
    """Makes a class of parts, which do not change.

    That nobody sets anything in them is seen to when types are checked, not whenever
    one is made: there are many of them, in texts and as classes.
    """
    return dataclass(slots=True, eq=False, repr=False)(cls)


@_part
class Part:
    """A part of a text: text[start:end]."""

    start: int
    end: int

    def __repr__(self) -> str:
        found = (f"{it.name}={getattr(self, it.name)!r}" for it in fields(self))
        return f"{type(self).__name__}({', '.join(found)})"


# --- terms: types and objects --------------------------------------------------------


@_part
class Term(Part):
    """A type or an object."""


@_part
class Name(Term):
    """x, x.y (`up` is None), .x (`up` is 0), ^.x (1), and so on outwards."""

    labels: tuple[str, ...]
    up: int | None


@_part
class Literal(Term):
    """A quoted name or a number."""

    value: str | int | float


@_part
class Application(Term):
    """p(a₁, …, aₙ), or f(a)."""

    head: Term
    args: tuple[Term, ...]


@_part
class Abstraction(Term):
    """λx:S. body."""

    variable: Word
    domain: Term
    body: Term


@_part
class Arrow(Term):
    """(S → T), or ((x : S) → T) where there is a variable."""

    variable: Word | None
    domain: Term
    result: Term


@_part
class Restriction(Term):
    """T@a."""

    base: Term
    value: Term


@_part
class Conjunction(Term):
    """S ∧ T."""

    parts: tuple[Term, ...]


@_part
class Disjunction(Term):
    """S ∨ T."""

    parts: tuple[Term, ...]


@_part
class Denial(Term):
    """¬T."""

    body: Term


@_part
class Concatenation(Term):
    """a + b."""

    parts: tuple[Term, ...]


@_part
class Fields(Term):
    """[ℓ : T, …]; without fields it is written Rec, so there is at least one."""

    fields: tuple[Field, ...]


@_part
class Field(Part):
    """ℓ : T, or ℓ = a : T."""

    label: Word
    value: Term | None
    type: Term


@_part
class Items(Term):
    """[a, …]; `[]` is Rec where a type must stand."""

    items: tuple[Term, ...]


@_part
class Braces(Term):
    """{ℓ = a, …}."""

    settings: tuple[tuple[Word, Term], ...]


@_part
class Elements(Term):
    """{a, …}, or set{} where there are none."""

    items: tuple[Term, ...]


@_part
class Events(Term):
    """<a b>."""

    items: tuple[Term, ...]


@_part
class Word(Part):
    """A single name, where one is declared or stands as a label."""

    text: str


# --- statements ----------------------------------------------------------------------


@_part
class Statement(Part):
    """A statement of a theory file."""


@_part
class Import(Statement):
    """import "f.ttr"."""

    path: str


@_part
class BasicNames(Statement):
    """basic A, B."""

    names: tuple[Word, ...]


@_part
class Predicates(Statement):
    """pred p(A), q(A, B)."""

    arities: tuple[Arity, ...]


@_part
class Arity(Part):
    """p(A₁, …, Aₙ) where a predicate is declared."""

    name: Word
    types: tuple[Term, ...]


@_part
class OpenNames(Statement):
    """open A, p."""

    names: tuple[Word, ...]


@_part
class ObjectNames(Statement):
    """object a, b : T."""

    names: tuple[Word, ...]
    type: Term


@_part
class GivenFact(Statement):
    """given a : T, with a degree or without."""

    sit: Term
    type: Term
    degree: Degree | None


@_part
class GivenChance(Statement):
    """given P(a : T | b : S) = p, or given P(T || S) = p."""

    chance: Probability | Expectation


@_part
class Definition(Statement):
    """Name := type or object."""

    name: Word
    value: Term


@_part
class RuleStatement(Statement):
    """rule name(s : S, e : E) "doc" of kind where [x : T] := value."""

    name: Word
    parameters: tuple[Parameter, ...]
    doc: Literal | None
    kind: Word | None
    where: Fields | None
    value: Term


@_part
class Parameter(Part):
    """s : S, or e : E in [lo, hi]."""

    name: Word
    type: Term
    degree: Degree | None


@_part
class StrategyStatement(Statement):
    """strategy name := value."""

    name: Word
    value: Term


@_part
class GameStatement(Statement):
    """game name(start : S, acts on agenda, hears A, B) := value."""

    name: Word
    begin: Term
    type: Term
    agenda: Term | None
    hears: tuple[Term, ...]
    value: Term


@_part
class AxiomClaim(Statement):
    """S <: T."""

    lower: Term
    upper: Term


@_part
class ConditionalAxiomClaim(Statement):
    """S <: T if C, …, where each C is what a check may ask."""

    lower: Term
    upper: Term
    when: tuple[Query, ...]


@_part
class RestrictiveAxiomClaim(Statement):
    """S <: T only if C, …."""

    lower: Term
    upper: Term
    only: tuple[Query, ...]


@_part
class Question(Statement):
    """check Q; `expected` is yes, no, unknown or error."""

    expected: str
    query: Query


@_part
class Degree(Part):
    """= p (`relation` is "=") or in [lo, hi] (it is "in")."""

    relation: str
    value: Term


@_part
class Query(Part):
    """What a check asks."""


@_part
class Judged(Query):
    """a : T."""

    sit: Term
    type: Term


@_part
class Comparison(Query):
    """S <= T or S = T; `relation` is "<=", "<= up to relabelling" or "="."""

    relation: str
    left: Term
    right: Term


@_part
class Probability(Query):
    """P(a : T | b : S, …) = p, or in [lo, hi]; `head` is what is written for P."""

    head: Term
    sit: Term
    type: Term
    degree: Degree | None
    when: tuple[tuple[Term, Term], ...] = ()


@_part
class Expectation(Query):
    """P(T || S, …) = p, or in [lo, hi]."""

    head: Term
    type: Term
    when: tuple[Term, ...]
    degree: Degree | None


@_part
class Claim(Query):
    """create(T) or wellformed(T)."""

    term: Term


def inside(part: Part) -> Iterator[Part]:
    """The part and every part in it, the outer before the inner."""
    waiting: list[object] = [part]
    while waiting:
        here = waiting.pop()
        if isinstance(here, tuple):
            waiting += reversed(here)
        elif isinstance(here, Part):
            yield here
            waiting += _values_of(here.__match_args__)(here)


@cache
def _values_of(fields: tuple[str, ...]) -> Callable[[Part], list[object]]:
    """What a part with these fields is made of, without its place, the last first."""
    made_of = fields[:1:-1]
    return lambda part: [getattr(part, name) for name in made_of]
