"""Putting objects in the place of paths."""

from __future__ import annotations

from collections.abc import Mapping

from ttr.types.objects import (
    BOUND,
    EventString,
    Object,
    Path,
    Record,
    UnresolvedError,
)
from ttr.types.paths import free_paths, map_parts, replace_paths
from ttr.types.syntax import Function, TypeNode

Around = tuple[Mapping[str, Object], ...]
"""The values of labels and of bound variables, scope by scope, innermost first."""


def follow_path(value: Object, labels: tuple[str, ...]) -> Object:
    """r.ℓ₁.….ℓₙ; raises `UnresolvedError` where a step is missing.

    >>> from ttr import record
    >>> follow_path(record(bg=record(x="fido")), ("bg", "x"))
    'fido'
    """
    for label in labels:
        if not isinstance(value, Record) or label not in value:
            lacks = "there is no" if isinstance(value, Record) else "no record has"
            path = ".".join(labels)
            raise UnresolvedError(f"the path {path} leads nowhere: {lacks} {label}")
        value = value._fields[label]
    return value


def resolve_paths(value: Object, around: Around) -> Object:
    """A field's type or object with its paths replaced by what they lead to.

    Raises `UnresolvedError` for a path that leads nowhere.

    >>> from ttr import Ind, Pred, this
    >>> print(resolve_paths(Pred("dog", Ind)(this.x), ({"x": "fido"},)))
    dog(fido)
    """

    if isinstance(value, TypeNode | Function) and not free_paths(value):
        return value

    def at(path: Path) -> Object:
        if path.up >= len(around):
            raise UnresolvedError(f"the path {_name(path)} leads out of every record")
        first, scope = path.labels[0], around[path.up]
        if first not in scope:
            raise UnresolvedError(
                f"the path {_name(path)} leads nowhere: there is no {first}"
            )
        return follow_path(scope[first], path.labels[1:])

    return replace_paths(value, at)


def _name(path: Path) -> str:
    return ".".join(label for label in path.labels if label != BOUND)


def instantiate_body(function: Function, argument: Object) -> Object:
    """The body of a function with an object for its variable.

    Raises `Unresolved` for a path in it that leads nowhere.

    >>> from ttr import Ind, Pred, fun, this
    >>> print(instantiate_body(fun(x=Ind)(Pred("run", Ind)(this.x)), "fido"))
    run(fido)
    """
    return resolve_paths(function.body, ({BOUND: argument},))


def field_type(field: TypeNode, whole: Path | Record) -> TypeNode:
    """The type of a field of a record as seen from outside the record.

    `whole` is the record, or the place where it stands.

    >>> from ttr import Ind, Pred, this
    >>> print(field_type(Pred("dog", Ind)(this.x), Record({"x": "fido"})))
    dog(fido)
    """

    def outside(path: Path) -> Object:
        if path.up > 0:
            return Path(path.up - 1, path.labels)
        return follow_labels(whole, path.labels)

    found: TypeNode = replace_paths(field, outside)
    return found


def substitute_variable(body: Object, term: Object) -> Object:
    """The body of a binder, as seen from outside, with a term for its variable.

    >>> from ttr import Ind, Pred, fun, this
    >>> print(substitute_variable(fun(x=Ind)(Pred("run", Ind)(this.x)).body, "fido"))
    run(fido)
    """

    def outside(path: Path) -> Object:
        if path.up > 0:
            return Path(path.up - 1, path.labels)
        return follow_labels(term, path.labels[1:])

    return replace_paths(body, outside)


def replace_name(value: TypeNode, name: str, *labels: str) -> Object:
    """The type one scope further in, with the path of these labels for an object.

    >>> from ttr import Ind, Pred
    >>> replace_name(Pred("run", Ind)("fido"), "fido", "x")
    Pred('run', Basic('Ind'))(this.x)
    """

    def at(value: Object, depth: int) -> Object:
        if isinstance(value, str):
            return Path(depth, labels) if value == name else value
        return map_parts(value, lambda part, deeper: at(part, depth + deeper))

    return at(value, 0)


def follow_labels(value: Object, labels: tuple[str, ...]) -> Object:
    """Where the labels lead, from an object or from a path.

    If they lead nowhere, it is a path that equals nothing else.
    """
    for done, label in enumerate(labels):
        if isinstance(value, Path):
            return Path(value.up, value.labels + labels[done:])
        if isinstance(value, EventString) and _is_event(value, label):
            value = value.items[int(label)]
            continue
        if not isinstance(value, Record) or label not in value:
            return Path(0, ("", *labels))
        value = value[label]
    return value


def _is_event(string: EventString, label: str) -> bool:
    """Is the label the number of an event of the string?"""
    return label.isdigit() and int(label) < len(string)
