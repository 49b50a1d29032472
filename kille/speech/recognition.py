"""From sound to what was perhaps said, with pocketsphinx.

The network of what is expected becomes its finite-state grammar. Beside it a loop of
all sounds of the language is matched to the same sound: what anything spoken, in any
words, would score. Where the grammar is much worse than that, something else was said.

Source: Huggins-Daines et al., "PocketSphinx" (2006); for the loop of sounds as a model
of everything else, Rose and Paul, "A hidden Markov model based keyword recognition
system" (1990).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from itertools import islice
from typing import Any, NamedTuple

from kille.speech.expectations import ExpectedSpeech, Speech
from kille.speech.grammar import in_full
from kille.speech.pronunciation import Pronouncer
from kille.speech.sound import RATE
from kille.speech.word_network import NOTHING, State, allows, reachable_states

_WORDS, _SOUNDS = "words", "sounds"
"""The names of the two searches."""

_ANEW = "~"
"""What the name of a word ends in whose entry in the dictionary is not used."""

_SETTINGS: Mapping[str, Any] = {
    "lm": None,
    "loglevel": "FATAL",
    "samprate": RATE,
    "bestpath": True,
    "wip": 1.0,
}
"""Every word has a weight of its own, so that there is no other price of a word."""

_LANGUAGE = 6.5
"""How much words count against sounds, whose frames are not independent."""

_SCORE = 1024.0
"""Scores come as logarithms, divided by this (a shift of 10 bits in pocketsphinx)."""

_ACOUSTIC = 20.0
"""Nats of sound that count as one: neighbouring frames say the same."""

_LOOP, _PAUSES = 2.0, 225.0
"""Nats a frame that the loop of sounds scores better than the right words do, at most,
and what it saves at pauses, which cost words a price. Of 363 right sentences of two
voices 98 % are above that, of 36 that no grammar has 5."""

_MOST = 40
"""How many ways to hear a sound are looked at."""

_FAINT = 0.05
"""What is less probable is not reported."""


class Hypothesis(NamedTuple):
    """A text that was perhaps said, and how probable that is."""

    text: str
    p: float


class Recogniser:
    """Recognises expected speech; `expect` sets what is expected.

    Raises ModuleNotFoundError where pocketsphinx is not installed.
    """

    def __init__(self, speech: Speech) -> None:
        from pocketsphinx import Decoder

        self._decoder = Decoder(**_SETTINGS)
        self._decoder.add_allphone_file(_SOUNDS, None)
        self._pronounced = speech.pronounced
        self._pronouncing = Pronouncer(
            self._decoder.lookup_word, speech.letters, speech.long
        )
        self._network = NOTHING
        self._weights: Mapping[str, float] = {}
        for word, ways in speech.pronounced.items():
            self._add(word, ways)

    def expect(self, what: ExpectedSpeech) -> None:
        """Listen for this from now on. The pronunciation of new words is guessed."""
        for word in sorted(what.learned):
            if self._decoder.lookup_word(self._entry_name(word)) is None:
                self._add(word, (self._pronouncing.of(word),))
        self._network, self._weights = what.network, what.weights
        arcs = list(self._arcs(what.network, what.weights))
        grammar = self._decoder.create_fsg(_WORDS, 0, 1, arcs)
        self._decoder.add_fsg(_WORDS, grammar)

    def hear(self, sound: bytes) -> tuple[Hypothesis, ...]:
        """What was perhaps said in a sound (16 kHz, 16 bits), the likeliest first.

        What the probabilities lack to 1 is that of something else, or of nothing.
        """
        if self._network is NOTHING or not any(sound):
            return ()
        frames = self._search(_SOUNDS, sound)
        loop = self._decoder.hyp()
        if loop is None or not frames:
            return ()
        self._search(_WORDS, sound)
        if self._decoder.hyp() is None:
            return ()
        words = self._language(self._decoder.hyp().hypstr.replace(_ANEW, ""))
        other = _nats(loop.score) + words - _PAUSES - _LOOP * self._speech_frames()
        return _probabilities(self._ways(), other)

    def _search(self, name: str, sound: bytes) -> int:
        """Match a sound; the number of frames in it, of 10 ms."""
        decoder = self._decoder
        decoder.activate_search(name)
        decoder.start_utt()
        decoder.process_raw(sound, full_utt=True)
        decoder.end_utt()
        return int(decoder.n_frames())

    def _language(self, text: str) -> float:
        """What the words of a text count, without the sounds, in nats."""
        return _LANGUAGE * sum(math.log(self._weights[it]) for it in text.split())

    def _speech_frames(self) -> int:
        """The number of frames in which the latest sound was heard to be words."""
        return sum(
            it.end_frame - it.start_frame + 1
            for it in self._decoder.seg()
            if not it.word.startswith("<")
        )

    def _ways(self) -> Iterator[tuple[str, float]]:
        """The texts that the grammar has for the latest sound, with their scores."""
        for it in islice(self._decoder.nbest(), _MOST):
            text = "" if it is None else it.hypstr.replace(_ANEW, "")
            if text and allows(self._network, text.split()):
                yield text, _nats(it.score)

    def _add(self, word: str, ways: Iterable[str]) -> None:
        """Add a word with these pronunciations to the dictionary."""
        for number, way in enumerate(filter(None, ways), start=1):
            name = self._entry_name(word)
            self._decoder.add_word(
                name if number == 1 else f"{name}({number})", way, False
            )

    def _entry_name(self, word: str) -> str:
        """The name of a word in the dictionary: what is pronounced anew has another."""
        return f"{word}{_ANEW}" if word in self._pronounced else word

    def _arcs(
        self, network: State, weights: Mapping[str, float]
    ) -> Iterator[tuple[Any, ...]]:
        """The network as pocketsphinx wants it: from 0 to 1, without unknown words."""
        numbers = {it: n for n, it in enumerate(reachable_states(network), start=2)}
        yield 0, numbers[network], 1.0
        for place, number in numbers.items():
            if place.ends:
                yield number, 1, 1.0
            for word, it in place.after:
                name = self._entry_name(word)
                if self._decoder.lookup_word(name) is not None:
                    yield number, numbers[it], weights[word] ** _LANGUAGE, name


def _nats(score: float) -> float:
    return _SCORE * math.log(score)


def _probabilities(
    ways: Iterable[tuple[str, float]], other: float
) -> tuple[Hypothesis, ...]:
    """Scores as probabilities: of each text the best way; contractions as the rest."""
    best: dict[str, float] = {}
    for text, nats in ways:
        best[text] = max(nats, best.get(text, -math.inf))
    top = max((*best.values(), other))
    whole = math.exp((other - top) / _ACOUSTIC)
    alike: dict[str, list[tuple[float, str]]] = {}
    for text, nats in best.items():
        share = math.exp((nats - top) / _ACOUSTIC)
        whole += share
        alike.setdefault(in_full(text.split()), []).append((share, text))
    found = (
        Hypothesis(join_clitics(max(them)[1]), sum(share for share, _ in them) / whole)
        for them in alike.values()
    )
    return tuple(
        sorted((it for it in found if it.p >= _FAINT), key=lambda it: (-it.p, it.text))
    )


def join_clitics(text: str) -> str:
    """A text as it is written: what hangs on a word joins it.

    >>> join_clitics("this isn't the car 's left")
    "this isn't the car's left"
    """
    return text.replace(" n't", "n't").replace(" '", "'")
