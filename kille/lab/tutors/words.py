"""The words in which a tutor speaks of what there is, and the sentences with them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from kille.dialogue.answer_details import deciding_cues
from kille.dialogue.criteria import CUES
from kille.dialogue.lexicon import lexicon
from kille.lab.worlds.sayings import (
    LESSON_ACTS,
    NOTHING,
    QUESTION_ACTS,
    THIS,
    Claim,
    Phrase,
    Saying,
    cue_matter,
    facing_matter,
    perspective_matter,
    word_matter,
)
from kille.lab.worlds.vocabulary import Vocabulary, vocabulary
from kille.lab.worlds.worlds import Thing
from ttr import Record
from ttr.aliases import Alias

__all__ = ["Words"]


@dataclass(frozen=True)
class Words:
    """The words of a language, as a tutor uses them.

    What the tutor `calls` something else than others do stands by what others call it.

    >>> words = Words("en", {"mug": "cup"})
    >>> words.lesson("noun", words.word_for("mug")), words.question("noun")
    ('This is a cup.', 'What is this?')
    """

    language: str = "en"
    calls: Mapping[str, str] = field(default_factory=dict)

    def word_for(self, name: str) -> str:
        """The tutor's word for a kind, a colour or a place of this English name."""
        if name in self.calls:
            return self.calls[name]
        return self._vocabulary.form_of(name)

    @property
    def _vocabulary(self) -> Vocabulary:
        return vocabulary(self.language)

    def sign(self, kind: str, word: str) -> Record:
        """The sign of a word."""
        means = (
            lexicon(self.language).means.get(word, "") if kind == "adjective" else ""
        )
        return self._vocabulary.types.sign(word, kind, means=means)

    def phrase_for(self, thing: Thing, *by: str) -> Phrase:
        """A phrase for a thing by its colour, its noun, or both: "the red cup"."""
        signs = {
            "adjective": self.sign("adjective", self.word_for(thing.colour)),
            "noun": self.sign("noun", self.word_for(thing.kind)),
        }
        return Phrase("", tuple(signs[it] for it in by))

    # --- sentences -------------------------------------------------------------------

    def lesson(
        self,
        kind: str,
        word: str,
        landmark: Phrase | None = None,
        target: Phrase = THIS,
    ) -> str:
        """Say that a word is true of this thing, or of one thing beside another."""
        return self._claim_text(LESSON_ACTS[kind], kind, word, landmark, target)

    def correction(self, kind: str, word: str, landmark: Phrase | None = None) -> str:
        """Say that, instead of what was said, a word is true of this thing."""
        return self._claim_text("correct", kind, word, landmark, THIS)

    def rejection(self, kind: str, word: str) -> str:
        """Say that a word is not true of this thing."""
        claim = Claim(self.sign(kind, word), THIS, NOTHING, denies=True)
        return Saying(self._vocabulary, "reject", claim).text

    def cue_statement(self, noun: str, cue: str) -> str:
        """Say that a cue does not matter for the things of a noun."""
        about = cue_matter(self.sign("noun", noun), cue, matters=False)
        return Saying(self._vocabulary, "weigh_cue", about).text

    def cited_cues(self, reasons: Sequence[Record]) -> tuple[str, ...]:
        """The cues that are named in an explanation, the first one first."""
        own = lexicon(self.language)
        names = {own.values[cue]: cue for cue in CUES}
        said = deciding_cues(own.sections, reasons)
        return tuple(names[it] for it in said if it in names)

    def _claim_text(
        self, act: str, kind: str, word: str, landmark: Phrase | None, target: Phrase
    ) -> str:
        claim = Claim(self.sign(kind, word), target, landmark or NOTHING)
        return Saying(self._vocabulary, act, claim).text

    def question(self, kind: str) -> str:
        """Ask what this thing is, which colour it has, or where it is."""
        return Saying(self._vocabulary, QUESTION_ACTS[kind], Claim(None, THIS)).text

    def which_question(self, phrase: Phrase) -> str:
        """Ask which thing a phrase is for."""
        return Saying(self._vocabulary, "ask_find", Claim(None, phrase)).text

    def mention(self, phrase: Phrase) -> str:
        """A phrase by itself."""
        return Saying(self._vocabulary, "mention", Claim(None, phrase)).text

    def plain_move(self, act: str) -> str:
        """A move that is about nothing in particular: `affirm`, `deny`, `greet` …"""
        return Saying(self._vocabulary, act).text

    def front_statement(self, front: str, phrase: Phrase) -> str:
        """Say which way a thing faces."""
        return Saying(self._vocabulary, "orient", facing_matter(front, phrase)).text

    def perspective(self, of: str) -> str:
        """Say whose perspective is meant: that of the `viewer` or the `landmark`."""
        return Saying(self._vocabulary, "take_frame", perspective_matter(of)).text

    def forget_request(self, kind: str, word: str) -> str:
        """Ask to forget a word."""
        about = word_matter(self.sign(kind, word))
        return Saying(self._vocabulary, "forget_word", about).text

    called = Alias("word_for")
    described = Alias("phrase_for")
    finding = Alias("which_question")
    mentioning = Alias("mention")
    plainly = Alias("plain_move")
    facing = Alias("front_statement")
    forgetting = Alias("forget_request")
