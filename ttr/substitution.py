"""Putting objects and other paths in the place of paths."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from ttr.errors import TTRError
from ttr.syntax import (
    ListOf,
    Meet,
    Object,
    Path,
    PType,
    Record,
    RecordType,
    Singleton,
    TypeNode,
    escaping,
    meet,
)

__all__ = ["Around", "Unresolved", "along", "grounded", "replace_paths"]

Around = tuple[Mapping[str, Object], ...]
"""What is known of the records around a field, innermost first."""


class Unresolved(TTRError):
    """A path that leads nowhere in the record it is asked of."""


def along(value: Object, labels: tuple[str, ...]) -> Object:
    """r.ℓ₁.….ℓₙ; raises `Unresolved` where a step is missing.

    >>> from ttr.syntax import record
    >>> along(record(bg=record(x="fido")), ("bg", "x"))
    'fido'
    """
    for label in labels:
        if not isinstance(value, Record) or label not in value:
            lacks = "there is no" if isinstance(value, Record) else "no record has"
            path = ".".join(labels)
            raise Unresolved(f"the path {path} leads nowhere: {lacks} {label}")
        value = value._fields[label]
    return value


def grounded(value: Object, around: Around) -> Object:
    """A field's type or object with its paths replaced by what they lead to.

    Raises `Unresolved` for a path that leads nowhere.

    >>> from ttr.syntax import Ind, Pred, this
    >>> print(grounded(Pred("dog", Ind)(this.x), ({"x": "fido"},)))
    dog(fido)
    """

    def at(path: Path) -> Object:
        name = ".".join(path.labels)
        if path.up >= len(around):
            raise Unresolved(f"the path {name} leads out of every record")
        first, *rest = path.labels
        if first not in around[path.up]:
            raise Unresolved(f"the path {name} leads nowhere: there is no {first}")
        return along(around[path.up][first], tuple(rest))

    return replace_paths(value, at)


def replace_paths(
    value: Object, at: Callable[[Path], Object], depth: int = 0
) -> Object:
    """The value with every path that escapes it replaced by at(path).

    `at` sees a path as from where the value stands and gives what stands for it there;
    inside nested record types the replacement is moved along. As a replacement never
    refers to a nested record, the order of its fields stays what it is.
    """
    if isinstance(value, TypeNode) and not _reaches(value, depth):
        return value
    match value:
        case Path():
            if value.up < depth:
                return value
            return _moved(at(Path(value.up - depth, value.labels)), depth)
        case RecordType(fields):
            inner = ((k, replace_paths(T, at, depth + 1)) for k, T in fields)
            return RecordType(tuple(inner))
        case PType(pred, args):
            return PType(pred, tuple(replace_paths(a, at, depth) for a in args))
        case Singleton(base, obj):
            base = replace_paths(base, at, depth)
            return Singleton(base, replace_paths(obj, at, depth))
        case Meet(parts):
            return meet(*(replace_paths(p, at, depth) for p in parts))
        case ListOf(item):
            return ListOf(replace_paths(item, at, depth))
        case tuple():
            return tuple(replace_paths(v, at, depth) for v in value)
        case Record():
            items = value._fields.items()
            return Record({k: replace_paths(v, at, depth) for k, v in items})
    return value


def _reaches(T: TypeNode, depth: int) -> bool:
    """Whether a path in T leads at least so many record types out."""
    return any(path.up >= depth for path in escaping(T))


def _moved(value: Object, depth: int) -> Object:
    """The value as it must be written `depth` record types further in."""
    if depth == 0:
        return value
    return replace_paths(value, lambda p: Path(p.up + depth, p.labels))
