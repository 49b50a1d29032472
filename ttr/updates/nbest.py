"""Uncertain events: alternatives with probabilities, as from a speech recogniser."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

from ttr.errors import UpdateError
from ttr.judging.certainty import is_certain
from ttr.judging.evaluator import derivation
from ttr.judging.models import Model
from ttr.probability import CERTAIN, REFUTED, Degree
from ttr.probability.degrees import ROUNDING, is_within
from ttr.types.objects import Object, Record, freeze
from ttr.types.printing import notation
from ttr.types.syntax import RecordType, Singleton, TypeNode
from ttr.updates.user_functions import excerpt


@dataclass(frozen=True)
class NBest:
    """Alternatives of which at most one happened, each with its probability.

    They add up to at most 1; the rest is the probability of something else. Built by
    `nbest`.

    >>> from ttr.updates import nbest
    >>> heard = nbest(("a cap", 0.2), ("a cup", 0.7))
    >>> [(event, p) for event, p in heard], isinstance(heard, NBest)
    ([('a cup', 0.7), ('a cap', 0.2)], True)
    """

    alternatives: tuple[tuple[Object, float], ...]

    def __post_init__(self) -> None:
        if not isinstance(self.alternatives, tuple | list):
            raise UpdateError(
                "an uncertain event is a list of alternatives, found "
                f"{excerpt(self.alternatives)}"
            )
        pairs = [_check_alternative(one) for one in self.alternatives]
        total = math.fsum(p for _, p in pairs)
        if total > 1.0 + ROUNDING:
            raise UpdateError(
                f"the probabilities of alternatives come to at most 1, found {total:g}"
            )
        if not pairs:
            raise UpdateError("an uncertain event has one alternative at least")
        best_first = tuple(sorted(pairs, key=lambda pair: -pair[1]))
        object.__setattr__(self, "alternatives", best_first)

    def __iter__(self) -> Iterator[tuple[Object, float]]:
        return iter(self.alternatives)

    def __str__(self) -> str:
        return " | ".join(f"{notation(event)} {p:g}" for event, p in self)


def nbest(*alternatives: tuple[object, float]) -> NBest:
    """An uncertain event: pairs of an event and its probability, in any order.

    Raises `UpdateError` for what is no probability, or if they add up to more than 1.

    >>> print(nbest(("e2", 0.3), ("e1", 0.6)))
    e1 0.6 | e2 0.3
    >>> nbest(("e1", 0.9), ("e2", 0.9))
    Traceback (most recent call last):
    ttr.errors.UpdateError: the probabilities of alternatives come to at most 1, ...
    """
    return NBest(alternatives)


def _check_alternative(one: object) -> tuple[Object, float]:
    match one:
        case (event, float() | int() as p) if 0.0 < p <= 1.0:
            return freeze(event), float(p)
    raise UpdateError(
        f"an alternative is an event and a probability above 0, found {excerpt(one)}"
    )


class MatchedEvent(NamedTuple):
    """What a rule takes of an event: the most probable alternative of its type.

    `p` is the probability that the event is of the type.
    """

    event: Object
    p: Degree


def match_event(
    event: Object | NBest, on: TypeNode, wanted: Degree, model: Model
) -> MatchedEvent | None:
    """The event as one of the type `on`; None if that is not as probable as wanted."""
    if not isinstance(event, NBest):
        if is_certain(model.facts, event, on):
            found = MatchedEvent(event, CERTAIN)
        elif wanted.lo == 1.0 or _plainly_lacks_labels(event, on):
            return None
        else:
            found = MatchedEvent(event, derivation(model.facts, event, on).p)
        return found if is_within(found.p, wanted) else None
    if wanted.lo == 1.0 and any(_plainly_lacks_labels(one, on) for one, _ in event):
        return None
    judged = [(one, q, _degree_of(one, on, model)) for one, q in event]
    fitting = [(one, q, p) for one, q, p in judged if p != REFUTED]
    if not fitting:
        return None
    best = max(fitting, key=lambda one: one[1] * one[2].lo)
    found = MatchedEvent(best[0], _total_degree([(q, p) for _, q, p in fitting]))
    return found if is_within(found.p, wanted) else None


def _plainly_lacks_labels(event: Object, on: TypeNode) -> bool:
    """Does an event plainly lack labels or names that the type asks for?

    This quick test excludes most events, as what is seen if something said is wanted.
    """
    if not isinstance(on, RecordType) or not isinstance(event, Record):
        return False
    found = event._fields
    return any(
        label not in found
        or (
            isinstance(field, Singleton)
            and isinstance(field.value, str)
            and field.value != found[label]
        )
        for label, field in on.fields
    )


def _total_degree(weighted: list[tuple[float, Degree]]) -> Degree:
    """The probability that any of several alternatives is the case."""
    lo, hi = (math.fsum(q * p[end] for q, p in weighted) for end in (0, 1))
    if lo > 1.0 - ROUNDING:
        return CERTAIN
    return Degree(lo, min(1.0, hi))


def _degree_of(event: Object, on: TypeNode, model: Model) -> Degree:
    if is_certain(model.facts, event, on):
        return CERTAIN
    return derivation(model.facts, event, on).p
