"""Snapshots of states, which show whether a rule has tampered with one.

Records, lists and types cannot be changed by plain means; but a rule in Python may
change an object that it finds in a record, or the inside of the record.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from typing import TypeAlias

from ttr.types.objects import EventString, FiniteSet, Object, Record
from ttr.types.syntax import TypeNode

Snapshot: TypeAlias = "dict[str, Snapshot] | tuple[object, ...]"


def snapshot(value: Object) -> Snapshot:
    """What an object is made of now: a dictionary for a record, else a tuple.

    >>> from ttr import record
    >>> snapshot(record(x="a")) == snapshot(record(x="a"))
    True
    """
    match value:
        case Record():
            return {label: snapshot(inner) for label, inner in value._fields.items()}
        case tuple() | list():
            return (type(value), *map(snapshot, value))
        case FiniteSet() | EventString():
            return (type(value), *map(snapshot, value.items))
        case str() | int() | float() | None | TypeNode():
            return (type(value), value)
    return (type(value), id(value), *_contents(value))


def _contents(value: object) -> Iterator[object]:
    """What is in an object of another kind: its bytes, or its attributes.

    Attributes that are no plain collections count as the same while they are the same
    objects.
    """
    with suppress(TypeError):
        yield memoryview(value).tobytes()  # type: ignore[arg-type]
    for name, one in getattr(value, "__dict__", {}).items():
        yield name, _plain_value(one)


def _plain_value(value: object) -> object:
    match value:
        case list() | tuple():
            return (type(value), *map(_plain_value, value))
        case dict():
            return tuple((_plain_value(k), _plain_value(v)) for k, v in value.items())
        case set() | frozenset():
            return frozenset(map(_plain_value, value))
        case str() | int() | float() | None:
            return value
    return id(value)


def copy_of(value: Object) -> Object:
    """A copy of an object, in which all records are copies, too.

    >>> from ttr import record
    >>> r = record(x=record(y="a"))
    >>> copy_of(r) == r, copy_of(r).x is r.x
    (True, False)
    """
    if not isinstance(value, Record):
        return value
    return Record({label: copy_of(inner) for label, inner in value._fields.items()})


def first_change(before: Snapshot, value: Object) -> str:
    """The first path at which an object has changed since; empty if it has not."""
    return next(_changes(before, snapshot(value), ""), "")


def _changes(before: Snapshot, after: Snapshot, path: str) -> Iterator[str]:
    if before == after:
        return
    if not isinstance(before, dict) or not isinstance(after, dict):
        yield path or "the state itself"
        return
    for label in sorted({*before, *after}):
        inner = f"{path}.{label}" if path else label
        if label not in before or label not in after:
            yield inner
        else:
            yield from _changes(before[label], after[label], inner)
