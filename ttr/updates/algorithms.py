"""Strategies of update, as values: which of several rules, in which order, how often.

Larsson and Traum 2000 leave to an update strategy which rules are applied: the first
that does, each in turn, class by class, or the one that the developer chooses.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeAlias

from ttr.errors import UpdateError, suggestion
from ttr.judging.rule_index import Demands, Sieve, any_of, demands_of
from ttr.types.syntax import Record, kind_of
from ttr.updates.rules import Rule

__all__ = [
    "Algorithm",
    "All",
    "Ask",
    "ByClass",
    "Choose",
    "First",
    "Maybe",
    "Measure",
    "Repeat",
    "Seq",
    "all_",
    "ask",
    "by_class",
    "first",
    "maybe",
    "places_of",
    "repeat",
    "replaced",
    "rules_of",
    "seq",
]

Choose: TypeAlias = Callable[[Sequence[str], Record], int | None]
"""Picks one of the names, by its index, or None of them."""

Measure: TypeAlias = str | Callable[[Record], object]
"""The path of a number or list of the state, or a function of the state."""


@dataclass(frozen=True)
class First:
    """The first of these that applies."""

    parts: tuple[Algorithm, ...]

    def __str__(self) -> str:
        return _written("first", self.parts)

    @cached_property
    def sieve(self) -> Sieve:
        """What leaves out the parts that cannot apply: they need not be tried."""
        return Sieve(map(_demands, self.parts))


@dataclass(frozen=True)
class All:
    """Each of these that applies, in order; it applies where one does."""

    parts: tuple[Algorithm, ...]

    def __str__(self) -> str:
        return _written("all", self.parts)


@dataclass(frozen=True)
class Seq:
    """All of these, one after the other; it applies where all do."""

    parts: tuple[Algorithm, ...]

    def __str__(self) -> str:
        return _written("seq", self.parts)


@dataclass(frozen=True)
class Maybe:
    """This if it applies, else nothing; it always applies."""

    part: Algorithm

    def __str__(self) -> str:
        return f"maybe({self.part})"


@dataclass(frozen=True)
class Repeat:
    """This as long as it applies, once at least.

    It applies at most so many `times`, and each time the `measure` gets smaller.
    """

    part: Algorithm
    times: int | None = None
    measure: Measure | None = None

    def __str__(self) -> str:
        named = self.measure if isinstance(self.measure, str) else None
        bounds = [str(bound) for bound in (self.times, named) if bound is not None]
        return _written("repeat", (self.part, *bounds))


@dataclass(frozen=True)
class ByClass:
    """Class after class, each rule of it that applies; it applies where one does.

    The order of the rules within a class is claimed not to matter.
    """

    classes: tuple[tuple[str, tuple[Rule, ...]], ...]

    def __str__(self) -> str:
        return _written("by_class", [kind for kind, _ in self.classes])


@dataclass(frozen=True)
class Ask:
    """The one of these that `choose` picks among those that apply."""

    parts: tuple[Algorithm, ...]
    choose: Choose

    def __str__(self) -> str:
        return _written("ask", self.parts)


Algorithm: TypeAlias = Rule | First | All | Seq | Maybe | Repeat | ByClass | Ask


def _written(name: str, parts: Sequence[object]) -> str:
    return f"{name}({', '.join(map(str, parts))})"


def first(*parts: Algorithm) -> First:
    """The first of these rules or strategies that applies."""
    return First(checked("first", parts))


def all_(*parts: Algorithm) -> All:
    """Each of these that applies, in order."""
    return All(checked("all_", parts))


def seq(*parts: Algorithm) -> Seq:
    """All of these in order; where one does not apply, none does."""
    return Seq(checked("seq", parts))


def maybe(part: Algorithm) -> Maybe:
    """This if it applies, else nothing."""
    checked("maybe", (part,))
    return Maybe(part)


def repeat(
    part: Algorithm, *, times: int | None = None, measure: Measure | None = None
) -> Repeat:
    """This again and again while it applies.

    To apply more than `times`, to come back to an earlier state, and not to make the
    `measure` smaller are errors. The measure is the path of a list or of a number that
    is not negative, or a function of the state that gives one.
    """
    checked("repeat", (part,))
    if times is not None and (type(times) is not int or times < 1):
        raise UpdateError(f"repeat takes how often at most, found times={times!r}")
    if measure is not None and not isinstance(measure, str) and not callable(measure):
        raise UpdateError(
            "a measure is the path of a list or number, or a function of the state, "
            f"found {measure!r}"
        )
    return Repeat(part, times, measure)


def by_class(*rules: Rule, order: Sequence[str]) -> ByClass:
    """The rules class by class, in this order of the classes (their `kind`).

    Raises `UpdateError` where a rule is of no class in the order, or a class has none.
    """
    if isinstance(order, str):
        raise UpdateError(f"the order of classes is a list of words, found {order!r}")
    for one in rules:
        if not isinstance(one, Rule):
            raise UpdateError(f"by_class takes rules, found {kind_of(one)}")
        if one.kind not in order:
            known = suggestion(one.kind, order)
            found = f"is of the class {one.kind}" if one.kind else "has no class"
            raise UpdateError(
                f"the rule {one} {found}; the order is {', '.join(order)}",
                hint=known or "give it a class by kind=",
            )
    classes = {kind: tuple(r for r in rules if r.kind == kind) for kind in order}
    for kind, members in classes.items():
        if not members:
            raise UpdateError(
                f"no rule is of the class {kind}",
                hint=suggestion(kind, [one.kind for one in rules]),
            )
    return ByClass(tuple(classes.items()))


def ask(*parts: Algorithm, choose: Choose) -> Ask:
    """The one that `choose` picks: it is given the names of those that apply.

    It gives an index, or None for none of them. Raises `UpdateError` where it cannot be
    called.
    """
    if not callable(choose):
        raise UpdateError(f"what chooses is a function, found {choose!r}")
    return Ask(checked("ask", parts), choose)


def checked(name: str, parts: tuple[object, ...]) -> tuple[Algorithm, ...]:
    """The parts, if all of them are rules and strategies; else `UpdateError`."""
    for part in parts:
        if not isinstance(part, Algorithm):
            raise UpdateError(f"{name} takes rules and strategies, found {part!r}")
    return parts  # type: ignore[return-value]


def rules_of(algorithm: Algorithm) -> tuple[Rule, ...]:
    """The rules in a strategy, each once, in the order in which they stand."""
    return tuple(dict.fromkeys(places_of(algorithm)))


def places_of(algorithm: Algorithm) -> Iterator[Rule]:
    """The rules in a strategy, as often as they stand in it."""
    match algorithm:
        case Rule():
            yield algorithm
        case Maybe(part) | Repeat(part):
            yield from places_of(part)
        case ByClass(classes):
            for _, members in classes:
                yield from members
        case First(parts) | All(parts) | Seq(parts) | Ask(parts):
            for part in parts:
                yield from places_of(part)


def replaced(algorithm: Algorithm, rules: Mapping[str, Rule]) -> Algorithm:
    """The strategy with these rules in place of those of their names."""
    match algorithm:
        case Rule():
            return rules.get(algorithm.name, algorithm)
        case Maybe(part) | Repeat(part):
            return replace(algorithm, part=replaced(part, rules))
        case ByClass(classes):
            new = [(k, tuple(rules.get(r.name, r) for r in rs)) for k, rs in classes]
            return ByClass(tuple(new))
    parts = tuple(replaced(part, rules) for part in algorithm.parts)
    return replace(algorithm, parts=parts)


def _demands(algorithm: Algorithm) -> Demands:
    """What is demanded of every state to which a strategy applies."""
    match algorithm:
        case Rule(on=None):
            return demands_of(algorithm.when)
        case Repeat(part) | Seq((part, *_)):
            return _demands(part)
        case ByClass(classes):
            return any_of(_demands(one) for _, members in classes for one in members)
        case First(parts) | All(parts) | Ask(parts) if parts:
            return any_of(map(_demands, parts))
    return {}
