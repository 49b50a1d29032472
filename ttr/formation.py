"""Well-formed types: every path leads somewhere, to what fits, and in no circle."""

from __future__ import annotations

from collections.abc import Iterator

from ttr.circles import circle
from ttr.errors import IllFormed, following_nesting, suggestion
from ttr.printing import notation
from ttr.subtyping import Answer, subtype
from ttr.syntax import (
    ListOf,
    Meet,
    Path,
    PType,
    RecordType,
    Singleton,
    TypeNode,
    as_type,
    escaping,
    meet,
)
from ttr.theories import Signature

__all__ = ["checked", "target", "wellformed"]


@following_nesting
def wellformed(T: TypeNode, theory: Signature | None = None, /) -> Answer:
    """Whether every path in T leads to a field that fits, and none in a circle.

    A type with a circle can be judged, but no witness of it built. Where the theory is
    given, what fits by an axiom fits. Raises `IllFormed` for what is no type.

    >>> from ttr.syntax import Ind, rectype, this
    >>> print(wellformed(rectype(x=Ind, y=Ind @ this.x)))
    yes: every path leads to a field that fits
    >>> print(wellformed(rectype(x=Ind @ this.y, y=Ind @ this.x)))
    no: its paths go in a circle: x → y → x
    """
    T = as_type(T)
    around = circle(T)
    if around:
        return Answer("no", f"its paths go in a circle: {around}")
    if isinstance(T, RecordType):
        try:
            checked(T, theory)
        except IllFormed as error:
            return Answer("no", error.message)
    return Answer("yes", "every path leads to a field that fits")


def checked(T: RecordType, theory: Signature | None = None) -> RecordType:
    """The record type itself, if its paths resolve and fit; else `IllFormed`.

    Paths that lead out of T are left to the record type that will be built around it.
    """
    for label, field in T.fields:
        paths = [path for path in escaping(field) if path.up == 0]
        for path in sorted(paths, key=lambda p: p.labels):
            target(path, T)
        if paths:
            _check_domains(label, field, (T,), theory)
    return T


def target(path: Path, T: RecordType) -> TypeNode:
    """The type of the field that a path leads to, from within T; else `IllFormed`."""
    here: TypeNode = T
    for label in path.labels:
        field = _field(here, label)
        if field is None:
            labels = list(_labels(here))
            is_record = labels or isinstance(here, RecordType)
            lacks = f"has no {label}" if is_record else "is no record type"
            raise IllFormed(
                f"the path {'.'.join(path.labels)} leads nowhere: {here} {lacks}",
                hint=suggestion(label, labels),
            )
        here = field
    return here


def _field(T: TypeNode, label: str) -> TypeNode | None:
    """The type of a field that every witness of T has, or None."""
    match T:
        case RecordType():
            return T.get(label)
        case Singleton(base, _):
            return _field(base, label)
        case Meet(parts):
            found = [_field(part, label) for part in parts]
            fields = [field for field in found if field is not None]
            return meet(*fields) if fields else None
    return None


def _labels(T: TypeNode) -> Iterator[str]:
    match T:
        case RecordType():
            yield from T
        case Singleton(base, _):
            yield from _labels(base)
        case Meet(parts):
            for part in parts:
                yield from _labels(part)


def _check_domains(
    label: str,
    field: TypeNode,
    around: tuple[RecordType, ...],
    theory: Signature | None,
) -> None:
    """Every path to the outermost record that a ptype takes fits an arity.

    `around` are the record types around the field, innermost first.
    """
    match field:
        case PType():
            _check_ptype(label, field, around, theory)
        case Meet(parts):
            for part in parts:
                _check_domains(label, part, around, theory)
        case Singleton(base, _) | ListOf(base):
            _check_domains(label, base, around, theory)
        case RecordType(fields):
            for name, inner in fields:
                path = f"{label}.{name}"
                _check_domains(path, inner, (field, *around), theory)


def _check_ptype(
    label: str,
    field: PType,
    around: tuple[RecordType, ...],
    theory: Signature | None,
) -> None:
    arities = [a for a in field.pred.arities if len(a) == len(field.args)]
    misfits = [_misfit(field, arity, around, theory) for arity in arities]
    first = misfits[0]
    if first is None or None in misfits:
        return
    arg, wanted, found = first
    scope = tuple(frozenset(R.labels) for R in around)
    raise IllFormed(
        f"in the field {label}, {notation(field, scope)} needs "
        f"{wanted} for {'.'.join(arg.labels)}, but that is of {found}"
    )


def _misfit(
    field: PType,
    arity: tuple[TypeNode, ...],
    around: tuple[RecordType, ...],
    theory: Signature | None,
) -> tuple[Path, TypeNode, TypeNode] | None:
    """The first argument that is a path out to an object that does not fit."""
    outermost = len(around) - 1
    for arg, wanted in zip(field.args, arity, strict=True):
        if not isinstance(arg, Path) or arg.up != outermost:
            continue
        found = target(arg, around[outermost])
        if subtype(found, wanted, theory).no:
            return arg, wanted, found
    return None
