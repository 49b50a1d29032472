"""Whether something is an information state, and still is one after a change."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from operator import is_

from ttr.errors import NoState, UpdateError
from ttr.judging.certainty import certainly, note
from ttr.judging.models import Model
from ttr.types.objects import lasts
from ttr.types.paths import escaping
from ttr.types.printing import notation
from ttr.types.syntax import ListOf, Object, Record, RecordType, TypeNode

__all__ = ["check_state", "still_of"]


def check_state(state: Object, type: RecordType, model: Model, when: str) -> None:
    """Refuses what is not certainly a state of its type, and says where it fails."""
    if not isinstance(type, RecordType):
        raise UpdateError(f"the type of a state is a record type, found {type!r}")
    if not isinstance(state, Record):
        raise NoState(f"{when} the state is no record, but {notation(state)}")
    if certainly(model.facts, state, type):
        return
    why = model.judge(state, type).why
    failed = why.failure()
    if failed is not None:
        claim = f"{notation(failed.sit)} : {failed.type}, {failed.because}"
        raise NoState(f"{when} the state is not of its type, at {why.path()}: {claim}")


def still_of(before: Record, after: Record, T: RecordType, model: Model) -> bool:
    """Whether a record is of T where another one is, in the same model.

    What is the same object in both, cannot have changed inside, and is of a type that
    mentions nothing else, need not be judged again.
    """
    if _depends(T):
        return False
    was, found = before._fields, after._fields
    keeps = _keeps(before, model)
    for label, field in T.fields:
        had, has = was[label], found.get(label, _NOTHING)
        if had is has and keeps:
            continue
        if has is _NOTHING or not _part_still_of(had, has, field, model):
            return False
    note(model.facts, after, T)
    return True


_NOTHING = object()
"""What a record has at a label that it lacks."""


@lru_cache(4096)
def _depends(T: RecordType) -> bool:
    """Whether what is in one field depends on what is in another, or further out."""
    return any(escaping(field) for _, field in T.fields)


def _part_still_of(was: Object, found: Object, T: TypeNode, model: Model) -> bool:
    if was is found:
        return _keeps(found, model) or certainly(model.facts, found, T)
    if isinstance(T, RecordType):
        if isinstance(was, Record) and isinstance(found, Record):
            return still_of(was, found, T, model)
    elif isinstance(T, ListOf) and isinstance(found, tuple) and _keeps(was, model):
        new = _new_in(found, was)
        return all(certainly(model.facts, element, T.item) for element in new)
    return certainly(model.facts, found, T)


def _keeps(value: Object, model: Model) -> bool:
    """Whether what a value is of cannot change while it is the same object.

    Facts are about objects as such; only witness functions look into them.
    """
    return not model.facts.functions or lasts(value)


def _new_in(found: tuple[Object, ...], was: tuple[Object, ...]) -> Sequence[Object]:
    """The elements of a list that another one does not have, and perhaps some more.

    A list is mostly longer or shorter at one end.
    """
    if all(map(is_, found, was)):
        return found[len(was) :]
    if all(map(is_, reversed(found), reversed(was))):
        return found[: max(0, len(found) - len(was))]
    known = set(map(id, was))
    return [element for element in found if id(element) not in known]
