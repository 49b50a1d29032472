"""The questions that a `check` statement may ask, as values."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from ttr.errors import Span, TTRError
from ttr.signature.signature import Interval
from ttr.types.objects import Object
from ttr.types.syntax import TypeNode
from ttr.updates.rules import Rule


@dataclass(frozen=True)
class IsOf:
    """a : T."""

    sit: Object
    type: TypeNode


@dataclass(frozen=True)
class IsBelow:
    """S <= T, under the axioms of the theory."""

    lower: TypeNode
    upper: TypeNode


@dataclass(frozen=True)
class IsBelowRelabelled:
    """S <= T up to relabelling: S is below T with other labels."""

    lower: TypeNode
    upper: TypeNode


@dataclass(frozen=True)
class IsSame:
    """S = T: they are the same type or object, with every f(a) worked out."""

    left: Object
    right: Object


@dataclass(frozen=True)
class Merges:
    """merge(S, T) = U, or amerge(S, T) = U; `operation` is its name."""

    operation: str
    left: TypeNode
    right: TypeNode
    result: Object


@dataclass(frozen=True)
class Creates:
    """create(T): a new witness of T can be made."""

    type: TypeNode


@dataclass(frozen=True)
class IsWellFormed:
    """wellformed(T): every path leads to a field of the right type, none to a cycle.

    If T cannot be built at all, `type` is the error that says why.
    """

    type: TypeNode | TTRError


@dataclass(frozen=True)
class HasDegree:
    """P(a : T | b : S, …) = [lo, hi] (`relation` is "="), or within it (it is "in")."""

    sit: Object
    type: TypeNode
    relation: str
    interval: Interval
    when: tuple[tuple[Object, TypeNode], ...] = ()


@dataclass(frozen=True)
class Expects:
    """P(T || S, …) = [lo, hi], or within it: for any object of S, …."""

    type: TypeNode
    when: tuple[TypeNode, ...]
    relation: str
    interval: Interval


@dataclass(frozen=True)
class IsTrue:
    """P(T) = [lo, hi]: how probably there is something of T."""

    type: TypeNode
    interval: Interval


@dataclass(frozen=True)
class Updates:
    """r(s, e) = a: the rule takes state s, with event e if it has one, to state a."""

    rule: Rule
    args: tuple[Object, ...]
    result: Object


Query: TypeAlias = (
    IsOf
    | IsBelow
    | IsBelowRelabelled
    | IsSame
    | Merges
    | Creates
    | IsWellFormed
    | HasDegree
    | Expects
    | IsTrue
    | Updates
)


@dataclass(frozen=True)
class Check:
    """The claim that a query has the expected answer: yes, no, unknown or error.

    If the query mentions a type that cannot be built, `query` is the error.
    """

    expected: str
    query: Query | TTRError
    span: Span
    text: str
