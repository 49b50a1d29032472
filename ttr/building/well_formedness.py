"""Well-formed types: every path leads somewhere, to what fits, and in no circle.

A scope is here a record type; that of a binder has one field, for its variable.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from typing import NamedTuple, TypeVar

from ttr.computing.normalisation import normal_type
from ttr.computing.path_cycles import describe_cycle
from ttr.computing.subtyping import Answer, subtype
from ttr.errors import IllFormedError, suggestion
from ttr.safety.budgets import spend, within_budget
from ttr.signature.signature import Signature, signature_of
from ttr.types.objects import BOUND, Object, Path
from ttr.types.paths import free_paths, mentions, parts
from ttr.types.printing import Scope, labels_of, notation, variable
from ttr.types.substitution import substitute_variable
from ttr.types.syntax import (
    Application,
    Function,
    FunType,
    Join,
    Meet,
    PType,
    RecordType,
    Singleton,
    TypeAt,
    TypeNode,
    Universe,
    as_type,
    join,
    meet,
)


@within_budget
def wellformed(T: TypeNode, /, theory: Signature | None = None) -> Answer:
    """Does every path in T lead to a field that fits, and none in a circle?

    A type with a circle can be judged, but no witness of it can be created. With a
    theory, its axioms count. Raises `IllFormedError` if T is not a type.

    >>> from ttr import Ind, rectype, this
    >>> print(wellformed(rectype(x=Ind, y=Ind @ this.x)))
    yes: every path leads to a field that fits
    >>> print(wellformed(rectype(x=Ind @ this.y, y=Ind @ this.x)))
    no: its paths go in a circle: x → y → x
    """
    T = as_type(T)
    around = describe_cycle(T)
    if around:
        return Answer("no", f"its paths go in a circle: {around}")
    if isinstance(T, RecordType):
        try:
            check_record_type(T, theory)
        except IllFormedError as error:
            return Answer("no", error.message)
    return Answer("yes", "every path leads to a field that fits")


_Where = tuple[str, ...]
"""The labels that lead to the field that is looked at."""


@within_budget
def check_record_type(T: RecordType, theory: Signature | None = None) -> RecordType:
    """The record type itself, if its paths resolve and fit; else `IllFormedError`.

    Paths that lead out of T are left to the record type that will be built around it.
    """
    theory = signature_of(theory)
    scope = _scope(T)
    for label, field in T.fields:
        _check(field, scope, (label,), theory)
    return T


_BINDER = TypeVar("_BINDER", Function, FunType)


@within_budget
def check_binder(
    binder: _BINDER, theory: Signature | None = None, name: str = ""
) -> _BINDER:
    """The binder itself, if its paths resolve and fit; else `IllFormedError`.

    `name` is what its variable is called in the error.
    """
    inside = binder.body if isinstance(binder, Function) else binder.result
    _check(inside, _scope(binder, name), (), signature_of(theory))
    return binder


def check_value(
    value: Object, around: RecordType, theory: Signature | None = None
) -> None:
    """Check that the paths of a value resolve and fit, if it stands in `around`.

    Raises `IllFormedError` if they do not. The value stands there like the type of a
    field.

    >>> from ttr import Ind, Pred, this
    >>> check_value(Pred("dog", Ind)(this.s.y), RecordType((("s", RecordType(())),)))
    Traceback (most recent call last):
    ttr.errors.IllFormedError: the path s.y leads nowhere: Rec has no y
    """
    _check(value, _scope(around), (), signature_of(theory))


class _Scope(NamedTuple):
    """The fields that paths may start from, what has them, and a variable's name."""

    fields: RecordType
    value: RecordType | Function | FunType
    name: str = ""


def _scope(value: RecordType | Function | FunType, name: str = "") -> _Scope:
    """A record type with its labels; for a binder, one field for its variable."""
    if isinstance(value, RecordType):
        return _Scope(value, value)
    return _Scope(RecordType(((BOUND, value.domain),)), value, name)


def _names(around: tuple[_Scope, ...], theory: Signature | None) -> Scope:
    """The scopes, innermost first, with the names that are printed in them."""
    found: Scope = signature_of(theory).spelling
    for one in reversed(around):
        if isinstance(one.value, RecordType):
            found = (labels_of(one.value), *found)
        else:
            found = (one.name or variable(one.value, found), *found)
    return found


def _check(
    inside: Object, scope: _Scope, where: _Where, theory: Signature | None
) -> None:
    """Check that the paths of what stands in a scope lead to fields that fit."""
    paths = [path for path in free_paths(inside) if path.up == 0]
    found = {
        path: field_at_path(path, scope.fields)
        for path in sorted(paths, key=lambda p: p.labels)
    }
    if not paths:
        return
    wanted = _argument_types(inside) if isinstance(inside, TypeNode) else None
    if wanted is None or any(
        _strip_singletons(found[path]) is not T for path, T in wanted
    ):
        _check_domains(inside, (scope,), where, theory)


@lru_cache(4096)
def _argument_types(inside: TypeNode) -> tuple[tuple[Path, TypeNode], ...] | None:
    """The paths out of a type that are arguments of predicates, with the types due.

    None where that is not enough to check them: with functions or several arities.
    """
    wanted: list[tuple[Path, TypeNode]] = []
    waiting: list[tuple[Object, int]] = [(inside, 0)]
    while waiting:
        value, depth = waiting.pop()
        if isinstance(value, Application | TypeAt):
            return None
        if isinstance(value, PType):
            if len(value.pred.arities) > 1:
                return None
            pairs = zip(value.args, value.pred.arities[0], strict=True)
            wanted += [
                (Path(0, arg.labels), T)
                for arg, T in pairs
                if isinstance(arg, Path) and arg.up == depth
            ]
        same, inner = parts(value)
        waiting += [(part, depth) for part in same]
        waiting += [(part, depth + 1) for part in inner]
    return tuple(wanted)


def field_at_path(path: Path, T: RecordType) -> TypeNode:
    """The type of the field that a path leads to, from within T; else
    `IllFormedError`.

    A field may have the type that a manifest field around it is set to.
    """
    try:
        return _follow(path, T)
    except IllFormedError:
        if len(path.labels) < 2 or not mentions(T, TypeAt):
            raise
        computed = normal_type(T, signature_of(None))
        if computed is T or not isinstance(computed, RecordType):
            raise
        return _follow(path, computed)


def _follow(path: Path, T: RecordType) -> TypeNode:
    """The type of the field that a path leads to, as the fields are written."""
    here: TypeNode = T
    for label in path.labels:
        field = _field(here, label)
        if field is None:
            labels = list(_labels(here))
            is_record = labels or isinstance(here, RecordType)
            lacks = f"has no {label}" if is_record else "is no record type"
            where = f"the path {_format_path(path)} leads nowhere"
            raise IllFormedError(
                f"{where}: {_format_scope(here)} {lacks}",
                hint=f"{label} is in some alternatives only"
                if label in labels
                else suggestion(label, labels) or _hint_outer(path, here),
            )
        here = field
    return here


def _hint_outer(path: Path, T: TypeNode) -> str:
    """A hint for a label that a record type around T may have."""
    if len(path.labels) > 1 or not isinstance(T, RecordType):
        return ""
    label = path.labels[0]
    return f"outer.{label}, written ^.{label}, is the {label} one record further out"


def _format_path(path: Path) -> str:
    """The labels of a path; the name of a variable is not known and left out."""
    return ".".join("" if label == BOUND else label for label in path.labels)


def _format_scope(T: TypeNode) -> str:
    is_variable = isinstance(T, RecordType) and BOUND in T
    return "the function" if is_variable else str(T)


def _field(T: TypeNode, label: str) -> TypeNode | None:
    """The type of a field that every witness of T has, or None."""
    spend()
    match T:
        case RecordType():
            return T.get(label)
        case Singleton(base, _):
            return _field(base, label)
        case Application():
            value = _value_of(T)
            return _field(value, label) if isinstance(value, TypeNode) else None
        case Meet(parts):
            found = [_field(part, label) for part in parts]
            fields = [field for field in found if field is not None]
            return meet(*fields) if fields else None
        case Join(parts):
            found = [_field(part, label) for part in parts]
            fields = [field for field in found if field is not None]
            return join(*fields) if len(fields) == len(found) else None
    return None


def _value_of(T: Application) -> Object | None:
    """What a written function gives for its argument, whatever that is; else None.

    That the argument fits is checked where it stands.
    """
    function: Object = T.function
    if isinstance(function, Application):
        function = _value_of(function)
    if not isinstance(function, Function):
        return None
    return substitute_variable(function.body, T.argument)


def _labels(T: TypeNode) -> Iterator[str]:
    match T:
        case RecordType():
            yield from T
        case Singleton(base, _):
            yield from _labels(base)
        case Application():
            value = _value_of(T)
            if isinstance(value, TypeNode):
                yield from _labels(value)
        case Meet(parts) | Join(parts):
            for part in parts:
                yield from _labels(part)


def _check_domains(
    value: Object,
    around: tuple[_Scope, ...],
    where: _Where,
    theory: Signature | None,
) -> None:
    """Check that the paths to the outermost scope fit wherever they are arguments.

    `around` are the scopes around the value, innermost first.
    """
    spend()
    outermost = len(around) - 1
    if not any(path.up == outermost for path in free_paths(value)):
        return
    match value:
        case PType(pred, args):
            arities = [a for a in pred.arities if len(a) == len(args)]
            _check_arguments(value, args, arities, around, where, theory)
        case Application(Path() as function, argument) if function.up == outermost:
            domain = _domain(field_at_path(function, around[outermost].fields))
            if domain is not None:
                _check_arguments(value, (argument,), [(domain,)], around, where, theory)
        case TypeAt(Path() as path) if path.up == outermost:
            _check_of_types(path, around, where, theory)
    same, inner = parts(value)
    for part in same:
        _check_domains(part, around, where, theory)
    if not inner:
        return
    within = (_scope(value), *around)
    labels = value.labels if isinstance(value, RecordType) else ()
    for i, part in enumerate(inner):
        _check_domains(part, within, (*where, *labels[i : i + 1]), theory)


def _check_of_types(
    path: Path,
    around: tuple[_Scope, ...],
    where: _Where,
    theory: Signature | None,
) -> None:
    """Refuse a path as a type where what it leads to is surely none."""
    found = field_at_path(path, around[-1].fields)
    if not _may_be_type(found):
        scope = _names(around, theory)
        raise IllFormedError(
            f"{_name_field(where)}expected a type, found {notation(path, scope)}, "
            f"which is of {found}",
            hint="only what is of Type, RecType, Type^1, … is a type",
        )


def _may_be_type(T: TypeNode) -> bool:
    """May what is of T be a type, as far as the form of T tells?"""
    match T:
        case Singleton(base, _):
            return _may_be_type(base)
        case Meet(parts):
            return any(map(_may_be_type, parts))
        case Join(parts):
            return all(map(_may_be_type, parts))
    return isinstance(T, Universe | Application | TypeAt)


def _domain(T: TypeNode) -> TypeNode | None:
    """The domain of functions of the type, where it depends on nothing."""
    if isinstance(T, FunType) and not free_paths(T.domain):
        return T.domain
    return None


def _check_arguments(
    value: PType | Application,
    args: tuple[Object, ...],
    arities: list[tuple[TypeNode, ...]],
    around: tuple[_Scope, ...],
    where: _Where,
    theory: Signature | None,
) -> None:
    """Refuse arguments that fit none of the arities, as far as their types tell."""
    misfits = [
        _find_misfit(args, arity, around[-1].fields, len(around) - 1, theory)
        for arity in arities
    ]
    first = misfits[0]
    if first is None or None in misfits:
        return
    arg, wanted, found = first
    scope = _names(around, theory)
    raise IllFormedError(
        f"{_name_field(where)}{notation(value, scope)} needs {wanted} for "
        f"{notation(arg, scope)}, but that is of {found}"
    )


def _name_field(where: _Where) -> str:
    return f"in the field {'.'.join(where)}, " if where else ""


def _find_misfit(
    args: tuple[Object, ...],
    arity: tuple[TypeNode, ...],
    scope: RecordType,
    up: int,
    theory: Signature | None,
) -> tuple[Path, TypeNode, TypeNode] | None:
    """The first argument that does not fit: its path, the type due and its own type."""
    for arg, wanted in zip(args, arity, strict=True):
        if not isinstance(arg, Path) or arg.up != up:
            continue
        found = field_at_path(arg, scope)
        if _strip_singletons(found) is not wanted and subtype(found, wanted, theory).no:
            return arg, wanted, found
    return None


def _strip_singletons(T: TypeNode) -> TypeNode:
    """T for T@a, at every depth."""
    while isinstance(T, Singleton):
        T = T.base
    return T
