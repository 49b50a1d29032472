"""Lists of what is in view, in words, by how certain each thing is; and counts.

A content that says what is in view has a part for each thing: thing01, thing02 … for
things that the robot is sure of, maybe01 … for likely ones, unknown01 … for the rest.
A question which thing was meant has choice01, choice02 … for the candidates.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import groupby
from typing import Any

from kille.dialogue.lexicon import Lexicon
from kille.dialogue.phrases import Words, claimed_predicates, phrase
from ttr import RecordType

Section = Mapping[str, Any]


def list_slots(
    lexicon: Lexicon, content: RecordType, words: Words
) -> Iterator[tuple[str, str]]:
    """The slots that the parts of a content fill: {things}, {count}, {choices} …

    >>> from kille.dialogue.games.surveying import in_view
    >>> from kille.dialogue.lexicon import lexicon
    >>> from kille.dialogue.meanings import noun, packaged_types, word_of
    >>> from kille.dialogue.state import initial
    >>> from ttr import record
    >>> cup = noun("cup")
    >>> seen = [record(sit=record(x=x), sign=cup) for x in ("o1", "o2")]
    >>> content = in_view(initial(), seen, [], ["o3"], types=packaged_types())
    >>> dict(list_slots(lexicon(), content, {word_of(cup): cup}))["things"]
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
    named = (
        [*_in_row(lexicon, data, content, words)]
        if "order" in content
        else [
            *_group_by_noun(lexicon, data, seen.get("thing", ()), words, "{}"),
            *_group_by_noun(
                lexicon, data, seen.get("maybe", ()), words, data["perhaps"]
            ),
            *_unknown(data, count["unknown"]),
        ]
    )
    if named:
        yield "things", _join(data, named)
    if "choice" in seen:
        yield "choices", either(lexicon, list(_choices(lexicon, seen["choice"], words)))
    for slot, label in (("count", "thing"), ("maybe_count", "maybe")):
        if count[label]:
            article = _article(lexicon, seen[label], words)
            yield slot, _number(data, count[label], article)


def _in_row(
    lexicon: Lexicon, data: Section, content: RecordType, words: Words
) -> Iterator[str]:
    """What is in view from one side on; like things that stand together are counted."""
    kinds = {"thing": "{}", "maybe": data["perhaps"]}
    parts = sorted(content.fields, key=lambda it: it[0][-2:])
    seen = [
        (label[:-2], part)
        for label, part in parts
        if label[:-2] in (*kinds, "unknown") and isinstance(part, RecordType)
    ]

    def kind(it: tuple[str, RecordType]) -> tuple[str, str | None]:
        label, part = it
        return label, phrase(lexicon, part, words, "bare")

    for (label, _), alike in groupby(seen, kind):
        found = [part for _, part in alike]
        if label == "unknown":
            yield from _unknown(data, len(found))
        else:
            yield from _group_by_noun(lexicon, data, found, words, kinds[label])


def either(lexicon: Lexicon, parts: Sequence[str]) -> str:
    """Alternatives in a row: this, that or the other.

    >>> from kille.dialogue.lexicon import lexicon
    >>> either(lexicon(), ["a cup"]), either(lexicon(), ["red", "blue", "green"])
    ('a cup', 'red, blue or green')
    """
    data = lexicon.sections["listing"]
    *before, last = parts
    if not before:
        return last
    wording: str = data["either"]
    return wording.format(data["between"].join(before), last)


def _group_by_noun(
    lexicon: Lexicon,
    data: Section,
    parts: Sequence[RecordType],
    words: Words,
    wording: str,
) -> Iterator[str]:
    """Count things by their nouns, in the order of their first things."""
    nouns = Counter(phrase(lexicon, part, words, "bare") for part in parts)
    first = {phrase(lexicon, part, words, "bare"): part for part in reversed(parts)}
    for noun, count in nouns.items():
        if noun is None:
            continue
        one = phrase(lexicon, first[noun], words, "indefinite")
        all_of_them = phrase(lexicon, first[noun], words, "counted")
        several = f"{_number(data, count)} {all_of_them}"
        yield wording.format(one if count == 1 else several)


def _choices(
    lexicon: Lexicon, parts: Sequence[RecordType], words: Words
) -> Iterator[str]:
    """Phrases to choose from; one noun is said once, where all have adjectives."""
    nouns = {part.get("c") for part in parts}
    alike = len(nouns) == 1 and None not in nouns
    plain = all("a" in part and "landmark" not in part for part in parts)
    style = "elided" if alike and plain else "definite"
    *before, last = parts
    for part in before:
        yield phrase(lexicon, part, words, style) or ""
    yield phrase(lexicon, last, words, "definite") or ""


def _unknown(data: Section, count: int) -> Iterator[str]:
    if count:
        wording = data["unknown"] if count == 1 else data["unknowns"]
        yield wording.format(_number(data, count))


def _join(data: Section, parts: list[str]) -> str:
    """Parts of a list, with commas between them and a word before the last."""
    *before, last = parts
    if not before:
        return last
    wording: str = data["last" if len(before) > 1 else "both"]
    return wording.format(data["between"].join(before), last)


def _article(lexicon: Lexicon, parts: Iterable[RecordType], words: Words) -> str:
    """The article of the nouns of some things, if it is the same of all of them."""
    found = {
        lexicon.article(words[it])
        for part in parts
        for it in claimed_predicates(part.get("c"))
        if it in words
    }
    return found.pop() if len(found) == 1 else ""


def _number(data: Section, count: int, article: str = "") -> str:
    """A number in words, if the language has a word for it.

    Where the number one agrees with a noun, it goes by the article.
    """
    numbers = data["numbers"]
    if count == 1 and article in data.get("one", {}):
        return str(data["one"][article])
    return str(numbers[count - 1] if count <= len(numbers) else count)
