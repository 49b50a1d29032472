"""Whether a judgement certainly holds, found without deriving why.

Update asks this of every rule and state, and mostly the answer is plain from the form
of the type. Law: `certainly(facts, a, T)` iff the derivation of a : T ends in [1, 1].
"""

from __future__ import annotations

from ttr.assignments import Assignment
from ttr.errors import Refused
from ttr.judging import derivation, reduced
from ttr.levels import why_outside
from ttr.objects import Unresolved
from ttr.paths import escaping
from ttr.probability import CERTAIN, REFUTED
from ttr.substitution import Around, grounded
from ttr.syntax import (
    Basic,
    ListOf,
    NonEmpty,
    Object,
    PType,
    Record,
    RecordType,
    Singleton,
    TypeNode,
    Universe,
    identity,
)

__all__ = ["certainly"]


def certainly(facts: Assignment, sit: Object, T: TypeNode) -> bool:
    """Whether sit : T is certain by the facts.

    >>> from ttr.constructors import rectype
    >>> from ttr.models import Model
    >>> from ttr.syntax import Ind, record
    >>> M = Model().given("a", Ind)
    >>> certainly(M.facts, record(x="a"), rectype(x=Ind))
    True
    """
    return _certain(facts, sit, T, ())


def _certain(facts: Assignment, sit: Object, T: TypeNode, around: Around) -> bool:
    match T:
        case RecordType(fields):
            if not isinstance(sit, Record):
                return False
            found = sit._fields
            if any(label not in found for label, _ in fields):
                return False
            inside = (found, *around)
            return all(_certain(facts, found[k], field, inside) for k, field in fields)
        case Singleton(base, value):
            wanted = _worked_out(facts, value, around)
            same = wanted is not None and identity(wanted) == identity(sit)
            return same and _certain(facts, sit, base, around)
        case ListOf(item):
            return isinstance(sit, tuple) and _each(facts, sit, item, around)
        case NonEmpty(item):
            there = isinstance(sit, tuple) and bool(sit)
            return there and _each(facts, sit, item, around)
        case Universe():
            return not why_outside(sit, T)
        case Basic():
            return _atom(facts, sit, T)
        case PType():
            ground = _worked_out(facts, T, around)
            return ground is not None and _atom(facts, sit, ground)
    return derivation(facts, sit, T, around).p == CERTAIN


def _each(facts: Assignment, sit: Object, item: TypeNode, around: Around) -> bool:
    return all(_certain(facts, element, item, around) for element in sit)


def _atom(facts: Assignment, sit: Object, T: Basic | PType) -> bool:
    """A judgement of an atom; one that is uncertain may yet follow from others."""
    p, _ = facts.degree_of(sit, T)
    if p in (CERTAIN, REFUTED):
        return p == CERTAIN
    return derivation(facts, sit, T).p == CERTAIN


def _worked_out(facts: Assignment, value: Object, around: Around) -> Object | None:
    """The value without paths and applications; None where it comes to nothing."""
    try:
        if escaping(value):
            value = grounded(value, around)
        return reduced(facts, value)
    except (Unresolved, Refused):
        return None
