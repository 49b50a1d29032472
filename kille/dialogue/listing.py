"""What is in view, in words: a list by how certain each thing is, and counts.

A content that says what is in view has a part for each thing: thing01, thing02 … for
those that the robot is sure of, maybe01 … for what may be so, unknown01 … for the rest.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from kille.dialogue.lexicon import Lexicon
from kille.dialogue.phrases import Words, phrase
from ttr import RecordType

__all__ = ["listed"]

Section = Mapping[str, Any]


def listed(
    lexicon: Lexicon, content: RecordType, words: Words
) -> Iterator[tuple[str, str]]:
    """The slots that the parts of a view fill: {things}, {count} and {maybe_count}.

    >>> from kille.dialogue.games.surveying import in_view
    >>> from kille.dialogue.lexicon import lexicon
    >>> from kille.dialogue.meanings import noun, word_of
    >>> from kille.dialogue.state import initial
    >>> from ttr import record
    >>> cup = noun("cup")
    >>> seen = [record(sit=record(x=x), sign=cup) for x in ("o1", "o2")]
    >>> content = in_view(initial(), seen, [], ["o3"])
    >>> dict(listed(lexicon(), content, {word_of(cup): cup}))["things"]
    'two cups and one thing that I do not know'
    """
    data = lexicon.sections["listing"]
    parts = [
        (label.rstrip("0123456789"), part)
        for label, part in content.fields
        if isinstance(part, RecordType)
    ]
    count = Counter(label for label, _ in parts)
    seen = {label: [part for it, part in parts if it == label] for label in count}
    named = [
        *_named(lexicon, data, seen.get("thing", ()), words, "{}"),
        *_named(lexicon, data, seen.get("maybe", ()), words, data["perhaps"]),
        *_unknown(data, count["unknown"]),
    ]
    if named:
        yield "things", _joined(data, named)
    counted = content.get("counted")
    if isinstance(counted, RecordType):
        noun = phrase(lexicon, counted, words, "bare")
        yield from [("several", lexicon.inflected(noun, "PLURAL"))] if noun else []
    for slot, label in (("count", "thing"), ("maybe_count", "maybe")):
        if count[label]:
            yield slot, _number(data, count[label])


def _named(
    lexicon: Lexicon,
    data: Section,
    parts: Sequence[RecordType],
    words: Words,
    wording: str,
) -> Iterator[str]:
    """Things by their nouns: of the same sort all at once, in the order given."""
    nouns = Counter(phrase(lexicon, part, words, "bare") for part in parts)
    first = {phrase(lexicon, part, words, "bare"): part for part in reversed(parts)}
    for noun, count in nouns.items():
        if noun is None:
            continue
        one = phrase(lexicon, first[noun], words, "indefinite")
        several = f"{_number(data, count)} {lexicon.inflected(noun, 'PLURAL')}"
        yield wording.format(one if count == 1 else several)


def _unknown(data: Section, count: int) -> Iterator[str]:
    if count:
        wording = data["unknown"] if count == 1 else data["unknowns"]
        yield wording.format(_number(data, count))


def _joined(data: Section, parts: list[str]) -> str:
    """Parts of a list, with commas between them and a word before the last."""
    *before, last = parts
    if not before:
        return last
    wording: str = data["last" if len(before) > 1 else "both"]
    return wording.format(data["between"].join(before), last)


def _number(data: Section, count: int) -> str:
    """A number in words, as far as there are any."""
    numbers = data["numbers"]
    return str(numbers[count - 1] if count <= len(numbers) else count)
