"""Types of what is said of things: conjunction, quantification, sameness."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import count
from typing import TypeAlias

from ttr.building.constructors import rectype
from ttr.types.paths import rebuilt
from ttr.types.syntax import (
    BOUND,
    Function,
    Ind,
    Object,
    Path,
    RecordType,
    Singleton,
    TypeNode,
)

__all__ = ["Property", "Variables", "all_of", "closed", "conjuncts", "placed", "same"]

Property: TypeAlias = Callable[[str], TypeNode]
"""What is said of a thing, given its name."""


class Variables:
    """Names for variables while a type is built, none of them the name of an object."""

    def __init__(self) -> None:
        self._numbers: Iterator[int] = count(1)

    def bind(self, said: Property) -> Function:
        """The function from a thing to what is said of it.

        >>> from ttr.types.syntax import Pred
        >>> hug = Pred("hug", Ind, Ind)
        >>> print(Variables().bind(lambda x: hug(x, "sam")))
        \\x:Ind. hug(x, sam)
        """
        name = self.fresh()
        return closed(said(name), name)

    def fresh(self) -> str:
        """A name that stands for nothing else."""
        return f"·{next(self._numbers)}"


def closed(said: TypeNode, name: str) -> Function:
    """The function λx:Ind. of a type, with the variable where the name stands."""
    return Function(Ind, placed(said, name, BOUND), "x")


def placed(said: TypeNode, name: str, *labels: str) -> Object:
    """The type, one scope further in, with a path where the name stands."""

    def at(value: Object, depth: int) -> Object:
        if isinstance(value, str):
            return Path(depth, labels) if value == name else value
        return rebuilt(value, lambda part, deeper: at(part, depth + deeper))

    return at(said, 0)


def all_of(*parts: TypeNode) -> TypeNode:
    """The type of records with a situation of each of the types; of one, itself.

    >>> from ttr.types.syntax import Pred
    >>> dog, bark = Pred("dog", Ind), Pred("bark", Ind)
    >>> print(all_of(dog("fido"), all_of(bark("fido"), dog("fido"))))
    [c1 : dog(fido), c2 : bark(fido)]
    """
    flat = dict.fromkeys(piece for part in parts for piece in conjuncts(part))
    if len(flat) == 1:
        return next(iter(flat))
    return rectype({f"c{i}": piece for i, piece in enumerate(flat, 1)})


def conjuncts(T: TypeNode) -> tuple[TypeNode, ...]:
    """The types that a type of `all_of` puts together; of any other, itself."""
    if isinstance(T, RecordType) and T.labels == tuple(
        f"c{i}" for i in range(1, len(T.labels) + 1)
    ):
        return tuple(piece for _, piece in T.fields)
    return (T,)


def same(a: str, b: str) -> TypeNode:
    """The type that is true iff a is b: b, as one of the things that are a."""
    return Singleton(Singleton(Ind, a), b)
