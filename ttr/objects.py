"""What types are about: objects, records of them, and paths into records.

Objects are any Python values. A string is a name; a list is a tuple; a record is a
`Record`; an array is itself, compared by identity; a type is an object as well.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator, Mapping
from typing import Any, TypeAlias, TypeVar

from ttr.errors import IllFormed, TTRError
from ttr.interning import Node, identity, node

__all__ = [
    "Object",
    "Path",
    "Record",
    "check_label",
    "freeze",
    "labelled",
    "outer",
    "record",
    "this",
]

Object: TypeAlias = Any
"""Any Python value; containers are frozen by `freeze`."""

_Value = TypeVar("_Value")


def freeze(value: object) -> Object:
    """The value as an object of the theory: lists become tuples, `this.x` a path.

    Only plain lists, tuples and dictionaries are taken for notation; an object of a
    class of its own stays what it is.

    >>> freeze([1, {"x": "fido"}])
    (1, record(x='fido'))
    """
    kind = type(value)
    if kind is list or kind is tuple:
        return tuple(map(freeze, value))  # type: ignore[call-overload]
    if kind is dict:
        return Record(value)  # type: ignore[arg-type]
    return value._path() if isinstance(value, PathTo) else value


# --- paths ---------------------------------------------------------------------------


@node
class Path(Node):
    """A path into a record: `up` record types outwards, then along the labels."""

    up: int
    labels: tuple[str, ...]


class PathTo:
    """Writes paths as Python attributes: `this.x`, `outer.x`, `this["bg.x"]`."""

    __slots__ = ("_labels", "_up")

    def __init__(self, up: int, labels: tuple[str, ...] = ()) -> None:
        self._up, self._labels = up, labels

    def __getattr__(self, label: str) -> PathTo:
        if label.startswith("_"):
            raise AttributeError(label)
        return self[label]

    def __getitem__(self, path: str) -> PathTo:
        labels = path.split(".") if isinstance(path, str) else [path]
        for label in labels:
            check_label(label)
        return PathTo(self._up, (*self._labels, *labels))

    def __iter__(self) -> Iterator[object]:
        raise TypeError("a path is no list: write its labels, as in this['bg.x']")

    def __call__(self, up: int) -> PathTo:
        if self._labels or self._up == 0:
            raise IllFormed("only outer can be called, as in outer(2).x")
        if type(up) is not int or up < 1:
            raise IllFormed(f"outer takes how many record types out, found {up!r}")
        return PathTo(up)

    def __repr__(self) -> str:
        from ttr.printing import python

        return python(Path(self._up, self._labels))

    def _path(self) -> Path:
        """The path written so far; raises `IllFormed` where it has no label."""
        if not self._labels:
            raise IllFormed("a path needs a label, as in this.x or outer.x")
        return Path(self._up, self._labels)


this = PathTo(0)
"""The record in which a field stands: `this.x`, or `this["bg.x"]` for a text path."""

outer = PathTo(1)
"""The record one further out, `^.x`; `outer(2).x` is two further out."""


# --- records -------------------------------------------------------------------------


class Record:
    """A record {ℓ = a, …}: labels are its attributes, and it has no public methods.

    Two records are equal when they have the same labels with the same objects.

    >>> r = record(x="fido", bg=record(size=3))
    >>> r.x, r["bg.size"], r == record({"bg": {"size": 3}, "x": "fido"})
    ('fido', 3, True)
    """

    __slots__ = ("__weakref__", "_fields", "_hash")

    _fields: dict[str, Object]
    _hash: int | None

    def __init__(self, fields: Mapping[str, object]) -> None:
        for label in fields:
            check_label(label)
        object.__setattr__(self, "_fields", {k: freeze(v) for k, v in fields.items()})
        object.__setattr__(self, "_hash", None)

    def __getattr__(self, label: str) -> Object:
        if not label.startswith("_") and label in self._fields:
            return self._fields[label]
        raise AttributeError(f"no label {label} in {self}")

    def __getitem__(self, path: str) -> Object:
        value: Object = self
        for label in path.split("."):
            if not isinstance(value, Record) or label not in value._fields:
                raise KeyError(path)
            value = value._fields[label]
        return value

    def __contains__(self, label: object) -> bool:
        return label in self._fields

    def __iter__(self) -> Iterator[str]:
        return iter(self._fields)

    def __len__(self) -> int:
        return len(self._fields)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Record):
            return NotImplemented
        mine, theirs = self._fields, other._fields
        return mine.keys() == theirs.keys() and all(
            identity(v) == identity(theirs[k]) for k, v in mine.items()
        )

    def __hash__(self) -> int:
        if self._hash is None:
            key = frozenset((k, identity(v)) for k, v in self._fields.items())
            object.__setattr__(self, "_hash", hash(key))
        return self._hash  # type: ignore[return-value]

    def __setattr__(self, label: str, value: object) -> None:
        raise TTRError(
            f"a record does not change, so {label} cannot be set",
            hint=f"replace(r, {label}=…) gives a new record",
        )

    def __delattr__(self, label: str) -> None:
        raise TTRError(f"a record does not change, so {label} cannot be deleted")

    def __str__(self) -> str:
        from ttr.printing import notation

        return notation(self)

    def __repr__(self) -> str:
        from ttr.printing import python

        return python(self)

    def __reduce__(self) -> tuple[object, ...]:
        return Record, (self._fields,)

    def __copy__(self) -> Record:
        return self

    def __deepcopy__(self, memo: object) -> Record:
        return self


def record(fields: Mapping[str, object] | None = None, /, **labels: object) -> Record:
    """The record with these labels, as keywords or as one mapping.

    Raises `IllFormed` for what is no label, and for a label that is there twice.

    >>> print(record(x="fido", c="s1"))
    {c = s1, x = fido}
    """
    return Record(labelled("record", fields, labels))


def labelled(
    what: str, fields: Mapping[str, _Value] | None, labels: Mapping[str, _Value]
) -> dict[str, _Value]:
    """The labels of a mapping and of keywords together; a label is there once."""
    if fields is None:
        return dict(labels)
    if not isinstance(fields, Mapping):
        raise IllFormed(
            f"{what} takes labels as keywords or as one mapping, found {fields!r}"
        )
    twice = sorted(fields.keys() & labels.keys())
    if twice:
        raise IllFormed(f"the label {twice[0]} is there twice")
    return {**fields, **labels}


def check_label(label: object) -> None:
    """Refuses what is no label: labels are identifiers that do not start with `_`.

    Nor may Python read another identifier for it: `r.ﬁ` would look for `fi`.
    """
    if isinstance(label, str) and label.isidentifier() and label[0] != "_":
        if label.isascii() or unicodedata.normalize("NFKC", label) == label:
            return
        usual = unicodedata.normalize("NFKC", label)
        raise IllFormed(f"the label {label!r} is written {usual} in Python")
    raise IllFormed(f"a label is an identifier that does not start with _: {label!r}")
