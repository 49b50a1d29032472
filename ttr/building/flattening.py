"""Nested records on one level, and back: bg.x becomes the label bg__x."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any, TypeVar

from ttr.building.field_addresses import (
    Address,
    format_address,
    to_absolute,
    to_relative,
)
from ttr.errors import IllFormedError
from ttr.safety.budgets import spend, within_budget
from ttr.types.derived_types import order_fields
from ttr.types.objects import Object, Path, Record, check_label
from ttr.types.paths import replace_paths
from ttr.types.syntax import RecordType, TypeNode, kind_of

_Shape = TypeVar("_Shape", RecordType, Record)


# --- flat ----------------------------------------------------------------------------


@within_budget
def flatten(
    value: _Shape, like: RecordType | None = None, /, sep: str = "__"
) -> _Shape:
    """The fields of nested record types, or of nested records, on one level.

    A field at the path bg.x gets the label bg__x, and paths follow. A record is taken
    apart wherever it holds a record with labels, or only where the record type `like`
    has a record type with fields. Raises `IllFormedError` where a joined label could be
    taken apart in another way, where something is said of a nested record as a whole,
    and where a record lacks what `like` has.
    Law: r : T iff flatten(r, T) : flatten(T), and unflatten(flatten(r)) == r.

    >>> from ttr import Ind, Pred, outer, record, rectype, this
    >>> hug = Pred("hug", Ind, Ind)
    >>> T = rectype(bg=rectype(x=Ind, e=hug(outer.y, this.x)), y=Ind)
    >>> print(flatten(T))
    [bg__x : Ind, y : Ind, bg__e : hug(y, bg__x)]
    >>> print(flatten(record(bg={"x": "fido"}, y="sam")))
    {bg__x = fido, y = sam}
    """
    if isinstance(value, Record):
        parts = _all_parts(value, ()) if like is None else _parts_like(like, value, ())
        return Record({_join_labels(at, sep): part for at, part in parts})
    if isinstance(value, RecordType):
        return _flatten_type(value, sep)
    raise _wrong_argument("flatten", value)


def _flatten_type(T: RecordType, sep: str) -> RecordType:
    leaves = dict(_leaves(T, ()))
    fields: dict[str, TypeNode] = {}
    for at, field in leaves.items():
        follow = partial(_flat_path, at=at, leaves=leaves, sep=sep)
        fields[_join_labels(at, sep)] = replace_paths(field, follow)
    return RecordType(order_fields(fields))


def _leaves(T: RecordType, at: Address) -> Iterator[tuple[Address, TypeNode]]:
    """The fields that are not record types with fields, each with its address."""
    spend((1 + len(at) // 4) * len(T.fields))
    for label, field in T.fields:
        if isinstance(field, RecordType) and field.fields:
            yield from _leaves(field, (*at, label))
        else:
            yield (*at, label), field


def _flat_path(
    path: Path, at: Address, leaves: Mapping[Address, TypeNode], sep: str
) -> Path:
    """A path in the field at an address, as it is written in the flat type."""
    found = to_absolute(path, at[:-1])
    if found.up > 0:
        return found
    for size in range(1, len(found.labels) + 1):
        if found.labels[:size] in leaves:
            label = _join_labels(found.labels[:size], sep)
            return Path(0, (label, *found.labels[size:]))
    whole = format_address(found.labels)
    raise IllFormedError(
        f"{whole} cannot be flattened: {format_address(at)} is about {whole} as a whole"
    )


def _all_parts(r: Record, at: Address) -> Iterator[tuple[Address, Object]]:
    """The addresses and values in a record, and in the nonempty records inside it."""
    spend()
    for label, value in r._fields.items():
        if isinstance(value, Record) and len(value) > 0:
            yield from _all_parts(value, (*at, label))
        else:
            yield (*at, label), value


def _parts_like(
    T: RecordType, value: Object, at: Address
) -> Iterator[tuple[Address, Object]]:
    """The addresses and values in a record, nested wherever T has a record type."""
    spend()
    labels = value._fields if isinstance(value, Record) else {}
    for label, field in T.fields:
        if label not in labels:
            there = format_address((*at, label))
            raise IllFormedError(f"there is no {there} in the record, but {T} has one")
        if isinstance(field, RecordType) and field.fields:
            yield from _parts_like(field, labels[label], (*at, label))
        else:
            yield (*at, label), labels[label]
    for label in labels:
        if label not in T:
            yield (*at, label), labels[label]


def _join_labels(at: Address, sep: str) -> str:
    """One label for an address; refuses one that would split in another way."""
    _check_separator(sep)
    label = sep.join(at)
    check_label(label)
    if _split_label(label, sep) == at:
        return label
    raise IllFormedError(
        f"{format_address(at)} cannot become the label {label}, which reads as "
        f"{format_address(_split_label(label, sep))}",
        hint='give another separator, as in flatten(T, sep="_in_")',
    )


def _split_label(label: str, sep: str) -> Address:
    _check_separator(sep)
    return tuple(label.split(sep))


def _check_separator(sep: object) -> None:
    if not isinstance(sep, str) or not sep or not f"a{sep}".isidentifier():
        raise IllFormedError(f"a separator is a part of an identifier, found {sep!r}")


# --- nested --------------------------------------------------------------------------


@within_budget
def unflatten(value: _Shape, sep: str = "__") -> _Shape:
    """The record type or record that flattens to this one.

    A label bg__x becomes the label x inside bg, and paths follow. Raises
    `IllFormedError` for a label that cannot be taken apart, and for one that is taken
    apart while its first part is a label as well.
    Law: flatten(unflatten(T)) is T, and the same for records.

    >>> from ttr import Ind, Pred, rectype, this
    >>> print(unflatten(rectype(bg__x=Ind, bg__c=Pred("dog", Ind)(this.bg__x))))
    [bg : [x : Ind, c : dog(x)]]
    """
    if isinstance(value, Record):
        return _record(_build_tree(value._fields, sep))
    if not isinstance(value, RecordType):
        raise _wrong_argument("unflatten", value)
    fields: dict[str, TypeNode] = {}
    for label, field in value.fields:
        scope = _split_label(label, sep)[:-1]
        follow = partial(_nested_path, scope=scope, flat=value, sep=sep)
        fields[label] = replace_paths(field, follow)
    return _record_type(_build_tree(fields, sep))


def _nested_path(path: Path, scope: Address, flat: RecordType, sep: str) -> Path:
    """A path in a field of a flat type, as it is written in the nested one."""
    first, *rest = path.labels
    if path.up == 0 and first in flat:
        path = Path(0, (*_split_label(first, sep), *rest))
    return to_relative(path, scope)


_Tree = dict[str, Any]
"""Labels with what they have: a field, or a tree again."""


def _build_tree(fields: Mapping[str, Object], sep: str) -> _Tree:
    tree: _Tree = {}
    for label, inside in fields.items():
        *around, last = _split_label(label, sep)
        here = tree
        for part in around:
            check_label(part)
            here = here.setdefault(part, {})
            if not isinstance(here, dict):
                raise _label_clash(label, sep)
        check_label(last)
        if last in here:
            raise _label_clash(label, sep)
        here[last] = inside
    return tree


def _label_clash(label: str, sep: str) -> IllFormedError:
    path = format_address(_split_label(label, sep))
    return IllFormedError(
        f"{label} cannot become {path}: one of its parts is also a field"
    )


def _record(tree: _Tree) -> Record:
    spend()
    return Record(
        {k: _record(v) if isinstance(v, dict) else v for k, v in tree.items()}
    )


def _record_type(tree: _Tree) -> RecordType:
    spend()
    return RecordType(
        order_fields(
            {k: _record_type(v) if isinstance(v, dict) else v for k, v in tree.items()}
        )
    )


def _wrong_argument(what: str, value: object) -> IllFormedError:
    return IllFormedError(
        f"{what} takes a record type or a record, found {kind_of(value)}"
    )
