"""Contents as formulas: what is said of things, and how many of them there are.

A property becomes a Boolean combination of simple properties (`Says`, `Is`), a sentence
a Boolean combination of counts (`Counted`) and of what is not looked into (`Stated`).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TypeAlias, TypeGuard

from ttr.semantics.fragment.content_types import closed
from ttr.semantics.quantifiers import Thresholds, absent, determiner_of, number
from ttr.semantics.quantifiers.determiners import demands, properties
from ttr.semantics.quantifiers.thresholds import Threshold
from ttr.types.paths import escaping
from ttr.types.substitution import grounded
from ttr.types.syntax import (
    BOUND,
    Function,
    Join,
    Object,
    PType,
    RecordType,
    Singleton,
    TypeNode,
)

__all__ = [
    "AT_ALL",
    "Alike",
    "Counted",
    "Formula",
    "Is",
    "Leaf",
    "Neither",
    "Parts",
    "Says",
    "Some",
    "Stated",
    "applied",
    "claim",
    "leaves",
    "said",
]

VARIABLE = "·thing"
"""The thing that a property is said of, while it is taken apart."""


@dataclass(frozen=True)
class Says:
    """A property that is not taken apart: what a function says of a thing."""

    function: Function


@dataclass(frozen=True)
class Is:
    """To be what a name names."""

    name: str


@dataclass(frozen=True)
class Counted:
    """Of what is P, so much is Q."""

    P: Formula
    Q: Formula
    threshold: Threshold


@dataclass(frozen=True)
class Stated:
    """A sentence that is not taken apart."""

    type: TypeNode


@dataclass(frozen=True)
class Parts:
    """All of these."""

    parts: tuple[Formula, ...]


@dataclass(frozen=True)
class Some:
    """At least one of these."""

    parts: tuple[Formula, ...]


@dataclass(frozen=True)
class Alike:
    """All of these, which say the same of different things; so not this is none."""

    parts: tuple[Formula, ...]


@dataclass(frozen=True)
class Neither:
    """Not this."""

    part: Formula


Leaf: TypeAlias = Says | Is | Counted | Stated
Formula: TypeAlias = Leaf | Parts | Some | Alike | Neither

EVERYTHING = Parts(())


def leaves(formula: Formula) -> Iterator[Leaf]:
    """The leaves of a formula, from left to right."""
    match formula:
        case Parts(parts) | Some(parts) | Alike(parts):
            for part in parts:
                yield from leaves(part)
        case Neither(part):
            yield from leaves(part)
        case _:
            yield formula


# --- of things -----------------------------------------------------------------------


def said(P: Function | TypeNode) -> Formula:
    """What a property says of a thing, as a formula."""
    if isinstance(P, Function):
        return _of_thing(applied(P, VARIABLE))
    return _of_type(P)


def applied(P: Function, thing: str) -> TypeNode:
    """What a property says of a thing with a name."""
    body = grounded(P.body, ({BOUND: thing},))
    return body if isinstance(body, TypeNode) else Singleton(P.domain, thing)


def _of_type(P: TypeNode) -> Formula:
    """To be of a type: one of some named things, or what is not taken apart."""
    match P:
        case Join(parts):
            return Some(tuple(map(_of_type, parts)))
        case Singleton(_, str(name)):
            return Is(name)
    return Says(Function(P, P, "x"))


def _of_thing(T: TypeNode) -> Formula:
    match T:
        case PType(pred, (TypeNode() as denied,)) if pred is absent:
            return Neither(_of_thing(denied))
        case Join(parts):
            return Some(tuple(map(_of_thing, parts)))
        case RecordType(fields) if _is_conjunction(T):
            return Parts(tuple([_of_thing(field) for _, field in fields]))
        case Singleton(Singleton(_, a), b) if VARIABLE in (a, b):
            return Parts(tuple([Is(it) for it in (a, b) if _is_name(it)]))
        case Singleton(_, a) if a == VARIABLE:
            return EVERYTHING
    return Says(closed(T, VARIABLE))


def _is_name(value: Object) -> TypeGuard[str]:
    return isinstance(value, str) and value != VARIABLE


def _is_conjunction(T: RecordType) -> bool:
    """Whether no field depends on another, nor is an object."""
    paths = {path.labels[0] for _, field in T.fields for path in escaping(field)}
    plain = all(not isinstance(field, Singleton) for _, field in T.fields)
    return plain and paths.isdisjoint(T.labels)


# --- of the world --------------------------------------------------------------------


def claim(
    T: TypeNode, thresholds: Thresholds, held: frozenset[str] = frozenset()
) -> Formula:
    """What a content claims, as a formula; the things in `held` are not spoken of.

    What can only be said of these is `Stated`.
    """
    if isinstance(T, PType) and determiner_of(T) is not None:
        P, Q = map(said, properties(T))
        asked = demands(T, thresholds)
        some = [Counted(P, P, AT_ALL)] if any(one.presupposes for one in asked) else []
        return Parts((*[Counted(P, Q, one) for one in asked], *some))
    match T:
        case PType(pred, (TypeNode() as denied,)) if pred is absent:
            return Neither(claim(denied, thresholds, held))
        case Join(parts):
            return Some(tuple([claim(part, thresholds, held) for part in parts]))
        case RecordType(fields) if _is_conjunction(T):
            return Parts(tuple([claim(it, thresholds, held) for _, it in fields]))
        case Singleton(Singleton(_, str(a)), str(b)):
            return Counted(Is(a), Is(b), AT_ALL)
        case PType(_, args):
            names = [it for it in args if isinstance(it, str) and it not in held]
            if names:
                return Alike(tuple([_of_named(T, name) for name in names]))
    return Stated(T)


def _of_named(T: TypeNode, name: str) -> Formula:
    return Counted(Is(name), Says(closed(T, name)), AT_ALL)


AT_ALL = number("at least", 1)
