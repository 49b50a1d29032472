"""Types of strings of events by their form: what is a piece of a string, and how long.

In str(T₁, …, Tₙ) and plus(T) a type stands for *pieces*: one that by its form is a type
of strings stands for several events in a row, any other for one event.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import product
from math import prod

from ttr.computing.normal_forms import push_negations_inwards
from ttr.safety.budgets import spend
from ttr.types.objects import EventString, Object
from ttr.types.syntax import (
    Join,
    Meet,
    Negation,
    Plus,
    Singleton,
    Str,
    TypeNode,
    join,
    meet,
)

ALTERNATIVES = 256
"""How many alternatives a piece may have; with more it is not divided."""


def is_of_strings(T: TypeNode) -> bool:
    """Is T by its form a type of strings, rather than of events?

    >>> from ttr import Ind
    >>> is_of_strings(Plus(Ind)), is_of_strings(Ind), is_of_strings(~~Str(Ind))
    (True, False, True)
    """
    match T:
        case Str() | Plus():
            return True
        case Join(parts) | Meet(parts):
            spend(len(parts))
            return any(map(is_of_strings, parts))
        case Singleton(base, _):
            return is_of_strings(base)
        case Negation():
            inner = push_negations_inwards(T)
            return inner is not T and is_of_strings(inner)
    return False


def events_of(T: Str) -> tuple[TypeNode, ...] | None:
    """The types of the events, one by one; None if a piece may have several.

    >>> from ttr import Ind
    >>> events_of(Str(Ind, Ind)), events_of(Str(Ind, Plus(Ind)))
    ((Basic('Ind'), Basic('Ind')), None)
    """
    return None if any(map(is_of_strings, T.items)) else T.items


def string_of(types: Iterable[TypeNode], pieces: Iterable[Object]) -> EventString:
    """The string of these pieces: a piece is a string, or one event.

    >>> from ttr import Ind
    >>> print(string_of((Plus(Ind), Ind), (EventString("a", "b"), "c")))
    <a b c>
    """
    events: list[Object] = []
    for T, piece in zip(types, pieces, strict=True):
        is_string = is_of_strings(T) and isinstance(piece, EventString)
        events += piece.items if is_string else (piece,)
    return EventString(*events)


def alternatives(T: TypeNode) -> tuple[TypeNode, ...]:
    """The types whose join is T, each of them either of strings or of events.

    >>> from ttr import Basic
    >>> A, B = Basic("A"), Basic("B")
    >>> print(*alternatives((A | Str(A)) & B), sep="; ")
    A /\\ B; B /\\ str(A)
    """
    spend()
    if not is_of_strings(T):
        return (T,)
    T = push_negations_inwards(T)
    match T:
        case Join(parts):
            found = [one for part in parts for one in alternatives(part)]
            return tuple(dict.fromkeys(found))
        case Singleton(base, value):
            return tuple([Singleton(one, value) for one in alternatives(base)])
        case Meet(parts):
            choices = [_choices(part) for part in parts]
            if 1 < prod(map(len, choices)) <= ALTERNATIVES:
                found = [meet(*choice) for choice in product(*choices)]
                once = dict.fromkeys(one for U in found for one in alternatives(U))
                return tuple(once)
    return (T,)


def _choices(T: TypeNode) -> tuple[TypeNode, ...]:
    """The parts of a join in a meet, unless an automaton can follow the join itself."""
    return T.parts if isinstance(T, Join) and not is_regular(T) else (T,)


def is_regular(T: TypeNode) -> bool:
    """Is a type of strings decided event by event?

    It is not if a string as a whole has to be equal to another, or of a type that is
    not a type of strings.
    """
    spend()
    match T:
        case Str() | Plus():
            return True
        case Join(parts):
            return all(map(is_regular, parts))
        case Meet(parts):
            return any(map(is_regular, parts)) and all(
                map(_is_regular_or_denied, parts)
            )
    return False


def _is_regular_or_denied(T: TypeNode) -> bool:
    """Is a part of a meet regular, or the negation of a regular type?"""
    return is_regular(T.body if isinstance(T, Negation) else T)


def regular_above(T: TypeNode) -> TypeNode:
    """A regular type of strings above T: T without the parts that are not regular.

    >>> from ttr import Basic, Ind
    >>> print(regular_above(Str(Ind) & Basic("Short")))
    str(Ind)
    """
    spend()
    match T:
        case Meet(parts):
            kept = [part for part in parts if _is_regular_or_denied(part)]
            others = [p for p in parts if p not in kept and is_of_strings(p)]
            return meet(*kept, *map(regular_above, others))
        case Join(parts):
            return join(*map(regular_above, parts))
        case Singleton(base, _):
            return regular_above(base)
    return T
