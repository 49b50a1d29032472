"""What is said can be understood again: parse(generate(act)) = act, in each language.

A content is made of the slots of the wording, so that every act of the lexicon is
tried, whoever adds it.
"""

from __future__ import annotations

import random
from string import Formatter

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kille.dialogue.language import LANGUAGES, overhear, understand
from kille.dialogue.lexicon import lexicon
from kille.dialogue.meanings import (
    CLAIMS,
    denied,
    named,
    noun,
    placed,
    predicate_at,
    relation,
    sign,
)
from kille.dialogue.wording import say, tell
from ttr import Rec, Record, RecordType, merge, record, rectype

NOUNS = {
    "en": ["cup", "apple", "book", "shoe-box", "unicorn", "box", "hour", "gadget"],
    "sv": ["kopp", "äpple", "bok", "hus", "nallebjörn", "blick", "penna", "fönster"],
}
ADJECTIVES = {
    "en": ["red", "big", "striped", "orange", "round"],
    "sv": ["röd", "stor", "randig", "blå", "rund", "liten", "svart"],
}
RELATIONS = {
    "en": ["to the left of", "behind", "in front of", "near", "on top of"],
    "sv": ["till vänster om", "bakom", "framför", "bredvid", "i närheten av"],
}

WORD_SLOTS = {
    "word": "Naming",
    "a_word": "Naming",
    "quality": "Having",
    "so": "Having",
    "relation": "Relation",
    "noun": "Noun",
    "the_noun": "Noun",
    "a_noun": "Noun",
    "adjective": "Adjective",
    "not_word": "NotNaming",
    "not_a_word": "NotNaming",
    "not_quality": "NotHaving",
    "not_so": "NotHaving",
    "not_relation": "NotRelation",
    "rival_so": "Having",
    "plural_noun": "Noun",
    "rival": "Naming",
    "a_rival": "Naming",
    "rival_quality": "Having",
    "rival_relation": "Relation",
}
"""What a slot says of a word, as the type that the word has its place in."""

PHRASES = ("target", "landmark", "counted")

OTHER = {"examples"}


def slots_of(wording: str) -> list[str]:
    return [slot for _, slot, _, _ in Formatter().parse(wording) if slot]


def is_plain(wording: str) -> bool:
    """Whether the text holds all there is of the content."""
    return all(
        slot in WORD_SLOTS or slot in OTHER or slot.split("_")[-1] in PHRASES
        for slot in slots_of(wording)
        if not slot.startswith("rival_") or slot in WORD_SLOTS
    ) and not any(
        slot.startswith(("rival_the", "rival_a_t")) for slot in slots_of(wording)
    )


def a_word(chance: random.Random, language: str, template: str) -> Record:
    match template:
        case "Naming" | "Noun" | "NotNaming":
            return noun(chance.choice(NOUNS[language]))
        case "Having" | "Adjective" | "NotHaving":
            form = chance.choice(ADJECTIVES[language])
            return sign(form, "adjective", means=lexicon(language).means.get(form, ""))
    return relation(chance.choice(RELATIONS[language]))


def a_phrase(chance: random.Random, language: str, definite: bool) -> RecordType:
    kinds = ["Noun", "Adjective Noun"]
    if definite:
        kinds += ["Adjective", "This", "It", "Other", "This Noun", "Other Noun"]
    meaning: RecordType = named("Phrase")
    for name in chance.choice(kinds).split():
        if name in ("Noun", "Adjective"):
            WORDS.append(a_word(chance, language, name))
            meaning = merge(meaning, WORDS[-1].meaning)
        else:
            meaning = merge(meaning, named(name))
    return meaning


WORDS: list[Record] = []


TOLD_OF = {
    "mention": "Asked",
    "ask_name": "Asked",
    "ask_place": "Asked",
    "ask_quality": "Asked",
    "ask_find": "Asked",
    "ask_view": "Scene",
    "ask_count": "Scene",
    "take_frame": "ByLandmark",
    "ask_meaning": "Word",
    "forget_word": "Word",
}
"""What else the content of a tutor's move says; Word: that the word itself is meant."""


def a_move(
    chance: random.Random, language: str, wording: str, told_of: str | None = None
) -> Record:
    """A move of which the wording says everything."""
    WORDS.clear()
    chosen: dict[tuple[bool, str], Record] = {}
    by_itself = told_of in ("Asked", "Scene", "ByLandmark")
    content: RecordType = named(told_of) if by_itself else Rec
    rival: RecordType = Rec
    for slot in slots_of(wording):
        if slot in WORD_SLOTS:
            template = WORD_SLOTS[slot]
            rivalry = slot.startswith(("rival", "a_rival"))
            while (rivalry, template) not in chosen:
                word = a_word(chance, language, template)
                if word not in WORDS:
                    chosen[rivalry, template] = word
                    WORDS.append(word)
            said = placed(chosen[rivalry, template], template)
            if told_of == "Word":
                said = rectype(word=chosen[rivalry, template].meaning)
            if "rival" in slot:
                rival = merge(rival, said)
            else:
                content = merge(content, said)
        elif slot not in OTHER:
            part = slot.split("_")[-1]
            phrase = a_phrase(chance, language, slot.startswith("the_"))
            content = merge(content, rectype({part: phrase}))
    if rival is not Rec:
        same = rectype({k: T for k, T in content.fields if k not in CLAIMS})
        rival = merge(same, rival)
    return record(content=content, rival=rival, signs=list(dict.fromkeys(WORDS)))


def is_claim(content: RecordType) -> bool:
    return any(label in content for label in CLAIMS)


SAID = [
    (language, act, wording)
    for language in LANGUAGES
    for act, wordings in lexicon(language).says.items()
    for wording in wordings
    if is_plain(wording)
]

LESS = {
    ("ask_count", "How many things are there?"),
    ("ask_count", "Hur många saker finns det?"),
}
"""Wordings that say "things" of what the content says nothing of."""

TOLD = [
    (language, act, wording)
    for language in LANGUAGES
    for act, wordings in lexicon(language).tells.items()
    for wording in wordings
    if is_plain(wording) and (act, wording) not in LESS
]


@pytest.mark.parametrize(("language", "act", "wording"), SAID)
@settings(max_examples=8)
@given(st.integers(0, 2**32))
def test_what_the_robot_says_is_understood(
    language: str, act: str, wording: str, seed: int
) -> None:
    move = a_move(random.Random(seed), language, wording)
    text = say(lexicon(language), act, move)
    said = overhear(text, language)
    readings = [
        (predicate_at(it.type, "e").name, it.content, it.type["rival"].value)
        for it in said
    ]
    assert (act, move.content, move.rival) in readings, text
    assert (act, denied(move.content), move.rival) not in readings or not is_claim(
        move.content
    )


@pytest.mark.parametrize(("language", "act", "wording"), TOLD)
@settings(max_examples=8)
@given(st.integers(0, 2**32))
def test_what_the_tutor_says_is_understood(
    language: str, act: str, wording: str, seed: int
) -> None:
    move = a_move(random.Random(seed), language, wording, TOLD_OF.get(act))
    text = tell(lexicon(language), act, move)
    (said,) = understand(text, language)
    found = [(predicate_at(it.type, "e").name, it.content) for it in said.readings]
    assert (act, move.content) in found, text
    assert (act, denied(move.content)) not in found or not is_claim(move.content)


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_languages_say_the_same_acts(language: str) -> None:
    assert lexicon(language).says.keys() == lexicon("en").says.keys()
    assert lexicon(language).tells.keys() == lexicon("en").tells.keys()


def test_words_are_said_as_the_tutor_says_them() -> None:
    english = lexicon("en")
    move = record(
        content=placed(noun("hotel", "an"), "Naming"), signs=[noun("hotel", "an")]
    )
    assert say(english, "learned", move) == "OK, I learned an hotel."
