"""Whether a judgement certainly holds, found without deriving why.

Update asks this of every rule and state, and mostly the answer is plain from the form
of the type. Law: `certainly(facts, a, T)` iff the derivation of a : T ends in [1, 1].
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from operator import is_
from typing import TypeAlias
from weakref import ref

from ttr.computing.universe_levels import why_outside
from ttr.errors import Refused
from ttr.judging.assignments import Assignment
from ttr.judging.evaluator import derivation, reduced, stands
from ttr.judging.rule_index import Sieve, demands_of
from ttr.probability import CERTAIN, REFUTED
from ttr.types.objects import Unresolved, lasts
from ttr.types.paths import escaping, occurring
from ttr.types.substitution import Around, grounded
from ttr.types.syntax import (
    Basic,
    Join,
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

__all__ = ["certainly", "certainly_also", "note"]


def certainly(facts: Assignment, sit: Object, T: TypeNode) -> bool:
    """Whether sit : T is certain by the facts.

    >>> from ttr.building.constructors import rectype
    >>> from ttr.judging.models import Model
    >>> from ttr.types.syntax import Ind, record
    >>> M = Model().given("a", Ind)
    >>> certainly(M.facts, record(x="a"), rectype(x=Ind))
    True
    """
    return _certain(facts, sit, T, ())


def certainly_also(
    facts: Assignment, sit: Object, T: TypeNode, known: TypeNode
) -> bool:
    """Whether sit : T is certain by the facts, by which it certainly is of `known`.

    What the known type says is not judged again. Law: where sit : known is certain,
    the answer is that of `certainly`.

    >>> from ttr.judging.models import Model
    >>> from ttr.types.syntax import Ind
    >>> M = Model().given("a", Ind)
    >>> certainly_also(M.facts, ("a", "a"), NonEmpty(Ind), ListOf(Ind))
    True
    """
    if T is known:
        return True
    claims = _claims(T, known)
    if claims is None:
        return _also(facts, sit, T, known, ())
    for labels, claim, given in claims:
        value = sit
        for label in labels:
            value = value._fields.get(label, _NOTHING)
        if value is _NOTHING:
            return False
        if given is None:
            if not _certain(facts, value, claim, ()):
                return False
        elif not _also(facts, value, claim, given, ()):
            return False
    return True


_NOTHING = object()
"""What is at a label that a record lacks."""

Claims: TypeAlias = tuple[tuple[tuple[str, ...], TypeNode, TypeNode | None], ...]
"""What is claimed at which path, and what is known of what is there."""


@lru_cache(4096)
def _claims(T: TypeNode, known: TypeNode) -> Claims | None:
    """What T says that the known type does not, path by path.

    None where it is no matter of paths: one of the two is no record type, or a field of
    T depends on what is around it.
    """
    if not isinstance(T, RecordType) or not isinstance(known, RecordType):
        return None
    found: list[tuple[tuple[str, ...], TypeNode, TypeNode | None]] = []
    for label, field in T.fields:
        given = known.get(label)
        if given is field:
            continue
        if escaping(field):
            return None
        inner = None if given is None else _claims(field, given)
        if inner is None:
            found.append(((label,), field, given))
        else:
            found += [((label, *path), claim, of) for path, claim, of in inner]
    return tuple(found)


def _also(
    facts: Assignment, sit: Object, T: TypeNode, known: TypeNode, around: Around
) -> bool:
    if T is known:
        return True
    if isinstance(T, RecordType) and isinstance(known, RecordType):
        return _fields_also(facts, sit, _telling_first(T), known, around)
    if isinstance(T, Singleton):
        return _is_value(facts, sit, T, around) and _also(
            facts, sit, T.base, known, around
        )
    lists = ListOf, NonEmpty
    if isinstance(T, lists) and isinstance(known, lists) and T.item is known.item:
        return bool(sit) or isinstance(T, ListOf)
    return _certain(facts, sit, T, around)


def _fields_also(
    facts: Assignment,
    sit: Record,
    fields: tuple[tuple[str, TypeNode], ...],
    known: RecordType,
    around: Around,
) -> bool:
    found = sit._fields
    inside = (found, *around)
    types = known._types
    for label, field in fields:
        if label not in found:
            return False
        given = types.get(label)
        if given is field:
            continue
        if given is None:
            if not _certain(facts, found[label], field, inside):
                return False
        elif not _also(facts, found[label], field, given, inside):
            return False
    return True


def _certain(facts: Assignment, sit: Object, T: TypeNode, around: Around) -> bool:
    plain = _PLAIN.get(type(T))
    if plain is not None:
        return plain(facts, sit, T, around)
    return derivation(facts, sit, T, around).p == CERTAIN


def _record(facts: Assignment, sit: Object, T: RecordType, around: Around) -> bool:
    if not isinstance(sit, Record):
        return False
    if _is_noted(facts, sit, T):
        return True
    found = sit._fields
    inside = (found, *around)
    for label, field in _telling_first(T):
        if label not in found or not _certain(facts, found[label], field, inside):
            return False
    note(facts, sit, T)
    return True


@lru_cache(4096)
def _telling_first(T: RecordType) -> tuple[tuple[str, TypeNode], ...]:
    """The fields, those first in which records are most likely to differ.

    What is of which basic type is mostly the same, but not which predicate is true.
    """
    return tuple(sorted(T.fields, key=lambda field: not isinstance(field[1], PType)))


# --- what need not be judged twice ---------------------------------------------------


Grounds: TypeAlias = tuple[object, ...]
"""Witness functions, and what was told of some basic types: as long as these are the
same objects, the same is of types made of them."""


def note(facts: Assignment, sit: Record, T: RecordType) -> None:
    """Notes that a record is certainly of T, so that it need not be judged again."""
    basics = _basics(T)
    if basics is None or not lasts(sit) or not _alone(facts, basics):
        return
    noted = sit._noted
    if noted is None:
        noted = {}
        object.__setattr__(sit, "_noted", noted)
    noted[T] = _grounds(facts, basics)


def _is_noted(facts: Assignment, sit: Record, T: RecordType) -> bool:
    noted = sit._noted
    grounds = noted.get(T) if noted is not None else None
    if grounds is None:
        return False
    functions, *told = grounds
    if functions() is not facts.functions:
        return False
    basics = _basics(T) or ()
    now = map(facts.told.get, basics)
    return all(map(is_, told, now)) and _alone(facts, basics)


def _grounds(facts: Assignment, basics: tuple[Basic, ...]) -> Grounds:
    return (ref(facts.functions), *map(facts.told.get, basics))


def _alone(facts: Assignment, basics: tuple[Basic, ...]) -> bool:
    """Whether nothing but what was told and seen says what is of these types."""
    return facts.theory.axiom_heads.isdisjoint(basics)


@lru_cache(4096)
def _basics(T: RecordType) -> tuple[Basic, ...] | None:
    """The basic types in a type of lists, records and universes; None for another.

    Its fields may be set to names, and to lists of names.
    """
    within = (Basic, Universe, ListOf, RecordType, Singleton, str, tuple)
    found = list(occurring([T]))
    if not all(isinstance(part, within) for part in found):
        return None
    return tuple(part for part in found if isinstance(part, Basic))


def _singleton(facts: Assignment, sit: Object, T: Singleton, around: Around) -> bool:
    return _is_value(facts, sit, T, around) and _certain(facts, sit, T.base, around)


def _is_value(facts: Assignment, sit: Object, T: Singleton, around: Around) -> bool:
    value = T.value
    if isinstance(value, str):
        return value is sit or value == sit
    if value is sit and stands(T):
        return True
    wanted = _worked_out(facts, value, around)
    return wanted is not None and (
        wanted is sit or bool(identity(wanted) == identity(sit))
    )


def _list(facts: Assignment, sit: Object, T: ListOf | NonEmpty, around: Around) -> bool:
    if not isinstance(sit, tuple) or (not sit and isinstance(T, NonEmpty)):
        return False
    return all(_certain(facts, element, T.item, around) for element in sit)


def _universe(facts: Assignment, sit: Object, T: Universe, around: Around) -> bool:
    return not why_outside(sit, T)


def _basic(facts: Assignment, sit: Object, T: Basic, around: Around) -> bool:
    return _atom(facts, sit, T)


def _ptype(facts: Assignment, sit: Object, T: PType, around: Around) -> bool:
    if not facts.can_be(sit, T.pred):
        return False
    ground = _worked_out(facts, T, around)
    return ground is not None and _atom(facts, sit, ground)


def _join(facts: Assignment, sit: Object, T: Join, around: Around) -> bool:
    """One certain part is enough; uncertain ones may be certain together."""
    left = _sieve(T).left(sit, facts)
    possible = [T.parts[n] for n in left if not _excluded(facts, sit, T.parts[n])]
    if len(possible) < 2:
        return any(_certain(facts, sit, part, around) for part in possible)
    return (
        any(_certain(facts, sit, part, around) for part in possible)
        or derivation(facts, sit, T, around).p == CERTAIN
    )


@lru_cache(4096)
def _sieve(T: Join) -> Sieve:
    """What leaves out the parts of a join that something cannot be of."""
    return Sieve(map(demands_of, T.parts))


def _excluded(facts: Assignment, sit: Object, T: TypeNode) -> bool:
    """Whether sit plainly cannot be of T; where this says no, it may be or not."""
    if isinstance(T, PType):
        return not facts.can_be(sit, T.pred)
    if not isinstance(T, RecordType):
        return False
    if not isinstance(sit, Record):
        return True
    found = sit._fields
    return any(
        label not in found or _excluded(facts, found[label], field)
        for label, field in _telling_first(T)
    )


_PLAIN: dict[type[TypeNode], Callable[..., bool]] = {
    RecordType: _record,
    Join: _join,
    Singleton: _singleton,
    ListOf: _list,
    NonEmpty: _list,
    Universe: _universe,
    Basic: _basic,
    PType: _ptype,
}
"""What decides for types of which the form is enough to tell."""


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
