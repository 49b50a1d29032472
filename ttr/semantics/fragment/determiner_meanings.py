"""Meanings of determiners: quantifiers for every, most, both, at least three."""

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

_PLAIN: dict[str, Determiner] = {
    one.name: one for one in (every, not_every, exist, no, most, many, few, several)
}

_PRESUPPOSING: dict[str, tuple[Determiner, Determiner]] = {
    "the": (exist, every),
    "both": (exactly(2), every),
    "neither": (exactly(2), no),
}
"""What they presuppose of how many there are, and what they say of these."""

_NUMERALS: tuple[str, ...] = (
    *("zero", "one", "two", "three", "four", "five", "six"),
    *("seven", "eight", "nine", "ten", "eleven", "twelve"),
)


def apply_determiner(det: Phrase, P: Function, Q: Function) -> TypeNode:
    """The type det(P, Q) for a determiner phrase and two properties."""
    if det.kind in _PRESUPPOSING:
        there_are, so_many = _PRESUPPOSING[det.kind]
        return all_of(there_are(P, P), so_many(P, Q))
    if det.kind in _PLAIN:
        return _PLAIN[det.kind](P, Q)
    return _numeral_determiner(det.kind, _number(det))(P, Q)


def _numeral_determiner(kind: str, n: int) -> Determiner:
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
    """The number at the end of a determiner phrase: a numeral or digits."""
    word = det.parts[-1].parts[0].word.lower()
    return int(word) if word.isdecimal() else _NUMERALS.index(word)
