"""What is said can be understood again: parse(generate(act)) = act, in each language.

A content is made of the slots of the wording, so that every act of the lexicon is
tried, whoever adds it.
"""

from __future__ import annotations

import random
from collections.abc import Sequence, Set
from string import Formatter

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kille.dialogue.language import LANGUAGES, overhear, understand
from kille.dialogue.lexicon import lexicon
from kille.dialogue.meanings import (
    CLAIMS,
    denial,
    meaning_at,
    noun,
    predicate_at,
    record_type,
    relation,
    sign,
    theory,
)
from kille.dialogue.wording import say, tell
from kille.lab.tutors.heard_sayings import IN_PARTS
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

COMPARATIVES = {
    "en": ["bigger than", "smaller than", "nearer than"],
    "sv": ["större än", "mindre än", "närmare än"],
}

WORD_SLOTS = {
    "word": "Naming",
    "a_word": "Naming",
    "quality": "Having",
    "so": "Having",
    "how": "Having",
    "relation": "Relation",
    "comparative": "Comparison",
    "noun": "Noun",
    "the_noun": "Noun",
    "a_noun": "Noun",
    "adjective": "Adjective",
    "plural_adjective": "Adjective",
    "not_word": "NotNaming",
    "not_a_word": "NotNaming",
    "not_quality": "NotHaving",
    "not_so": "NotHaving",
    "not_how": "NotHaving",
    "not_relation": "NotRelation",
    "rival_so": "Having",
    "rival_how": "Having",
    "plural_noun": "Noun",
    "rival": "Naming",
    "a_rival": "Naming",
    "rival_quality": "Having",
    "rival_relation": "Relation",
}
"""What a slot says of a word, as the type that the word has its place in."""

KIND_SLOTS = {
    "a_subkind": "subkind",
    "superkind": "superkind",
    "synonym": "synonym",
    "headword": "headword",
    "a_superkind": "superkind",
}
"""Slots of the two kinds of which one is a kind of the other, as their labels."""

CRITERION_SLOTS = {
    "plural_subject": ("subject", "Noun"),
    "a_subject": ("subject", "Noun"),
    "plural_property": ("property", "Adjective"),
    "plural_component": ("component", "Noun"),
    "a_component": ("component", "Noun"),
}
"""Slots of what is said of all things of a kind: their labels, and what is there."""

SAID_BY_TYPE = {
    "cue": ("ByColour", "ByShape", "BySize", "ByTexture", "ByPattern", "ByDetails"),
    "matters": ("Matters", "MattersNot"),
    "side": ("AtLeft", "AtRight", "AtMiddle"),
    "often": ("Always", "Generally", "Usually", "Often", "Sometimes", "Never"),
}
"""Slots that a type of the theory fills: one of these."""

PHRASES = ("target", "landmark", "counted")

OTHER = {"examples"}

TOLD_BESIDES = {
    "sureness": "degrees",
    "degree": "degrees",
    "rival_degree": "degrees",
    "distance": "degrees",
    "cues": "reasons",
    "when": "reminder",
    "lesson": "reminder",
    "words": "recalled",
    "lessons": "recalled",
    "confused": "confused",
    "times": "recalled",
    "several_times": "recalled",
    "qualities": "recalled",
    "type": "recalled",
    "lost": "lost",
    "height": "measured",
    "length": "measured",
    "distance_away": "measured",
    "rival_height": "measured",
    "rival_length": "measured",
    "rival_distance_away": "measured",
}
"""Slots of what is beside the content: how certain, why, from which lesson."""

SIDES = ("OnTheLeft", "InTheMiddle", "OnTheRight")
"""Which of several things is meant, as the types that say it."""

IN_VIEW = {"things", "count", "maybe_count", "rival_count"}
"""Slots of what a content has a part for each of: only how it is said is recovered."""


def slots_of(wording: str) -> list[str]:
    return [slot for _, slot, _, _ in Formatter().parse(wording) if slot]


def is_about(slot: str) -> bool:
    """Whether a slot says something of the content."""
    return slot not in (*OTHER, *TOLD_BESIDES, *IN_VIEW)


def besides(
    chance: random.Random, wording: str, words: Sequence[Record]
) -> dict[str, object]:
    """What else a move has of which the wording tells: degrees, reasons, lessons."""
    told = {TOLD_BESIDES[it] for it in slots_of(wording) if it in TOLD_BESIDES}
    slots = set(slots_of(wording))
    sign = words[0] if words else noun("cup")
    reminder = record(
        key="7",
        sign=sign,
        examples=1.0,
        text=chance.choice(["This is a cup.", "No, it is (I think) a cup!", "Rött."]),
        dialogue="2",
        turn="11",
        age=chance.choice([5.0, 70.0, 1800.0, 50_000.0, 10_000_000.0]),
        day="2026-05-01",
        time="12:30",
    )
    cues = ["shape", "colour", "size", "texture"][: chance.randint(1, 4)]
    shares = [record(name=it, share=1.0 / len(cues)) for it in cues]
    reminders = [reminder] if "lesson" in slots or "when" in slots else []
    reason = record(claim=Rec, p=0.8, cues=shares, reminders=reminders)
    confused = [noun("mug"), noun("bowl")] if "confused" in told else []
    lessons = chance.choice([1.0, 2.0, 17.0]) if {"lessons", "words"} & slots else 0.0
    several = {"several_times": 3.0, "times": 1.0}
    lessons = next((several[it] for it in several if it in slots), lessons)
    rest = {
        "qualities": [sign] if "qualities" in slots else [],
        "reminders": [reminder] if "when" in slots else [],
    }
    known = [record(rest, sign=sign, lessons=lessons, confused=confused)]
    bowl = record(rest, sign=noun("bowl"), lessons=1.0, confused=[])
    known += [bowl] * ("words" in slots)
    rival = {"rival_degree", "distance"} & slots
    asked = "cues" in slots or "reminder" in told
    return {
        "degrees": [0.87, 0.08] if rival else [0.87],
        "reasons": [reason] if asked else [],
        "undone": [reminder] if slots == {"when", "lesson"} else [],
        "recalls": [sign] if told & {"recalled", "confused"} else [],
        "recalled": known if told & {"recalled", "confused"} else [],
        "lost": [sign] if "lost" in told else [],
        "measured": _extents(chance, slots),
    }


def _extents(chance: random.Random, slots: Set[str]) -> list[Record]:
    """What was measured of the things of which a wording tells that."""
    labels = ("height", "length", "distance")
    lengths = (0.004, 0.07, 0.99, 1.26)
    return [
        record({label: chance.choice(lengths) for label in labels}, x=x)
        for x, slot in (("o1", "height"), ("o2", "rival_height"))
        if slot in slots
    ]


def in_view(chance: random.Random, wording: str) -> dict[str, RecordType]:
    """Parts of what is in view, as many as the wording tells of."""
    several = {"things": ("thing", "maybe", "unknown"), "count": ("thing",)}
    several["maybe_count"] = ("maybe",)
    parts = {}
    for slot in slots_of(wording):
        for label in several.get(slot, ()):
            WORDS.append(a_word(chance, "en", "Noun"))
            seen = record_type("Phrase") if label == "unknown" else WORDS[-1].meaning
            for n in range(chance.randint(1, 3)):
                parts[f"{label}{n + 1:02}"] = seen
    return parts


def a_word(chance: random.Random, language: str, template: str) -> Record:
    match template:
        case "Naming" | "Noun" | "NotNaming":
            return noun(chance.choice(NOUNS[language]))
        case "Having" | "Adjective" | "NotHaving":
            form = chance.choice(ADJECTIVES[language])
            return sign(form, "adjective", means=lexicon(language).means.get(form, ""))
    if template == "Comparison":
        form = chance.choice(COMPARATIVES[language])
        return sign(form, "relation", means=lexicon(language).means.get(form, ""))
    return relation(chance.choice(RELATIONS[language]))


def a_phrase(chance: random.Random, language: str, article: str) -> RecordType:
    kinds = ["Noun", "Adjective Noun"]
    if article:
        kinds += ["Other Noun"]
    if article == "the":
        kinds += ["Adjective", "This", "It", "Other", "This Noun"]
    meaning: RecordType = record_type("Phrase")
    for name in chance.choice(kinds).split():
        if name in ("Noun", "Adjective"):
            WORDS.append(a_word(chance, language, name))
            meaning = merge(meaning, WORDS[-1].meaning)
        else:
            meaning = merge(meaning, record_type(name))
    return meaning


WORDS: list[Record] = []


TOLD_OF = {
    "mention": "Asked",
    "ask_name": "Asked",
    "ask_place": "Asked",
    "ask_also": "Asked",
    "ask_quality": "Asked",
    "ask_find": "Asked",
    "ask_size": "Asked",
    "ask_view": "Scene",
    "ask_count": "Scene",
    "ask_places": "Scene",
    "instruct_several": "Scene",
    "instruct_every": "Scene",
    "tell_part": "Asked",
    "take_frame": "ByLandmark",
    "ask_meaning": "Word",
    "ask_taught": "Word",
    "ask_lessons": "Word",
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
    content: RecordType = record_type(told_of) if by_itself else Rec
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
            said = meaning_at(chosen[rivalry, template], template)
            if told_of == "Word":
                said = rectype(word=chosen[rivalry, template].meaning)
            if "rival" in slot:
                rival = merge(rival, said)
            else:
                content = merge(content, said)
        elif slot in KIND_SLOTS:
            label = KIND_SLOTS[slot]
            while label not in content:
                word = a_word(chance, language, "Noun")
                if word not in WORDS:
                    WORDS.append(word)
                    content = merge(content, rectype({label: word.meaning}))
        elif slot in CRITERION_SLOTS:
            label, template = CRITERION_SLOTS[slot]
            while label not in content:
                word = a_word(chance, language, template)
                if word not in WORDS:
                    WORDS.append(word)
                    content = merge(content, rectype({label: word.meaning}))
        elif slot in SAID_BY_TYPE:
            said = record_type(chance.choice(SAID_BY_TYPE[slot]))
            content = merge(content, said)
        elif slot == "number":
            content = merge(content, rectype(number=theory()["Text"] @ "12"))
        elif slot == "one":
            content = merge(content, record_type(chance.choice(SIDES)))
        elif slot == "choices":
            nouns = [noun(it) for it in chance.sample(NOUNS[language], 3)]
            WORDS.extend(nouns)
            choices = {f"choice{n:02}": it.meaning for n, it in enumerate(nouns, 1)}
            content = merge(record_type("Scene"), rectype(choices))
        elif slot == "amid":
            one, other = (noun(it) for it in chance.sample(NOUNS[language], 2))
            WORDS.extend([one, other])
            flank = merge(one.meaning, rectype(landmark=other.meaning))
            amid = merge(record_type("Between"), rectype(landmark=flank))
            content = merge(content, rectype(amid=amid))
        elif slot.startswith("rival_the_"):
            part = slot.split("_")[-1]
            while rival is Rec or rival[part] == content[part]:
                rival = rectype({part: a_phrase(chance, language, "the")})
        elif is_about(slot):
            part = slot.split("_")[-1]
            phrase = a_phrase(chance, language, slot.removesuffix(part).strip("_"))
            content = merge(content, rectype({part: phrase}))
    if rival is not Rec:
        phrased = [k for k in PHRASES if k in rival and f"rival_the_{k}" in wording]
        same = {k: T for k, T in content.fields if k not in (*CLAIMS, *phrased)}
        rival = merge(rectype(same), rival)
    return record(content=content, rival=rival, signs=list(dict.fromkeys(WORDS)))


def is_claim(content: RecordType) -> bool:
    return any(label in content for label in CLAIMS)


SAID = [
    (language, style, act, wording)
    for language in LANGUAGES
    for style in ("paper", "four")
    for act, wordings in lexicon(language, style).says.items()
    for wording in wordings
    if style == "paper" or wordings != lexicon(language).says[act]
]

LESS = {
    ("ask_count", "How many things are there?"),
    ("ask_count", "Hur många saker finns det?"),
    ("ask_more_of", "Are there more red things than blue things?"),
    ("ask_more_of", "Finns det fler röda saker än blå saker?"),
}
"""Wordings that say "things" of what the content says nothing of."""

TOLD = [
    (language, act, wording)
    for language in LANGUAGES
    for act, wordings in lexicon(language).tells.items()
    for wording in wordings
    if act not in IN_PARTS
    and (act, wording) not in LESS
    and not {"front", "by"} & set(slots_of(wording))
]


@pytest.mark.parametrize(("language", "style", "act", "wording"), SAID)
@settings(max_examples=8)
@given(st.integers(0, 2**32))
def test_what_the_robot_says_is_understood(
    language: str, style: str, act: str, wording: str, seed: int
) -> None:
    chance = random.Random(seed)
    move = a_move(chance, language, wording)
    details = besides(chance, wording, move.signs)
    parts = in_view(chance, wording)
    others = in_view(chance, "{count}" if "{rival_count}" in wording else "")
    shown = record(
        details,
        content=merge(move.content, rectype(parts)),
        rival=merge(move.rival, rectype(others)),
        signs=list(dict.fromkeys(WORDS)),
    )
    text = say(lexicon(language, style), act, shown)
    said = overhear(text, language)
    readings = [
        (predicate_at(it.type, "e").name, it.content, it.type["rival"].value)
        for it in said
    ]
    assert (act, move.content, move.rival) in readings, text
    assert (act, denial(move.content), move.rival) not in readings or not is_claim(
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
    assert (act, denial(move.content)) not in found or not is_claim(move.content)


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_languages_say_the_same_acts(language: str) -> None:
    assert lexicon(language).says.keys() == lexicon("en").says.keys()
    assert lexicon(language).tells.keys() == lexicon("en").tells.keys()


def test_words_are_said_as_the_tutor_says_them() -> None:
    english = lexicon("en")
    move = record(
        content=meaning_at(noun("hotel", "an"), "Naming"), signs=[noun("hotel", "an")]
    )
    assert say(english, "learned", move) == "OK, I learned an hotel."
