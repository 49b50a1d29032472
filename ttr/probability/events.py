"""Events: conditions on judgements that may or may not hold.

The atoms are judgements of an object and a basic type or ptype. An event is made of
atoms by `All`, `AnyOf` and `Not`.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from ttr.probability.degrees import CERTAIN, REFUTED, Degree
from ttr.safety.budgets import spend


@dataclass(frozen=True, slots=True)
class Atomic:
    """An atom, and how probable it is.

    >>> from ttr.probability import chance
    >>> print(chance(Atomic("rain", Degree(0.2, 0.3))).p)
    [0.2, 0.3]
    """

    atom: Hashable
    p: Degree


@dataclass(frozen=True, slots=True)
class All:
    """All of the events.

    >>> from ttr.probability import chance
    >>> a, b = Atomic("a", Degree(0.5, 0.5)), Atomic("b", Degree(0.5, 0.5))
    >>> print(chance(All((a, b))).p)
    0.25
    """

    parts: tuple[Event, ...]


@dataclass(frozen=True, slots=True)
class AnyOf:
    """At least one of the events.

    >>> from ttr.probability import chance
    >>> a, b = Atomic("a", Degree(0.5, 0.5)), Atomic("b", Degree(0.5, 0.5))
    >>> print(chance(AnyOf((a, b))).p)
    0.75
    """

    parts: tuple[Event, ...]


@dataclass(frozen=True, slots=True)
class Not:
    """The event does not happen.

    >>> from ttr.probability import chance
    >>> print(chance(Not(Atomic("rain", Degree(0.25, 0.5)))).p)
    [0.5, 0.75]
    """

    part: Event


Event: TypeAlias = Atomic | All | AnyOf | Not
"""An atom, or what is made of events by `All`, `AnyOf` and `Not`.

>>> from ttr.probability import AnyOf, Atomic, Event, Not, chance, degree
>>> rain = Atomic("rain", degree(0.3))
>>> event: Event = AnyOf((rain, Not(rain)))
>>> print(chance(event).p)
1
"""

Truth: TypeAlias = Mapping[Hashable, bool]
"""Which atoms hold, and which do not."""

SURE, NEVER = All(()), AnyOf(())


def atoms(event: Event) -> Iterator[Atomic]:
    """The atoms, as often as they occur."""
    for one, _ in signs(event):
        yield one


def signs(event: Event) -> Iterator[tuple[Atomic, bool]]:
    """The atoms as often as they occur, and whether the event rises with them."""
    waiting = [(event, True)]
    while waiting:
        one, sign = waiting.pop()
        match one:
            case Atomic():
                yield one, sign
            case Not(part):
                waiting.append((part, not sign))
            case All(parts) | AnyOf(parts):
                waiting += [(part, sign) for part in parts]


def simplify(event: Event, truth: Truth) -> Event:
    """What is left of an event when some atoms hold or fail.

    >>> a, b = Atomic("a", Degree(0.5, 0.5)), Atomic("b", Degree(0.4, 0.4))
    >>> simplify(All((a, b)), {"a": True})
    Atomic(atom='b', p=Degree(lo=0.4, hi=0.4))
    >>> simplify(All((a, b)), {"a": False})
    AnyOf(parts=())
    """
    spend()
    match event:
        case Atomic(atom, p):
            if atom in truth:
                return SURE if truth[atom] else NEVER
            if p == CERTAIN:
                return SURE
            return NEVER if p == REFUTED else event
        case Not(part):
            return _negate(simplify(part, truth))
        case All(parts):
            return _join(All, SURE, NEVER, parts, truth)
        case AnyOf(parts):
            return _join(AnyOf, NEVER, SURE, parts, truth)


def _negate(event: Event) -> Event:
    match event:
        case Not(part):
            return part
        case All(()):
            return NEVER
        case AnyOf(()):
            return SURE
    return Not(event)


def _join(
    kind: type[All] | type[AnyOf],
    empty: Event,
    decisive: Event,
    parts: tuple[Event, ...],
    truth: Truth,
) -> Event:
    """The simplified parts, with parts of the same kind inside them taken out."""
    spend()
    kept: list[Event] = []
    for part in parts:
        left = simplify(part, truth)
        if left == decisive:
            return decisive
        kept += left.parts if isinstance(left, kind) else [left]
    kept = list(dict.fromkeys(kept))
    if not kept:
        return empty
    return kept[0] if len(kept) == 1 else kind(tuple(kept))


def substitute(event: Event, by: Mapping[Hashable, Event]) -> Event:
    """The event with other events in place of some atoms.

    >>> a, b = Atomic("a", Degree(0.5, 0.5)), Atomic("b", Degree(0.4, 0.4))
    >>> substitute(Not(a), {"a": b}) == Not(b)
    True
    """
    spend()
    match event:
        case Atomic(atom):
            return by.get(atom, event)
        case Not(part):
            return Not(substitute(part, by))
        case All(parts) | AnyOf(parts):
            return type(event)(tuple([substitute(part, by) for part in parts]))


def meets(case: Truth, given: Truth, others: Sequence[Event] = ()) -> bool:
    """Does a case agree with what is given, and do the other events happen in it?

    >>> a, b = Atomic("a", Degree(0.5, 0.5)), Atomic("b", Degree(0.4, 0.4))
    >>> meets({"a": True, "b": False}, {"a": True}, [AnyOf((a, b)), Not(b)])
    True
    """
    return all(case[atom] == so for atom, so in given.items()) and all(
        simplify(one, case) == SURE for one in others
    )


def literals(event: Event) -> dict[Hashable, bool] | None:
    """The atoms of a conjunction of literals, and their signs; None for other events.

    >>> a, b = Atomic("a", Degree(0.5, 0.5)), Atomic("b", Degree(0.4, 0.4))
    >>> literals(All((a, Not(b))))
    {'a': True, 'b': False}
    >>> literals(AnyOf((a, b))), literals(All((a, Not(a))))
    (None, None)
    """
    found: dict[Hashable, bool] = {}
    waiting = [(event, True)]
    while waiting:
        one, sign = waiting.pop()
        match one:
            case Atomic(atom):
                if found.setdefault(atom, sign) != sign:
                    return None
            case Not(part):
                waiting.append((part, not sign))
            case All(parts) | AnyOf(parts):
                if isinstance(one, All) != sign and len(parts) != 1:
                    return None
                waiting += [(part, sign) for part in reversed(parts)]
    return found
