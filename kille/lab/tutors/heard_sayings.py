"""What is heard of what a tutor says: all of it, a part of it, or one of two things.

What the grammar reads as a whole is heard as its text is; of what else is said the
parts are heard that are understood, as the robot hears them in its situation.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from random import Random

from hypothesis import strategies as st

from kille.dialogue.language import understand
from kille.dialogue.meanings import word_of
from kille.dialogue.robust_reading.situations import Situation, situation_of
from kille.dialogue.robust_reading.text_hearing import hear_in_parts
from kille.dialogue.tutoring import hear_sentences
from kille.lab.worlds.asides import Aside
from kille.lab.worlds.sayings import Saying
from ttr import Pred, Record

NONSENSE = (
    "",
    "?!",
    "Colourless green ideas sleep furiously.",
    "no no no",
    "You are stupid.",
    "import os; os.remove('x')",
    "[x : Ind, c : cup(x)]",
    "☃" * 30,
    "This is a",
    "Where is the cupp?",
    "Is this a muug?",
    "Forget bokk.",
    "cup " * 90,
)
"""What means nothing in any grammar."""

IN_PARTS = (
    "ask_deed",
    "ask_beyond",
    "ask_difference",
    "ask_part",
    "define",
    "ask_self",
    "remark",
    "ask_guess",
    "ask_whose",
    "agree_partly",
    "forget_about",
    "correct_thing",
    "attend",
    "tell_use",
)
"""The moves that are understood in a part of a sentence only."""

CERTAINTIES = ((0.9, 0.05), (0.5, 0.4), (0.2, 0.1), (0.05, 0.02))
"""How probable it is that the one, and the other, of two things was said."""

Sayings = Sequence[Saying]


def sample_texts(options: Sayings) -> st.SearchStrategy[object]:
    """Sample one of these, as a text, or as an event."""
    return st.sampled_from(options).map(event_or_text)


def sample_asides(s: Record, options: Sequence[Aside]) -> st.SearchStrategy[object]:
    """Sample one of these, as it is heard in a state."""
    return st.sampled_from(options).map(lambda it: aside_event(it, s))


def aside_event(aside: Aside, s: Record) -> object:
    """The text of what is said, or the event of what is heard of it in a state."""
    return aside.text if aside.is_read_whole else _part_event(aside, situation_of(s))


@lru_cache(256)
def event_or_text(one: Saying) -> object:
    """The text of what is said, or its event where only its parts are understood."""
    if one.act not in IN_PARTS:
        return one.text
    return _part_event(one, Situation(things=1))


@lru_cache(1024)
def _part_event(said: Saying | Aside, around: Situation) -> object:
    """The event of what is heard first of something said; None if nothing is."""
    language, types = said.words.language, said.words.types
    sentences = understand(said.text, language, types=types)
    heard = hear_in_parts(sentences, around, language, types=types)
    return hear_sentences(*heard.moves[:1])


def sample_unclear(said: Sequence[Sayings]) -> st.SearchStrategy[object]:
    """Sample events in which one of two texts was heard."""
    said = [them for them in said if them[0].act not in IN_PARTS]
    random = Random(len(said))
    pairs = [
        (random.choice(random.choice(said)), random.choice(random.choice(said)), p)
        for p in CERTAINTIES
        for _ in said
    ]
    return st.sampled_from(pairs).map(_either)


def _either(mumbled: tuple[Saying, Saying, tuple[float, float]]) -> object:
    """The event that one of two texts was heard, each so probable."""
    *both, p = mumbled
    sentences = [
        understand(one.text, one.words.language, types=one.words.types)[0]
        for one in both
    ]
    return hear_sentences(*sentences, p=p)


def sample_misspelt(
    said: Sequence[Sayings], known: frozenset[Pred]
) -> st.SearchStrategy[str]:
    """Sample questions with a word that is nearly one that the robot knows."""
    asked = [
        one for them in said for one in them if one.act in ("ask_place", "ask_find")
    ]
    pairs = [
        (one, sign.form)
        for one in asked
        for sign in one.about.signs
        if sign.kind == "noun" and word_of(sign) in known
    ]
    if not pairs:
        return st.sampled_from(NONSENSE)
    return st.sampled_from(pairs).map(lambda it: it[0].text.replace(it[1], f"{it[1]}q"))
