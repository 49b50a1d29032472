"""The known witnesses of a type: who, by what was told, certainly is of it."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

from ttr.assignments import Assignment
from ttr.errors import Unsupported
from ttr.judging import derivation, reduced
from ttr.objects import Unresolved
from ttr.probability import CERTAIN
from ttr.substitution import grounded
from ttr.syntax import (
    Application,
    Basic,
    EventString,
    Join,
    Meet,
    Object,
    PType,
    Record,
    RecordType,
    Singleton,
    Str,
    TypeNode,
    identity,
)

__all__ = ["witnesses"]


def witnesses(facts: Assignment, T: TypeNode) -> Iterator[Object]:
    """The known objects that certainly are of T, each once, in the order told.

    T has no paths that escape it. Raises `Unsupported` where there may be others
    without end: lists, sets, functions, types, and what something is not of.
    """
    match T:
        case Basic() | PType():
            yield from facts.witnesses(T)
        case Singleton(_, value):
            value = reduced(facts, value)
            if _is_of(facts, value, T):
                yield value
        case Join(parts):
            found = [sit for part in parts for sit in witnesses(facts, part)]
            yield from {identity(sit): sit for sit in found}.values()
        case Meet(parts):
            source = next(filter(_is_listed, parts), parts[0])
            known = witnesses(facts, source)
            yield from (sit for sit in known if _is_of(facts, sit, T))
        case Str(items):
            choices = [tuple(witnesses(facts, item)) for item in items]
            yield from (EventString(*events) for events in product(*choices))
        case RecordType():
            yield from map(Record, _filled(facts, T))
        case Application():
            value = reduced(facts, T)
            if isinstance(value, TypeNode):
                yield from witnesses(facts, value)
        case _:
            raise Unsupported(
                f"what is of {T} cannot be listed, as there may be no end of it",
                hint="judge an object, or create a witness",
            )


def _is_of(facts: Assignment, sit: Object, T: TypeNode) -> bool:
    return derivation(facts, sit, T).p == CERTAIN


def _is_listed(T: TypeNode) -> bool:
    return isinstance(T, Basic | PType | Singleton | RecordType | Str)


def _filled(facts: Assignment, T: RecordType) -> Iterator[dict[str, Object]]:
    """The ways to fill the fields, one after the other; without recursion."""
    labels = T.labels
    waiting: list[Iterator[dict[str, Object]]] = [iter(({},))]
    while waiting:
        fields = next(waiting[-1], None)
        if fields is None:
            waiting.pop()
        elif len(fields) == len(labels):
            yield fields
        else:
            waiting.append(_next(facts, T, labels[len(fields)], fields))


def _next(
    facts: Assignment, T: RecordType, label: str, fields: dict[str, Object]
) -> Iterator[dict[str, Object]]:
    """The fields with each witness of the next one, given those before it."""
    try:
        field = grounded(T[label], (fields,))
    except Unresolved as unresolved:
        raise Unsupported(
            f"the records of {T} cannot be listed: {unresolved.message}",
            hint="fields on a cycle can be judged, but not listed",
        ) from None
    yield from ({**fields, label: sit} for sit in witnesses(facts, field))
