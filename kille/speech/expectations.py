"""What a tutor is expected to say, by the words that the robot knows.

Known words may stand wherever the grammar has words, and unknown nouns in lessons.
Neighbours agree: "an apple", but "a cup".
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any, Protocol

from kille.dialogue.lexicon import Lexicon, lexicon
from kille.speech.grammar import CONTRACTED, TAUGHT, split_words, tutors_grammar
from kille.speech.word_network import (
    State,
    fill_slots,
    fuse_words,
    reachable_states,
    restrict,
    sequence,
    union,
)

LANGUAGES = ("en",)
"""The languages that there is a model of the sounds of."""

_HISSING = re.compile(r"(s|z|x|sh|ch|se|ce|'re)\Z")


class SpokenWord(Protocol):
    """What speech asks of a word; nouns have an article, too."""

    @property
    def form(self) -> Any:
        """As it is written."""

    @property
    def kind(self) -> Any:
        """Noun, adjective or relation."""

    @property
    def article(self) -> Any:
        """The indefinite one that it is used with, if there is any."""


@dataclass(frozen=True)
class Speech:
    """What is known of a spoken language besides its grammar and lexicon."""

    nouns: tuple[str, ...]
    adjectives: tuple[str, ...]
    relations: tuple[str, ...]
    unsaid: tuple[str, ...]
    weights: Mapping[str, Any]
    pronounced: Mapping[str, tuple[str, ...]]
    letters: Mapping[str, str]
    long: Mapping[str, str]
    asking: tuple[str, ...]
    """The words that questions begin with."""
    sorry: str
    """The answer to speech that could not be understood."""


@dataclass(frozen=True)
class ExpectedSpeech:
    """All that may be said, how probable its words are, and which are the tutor's."""

    network: State
    weights: Mapping[str, float]
    learned: frozenset[str]


@cache
def speech(language: str = "en") -> Speech:
    """The packaged knowledge of a spoken language.

    >>> speech().pronounced["'s"]
    ('Z', 'S')
    """
    source = files("kille.grammars").joinpath(f"speech.{language}.toml")
    data = tomllib.loads(source.read_text(encoding="utf-8"))
    return Speech(
        nouns=tuple(data["nouns"]),
        adjectives=tuple(data["adjectives"]),
        relations=tuple(data["relations"]),
        unsaid=tuple(data["unsaid"]),
        weights=data["weights"],
        pronounced={word: tuple(them) for word, them in data["pronounced"].items()},
        letters=data["letters"],
        long=data["long"],
        asking=tuple(data["asking"]),
        sorry=data["sorry"],
    )


def expected_speech(
    words: Iterable[SpokenWord], language: str = "en"
) -> ExpectedSpeech:
    """What may be said to a robot that knows these words.

    >>> from kille.dialogue.meanings import sign
    >>> from kille.speech.word_network import allows
    >>> network = expected_speech([sign("cup", "noun")]).network
    >>> [
    ...     allows(network, text.split())
    ...     for text in ("where is the cup", "this is a lamp", "where is the lamp")
    ... ]
    [True, True, False]
    >>> [allows(network, text.split()) for text in ("an apple", "a apple")]
    [True, False]
    """
    known, language_ = tuple(words), speech(language)
    lexicon_, grammar = lexicon(language), tutors_grammar(language, *language_.unsaid)
    forms = {
        kind: [str(it.form) for it in known if it.kind == kind]
        for kind in ("noun", "adjective", "relation")
    }
    adjectives = [*forms["adjective"], *language_.adjectives]
    slots = {
        TAUGHT: [*forms["noun"], *language_.nouns],
        "_noun": forms["noun"],
        "_several": [lexicon_.inflect(it, "PLURAL") for it in forms["noun"]],
        "_adjective": adjectives,
        "_relation": [*forms["relation"], *language_.relations],
    }
    network = fill_slots(
        grammar, {slot: _network_of(them) for slot, them in slots.items()}
    )
    plain = _words(grammar) | frozenset(CONTRACTED.values())
    new = _words_of(language_.nouns) - _words_of(forms["noun"]) - plain
    learned = frozenset(set().union(*map(_words_of, slots.values())) - plain)
    weights = language_.weights
    return ExpectedSpeech(
        fuse_words(restrict(network, _Neighbours(lexicon_, known)), CONTRACTED),
        dict.fromkeys(plain | learned, float(weights["usual"]))
        | dict.fromkeys(_clitics(plain), float(weights["attached"]))
        | dict.fromkeys(weights["seldom_words"], float(weights["seldom"]))
        | dict.fromkeys(_words_of(adjectives) - plain, float(weights["adjective"]))
        | dict.fromkeys(new, float(weights["new"])),
        learned,
    )


def _clitics(words: Iterable[str]) -> set[str]:
    return {word for word in words if word.startswith("'")}


def _network_of(forms: Iterable[str]) -> State:
    return union(sequence(split_words(form)) for form in forms)


def _words_of(forms: Iterable[str]) -> set[str]:
    return {word for form in forms for word in split_words(form)}


@cache
def _words(network: State) -> frozenset[str]:
    return frozenset(
        word for place in reachable_states(network) for word, _ in place.after
    )


class _Neighbours:
    """Whether a word may follow another: articles agree, and "'s" needs its word."""

    def __init__(self, lexicon_: Lexicon, known: Iterable[SpokenWord]) -> None:
        self._articles = lexicon_.articles
        self._used = {
            split_words(str(it.form))[0]: str(it.article)
            for it in known
            if it.kind == "noun" and split_words(str(it.form))
        }

    def __call__(self, before: str, word: str) -> bool:
        if before in ("a", "an"):
            used = self._used.get(word, "")
            return bool(word) and self._articles.choose(word, used) == before
        match word:
            case "'s":
                return bool(before) and not _HISSING.search(before)
            case "'re" | "'m" | "'d":
                return (before, word) in CONTRACTED
            case "n't":
                return (before, word) in CONTRACTED
        return not word.startswith("'") or bool(before)
