"""Records as values: a changed copy of a record."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ttr.errors import TTRError, suggestion
from ttr.objects import labelled
from ttr.printing import notation
from ttr.syntax import Object, Record, freeze, identity

__all__ = ["differences", "replace"]


def replace(
    r: Record, changes: Mapping[str, object] | None = None, /, **labels: object
) -> Record:
    """The record with other objects at these labels or paths.

    A path is written with dots, in a mapping. Raises `TTRError` for a path that is not
    in the record: replacing never adds a label.

    >>> from ttr.syntax import record
    >>> r = record(x="fido", bg=record(size=3))
    >>> print(replace(r, {"bg.size": 4}, x="sam"))
    {bg = {size = 4}, x = sam}
    """
    for path, value in labelled("replace", changes, labels).items():
        if not isinstance(path, str):
            raise TTRError(f"a path is written as a text, as in 'bg.x', found {path!r}")
        r = _replaced(r, tuple(path.split(".")), freeze(value))
    return r


def _replaced(r: Record, path: tuple[str, ...], value: Object) -> Record:
    label, *rest = path
    if not isinstance(r, Record) or label not in r:
        known = r if isinstance(r, Record) else ()
        raise TTRError(
            f"{'.'.join(path)} is not in {r}, so it cannot be replaced",
            hint=suggestion(label, known),
        )
    inner = _replaced(r._fields[label], tuple(rest), value) if rest else value
    return _with(r, label, inner)


def _with(r: Record, label: str, value: Object) -> Record:
    """The record with a frozen value at a label that it has: nothing needs checking."""
    changed = object.__new__(Record)
    object.__setattr__(changed, "_fields", {**r._fields, label: value})
    object.__setattr__(changed, "_hash", None)
    object.__setattr__(changed, "_lasts", None)
    object.__setattr__(changed, "_noted", None)
    return changed


def differences(before: Object, after: Object, path: str = "") -> Iterator[str]:
    """What is different, path by path, as lines `path: old → new`.

    Of a list that has only got longer or shorter, what came (+) or went (−) is told.

    >>> from ttr.syntax import record
    >>> list(differences(record(x="a", y=["b"]), record(x="c", y=["b", "d"])))
    ['x: a → c', 'y: + d']
    """
    if isinstance(before, tuple) and isinstance(after, tuple):
        yield from _list_differences(before, after, path)
        return
    if not isinstance(before, Record) or not isinstance(after, Record):
        if identity(before) != identity(after):
            yield f"{path}: {notation(before)} → {notation(after)}"
        return
    for label in sorted({*before, *after}):
        inner = f"{path}.{label}" if path else label
        if label not in after:
            yield f"{inner}: {notation(before[label])} → nothing"
        elif label not in before:
            yield f"{inner}: nothing → {notation(after[label])}"
        else:
            yield from differences(before[label], after[label], inner)


def _list_differences(
    before: tuple[Object, ...], after: tuple[Object, ...], path: str
) -> Iterator[str]:
    """What is different between two lists, element by element where that is plain."""
    came, went = _beyond(after, before), _beyond(before, after)
    if came is None and went is None:
        yield f"{path}: {notation(before)} → {notation(after)}"
        return
    yield from (f"{path}: + {notation(a)}" for a in came or ())
    yield from (f"{path}: − {notation(a)}" for a in went or ())


def _beyond(
    long: tuple[Object, ...], short: tuple[Object, ...]
) -> tuple[Object, ...] | None:
    """What a list has besides another that it begins or ends with, else None."""
    rest = len(long) - len(short)
    if rest < 0:
        return None
    if identity(long[: len(short)]) == identity(short):
        return long[len(short) :]
    if identity(long[rest:]) == identity(short):
        return long[:rest]
    return None
