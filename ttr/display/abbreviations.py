"""Abbreviates types by the names that a theory defines for them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from ttr.errors import IllFormedError
from ttr.safety.budgets import spend
from ttr.types.interning import Node, identity
from ttr.types.objects import EventString, FiniteSet, Object, Path, Record
from ttr.types.paths import free_paths, map_parts
from ttr.types.printing import Scope, Spelling, spelling_of
from ttr.types.syntax import Basic, Function, FunType, RecordType, TypeNode, Universe

if TYPE_CHECKING:
    from ttr.signature.signature import Signature


@dataclass(frozen=True)
class Abbreviator:
    """Replaces what a theory defines by its name, up to so many levels from outside."""

    names: Mapping[object, str]
    unfold: int | None
    _folded: dict[Node, Node] = field(default_factory=dict)

    def __call__(self, value: Object) -> Object:
        """The value with names in place of definitions."""
        return value if self.unfold is None else self._fold(value, self.unfold)

    def spelling(self, text: Scope) -> Scope:
        """How a text writes what has been abbreviated so far, and anything else."""
        if not text or not self._folded or not isinstance(text[-1], Spelling):
            return text
        written = text[-1].written
        known = [(new, old) for new, old in self._folded.items() if old in written]
        return spelling_of([{new: written[old] for new, old in known}, written])

    def _fold(self, value: Object, unfold: int) -> Object:
        spend()
        name = self.names.get(identity(value)) if _is_long(value) else None
        if name is not None and unfold == 0:
            return Basic(name)
        inner = unfold if name is None else unfold - 1
        found = map_parts(value, lambda part, _: self._fold(part, inner))
        if found is not value and isinstance(value, RecordType | Function | FunType):
            self._folded.setdefault(found, value)
        return found


def abbreviator(theory: Signature | None, unfold: int | None) -> Abbreviator:
    """A function that replaces what the theory defines by its name.

    `unfold` is the number of definitions, one inside another, that are shown in full
    before a name is put; None shows all of them in full. Raises `IllFormedError` if it
    is neither, and if there is no theory to take names from.

    >>> from ttr import Theory
    >>> kennel = Theory.parse('''
    ...     basic Ind
    ...     pred  dog(Ind)
    ...     Dog  := [x : Ind, c : dog(x)]
    ...     Pair := [a : Dog, b : Dog]
    ... ''')
    >>> print(abbreviator(kennel, 0)(kennel.Pair), abbreviator(kennel, 1)(kennel.Pair))
    Pair [a : Dog, b : Dog]
    """
    if unfold is None:
        return Abbreviator({}, None)
    if type(unfold) is not int or unfold < 0:
        raise IllFormedError(
            "unfold takes how many levels of definitions to open, 0 or more, "
            f"found {unfold!r}"
        )
    definitions = getattr(theory, "definitions", None)
    if definitions is None:
        raise IllFormedError(
            "unfold needs the theory whose names to show",
            hint="give it too, as in box(T, unfold=0, theory=kennel)",
        )
    return Abbreviator(_names(definitions), unfold)


def _names(definitions: Mapping[str, Object]) -> dict[object, str]:
    """The name of each definition; the first, if there are several.

    A value with a path that leads out of it has none: what it means depends on where it
    stands.
    """
    names: dict[object, str] = {}
    for name, value in definitions.items():
        if _is_long(value) and not free_paths(value):
            names.setdefault(identity(value), name)
    return names


def _is_long(value: Object) -> bool:
    """Is the value longer than a name?"""
    match value:
        case Basic() | Universe() | Path() | RecordType(()) | ():
            return False
    kinds = (TypeNode, Function, Record, tuple, FiniteSet, EventString)
    return isinstance(value, kinds)
