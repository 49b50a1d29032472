"""Contents as formulas: Boolean combinations of what things are, and how many.

A property becomes a Boolean combination of simple properties (`OpaqueProperty`, `Is`).
A sentence becomes a Boolean combination of counts (`Count`) and of sentences that are
not analysed (`OpaqueSentence`).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import TypeAlias, TypeGuard

from ttr.semantics.fragment.content_types import abstract_over
from ttr.semantics.quantifiers import Thresholds, absent, determiner_of, number
from ttr.semantics.quantifiers.determiners import properties, threshold_of
from ttr.semantics.quantifiers.thresholds import Threshold
from ttr.types.objects import Object
from ttr.types.paths import free_paths, subterms
from ttr.types.substitution import instantiate_body
from ttr.types.syntax import Function, Join, PType, RecordType, Singleton, TypeNode

_VARIABLE = "·thing"
"""The name of the thing that a property is said of while it is analysed."""


@dataclass(frozen=True)
class OpaqueProperty:
    """A property that is not analysed: what a function says of a thing."""

    function: Function


@dataclass(frozen=True)
class Is:
    """The property of being the thing with a name."""

    name: str


@dataclass(frozen=True)
class Count:
    """So many, or such a share, of the things that are P are Q."""

    P: Formula
    Q: Formula
    threshold: Threshold


@dataclass(frozen=True)
class OpaqueSentence:
    """A sentence that is not analysed."""

    type: TypeNode


@dataclass(frozen=True)
class Conjunction:
    """All of these are so."""

    parts: tuple[Formula, ...]


@dataclass(frozen=True)
class Disjunction:
    """At least one of these is so."""

    parts: tuple[Formula, ...]


@dataclass(frozen=True)
class AllOrNone:
    """All of these hold, or none: they say the same about different arguments."""

    parts: tuple[Formula, ...]


@dataclass(frozen=True)
class Negated:
    """This is not so."""

    part: Formula


Leaf: TypeAlias = OpaqueProperty | Is | Count | OpaqueSentence
Formula: TypeAlias = Leaf | Conjunction | Disjunction | AllOrNone | Negated

_EVERYTHING = Conjunction(())


def leaves(formula: Formula) -> Iterator[Leaf]:
    """The leaves of a formula, from left to right."""
    match formula:
        case Conjunction(parts) | Disjunction(parts) | AllOrNone(parts):
            for part in parts:
                yield from leaves(part)
        case Negated(part):
            yield from leaves(part)
        case _:
            yield formula


# --- of things -----------------------------------------------------------------------


def property_formula(P: Function | TypeNode) -> Formula:
    """A property as a formula about a thing."""
    if isinstance(P, Function):
        return _of_thing(apply_property(P, _VARIABLE))
    return _of_type(P)


def apply_property(P: Function, thing: str) -> TypeNode:
    """The type that a property gives of the thing with this name."""
    body = instantiate_body(P, thing)
    return body if isinstance(body, TypeNode) else Singleton(P.domain, thing)


def _of_type(P: TypeNode) -> Formula:
    """Being of a type, as a formula: a join of named things is analysed, no other."""
    match P:
        case Join(parts):
            return Disjunction(tuple(map(_of_type, parts)))
        case Singleton(_, str(name)):
            return Is(name)
    return OpaqueProperty(Function(P, P))


def _of_thing(T: TypeNode) -> Formula:
    match T:
        case PType(pred, (TypeNode() as denied,)) if pred is absent:
            return Negated(_of_thing(denied))
        case Join(parts):
            return Disjunction(tuple(map(_of_thing, parts)))
        case RecordType(fields) if _is_conjunction(T):
            return Conjunction(tuple([_of_thing(field) for _, field in fields]))
        case Singleton(Singleton(_, a), b) if _VARIABLE in (a, b):
            return Conjunction(tuple([Is(it) for it in (a, b) if _is_name(it)]))
        case Singleton(_, a) if a == _VARIABLE:
            return _EVERYTHING
    return OpaqueProperty(abstract_over(T, _VARIABLE))


def _is_name(value: Object) -> TypeGuard[str]:
    return isinstance(value, str) and value != _VARIABLE


def _is_conjunction(T: RecordType) -> bool:
    """Is no field dependent on another, and none manifest?"""
    paths = {path.labels[0] for _, field in T.fields for path in free_paths(field)}
    plain = all(not isinstance(field, Singleton) for _, field in T.fields)
    return plain and paths.isdisjoint(T.labels)


# --- of the world --------------------------------------------------------------------


def content_formula(
    T: TypeNode, thresholds: Thresholds, held: frozenset[str] = frozenset()
) -> Formula:
    """The content of a sentence as a formula.

    Names in `held` are not counted as things; a sentence about these alone is opaque.
    """
    if isinstance(T, PType) and determiner_of(T) is not None:
        counts = _counts(T, thresholds)
        names = [] if held else _names_in(properties(T))
        if not names:
            return counts
        return AllOrNone((counts, *[_of_named(T, name) for name in names]))
    match T:
        case PType(pred, (TypeNode() as denied,)) if pred is absent:
            return Negated(content_formula(denied, thresholds, held))
        case Join(parts):
            inside = [content_formula(part, thresholds, held) for part in parts]
            return Disjunction(tuple(inside))
        case RecordType(fields) if _is_conjunction(T):
            inside = [content_formula(part, thresholds, held) for _, part in fields]
            return Conjunction(tuple(inside))
        case Singleton(Singleton(_, str(a)), str(b)):
            return Count(Is(a), Is(b), AT_ALL)
        case PType(_, args):
            names = [it for it in args if isinstance(it, str) and it not in held]
            if names:
                return AllOrNone(tuple([_of_named(T, name) for name in names]))
    return OpaqueSentence(T)


def _counts(T: PType, thresholds: Thresholds) -> Formula:
    """A quantified sentence as counts of the things that have its properties."""
    P, Q = map(property_formula, properties(T))
    asked = threshold_of(T, thresholds)
    some = [Count(P, P, AT_ALL)] if any(one.presupposes for one in asked) else []
    return Conjunction((*[Count(P, Q, one) for one in asked], *some))


def _names_in(found: Iterable[Object]) -> list[str]:
    """The names of the things that some properties relate others to, each once.

    "A boy that Kim likes" says something of Kim, too; being Kim says nothing of her.
    """
    ptypes = (part for part in subterms(found) if isinstance(part, PType))
    args = (arg for T in ptypes for arg in T.args)
    return list(dict.fromkeys(arg for arg in args if isinstance(arg, str)))


def _of_named(T: TypeNode, name: str) -> Formula:
    return Count(Is(name), OpaqueProperty(abstract_over(T, name)), AT_ALL)


AT_ALL = number("at least", 1)
