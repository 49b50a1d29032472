"""Subtraction: a record type or a record without what a path leads to."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeVar

from ttr.building.field_addresses import Address, format_address, parse_address
from ttr.building.well_formedness import check_record_type
from ttr.errors import IllFormedError, suggestion
from ttr.safety.budgets import spend, within_budget
from ttr.signature.signature import Signature
from ttr.types.derived_types import order_fields
from ttr.types.objects import Object, Record
from ttr.types.paths import subterms
from ttr.types.syntax import Meet, RecordType, TypeNode, kind_of, meet

_Shape = TypeVar("_Shape", RecordType, Record)


@within_budget
def subtract(value: _Shape, /, *paths: str, theory: Signature | None = None) -> _Shape:
    """T ⊖ π: the record type or record without what these paths lead to.

    Raises `IllFormedError` for a path that is not there, and where another field would
    then have a path that leads nowhere; several paths are taken away at once.
    Law: T <= subtract(T, π).

    >>> from ttr import Ind, Pred, rectype, this
    >>> T = rectype(x=Ind, y=Ind, e=Pred("hug", Ind, Ind)(this.x, this.y))
    >>> print(subtract(T, "e"))
    [x : Ind, y : Ind]
    >>> subtract(T, "y")
    Traceback (most recent call last):
    ttr.errors.IllFormedError: without y, the path y leads nowhere: ...
    >>> print(subtract(T, "y", "e"))
    [x : Ind]
    """
    addresses = [parse_address(path, "subtract") for path in paths]
    if isinstance(value, Record):
        for labels in addresses:
            value = _remove_from_record(value, labels, ())
        return value
    if not isinstance(value, RecordType):
        raise IllFormedError(
            f"subtract takes a record type or a record, found {kind_of(value)}"
        )
    for labels in addresses:
        value = _remove(value, labels, ())
    return _check_result(value, paths, theory)


def _remove(T: RecordType, labels: Address, around: Address) -> RecordType:
    spend()
    label, *rest = labels
    here = (*around, label)
    if label not in T:
        raise _missing_path(here, T)
    fields = dict(T.fields)
    if rest:
        fields[label] = _remove_inside(fields[label], tuple(rest), here)
    else:
        del fields[label]
    return RecordType(order_fields(fields))


def _remove_inside(T: TypeNode, labels: Address, at: Address) -> TypeNode:
    spend()
    match T:
        case RecordType():
            return _remove(T, labels, at)
        case Meet(parts):
            having = [p for p in parts if isinstance(p, RecordType) and labels[0] in p]
            others = [p for p in parts if p not in having]
            if having:
                return meet(*others, *[_remove(p, labels, at) for p in having])
    raise IllFormedError(
        f"there is no {format_address((*at, *labels))} to take away: "
        f"{format_address(at)} : {T} is no record type with that label"
    )


def _remove_from_record(r: Object, labels: Address, around: Address) -> Record:
    label, *rest = labels
    here = (*around, label)
    if not isinstance(r, Record) or label not in r:
        raise _missing_path(here, r if isinstance(r, Record) else ())
    fields = dict(r._fields)
    if rest:
        fields[label] = _remove_from_record(fields[label], tuple(rest), here)
    else:
        del fields[label]
    return Record(fields)


def _missing_path(path: Address, known: Iterable[str]) -> IllFormedError:
    return IllFormedError(
        f"there is no {format_address(path)} to take away",
        hint=suggestion(path[-1], known),
    )


def _check_result(
    T: RecordType, paths: tuple[str, ...], theory: Signature | None
) -> RecordType:
    """T itself, if every path in it still leads somewhere; else `IllFormedError`."""
    try:
        for part in subterms([T]):
            if isinstance(part, RecordType):
                check_record_type(part, theory)
    except IllFormedError as error:
        gone = " and ".join(paths)
        raise IllFormedError(
            f"without {gone}, {error.message}", hint=error.hint
        ) from None
    return T
