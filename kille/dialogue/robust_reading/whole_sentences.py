"""Whether a sentence that the grammar reads as a whole had better be read by its parts.

The grammar may read what is no sentence of its own by unknown words: "No worries." as a
correction, and "This is, uh, a cup." as how two things stand.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence, Set

from kille.dialogue.language import Sentence, Utterance
from kille.dialogue.meanings import predicate_at
from kille.dialogue.robust_reading.situations import Situation
from kille.dialogue.word_lists import REMARK, WordLists, plain_text, word_lists
from ttr import Record

_COMMA = re.compile(r"[,;:]")


def needs_parts(
    sentences: Iterable[Sentence], situation: Situation, language: str = "en"
) -> bool:
    """Whether some sentence is none, or may better be read by its parts."""
    lists = word_lists(language)
    return any(not it.readings or is_weak(it, situation, lists) for it in sentences)


def is_weak(it: Sentence, situation: Situation, lists: WordLists) -> bool:
    """Whether a sentence answers what nobody asked, or is in doubt, or has fillers."""
    if lists.write_out(it.text) != it.text:
        return True
    if not situation.asks_which and _is_mention(it):
        return True
    if it.readings and _spans_break(it.readings[0]):
        return True  # "A cup, silly."
    return all(
        "doubt" in one.type
        or _breaks_off(one)
        or _spans_break(one)
        or _says_kind(one, situation, lists)
        or _asks_about_nothing_seen(one, situation, lists)
        or any(_is_odd(sign, situation.qualities, lists) for sign in one.signs)
        for one in it.readings
    )


def _says_kind(it: Utterance, situation: Situation, lists: WordLists) -> bool:
    """Whether a kind is said as if it were how things are: "Knives are cutlery."."""
    if predicate_at(it.type, "e").name != "generalise":
        return False
    hows = [sign.form for sign in it.signs if sign.kind == "adjective"]
    return any(how not in situation.known and lists.judge_quality(how) for how in hows)


def _asks_about_nothing_seen(
    it: Utterance, situation: Situation, lists: WordLists
) -> bool:
    """Whether a question is about what nobody can see: "the capital of Mongolia"."""
    if predicate_at(it.type, "e").name not in ("ask_name", "ask_find"):
        return False
    nouns = [sign.form for sign in it.signs if sign.kind == "noun"]
    return any(
        noun not in situation.known and lists.judge_noun(noun, lists.contents) == REMARK
        for noun in nouns
    )


def _breaks_off(it: Utterance) -> bool:
    """Whether a clause ends with what is read as a relation: "It is red, …"."""
    text = " ".join(it.text.lower().split())
    relations = (sign.form for sign in it.signs if sign.kind == "relation")
    return any(re.search(rf"\b{re.escape(one)}\s*[,;:]", text) for one in relations)


def _is_mention(it: Sentence) -> bool:
    """Whether all that a sentence can be is an answer which thing is meant."""
    return all(predicate_at(one.type, "e").name == "mention" for one in it.readings)


def _is_odd(sign: Record, qualities: Set[str], lists: WordLists) -> bool:
    """Whether what was read as a word has a part that is none of such words'."""
    parts = sign.form.split()
    if sign.kind == "relation":
        if parts[0] in lists.articles or not lists.fillers.isdisjoint(parts):
            return True
        return len(parts) == 1 and _is_no_relation(parts[0], qualities, lists)
    if sign.kind == "noun" and _ends_with_aside(parts, lists):
        return True
    return not lists.is_phrase(parts) and any(map(lists.is_closed, parts))


def _ends_with_aside(parts: Sequence[str], lists: WordLists) -> bool:
    """Whether the last word of a noun may be left out: "a tool anyway"."""
    return (parts[-1],) in lists.harmless and parts[-1] not in lists.things


def _is_no_relation(form: str, qualities: Set[str], lists: WordLists) -> bool:
    """Whether a word is of another kind: "This is also a cup."."""
    return lists.is_closed(form) or (form,) in lists.harmless or form in qualities


def are_parts_better(
    whole: Sentence, moves: tuple[Sentence, ...], is_all: bool, lists: WordLists
) -> bool:
    """Whether the moves in a sentence are a better reading than that of the whole.

    `is_all` says that no word is missing in them.
    """
    if not moves:  # "None of them is a tool anyways."
        return any(it.signs for it in whole.readings) and all(
            _has_closed_word(it, lists) for it in whole.readings
        )
    if is_all and any(_spans_break(it) for it in whole.readings):
        return True
    if whole.readings and _spans_break(whole.readings[0], ("noun",)):
        return True  # "A cup, dimwit."
    if whole.readings and all(_has_closed_word(it, lists) for it in whole.readings):
        return True
    fills = not lists.fillers.isdisjoint(plain_text(whole.text).split())
    fills = fills or lists.write_out(whole.text) != whole.text
    doubted = any("doubt" in it.readings[0].type for it in moves)
    return _is_mention(whole) or fills or (is_all and not doubted)


def _has_closed_word(reading: Utterance, lists: WordLists) -> bool:
    """Whether a noun has a part that is none of a noun's: "a ladle then"."""
    nouns = (it.form.split() for it in reading.signs if it.kind == "noun")
    return any(
        any(map(lists.is_closed, parts))
        or (len(parts) > 1 and _ends_with_aside(parts, lists))
        for parts in nouns
    )


def _spans_break(reading: Utterance, kinds: Iterable[str] = ()) -> bool:
    """Whether some word of a reading goes on after a comma: "lamp, also called …".

    If kinds of words are given, only those count.
    """
    text = " ".join(reading.text.lower().split())
    unbroken = " ".join(_COMMA.sub(" ", text).split())
    words = (it for it in reading.signs if not kinds or it.kind in kinds)
    several = (it.form for it in words if " " in it.form)
    return any(it not in text and it in unbroken for it in several)
