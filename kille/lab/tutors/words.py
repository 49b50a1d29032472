"""The words in which a tutor speaks of what there is, and the sentences with them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from kille.dialogue.lexicon import lexicon
from kille.dialogue.meanings import sign
from kille.lab.worlds.sayings import (
    LESSON_ACTS,
    NOTHING,
    QUESTION_ACTS,
    THIS,
    Claim,
    Phrase,
    Saying,
    facing_matter,
    perspective_matter,
    word_matter,
)
from kille.lab.worlds.vocabulary import vocabulary
from kille.lab.worlds.worlds import Thing
from ttr import Record

__all__ = ["Words"]


@dataclass(frozen=True)
class Words:
    """The words of a language, as a tutor uses them.

    What he `calls` something else than others do stands by what they call it.

    >>> words = Words("en", {"mug": "cup"})
    >>> words.lesson("noun", words.called("mug")), words.question("noun")
    ('This is a cup.', 'What is this?')
    """

    language: str = "en"
    calls: Mapping[str, str] = field(default_factory=dict)

    def called(self, name: str) -> str:
        """What he calls a kind, a colour or a place; others, in English, call it so."""
        if name in self.calls:
            return self.calls[name]
        return vocabulary(self.language).form_of(name)

    def sign(self, kind: str, word: str) -> Record:
        """The sign of a word."""
        means = (
            lexicon(self.language).means.get(word, "") if kind == "adjective" else ""
        )
        return sign(word, kind, means=means)

    def described(self, thing: Thing, *by: str) -> Phrase:
        """A phrase for a thing by its colour, its noun, or both: "the red cup"."""
        signs = {
            "adjective": self.sign("adjective", self.called(thing.colour)),
            "noun": self.sign("noun", self.called(thing.kind)),
        }
        return Phrase("", tuple(signs[it] for it in by))

    # --- what he says ----------------------------------------------------------------

    def lesson(
        self,
        kind: str,
        word: str,
        landmark: Phrase | None = None,
        target: Phrase = THIS,
    ) -> str:
        """That a word is true of this thing, or of one thing beside another."""
        return self._claiming(LESSON_ACTS[kind], kind, word, landmark, target)

    def correction(self, kind: str, word: str, landmark: Phrase | None = None) -> str:
        """That, instead of what was said, a word is true of this thing."""
        return self._claiming("correct", kind, word, landmark, THIS)

    def _claiming(
        self, act: str, kind: str, word: str, landmark: Phrase | None, target: Phrase
    ) -> str:
        claim = Claim(self.sign(kind, word), target, landmark or NOTHING)
        return Saying(self.language, act, claim).text

    def question(self, kind: str) -> str:
        """What this thing is, what colour it is, or where."""
        return Saying(self.language, QUESTION_ACTS[kind], Claim(None, THIS)).text

    def finding(self, phrase: Phrase) -> str:
        """Which thing a phrase is for."""
        return Saying(self.language, "ask_find", Claim(None, phrase)).text

    def mentioning(self, phrase: Phrase) -> str:
        """A phrase by itself."""
        return Saying(self.language, "mention", Claim(None, phrase)).text

    def plainly(self, act: str) -> str:
        """A move that is about nothing in particular: `affirm`, `deny`, `greet` …"""
        return Saying(self.language, act).text

    def facing(self, front: str, phrase: Phrase) -> str:
        """Which way a thing faces."""
        return Saying(self.language, "orient", facing_matter(front, phrase)).text

    def perspective(self, of: str) -> str:
        """Whose perspective is meant: that of the `viewer`, or of the `landmark`."""
        return Saying(self.language, "take_frame", perspective_matter(of)).text

    def forgetting(self, kind: str, word: str) -> str:
        """That a word is to be forgotten."""
        about = word_matter(self.sign(kind, word))
        return Saying(self.language, "forget_word", about).text
