"""Listening for what may be said with the words that are known at present."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from kille.speech.expectations import SpokenWord, expected_speech, speech
from kille.speech.recognition import Hypothesis, Recogniser
from kille.speech.sound import SoundError


class KnownWord(NamedTuple):
    """What speech has to know of a word: a value that can be sent to a process.

    >>> KnownWord.of(KnownWord("cup", "noun", "a"))
    KnownWord(form='cup', kind='noun', article='a')
    """

    form: str
    kind: str
    article: str = ""

    @classmethod
    def of(cls, word: SpokenWord) -> KnownWord:
        """The same of a word of the robot's; only nouns have an article."""
        article = str(word.article) if word.kind == "noun" else ""
        return cls(str(word.form), str(word.kind), article)


class Listener:
    """Recognises speech; each word is expected from when it is known.

    Raises `SoundError` where pocketsphinx is not installed.
    """

    def __init__(self, language: str = "en") -> None:
        self._language = language
        try:
            self._recogniser = Recogniser(speech(language))
        except ModuleNotFoundError as error:
            raise SoundError(
                "pocketsphinx is not installed: pip install 'kille[speech]'"
            ) from error
        self._expected: tuple[KnownWord, ...] | None = None

    def expect(self, words: Iterable[SpokenWord]) -> None:
        """Expect what may be said with these words, and new nouns in lessons."""
        known = tuple(map(KnownWord.of, words))
        if known != self._expected:
            self._recogniser.expect(expected_speech(known, self._language))
            self._expected = known

    def hear(self, sound: bytes) -> tuple[Hypothesis, ...]:
        """What was perhaps said, as it is written, the likeliest first."""
        return tuple(
            Hypothesis(punctuate(it.text, self._language), it.p)
            for it in self._recogniser.hear(sound)
        )


def punctuate(text: str, language: str = "en") -> str:
    """Write heard text with a capital letter, and a question with its mark.

    >>> punctuate("this is a cup"), punctuate("what is this")
    ('This is a cup.', 'What is this?')
    """
    asks = text.partition(" ")[0].partition("'")[0] in speech(language).asking
    return f"{text[:1].upper()}{text[1:]}{'?' if asks else '.'}"
