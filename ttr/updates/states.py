"""Checking that something is an information state, and still is one after a change."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from operator import is_

from ttr.errors import NoStateError, UpdateError
from ttr.judging.certainty import is_certain, remember_certain
from ttr.judging.models import Model
from ttr.types.objects import Object, Record, is_immutable
from ttr.types.paths import free_paths
from ttr.types.printing import notation
from ttr.types.syntax import ListOf, RecordType, TypeNode


def check_state(state: Object, type: RecordType, model: Model, when: str) -> None:
    """Check that a state certainly is of its type.

    Raises `NoStateError` if it is not, and says where it fails; `UpdateError` for what
    is no record type.
    """
    if not isinstance(type, RecordType):
        raise UpdateError(f"the type of a state is a record type, found {type!r}")
    if not isinstance(state, Record):
        raise NoStateError(f"{when} the state is no record, but {notation(state)}")
    if is_certain(model.facts, state, type):
        return
    why = model.judge(state, type).why
    failed = why.failure()
    if failed is not None:
        claim = f"{notation(failed.sit)} : {failed.type}, {failed.because}"
        raise NoStateError(
            f"{when} the state is not of its type, at {why.path()}: {claim}"
        )


def is_still_of(before: Record, after: Record, T: RecordType, model: Model) -> bool:
    """Is a record of T, given that another one is, in the same model?

    A field need not be judged again if it has the same object in both records, the
    object cannot have changed inside, and its type depends on no other field.
    """
    if not _are_fields_still_of(before, after, T, model):
        return False
    remember_certain(model.facts, after, T)
    return True


def _are_fields_still_of(
    before: Record, after: Record, T: RecordType, model: Model
) -> bool:
    if _has_dependent_fields(T):
        return False
    was, found = before._fields, after._fields
    keeps = _cannot_change(before, model)
    for label, field in T.fields:
        had, has = was[label], found.get(label, _NOTHING)
        if had is has and keeps:
            continue
        if has is _NOTHING or not _is_part_still_of(had, has, field, model, keeps):
            return False
    return True


_NOTHING = object()
"""The value of a label that a record lacks."""


@lru_cache(4096)
def _has_dependent_fields(T: RecordType) -> bool:
    """Does the type of any field depend on another field, or on paths out of T?"""
    return any(free_paths(field) for _, field in T.fields)


def _is_part_still_of(
    was: Object, found: Object, T: TypeNode, model: Model, keeps: bool
) -> bool:
    """Is a part of a record still of its type? If it `keeps`, it cannot change."""
    if was is found:
        return _cannot_change(found, model) or is_certain(model.facts, found, T)
    if isinstance(T, RecordType):
        if isinstance(was, Record) and isinstance(found, Record):
            return _are_fields_still_of(was, found, T, model)
    elif (
        isinstance(T, ListOf)
        and isinstance(found, tuple)
        and (keeps or _cannot_change(was, model))
    ):
        new = tuple(_possibly_new_elements(found, was))
        return not new or is_certain(model.facts, new, T)
    return is_certain(model.facts, found, T)


def _cannot_change(value: Object, model: Model) -> bool:
    """Does the same object always stay of the same types?

    Facts are about objects as such; only witness functions look inside them.
    """
    return not model.facts.functions or is_immutable(value)


def _possibly_new_elements(
    found: tuple[Object, ...], was: tuple[Object, ...]
) -> Sequence[Object]:
    """The elements of a list that another one lacks, and perhaps some more.

    Most lists grow or shrink at one end.
    """
    if all(map(is_, found, was)):
        return found[len(was) :]
    if all(map(is_, reversed(found), reversed(was))):
        return found[: max(0, len(found) - len(was))]
    known = set(map(id, was))
    return [element for element in found if id(element) not in known]
