"""Determiners: what every, most, both or at least three say of two properties."""

from __future__ import annotations

from ttr.semantics.fragment.content_types import all_of
from ttr.semantics.fragment.sentence_parsing import Phrase
from ttr.semantics.quantifiers import (
    Determiner,
    at_least,
    at_most,
    every,
    exactly,
    exist,
    few,
    many,
    most,
    no,
    not_every,
    several,
)
from ttr.types.syntax import Function, TypeNode

__all__ = ["determined"]

PLAIN: dict[str, Determiner] = {
    one.name: one for one in (every, not_every, exist, no, most, many, few, several)
}

PRESUPPOSING: dict[str, tuple[Determiner, Determiner]] = {
    "the": (exist, every),
    "both": (exactly(2), every),
    "neither": (exactly(2), no),
}
"""How many there are, and how many of them are so."""

NUMERALS: tuple[str, ...] = (
    *("zero", "one", "two", "three", "four", "five", "six"),
    *("seven", "eight", "nine", "ten", "eleven", "twelve"),
)


def determined(det: Phrase, P: Function, Q: Function) -> TypeNode:
    """The type that a determiner makes of two properties."""
    if det.kind in PRESUPPOSING:
        there_are, so_many = PRESUPPOSING[det.kind]
        return all_of(there_are(P, P), so_many(P, Q))
    if det.kind in PLAIN:
        return PLAIN[det.kind](P, Q)
    return _counted(det.kind, _number(det))(P, Q)


def _counted(kind: str, n: int) -> Determiner:
    match kind:
        case "at_most":
            return at_most(n)
        case "exactly":
            return exactly(n)
        case "more_than":
            return at_least(n + 1)
        case "fewer_than":
            return at_most(n - 1)
    return at_least(n)


def _number(det: Phrase) -> int:
    """The number that a determiner ends with, which is 1 or more."""
    word = det.parts[-1].parts[0].word.lower()
    return int(word) if word.isdecimal() else NUMERALS.index(word)
