"""Paths written as Python attributes: `this.x`, `outer.x`, `outer(2).x`."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ttr.errors import IllFormedError
from ttr.types.interning import as_python
from ttr.types.objects import Object, Path, WrittenPath, check_label, concat
from ttr.types.syntax import Application, TypeNode, apply_to, as_type


class PathTo(WrittenPath):
    """Writes paths as Python attributes: `this.x`, `outer.x`, `this["bg.x"]`.

    The operators of types make types of the type that is there: `this.T >> this.T`.
    """

    __slots__ = ()

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

    def __call__(self, *args: Any) -> PathTo | Application:
        """`outer(2)` is two scopes out; `this.f(a)` applies what a path leads to."""
        if self._labels:
            return apply_to(self._path(), *args)
        if self._up == 0 or len(args) != 1:
            raise IllFormedError("only outer can be called, as in outer(2).x")
        if type(args[0]) is not int or args[0] < 1:
            raise IllFormedError(
                f"outer takes how many scopes out, 1 or more, found {args[0]!r}"
            )
        return PathTo(args[0])

    def __add__(self, other: object) -> Object:
        return concat(self, other)

    def __radd__(self, other: object) -> Object:
        return concat(other, self)

    def __and__(self, other: object) -> TypeNode:
        return as_type(self) & other

    def __or__(self, other: object) -> TypeNode:
        return as_type(self) | other

    def __invert__(self) -> TypeNode:
        return ~as_type(self)

    def __rshift__(self, other: object) -> TypeNode:
        return as_type(self) >> other

    def __matmul__(self, value: object) -> TypeNode:
        return as_type(self) @ value

    def __repr__(self) -> str:
        return as_python(Path(self._up, self._labels))


this = PathTo(0)
"""The record in which a field stands: `this.x`, or `this["bg.x"]` for a text path.

It is the innermost record type around the place where it ends up. A Python function
that puts a record type around its argument captures it: to compose with functions write
`rectype(x=Ind, c=lambda r: P(r.x))`, where `r.x` is always the x of this record type.

>>> from ttr import Ind, Pred, rectype, this
>>> print(rectype(x=Ind, c=Pred("dog", Ind)(this.x)))
[x : Ind, c : dog(x)]
"""

outer = PathTo(1)
"""The record one further out, `^.x`; `outer(2).x` is two further out.

>>> from ttr import Ind, Pred, outer, rectype, this
>>> print(rectype(x=Ind, e=rectype(x=Ind, c=Pred("hug", Ind, Ind)(this.x, outer.x))))
[x : Ind, e : [x : Ind, c : hug(x, ^.x)]]
"""
