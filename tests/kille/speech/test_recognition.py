"""Sentences are heard; silence, noise and other talk are not."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from kille.dialogue.meanings import sign
from kille.speech.expectations import expected_speech, speech
from kille.speech.grammar import in_full, split_words
from kille.speech.recognition import Recogniser
from kille.speech.sound import RATE

Spoken = Callable[..., bytes]

SENTENCES = [
    "this is a cup",
    "this is an apple",
    "what is this",
    "that is wrong",
    "the book is to the left of the box",
    "where is the ball",
    "how many cups are there",
]


@pytest.mark.parametrize("voice", ["rms", "awb"])
@pytest.mark.parametrize("text", SENTENCES)
def test_a_sentence_is_heard(
    recogniser: Recogniser, spoken: Spoken, text: str, voice: str
) -> None:
    best, *_ = recogniser.hear(spoken(text, voice))
    assert in_full(split_words(best.text)) == text
    assert 0 < best.p <= 1


def test_a_noun_that_is_not_known_is_heard_in_a_lesson(
    recogniser: Recogniser, spoken: Spoken
) -> None:
    heard = [it.text for it in recogniser.hear(spoken("this is a banana"))]
    assert heard[0] == "this is a banana"
    assert not any(
        "banana" in it.text for it in recogniser.hear(spoken("where is the banana"))
    )


def test_probabilities_are_of_one(recogniser: Recogniser, spoken: Spoken) -> None:
    heard = recogniser.hear(spoken("no, it is a book"))
    assert heard
    assert sum(it.p for it in heard) <= 1 + 1e-9
    assert list(heard) == sorted(heard, key=lambda it: -it.p)


def noise(amplitude: float) -> bytes:
    samples = np.random.default_rng(0).normal(size=2 * RATE) * amplitude
    return bytes(samples.astype("<i2").tobytes())


@pytest.mark.parametrize(
    "sound",
    [b"", bytes(2 * RATE), noise(1), noise(300), noise(6_000)],
    ids=["none", "silence", "breath", "noise", "loud"],
)
def test_what_is_no_speech_is_not_heard(recogniser: Recogniser, sound: bytes) -> None:
    assert recogniser.hear(sound) == ()


@pytest.mark.parametrize(
    "text",
    [
        "The weather in Gothenburg is rather rainy today.",
        "We went to the cinema yesterday evening.",
        "Elephants never forget their friends.",
    ],
)
def test_other_talk_is_heard_so_badly_that_the_robot_begs_pardon(
    recogniser: Recogniser, spoken: Spoken, text: str
) -> None:
    assert all(it.p < 0.3 for it in recogniser.hear(spoken(text)))


def test_a_new_word_is_heard_as_it_is_guessed(spoken: Spoken) -> None:
    other = Recogniser(speech())
    other.expect(expected_speech([sign("wug", "noun"), sign("shoe-box", "noun")]))
    for text in ("where is the wug", "this is a wug", "where is the shoe-box"):
        assert in_full(split_words(other.hear(spoken(text))[0].text)) == text
