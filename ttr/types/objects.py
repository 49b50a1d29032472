"""Objects, which types are about: also records, and paths into records.

Objects are any Python values. A Python string is a name; a list is a tuple; a record is
a `Record`, a set a `FiniteSet`, a string of events an `EventString`; an array is
itself, compared by identity; a type is an object as well.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache
from itertools import chain, groupby
from types import NoneType
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

from ttr.errors import IllFormedError, TTRError
from ttr.safety.budgets import spend, within_budget
from ttr.showing import NotebookValue
from ttr.types.interning import (
    Node,
    as_notation,
    as_python,
    cache_on_node,
    identity,
    node,
)

Object: TypeAlias = Any
"""Any Python value; containers are frozen by `freeze`."""

_Value = TypeVar("_Value")


class UnresolvedError(TTRError):
    """An object that is not there: a path to nowhere, the first of an empty list."""


def freeze(value: object) -> Object:
    """The value as an object of the theory: lists become tuples, `this.x` a path.

    Only plain lists, tuples, dictionaries and sets are notation; an object of any other
    class stays what it is.

    >>> freeze([1, {"x": "fido"}])
    (1, record(x='fido'))
    """
    kind = type(value)
    if kind not in _TAKEN_FOR_NOTATION:
        return value
    if kind is list or kind is tuple:
        return _freeze_each(tuple(value))  # type: ignore[arg-type]
    if kind is dict:
        return Record(value)  # type: ignore[arg-type]
    if isinstance(value, set | frozenset):
        return FiniteSet(*value)
    if isinstance(value, TermAsType):
        return value.term
    return value._path()  # type: ignore[attr-defined]


def _freeze_each(values: tuple[object, ...]) -> tuple[Object, ...]:
    """The values as objects; the same tuple if all of them are objects already."""
    spend()
    if _TAKEN_FOR_NOTATION.isdisjoint(map(type, values)):
        return values
    return tuple(map(freeze, values))


_TAKEN_FOR_NOTATION: set[type] = {list, tuple, dict, set, frozenset}
"""The classes that are read as notation; objects of others stay what they are."""


# --- paths ---------------------------------------------------------------------------


BOUND = "•"
"""The first label of a path to a bound variable; no label that can be written."""


@node
class Path(Node):
    """A path into a record: `up` scopes outwards, then along the labels.

    Every record type is a scope of its labels, and every binder one of its variable,
    which has no name there but `BOUND`: so names of variables never matter.

    >>> from ttr import Ind, Pred, rectype, this
    >>> T = rectype(x=Ind, c=Pred("dog", Ind)(this.x))
    >>> T["c"].args == (Path(0, ("x",)),)
    True
    """

    up: int
    labels: tuple[str, ...]
    _sign = "."

    @staticmethod
    def _key(up: int, labels: tuple[str, ...]) -> tuple[object, ...]:
        return up, labels


@node
class Missing(Node):
    """Stands for the value of a label that a record lacks: there is no object."""


class Applied:
    """Base class of `ttr.types.syntax.Application`."""

    __slots__ = ()


class TermAsType:
    """Base class of `ttr.types.syntax.TypeAt`, which is its `term` among objects."""

    __slots__ = ()
    term: Object

    def __init_subclass__(cls) -> None:
        _TAKEN_FOR_NOTATION.add(cls)


class WrittenPath:
    """Base class of `ttr.types.path_notation.PathTo`, which Python writes paths with.

    `up` scopes outwards, then along the labels.
    """

    __slots__ = ("_labels", "_up")

    def __init__(self, up: int, labels: tuple[str, ...] = ()) -> None:
        self._up, self._labels = up, labels

    def _path(self) -> Path:
        """The path written so far; raises `IllFormedError` where it has no label."""
        if not self._labels:
            raise IllFormedError("a path needs a label, as in this.x or outer.x")
        return Path(self._up, self._labels)

    def __init_subclass__(cls) -> None:
        _TAKEN_FOR_NOTATION.add(cls)


# --- sets, strings of events and what is computed -------------------------------------


@node
class FiniteSet(Node):
    """{a, b}: a finite set of objects, each there once, in whatever order written.

    >>> FiniteSet("b", "a") is FiniteSet("a", "b", "a"), len(FiniteSet())
    (True, 0)
    """

    items: tuple[Object, ...]
    _sign = "{"

    if TYPE_CHECKING:

        def __init__(self, *items: object) -> None: ...

    @staticmethod
    def _normal(*items: object) -> tuple[object, ...]:
        once = {identity(item): item for item in map(freeze, items)}
        if len(once) < 2:
            return (tuple(once.values()),)
        return (tuple(sort_canonically(once.values())),)

    @staticmethod
    def _key(items: tuple[Object, ...]) -> tuple[object, ...]:
        return (frozenset(map(identity, items)),)

    def __iter__(self) -> Iterator[Object]:
        return iter(self.items)

    def __len__(self) -> int:
        return len(self.items)

    def __contains__(self, value: object) -> bool:
        return identity(freeze(value)) in map(identity, self.items)

    def __reduce__(self) -> tuple[object, ...]:
        return FiniteSet, self.items


@node
class EventString(Node):
    """<a b>: a string of events, one after the other.

    >>> print(EventString("e1", "e2") + EventString("e3"))
    <e1 e2 e3>
    """

    items: tuple[Object, ...]
    _sign = "<"

    if TYPE_CHECKING:

        def __init__(self, *items: object) -> None: ...

    @staticmethod
    def _normal(*items: object) -> tuple[object, ...]:
        return (tuple(map(freeze, items)),)

    def __iter__(self) -> Iterator[Object]:
        return iter(self.items)

    def __len__(self) -> int:
        return len(self.items)

    def __add__(self, other: object) -> Object:
        return concat(self, other)

    def __reduce__(self) -> tuple[object, ...]:
        return EventString, self.items


@node
class Operation(Node):
    """A list or string computed from others: a + b, fst(a) or rst(a).

    It is kept as long as a part of it is a path or an application; otherwise `concat`,
    `fst` and `rst` give the result.

    >>> from ttr import this
    >>> from ttr.types import fst
    >>> term = concat(["a"], this.qud)
    >>> isinstance(term, Operation), term.name
    (True, '+')
    >>> print(term, "and", fst(this.qud))
    [a] + .qud and fst(.qud)
    """

    name: str
    args: tuple[Object, ...]

    def __add__(self, other: object) -> Object:
        return concat(self, other)


def concat(*parts: object) -> Object:
    """a + b: the concatenation of lists, or of strings of events.

    Raises `UnresolvedError` for what is neither.

    >>> concat(["a"], ["b", "c"])
    ('a', 'b', 'c')
    >>> from ttr import this
    >>> print(concat(["a"], this.x))
    [a] + .x
    """
    flat: list[Object] = []
    for part in map(freeze, parts):
        flat += part.args if _is_operation(part, "+") else (part,)
    if not flat:
        raise IllFormedError("a concatenation needs at least one list or string")
    for piece in flat:
        if not _is_symbolic(piece) and not isinstance(piece, tuple | EventString):
            raise UnresolvedError(
                f"only lists and strings can be concatenated, not {piece}"
            )
    joined: list[Object] = []
    for stays, group in groupby(flat, _is_symbolic):
        pieces = list(group)
        joined += pieces if stays else [_concatenate(pieces)]
    return joined[0] if len(joined) == 1 else Operation("+", tuple(joined))


def _concatenate(pieces: list[Object]) -> Object:
    """The concatenation of lists, or of strings."""
    kinds = {type(piece) for piece in pieces}
    if len(kinds) > 1:
        whole = Operation("+", tuple(pieces))
        raise UnresolvedError(
            f"two lists or two strings can be concatenated, not {whole}"
        )
    if len(pieces) == 1:
        return pieces[0]
    events = tuple(chain.from_iterable(pieces))
    return EventString(*events) if kinds == {EventString} else events


def fst(value: object) -> Object:
    """The first element of a list; raises `UnresolvedError` where there is none.

    >>> fst(["a", "b"])
    'a'
    """
    value = freeze(value)
    if _is_symbolic(value):
        return Operation("fst", (value,))
    return _elements(value, "first element")[0]


def rst(value: object) -> Object:
    """A list without its first element; raises `UnresolvedError` where it has none.

    >>> rst(["a", "b"])
    ('b',)
    """
    value = freeze(value)
    return (
        Operation("rst", (value,))
        if _is_symbolic(value)
        else _elements(value, "rest")[1:]
    )


def _elements(value: Object, wanted: str) -> tuple[Object, ...]:
    if isinstance(value, tuple) and value:
        return value
    kind = "an empty list" if isinstance(value, tuple) else "no list"
    raise UnresolvedError(f"there is no {wanted}: it is {kind}")


def _is_operation(value: Object, name: str) -> bool:
    return isinstance(value, Operation) and value.name == name


def _is_symbolic(value: Object) -> bool:
    """Does the object depend on the value of a path or an application?"""
    return isinstance(value, Path | Operation | Applied)


# --- records -------------------------------------------------------------------------


class Record(NotebookValue):
    """A record {ℓ = a, …}: labels are its attributes, and it has no public methods.

    Two records are equal when they have the same labels with the same objects.

    >>> r = record(x="fido", bg=record(size=3))
    >>> r.x, r["bg.size"], r == record({"bg": {"size": 3}, "x": "fido"})
    ('fido', 3, True)
    """

    __slots__ = (
        "__dict__",
        "__weakref__",
        "_fields",
        "_hash",
        "_is_immutable",
        "_noted",
    )

    # Labels are asked for often: the fields are the dictionary of attributes itself.
    # `ttr.judging.certainty` notes what a record was found to be of.
    _fields: dict[str, Object]
    _hash: int | None
    _is_immutable: bool | None
    _noted: dict[Any, tuple[Any, ...]] | None

    def __init__(self, fields: Mapping[str, object]) -> None:
        spend(1 + len(fields))
        for label in fields:
            _check_label_once(label)
        own = {k: freeze(v) for k, v in fields.items()}
        object.__setattr__(self, "_fields", own)
        object.__setattr__(self, "__dict__", own)
        object.__setattr__(self, "_hash", None)
        object.__setattr__(self, "_is_immutable", None)
        object.__setattr__(self, "_noted", None)

    def __getattr__(self, label: str) -> Object:
        raise AttributeError(f"no label {label} in {self}")

    def __getitem__(self, path: str) -> Object:
        value: Object = self
        for label in path.split(".") if isinstance(path, str) else (path,):
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

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *self._fields})

    def _ipython_key_completions_(self) -> list[str]:
        return [*self._fields]

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Record):
            return NotImplemented
        if self is other:
            return True
        spend()
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

    @within_budget
    def __str__(self) -> str:
        return as_notation(self)

    @within_budget
    def __repr__(self) -> str:
        return as_python(self)

    def __reduce__(self) -> tuple[object, ...]:
        return Record, (self._fields,)

    def __copy__(self) -> Record:
        return self

    def __deepcopy__(self, memo: object) -> Record:
        return self


def record(fields: Mapping[str, object] | None = None, /, **labels: object) -> Record:
    """The record with these labels, as keywords or as one mapping.

    Raises `IllFormedError` for what is no label, and for a label that is there twice.

    >>> print(record(x="fido", c="s1"))
    {c = s1, x = fido}
    """
    return Record(combine_labels("record", fields, labels))


# --- the canonical order --------------------------------------------------------------


@within_budget
def sort_canonically(values: Iterable[_Value]) -> list[_Value]:
    """The values in canonical order, which depends on their structure alone.

    They are compared by what is written first (a name, or a sign as of a list), then by
    the kind of value, then part by part.

    >>> from ttr import Basic, Pred
    >>> A, B, p = Basic("A"), Basic("B"), Pred("p", Basic("A"))
    >>> print(*sort_canonically([~A, p("b"), A & B, p("a"), B, A]), sep="; ")
    A; A /\\ B; B; p(a); p(b); ~A
    """
    return sorted(values, key=_order_key)


_OrderKey: TypeAlias = tuple[Any, ...]
"""The text written first and the kind of value, then the keys of its parts."""


def _order_key(value: object) -> _OrderKey:
    """The sort key of a value; no other value has the same."""
    kind = type(value)
    if kind is str:
        return value, "str"
    if kind is int or kind is float:
        return repr(value), kind.__name__
    if isinstance(value, Node):
        return _order_key_of_node(value)
    if type(value) is tuple:
        spend(len(value))
        return _compose_key("", "tuple", list(map(_order_key, value)))
    if isinstance(value, Record):
        spend(len(value))
        fields = sorted(value._fields.items())
        return _compose_key("{", "Record", list(map(_order_key, fields)))
    return str(value), kind.__name__, (repr(value), "str")


@cache_on_node
def _order_key_of_node(value: Node) -> _OrderKey:
    fields = [_order_key(getattr(value, name)) for name in value.__match_args__]
    return _compose_key(value._sign, type(value).__name__, fields)


def _compose_key(sign: str, kind: str, parts: list[_OrderKey]) -> _OrderKey:
    return (sign + parts[0][0] if parts else sign, kind, *parts)


def is_immutable(value: Object) -> bool:
    """Can nothing inside the object change? Objects of foreign classes may.

    >>> is_immutable(record(x=("a", 1))), is_immutable(record(x=bytearray()))
    (True, False)
    """
    kind = type(value)
    if kind is str or kind is float:
        return True
    if kind is tuple:
        return all(map(is_immutable, value))
    if isinstance(value, Record):
        if value._is_immutable is None:
            found = all(map(is_immutable, value._fields.values()))
            object.__setattr__(value, "_is_immutable", found)
        return value._is_immutable  # type: ignore[return-value]
    if isinstance(value, Node):
        return True
    if isinstance(value, tuple):
        return all(map(is_immutable, value))
    return isinstance(value, _LASTING)


_LASTING = (str, int, float, complex, bytes, NoneType)
"""The kinds of objects that never change."""


def combine_labels(
    what: str, fields: Mapping[str, _Value] | None, labels: Mapping[str, _Value]
) -> dict[str, _Value]:
    """The labels of a mapping and of keywords together; none may occur twice."""
    if fields is None:
        return dict(labels)
    if not isinstance(fields, Mapping):
        raise IllFormedError(
            f"{what} takes labels as keywords or as one mapping, found {fields!r}"
        )
    twice = sorted(fields.keys() & labels.keys())
    if twice:
        raise IllFormedError(f"the label {twice[0]} is there twice")
    return {**fields, **labels}


def check_label(label: object) -> None:
    """Refuse what is not a label: an identifier that does not start with `_`.

    Python must read it as it is written: `r.ﬁ` would look for `fi`.
    """
    if isinstance(label, str) and label.isidentifier() and label[0] != "_":
        if label.isascii() or unicodedata.normalize("NFKC", label) == label:
            return
        usual = unicodedata.normalize("NFKC", label)
        raise IllFormedError(f"the label {label!r} is written {usual} in Python")
    raise IllFormedError(
        f"a label is an identifier that does not start with _: {label!r}"
    )


_check_label_once = lru_cache(4096)(check_label)
"""The check of a label, which is not made again for each record that has it."""
