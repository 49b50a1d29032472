"""Uncertain events: what may have been heard, with probabilities."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

from ttr.errors import UpdateError
from ttr.judging.certainty import certainly
from ttr.judging.evaluator import derivation
from ttr.judging.models import Model
from ttr.probability import CERTAIN, REFUTED, Degree
from ttr.types.printing import notation
from ttr.types.syntax import Object, Record, RecordType, Singleton, TypeNode, freeze
from ttr.updates.user_functions import in_short

__all__ = ["Heard", "NBest", "heard", "nbest"]

TOLERANCE = 1e-9
"""How far a sum of probabilities may be off by rounding."""


@dataclass(frozen=True)
class NBest:
    """Alternatives of which at most one happened, each with its probability.

    What is missing to 1 is the probability that it was something else. Built by
    `nbest`, which says what is refused.
    """

    alternatives: tuple[tuple[Object, float], ...]

    def __post_init__(self) -> None:
        if not isinstance(self.alternatives, tuple | list):
            raise UpdateError(
                "an uncertain event is a list of alternatives, found "
                f"{in_short(self.alternatives)}"
            )
        pairs = [_pair(one) for one in self.alternatives]
        total = math.fsum(p for _, p in pairs)
        if total > 1.0 + TOLERANCE:
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
    """An uncertain event: pairs of an event and its probability, the best first.

    Raises `UpdateError` where the probabilities are none, or come to more than 1.

    >>> print(nbest(("e2", 0.3), ("e1", 0.6)))
    e1 0.6 | e2 0.3
    >>> nbest(("e1", 0.9), ("e2", 0.9))
    Traceback (most recent call last):
    ttr.errors.UpdateError: the probabilities of alternatives come to at most 1, ...
    """
    return NBest(alternatives)


def _pair(one: object) -> tuple[Object, float]:
    match one:
        case (event, float() | int() as p) if 0.0 < p <= 1.0:
            return freeze(event), float(p)
    raise UpdateError(
        f"an alternative is an event and a probability above 0, found {in_short(one)}"
    )


class Heard(NamedTuple):
    """What a rule takes of an event: the likeliest alternative of its type.

    `p` is how probable it is that the event is of the type.
    """

    event: Object
    p: Degree


def heard(
    event: Object | NBest, on: TypeNode, wanted: Degree, model: Model
) -> Heard | None:
    """The event as one of the type `on`, if it is one as probably as wanted."""
    if not isinstance(event, NBest):
        if certainly(model.facts, event, on):
            found = Heard(event, CERTAIN)
        elif wanted.lo == 1.0 or _is_other(event, on):
            return None
        else:
            found = Heard(event, derivation(model.facts, event, on).p)
        return found if _within(found.p, wanted) else None
    if wanted.lo == 1.0 and any(_is_other(one, on) for one, _ in event):
        return None
    judged = [(one, q, _degree(one, on, model)) for one, q in event]
    fitting = [(one, q, p) for one, q, p in judged if p != REFUTED]
    if not fitting:
        return None
    best = max(fitting, key=lambda one: one[1] * one[2].lo)
    found = Heard(best[0], _total([(q, p) for _, q, p in fitting]))
    return found if _within(found.p, wanted) else None


def _is_other(event: Object, on: TypeNode) -> bool:
    """Whether an event plainly lacks labels, or names, that the type asks for.

    It is quick, and mostly tells what was said from what was seen.
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


def _total(weighted: list[tuple[float, Degree]]) -> Degree:
    """The probability that one of several alternatives is so."""
    lo, hi = (math.fsum(q * p[end] for q, p in weighted) for end in (0, 1))
    if lo > 1.0 - TOLERANCE:
        return CERTAIN
    return Degree(lo, min(1.0, hi))


def _within(p: Degree, wanted: Degree) -> bool:
    return wanted.lo - TOLERANCE <= p.lo and p.hi <= wanted.hi + TOLERANCE


def _degree(event: Object, on: TypeNode, model: Model) -> Degree:
    if certainly(model.facts, event, on):
        return CERTAIN
    return derivation(model.facts, event, on).p
