"""What is expected follows the grammar and the known words, and how they agree."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice
from random import Random

import pytest

from kille.dialogue.language import understand
from kille.dialogue.meanings import sign
from kille.speech.expectations import ExpectedSpeech, expected_speech, speech
from kille.speech.grammar import split_words
from kille.speech.recognition import join_clitics
from kille.speech.word_network import State, allows, reachable_states

KNOWN = [
    *(sign(it, "noun") for it in ("cup", "apple", "teddy bear", "shoe-box")),
    sign("hotel", "noun", "an"),
    sign("red", "adjective"),
    sign("atop", "relation"),
]


@pytest.fixture(scope="module")
def what() -> ExpectedSpeech:
    return expected_speech(KNOWN)


@pytest.mark.parametrize(
    "text",
    [
        "This is a cup.",
        "This is an apple.",
        "No, that isn't a teddy bear.",
        "Where's the shoe-box?",
        "Where are the cups?",
        "The red cup is to the left of the apple.",
        "Is the cup behind the red apple?",
        "The cup is atop the teddy bear.",
        "This is an hotel.",
        "This is a lamp.",
        "Okay, what do you see, please?",
    ],
)
def test_what_a_tutor_says_is_expected(what: ExpectedSpeech, text: str) -> None:
    assert allows(what.network, split_words(text))


@pytest.mark.parametrize(
    "text",
    ["This is a apple.", "This is an cup.", "Where is the lamp?", "This is a.", "Is."],
)
def test_what_nobody_says_is_not(what: ExpectedSpeech, text: str) -> None:
    assert not allows(what.network, split_words(text))


def test_every_word_has_a_weight(what: ExpectedSpeech) -> None:
    said = {word for place in reachable_states(what.network) for word, _ in place.after}
    assert said <= set(what.weights)
    assert all(0 < what.weights[it] <= 1 for it in said)


def test_what_is_expected_is_understood(what: ExpectedSpeech) -> None:
    texts = list(islice(_drawn(what.network, Random(3)), 150))
    assert [it for it in texts if not _understood(it)] == []


def _drawn(network: State, chance: Random) -> Iterator[str]:
    """Sentences of a network, of twelve words at most."""
    while True:
        place, said = network, list[str]()
        while place.after and not (place.ends and chance.random() < 0.5):
            word, place = chance.choice(place.after)
            said.append(word)
        if len(said) <= 12:
            yield join_clitics(" ".join(said))


def _understood(text: str) -> bool:
    return all(it.readings for it in understand(text))


def test_nouns_have_a_pronunciation_each_and_one_only() -> None:
    nouns = speech().nouns
    assert len(set(nouns)) == len(nouns)
