"""Types that contents are made of: abstraction, conjunction, equality."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import count
from typing import TypeAlias

from ttr.building.constructors import rectype
from ttr.types.objects import BOUND
from ttr.types.substitution import replace_name
from ttr.types.syntax import Function, Ind, RecordType, Singleton, TypeNode

Property: TypeAlias = Callable[[str], TypeNode]
"""A function from the name of a thing to what is said of it."""


class Variables:
    """Fresh names for variables, for as long as a type is being built."""

    def __init__(self) -> None:
        self._numbers: Iterator[int] = count(1)

    def bind(self, said: Property) -> Function:
        """The function λx:Ind. said(x).

        >>> from ttr import Pred
        >>> hug = Pred("hug", Ind, Ind)
        >>> print(Variables().bind(lambda x: hug(x, "sam")))
        \\x:Ind. hug(x, sam)
        """
        name = self.fresh()
        return abstract_over(said(name), name)

    def fresh(self) -> str:
        """A name that no object and no other variable has."""
        return f"·{next(self._numbers)}"


def abstract_over(said: TypeNode, name: str) -> Function:
    """The function λx:Ind. said[x/name]: a variable in place of the name."""
    return Function(Ind, replace_name(said, name, BOUND))


def all_of(*parts: TypeNode) -> TypeNode:
    """The record type [c1 : T₁, c2 : T₂, …] of several types; of one type, itself.

    >>> from ttr import Pred
    >>> dog, bark = Pred("dog", Ind), Pred("bark", Ind)
    >>> print(all_of(dog("fido"), all_of(bark("fido"), dog("fido"))))
    [c1 : dog(fido), c2 : bark(fido)]
    """
    flat = dict.fromkeys(piece for part in parts for piece in conjuncts(part))
    if len(flat) == 1:
        return next(iter(flat))
    return rectype({f"c{i}": piece for i, piece in enumerate(flat, 1)})


def conjuncts(T: TypeNode) -> tuple[TypeNode, ...]:
    """The types that `all_of` has put together; any other type is its only conjunct."""
    if isinstance(T, RecordType) and T.labels == tuple(
        f"c{i}" for i in range(1, len(T.labels) + 1)
    ):
        return tuple(piece for _, piece in T.fields)
    return (T,)


def equality(a: str, b: str) -> TypeNode:
    """A type that is true iff a is b: that of the things which are a and are b."""
    return Singleton(Singleton(Ind, a), b)
