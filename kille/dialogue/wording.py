"""From a move to its sentence, by the wordings of the lexicon.

A wording has slots, which a content fills as far as it can: `{a_word}` with what it
says of its target, `{the_target}` with the phrase for that, `{relation}` with how it
stands to `{the_landmark}`. The first wording whose slots can all be filled is used.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache
from string import Formatter
from zlib import crc32

from kille.dialogue.answer_details import details
from kille.dialogue.language_files import FILES, plain
from kille.dialogue.lexicon import Lexicon, Wordings
from kille.dialogue.meanings import DialogueTypes, word_of
from kille.dialogue.phrases import (
    Words,
    claimed_predicates,
    noun_phrase,
    phrase,
    place_words,
)
from kille.dialogue.sentence_suggestions import suggest_sentence
from kille.dialogue.view_lists import either, list_slots
from kille.dialogue.word_lists import plain_text
from ttr import Rec, Record, RecordType, TTRError
from ttr.escapes import terminal_text
from ttr.types import Join, Negation, Singleton

_SHOWN = 60
"""How many characters of a text that was not understood are repeated."""

_CLAIMS = {"c": "word", "a": "quality", "rel": "relation"}
"""The slots of what is said of a target, by the label of its claim."""

_PARTS = ("target", "landmark")
"""The labels of what is said by a noun phrase."""

_WORDS = {"c": "noun", "a": "adjective", "rel": "relation"}
"""The slots of a word by itself, where the content is what the word means."""


def say(lexicon: Lexicon, act: str, move: Record) -> str:
    """The robot's sentence for a move; `act` is the name of its predicate."""
    return _fill_wording(lexicon, lexicon.says, act, move)


def tell(lexicon: Lexicon, act: str, move: Record) -> str:
    """The tutor's sentence for a move: what a simulated tutor says.

    >>> from kille.dialogue.lexicon import lexicon
    >>> from kille.dialogue.meanings import meaning_in, noun
    >>> from ttr import record
    >>> move = record(content=meaning_in("cup", "Naming"), signs=[noun("cup")])
    >>> tell(lexicon("en"), "correct", move)
    'No, a cup.'
    """
    return _fill_wording(lexicon, lexicon.tells, act, move)


def did_not_understand(
    lexicon: Lexicon,
    text: str,
    understood: Iterable[str] | None = None,
    *,
    beside: bool = False,
    types: DialogueTypes,
) -> str:
    """The sentence that says what was not understood, and what could be said instead.

    That is the text with its typos corrected, or a similar example. `understood` are
    the phrases in it that were understood: where they are given, some example is
    offered in any case. `beside` other sentences that were understood, none is.

    >>> from kille.dialogue.lexicon import lexicon
    >>> from kille.dialogue.meanings import packaged_types
    >>> types, asked = packaged_types(), "Where is teh book?"
    >>> print(did_not_understand(lexicon("en"), asked, types=types))
    Sorry, I did not understand "Where is teh book?". You could say
    "Where is the book?"; ...
    """
    shown = terminal_text(re.sub(r"\s+", " ", text).strip())
    shown = shown if len(shown) <= _SHOWN else shown[: _SHOWN - 3] + "…"
    anyhow = understood is not None
    nearest = suggest_sentence(lexicon, shown, anyhow=anyhow, types=types)
    slots = {"text": shown} | ({} if nearest is None else {"nearest": nearest})
    parts = " … ".join(terminal_text(it) for it in understood or ())
    if parts and parts.lower() != plain_text(shown):
        slots["parts"] = parts
    wordings = lexicon.not_understood_beside if beside else lexicon.not_understood
    return _choose_wording(wordings, slots).format_map(slots)


def _fill_wording(lexicon: Lexicon, wordings: Wordings, act: str, move: Record) -> str:
    if act not in wordings:
        raise _no_wording(lexicon, wordings, act)
    words = {word_of(sign): sign for sign in move.signs}
    wanted = _slots_in_any(wordings[act])
    slots = dict(_slots(lexicon, move.content, words, wanted))
    rival = move.rival if "rival" in move else Rec
    if isinstance(rival, RecordType) and rival.fields:
        of_rival = _slots(lexicon, rival, words, _slots_of_rival(wanted))
        slots |= {_of_rival(slot): text for slot, text in of_rival}
    slots |= details(lexicon, move)
    wording = _choose_wording(wordings[act], slots)
    if lexicon.varied and wordings is lexicon.says:
        wording = _draw_wording(wording, lexicon.varied.get(act, ()), str(move.e))
    return _capital(lexicon.with_examples(wording).format_map(slots))


def _no_wording(lexicon: Lexicon, wordings: Wordings, act: str) -> TTRError:
    """The mistake of whoever made a move, and has not said how it is worded."""
    table = "says" if wordings is lexicon.says else "tutor"
    file = FILES[1].format(plain(lexicon.language))
    return TTRError(
        f"there is no wording of {act}: write one under [{table}] in {file}"
    )


def _choose_wording(wordings: Iterable[str], slots: Mapping[str, str]) -> str:
    """The first wording whose slots can all be filled, or else the last."""
    wording = ""
    for wording in wordings:
        if _slots_in(wording) <= slots.keys():
            return wording
    return wording


def _draw_wording(wording: str, others: Iterable[str], name: str) -> str:
    """A wording, or another one that says as much, drawn by the name of the move.

    A dialogue that is played again has the same moves, and so the same sentences.
    """
    slots = _slots_in(wording)
    ways = [wording, *(it for it in others if _slots_in(it) == slots)]
    return ways[crc32(name.encode()) % len(ways)]


@lru_cache(1024)
def _slots_in(wording: str) -> frozenset[str]:
    found = {slot for _, slot, _, _ in Formatter().parse(wording)}
    return frozenset(slot for slot in found if slot and slot != "examples")


@lru_cache(1024)
def _slots_in_any(wordings: tuple[str, ...]) -> frozenset[str]:
    """The slots in any of several wordings: no others need be filled."""
    return frozenset().union(*map(_slots_in, wordings))


_RIVALS = {"word": "rival", "a_word": "a_rival"}
"""The slots of the rival that are not called after what they are filled with."""


def _of_rival(slot: str) -> str:
    """The slot of the rival: {rival} for {word}, {a_rival}, {rival_relation} …"""
    return _RIVALS.get(slot, f"rival_{slot}")


@lru_cache(1024)
def _slots_of_rival(wanted: frozenset[str]) -> frozenset[str]:
    """The slots that the rival fills, as they are called where it is the content."""
    plain = {
        slot.removeprefix("rival_") for slot in wanted if slot.startswith("rival_")
    }
    return frozenset(
        plain.union(it for it, rival in _RIVALS.items() if rival in wanted)
    )


def _capital(sentence: str) -> str:
    return sentence[:1].upper() + sentence[1:]


_LISTS = frozenset(("things", "choices", "count", "maybe_count"))
"""The slots for lists of what is in view."""


def _slots(
    lexicon: Lexicon, content: RecordType, words: Words, wanted: frozenset[str]
) -> Iterator[tuple[str, str]]:
    """The slots that a content fills, with what it fills them with.

    What takes some work is done for the slots that are wanted only.
    """
    yield from _claim_slots(lexicon, content, words, wanted)
    if not wanted.isdisjoint(_LISTS):
        yield from list_slots(lexicon, content, words)
    for label, field in content.fields:
        sign = next((it for it in words.values() if it.meaning is field), None)
        if sign is not None and label not in (*_PARTS, *lexicon.styles):
            yield from _forms(lexicon, label, sign, wanted)
        elif label == "amid" and isinstance(field, RecordType):
            between = place_words(lexicon, field, words)
            if between is not None:
                yield label, between
        elif isinstance(field, RecordType):
            yield from _phrase_slots(lexicon, label, field, words, wanted)
        elif isinstance(field, Singleton) and isinstance(
            field.value, str | float | int
        ):
            yield label, lexicon.values.get(str(field.value), _plainly(field.value))


def _claim_slots(
    lexicon: Lexicon, content: RecordType, words: Words, wanted: frozenset[str]
) -> Iterator[tuple[str, str]]:
    """The words that a content claims to be true, or not."""
    alone, wanted = "x" in content, _with_claims_denied(wanted)
    for label in _CLAIMS:
        signs = [words[p] for p in claimed_predicates(content.get(label)) if p in words]
        if not signs:
            continue
        several = signs if isinstance(content[label], Join) else signs[:1]
        forms = [
            dict(_forms(lexicon, (_WORDS if alone else _CLAIMS)[label], sign, wanted))
            for sign in several
        ]
        if label == "a" and not alone:
            article = _gender(lexicon, content, words)
            for its, sign in zip(forms, several, strict=True):
                its["so"] = lexicon.predicative_form(sign.form, article)
                its["how"] = lexicon.say_material(sign.form) or sign.form
        slots = {
            slot: either(lexicon, [its[slot] for its in forms]) for slot in forms[0]
        }
        yield from slots.items()
        if isinstance(content[label], Negation):
            yield from ((f"not_{slot}", text) for slot, text in slots.items())
        if label == "rel" and "scale" in content:
            yield "comparative", signs[0].form.rpartition(" ")[0]


@lru_cache(1024)
def _with_claims_denied(wanted: frozenset[str]) -> frozenset[str]:
    """Slots, with those for what is claimed where they are for what is denied."""
    return wanted.union(slot.removeprefix("not_") for slot in wanted)


def _forms(
    lexicon: Lexicon, slot: str, sign: Record, wanted: frozenset[str]
) -> Iterator[tuple[str, str]]:
    """The forms of a word, as slots: the word, and what is wanted besides."""
    yield slot, sign.form
    if sign.kind == "adjective" and (plural := f"plural_{slot}") in wanted:
        material = lexicon.say_material(sign.form)
        yield plural, material or lexicon.inflect(sign.form, "WEAK")
    if sign.kind != "noun":
        return
    if (indefinite := f"a_{slot}") in wanted:
        yield indefinite, lexicon.with_article(sign.form, sign.article)
    if (definite := f"the_{slot}") in wanted:
        yield definite, noun_phrase(lexicon, sign, "definite")
    if (plural := f"plural_{slot}") in wanted:
        yield plural, lexicon.inflect(sign.form, "PLURAL", lexicon.article(sign))


def _gender(lexicon: Lexicon, content: RecordType, words: Words) -> str:
    """The article of the noun for the target, which what is said of it agrees with."""
    target = content.get("target")
    if not isinstance(target, RecordType):
        return ""
    noun = next(
        (words[p] for p in claimed_predicates(target.get("c")) if p in words), None
    )
    return lexicon.article(noun) if noun is not None else ""


def _phrase_slots(
    lexicon: Lexicon,
    label: str,
    part: RecordType,
    words: Words,
    wanted: frozenset[str],
) -> Iterator[tuple[str, str]]:
    """The phrase for a part, with and without its articles, as far as it is wanted."""
    for slot, style in (
        (label, label if label in lexicon.styles else "bare"),
        (f"a_{label}", "indefinite"),
        (f"the_{label}", "definite"),
        (f"no_{label}", "negated"),
    ):
        if slot not in wanted or (
            style == "negated" and not {"c", "a"} & {*part.labels}
        ):
            continue
        found = phrase(lexicon, part, words, style)
        if found is not None:
            yield slot, found


def _plainly(value: str | float) -> str:
    """A number or text of a content, in words."""
    return f"{value:g}" if isinstance(value, float) else str(value)
