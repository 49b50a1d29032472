"""Putting the names of a theory for what they stand for, so that types stay short."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

from ttr.errors import IllFormed
from ttr.safety.budgets import spend
from ttr.types.paths import escaping, rebuilt
from ttr.types.syntax import (
    Basic,
    EventString,
    FiniteSet,
    Function,
    Object,
    Path,
    Record,
    RecordType,
    TypeNode,
    Universe,
    identity,
)

if TYPE_CHECKING:
    from ttr.signature.signature import Signature

__all__ = ["folding"]


def folding(theory: Signature | None, unfold: int | None) -> Callable[[Object], Object]:
    """A function that puts the names of the theory for what is defined in it.

    `unfold` is how many definitions are opened, one inside another, before a name
    stands; None opens all. Raises `IllFormed` for what is no such number, and where
    there is no theory to take names from.

    >>> from ttr.theories.theory import Theory
    >>> kennel = Theory.parse('''
    ...     basic Ind
    ...     pred  dog(Ind)
    ...     Dog  := [x : Ind, c : dog(x)]
    ...     Pair := [a : Dog, b : Dog]
    ... ''')
    >>> print(folding(kennel, 0)(kennel.Pair), folding(kennel, 1)(kennel.Pair))
    Pair [a : Dog, b : Dog]
    """
    if unfold is None:
        return lambda value: value
    if type(unfold) is not int or unfold < 0:
        raise IllFormed(
            "unfold takes how many levels of definitions to open, 0 or more, "
            f"found {unfold!r}"
        )
    definitions = getattr(theory, "definitions", None)
    if definitions is None:
        raise IllFormed(
            "unfold needs the theory whose names to show",
            hint="give it too, as in box(T, unfold=0, theory=kennel)",
        )
    names = _names(definitions)
    return lambda value: _folded(value, names, unfold)


def _names(definitions: Mapping[str, Object]) -> dict[object, str]:
    """The names by what they stand for; where there are several, the first defined.

    What has a path that leads out of it depends on where it stands, so that no name
    stands for it.
    """
    names: dict[object, str] = {}
    for name, value in definitions.items():
        if _is_long(value) and not escaping(value):
            names.setdefault(identity(value), name)
    return names


def _is_long(value: Object) -> bool:
    """Whether a name can be shorter: a single word keeps its own."""
    match value:
        case Basic() | Universe() | Path() | RecordType(()) | ():
            return False
    kinds = (TypeNode, Function, Record, tuple, FiniteSet, EventString)
    return isinstance(value, kinds)


def _folded(value: Object, names: Mapping[object, str], unfold: int) -> Object:
    spend()
    name = names.get(identity(value)) if _is_long(value) else None
    if name is not None and unfold == 0:
        return Basic(name)
    inner = unfold if name is None else unfold - 1
    return rebuilt(value, lambda part, _: _folded(part, names, inner))
