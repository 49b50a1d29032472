"""Records as values: what stands at a path, and a changed copy of a record."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple

from ttr.errors import TTRError, suggestion
from ttr.safety.budgets import spend
from ttr.types.interning import identity
from ttr.types.objects import Object, Record, combine_labels, freeze, is_immutable
from ttr.types.printing import notation
from ttr.types.syntax import RecordType, TypeNode


def value_at(r: Object, path: str) -> Object:
    """The object at a path, written with dots; None if there is no such path.

    >>> from ttr import record
    >>> r = record(x="fido", bg=record(size=3))
    >>> value_at(r, "bg.size"), value_at(r, "bg.age")
    (3, None)
    """
    try:
        return r[path] if isinstance(r, Record) else None
    except KeyError:
        return None


def field_at(T: TypeNode, labels: Iterable[str]) -> TypeNode | None:
    """The type of the field that the labels lead to; None if there is no such field.

    >>> from ttr import Ind, rectype
    >>> T = rectype(bg=rectype(x=Ind))
    >>> field_at(T, ("bg", "x")), field_at(T, ("bg", "y"))
    (Basic('Ind'), None)
    """
    found: TypeNode | None = T
    for label in labels:
        found = found.get(label) if isinstance(found, RecordType) else None
    return found


def replace(
    r: Record, changes: Mapping[str, object] | None = None, /, **labels: object
) -> Record:
    """The record with other objects at these labels or paths.

    A path is written with dots, in a mapping. Raises `TTRError` for a path that is not
    in the record: replacing never adds a label.

    >>> from ttr import record
    >>> r = record(x="fido", bg=record(size=3))
    >>> print(replace(r, {"bg.size": 4}, x="sam"))
    {bg = {size = 4}, x = sam}
    """
    new = _RecordEditor(r)
    for path, value in combine_labels("replace", changes, labels).items():
        if not isinstance(path, str):
            raise TTRError(f"a path is written as a text, as in 'bg.x', found {path!r}")
        new.set_at(path.split("."), freeze(value))
    return new.record


class _RecordEditor:
    """Edits a record: what is on the way to a change is copied once.

    Nobody else has seen the copies, so they may be written to until they are done.
    """

    def __init__(self, r: Record) -> None:
        self.record = r
        self._copies: dict[int, Record] = {}

    def set_at(self, path: list[str], value: Object) -> None:
        """Put a frozen object at a path that is in the record."""
        *outer, last = path
        here = self.record = self._copy(self.record)
        on_the_way = [here]
        for label in outer:
            inner = self._copy(_value_at(here, label, path))
            here._fields[label] = inner
            here = inner
            on_the_way.append(here)
        _value_at(here, last, path)
        here._fields[last] = value
        if not is_immutable(value):
            for one in on_the_way:
                _write(one, "_is_immutable", None)

    def _copy(self, r: Object) -> Record:
        """A copy of the record; the value itself if it is a copy or no record."""
        if id(r) in self._copies or not isinstance(r, Record):
            return r  # type: ignore[no-any-return]
        copy = object.__new__(Record)
        fields = {**r._fields}
        _write(copy, "_fields", fields)
        _write(copy, "__dict__", fields)
        _write(copy, "_hash", None)
        _write(copy, "_is_immutable", r._is_immutable or None)
        _write(copy, "_noted", None)
        self._copies[id(copy)] = copy
        return copy


_write = object.__setattr__


def _value_at(r: Object, label: str, path: list[str]) -> Object:
    """The value of a label, on the way along a path."""
    if isinstance(r, Record) and label in r._fields:
        return r._fields[label]
    raise TTRError(
        f"{'.'.join(path)} is not in {r}, so it cannot be replaced",
        hint=suggestion(label, r if isinstance(r, Record) else ()),
    )


class Difference(NamedTuple):
    """What differs at a path: the objects before and after.

    Where nothing was or is, that object is `NOTHING`. Of a list that only grew or
    shrank there is a difference for each item, which is `listed`.
    """

    path: str
    before: Object
    after: Object
    listed: bool = False

    def __str__(self) -> str:
        was, now = ("nothing" if it is NOTHING else notation(it) for it in self[1:3])
        if not self.listed:
            return f"{self.path}: {was} → {now}"
        return f"{self.path}: " + (f"+ {now}" if self.before is NOTHING else f"− {was}")


NOTHING = object()
"""What stands in a difference for the object where there is none."""


def differences(before: Object, after: Object, path: str = "") -> Iterator[str]:
    """The differences, path by path, as lines `path: old → new`.

    For a list that only grew or shrank: what was added (+) or removed (−).

    >>> from ttr import record
    >>> list(differences(record(x="a", y=["b"]), record(x="c", y=["b", "d"])))
    ['x: a → c', 'y: + d']
    """
    return map(str, find_differences(before, after, path))


def find_differences(
    before: Object, after: Object, path: str = ""
) -> Iterator[Difference]:
    """The differences, path by path, as values."""
    spend()
    if isinstance(before, tuple) and isinstance(after, tuple):
        yield from _list_differences(before, after, path)
        return
    if not isinstance(before, Record) or not isinstance(after, Record):
        if identity(before) != identity(after):
            yield Difference(path, before, after)
        return
    for label in sorted({*before, *after}):
        inner = f"{path}.{label}" if path else label
        if label not in after:
            yield Difference(inner, before[label], NOTHING)
        elif label not in before:
            yield Difference(inner, NOTHING, after[label])
        else:
            yield from find_differences(before[label], after[label], inner)


def _list_differences(
    before: tuple[Object, ...], after: tuple[Object, ...], path: str
) -> Iterator[Difference]:
    """The differences between two lists: what was added or removed, if that is all."""
    came, went = _extra_elements(after, before), _extra_elements(before, after)
    if came is None and went is None:
        yield Difference(path, before, after)
        return
    yield from (Difference(path, NOTHING, a, listed=True) for a in came or ())
    yield from (Difference(path, a, NOTHING, listed=True) for a in went or ())


def _extra_elements(
    long: tuple[Object, ...], short: tuple[Object, ...]
) -> tuple[Object, ...] | None:
    """The elements of a list beyond another that it begins or ends with, else None."""
    rest = len(long) - len(short)
    if rest < 0:
        return None
    if identity(long[: len(short)]) == identity(short):
        return long[len(short) :]
    if identity(long[rest:]) == identity(short):
        return long[:rest]
    return None
