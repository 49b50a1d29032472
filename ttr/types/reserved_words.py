"""The words of the notation, which a theory cannot declare."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from ttr.types.objects import Object, fst, rst
from ttr.types.syntax import (
    ListOf,
    NonEmpty,
    Plus,
    Rec,
    RecType,
    SetOf,
    Str,
    Type,
    TypeNode,
)

LOGICAL: Mapping[str, TypeNode] = {"Type": Type, "RecType": RecType, "Rec": Rec}
"""The types that every theory has."""

WORDS: Mapping[type[TypeNode], str] = {
    ListOf: "list",
    NonEmpty: "nelist",
    SetOf: "set",
    Plus: "plus",
    Str: "str",
}
"""Types that are written as a word with types in brackets."""

LIST_OPERATIONS: Mapping[str, Callable[[Object], Object]] = {"fst": fst, "rst": rst}
"""Words that make an object of a list in brackets."""

RESERVED = frozenset((*LOGICAL, *WORDS.values(), *LIST_OPERATIONS, "fun"))
"""All of these words, and the one that begins a function."""
