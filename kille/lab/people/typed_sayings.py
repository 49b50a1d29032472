"""What a person has typed, as the robot's language has it: moves, questions, claims.

It is read by the grammar of tutors, whoever has typed it. Only what a sentence claims
can be kept as an answer.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from itertools import dropwhile

from kille.dialogue.language import Sentence, Utterance, understand
from kille.dialogue.lexicon import lexicon
from kille.dialogue.meanings import claims, is_denial, predicate_at, value_at
from kille.lab.worlds.sayings import QUESTION_ACTS
from kille.lab.worlds.vocabulary import vocabulary
from ttr import RecordType

QUESTIONS = {act: kind for kind, act in QUESTION_ACTS.items()}
QUESTIONS["ask_find"] = "reference"
"""The moves that ask for a word of a kind, or for a thing."""


def sentences(text: str, language: str) -> tuple[Sentence, ...]:
    """The sentences of a text; none of nothing."""
    return understand(text, language) if text.strip() else ()


def acts(text: str, language: str) -> tuple[str, ...]:
    """The moves that a text may be, the simplest first; none if it cannot be read.

    >>> acts("What is this?", "en"), acts("Blah blah.", "en")
    (('ask_name', 'ask_find'), ())
    """
    readings = (it for one in sentences(text, language) for it in one.readings)
    return tuple(dict.fromkeys(_act(it) for it in readings))


def asked_kind(text: str, language: str) -> str:
    """The kind of word that a text asks for, `reference` for a thing, or nothing."""
    kinds = (QUESTIONS[it] for it in acts(text, language) if it in QUESTIONS)
    return next(kinds, "")


def claimed_words(text: str, language: str) -> tuple[tuple[str, str], ...]:
    """The words that a text claims to be true, each with its kind.

    Who says "a red cup" claims that it is a cup, since colours are known words.

    >>> claimed_words("It is a red cup.", "en"), claimed_words("Is it a cup?", "en")
    ((('noun', 'cup'),), ())
    """
    return tuple(
        it for one in sentences(text, language) for it in _claims_of(one, language)
    )


def _claims_of(sentence: Sentence, language: str) -> Iterator[tuple[str, str]]:
    for reading in sentence.readings[:1]:
        content = value_at(reading.type, "content")
        asks = _act(reading).startswith("ask_")
        if asks or not isinstance(content, RecordType) or is_denial(content):
            return
        for sign in (it for it in reading.signs if claims(content, it)):
            form, kind = str(sign.form), str(sign.kind)
            yield kind, _without_adjectives(form, language) if kind == "noun" else form


def _without_adjectives(noun: str, language: str) -> str:
    """A noun without the adjectives before it that are known words."""
    *before, last = noun.split()
    return " ".join((*dropwhile(_adjectives(language).__contains__, before), last))


@cache
def _adjectives(language: str) -> frozenset[str]:
    """The adjectives that are known without lessons, as they stand before nouns."""
    known, words = vocabulary(language).adjectives.values(), lexicon(language)
    articles = (*words.articles.beginnings, *words.articles.endings)
    said = {
        words.predicative_form(str(it.form), article)
        for it in known
        for article in articles
    }
    return frozenset(said | {str(it.form) for it in known})


def _act(reading: Utterance) -> str:
    return predicate_at(reading.type, "e").name
