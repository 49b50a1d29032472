"""One-line printing: `notation` is the blackboard, `python` evaluates back.

A path is written in the shortest form that reads back to the same path: bare where the
nearest enclosing record type with its first label is the one meant, else with a dot
(`.x`, the record where the field stands) or carets (`^.x`, one record further out).
"""

from __future__ import annotations

import json
import keyword
import math
from collections.abc import Iterable

from ttr.syntax import (
    Basic,
    ListOf,
    Meet,
    Object,
    Path,
    Pred,
    PType,
    Record,
    RecordType,
    Singleton,
    TypeNode,
    Universe,
)

__all__ = ["notation", "python"]

Scope = tuple[frozenset[str], ...]
"""The labels of the record types around, innermost first."""


def notation(value: Object, scope: Scope = ()) -> str:
    """The value in the notation of the papers, on one line.

    >>> from ttr.syntax import Ind, Pred, rectype, outer
    >>> run = Pred("run", Ind)
    >>> inner = rectype(x=Ind, c=run(outer.x))
    >>> print(notation(rectype(x=Ind, y=inner)))
    [x : Ind, y : [c : run(^.x), x : Ind]]
    """
    match value:
        case Basic(name) | Universe(name, 0):
            return name
        case Universe(name, level):
            return f"{name}^{level}"
        case PType(pred, args):
            return f"{pred.name}({_listed(args, scope)})"
        case Singleton(base, obj):
            return f"{_tight(base, scope)}@{_operand(obj, scope)}"
        case Meet(parts):
            return " /\\ ".join(_tight(part, scope) for part in parts)
        case ListOf(item):
            return f"list({notation(item, scope)})"
        case RecordType(()):
            return "Rec"
        case RecordType(fields):
            inner = (frozenset(value.labels), *scope)
            return f"[{', '.join(_field(k, f, inner) for k, f in fields)}]"
        case Pred(name, _):
            return name
        case Path():
            return _path(value, scope)
    return _object(value, scope)


def _field(label: str, field: TypeNode, scope: Scope) -> str:
    match field:
        case Singleton(base, obj):
            return f"{label} = {notation(obj, scope)} : {notation(base, scope)}"
    return f"{label} : {notation(field, scope)}"


def _tight(T: TypeNode, scope: Scope) -> str:
    """A type as an operand: in brackets unless it holds together by itself."""
    text = notation(T, scope)
    return f"({text})" if isinstance(T, Meet | Singleton) else text


def _operand(value: Object, scope: Scope) -> str:
    """An object after @: in brackets where it is a type that falls apart."""
    text = notation(value, scope)
    return f"({text})" if isinstance(value, Meet | Singleton) else text


def _listed(values: Iterable[Object], scope: Scope) -> str:
    return ", ".join(notation(v, scope) for v in values)


def _path(path: Path, scope: Scope) -> str:
    name = ".".join(path.labels)
    nearest = next((i for i, ls in enumerate(scope) if path.labels[0] in ls), None)
    if nearest == path.up:
        return name
    return f"{'^' * path.up}.{name}"


def _object(value: Object, scope: Scope) -> str:
    kind = type(value)
    if kind is str:
        return _name(value, scope)
    if kind is tuple:
        return f"[{_listed(value, scope)}]"
    if kind is int or (kind is float and math.isfinite(value)):
        return repr(value)
    if isinstance(value, Record):
        items = sorted(value._fields.items())
        inside = ", ".join(f"{label} = {notation(v, scope)}" for label, v in items)
        return f"{{{inside}}}"
    return f"<{kind.__name__} {_size(value)}>"


def _name(name: str, scope: Scope) -> str:
    """A name, quoted where it would be read as a label or as something else."""
    bare = name.isidentifier() and name not in _RESERVED
    if bare and not any(name in labels for labels in scope):
        return name
    return json.dumps(name, ensure_ascii=False)


_RESERVED = frozenset({"Type", "RecType", "Rec", "list"})


def _size(value: object) -> object:
    """What tells an object without notation from others: its length, else its value."""
    try:
        return len(value)  # type: ignore[arg-type]
    except TypeError:
        return value


def python(value: Object) -> str:
    """The value as Python that evaluates back, with the names of `ttr` imported.

    >>> from ttr.syntax import *
    >>> T = rectype(x=Ind, c=Pred("run", Ind)(this.x))
    >>> T
    rectype(x=Basic('Ind'), c=Pred('run', Basic('Ind'))(this.x))
    >>> eval(repr(T)) is T
    True
    """
    match value:
        case Basic(name):
            return f"Basic({name!r})"
        case Universe(name, 0):
            return name
        case Universe(name, level):
            return f"Universe({name!r}, {level})"
        case Pred(name, arities):
            return f"Pred({', '.join([repr(name), *_arities(arities)])})"
        case PType(pred, args):
            return f"{python(pred)}({', '.join(map(python, args))})"
        case Singleton(base, obj):
            return f"Singleton({python(base)}, {python(obj)})"
        case Meet(parts):
            return f"meet({', '.join(map(python, parts))})"
        case ListOf(item):
            return f"ListOf({python(item)})"
        case RecordType(()):
            return "Rec"
        case RecordType(fields):
            return f"rectype({_keywords(fields)})"
        case Path(up, labels):
            return _python_path(up, labels)
        case Record():
            return f"record({_keywords(sorted(value._fields.items()))})"
        case tuple() if type(value) is tuple:
            inner = ", ".join(map(python, value))
            return f"({inner}{',' * (len(value) == 1)})"
    return repr(value)


def _arities(arities: tuple[tuple[TypeNode, ...], ...]) -> list[str]:
    if len(arities) == 1:
        return [python(T) for T in arities[0]]
    return [python(arity) for arity in arities]


def _keywords(items: Iterable[tuple[str, Object]]) -> str:
    pairs = list(items)
    if any(keyword.iskeyword(label) for label, _ in pairs):
        inner = ", ".join(f"{k!r}: {python(v)}" for k, v in pairs)
        return f"{{{inner}}}"
    return ", ".join(f"{k}={python(v)}" for k, v in pairs)


def _python_path(up: int, labels: tuple[str, ...]) -> str:
    start = {0: "this", 1: "outer"}.get(up, f"outer({up})")
    if any(keyword.iskeyword(label) for label in labels):
        return f"{start}[{'.'.join(labels)!r}]"
    return ".".join([start, *labels])
