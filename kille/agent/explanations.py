"""What a robot recalls when it is asked: why it thinks so, and what it knows of a word.

The reasons of a judgement are looked for in what was seen and what is remembered; they
are given as the records that the dialogue speaks of, `Reason` and `Recalled`.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from datetime import datetime

from kille.dialogue.meanings import DialogueTypes, claims, value_at, word_of
from kille.dialogue.reference import thing_at
from kille.grounding.knowledge import Knowledge
from kille.grounding.reasons import Reasons
from kille.grounding.witness_functions import WitnessFunctions
from kille.memory import Kind, Lesson, Word
from ttr import Record, RecordType, record

KINDS: dict[str, Kind] = {
    "noun": "object",
    "adjective": "attribute",
    "relation": "relation",
}
"""What the kinds of words that are talked of are called in a memory."""

_TALKED_OF = {kind: said for said, kind in KINDS.items()}


def sign_of(word: Word, types: DialogueTypes) -> Record:
    """A word of the memory in talk; an adjective may mean one of another language."""
    means = word.name.removeprefix("is_").replace("_", " ")
    kind = _TALKED_OF[word.kind]
    means = means if kind == "adjective" else ""
    return types.sign(word.surface, kind, word.article, means)


class Explainer:
    """Answers from what a robot knows and has in view, as of some time."""

    def __init__(
        self,
        knowledge: Knowledge,
        witnesses: WitnessFunctions,
        now: datetime,
        types: DialogueTypes,
    ) -> None:
        self._knowledge, self._witnesses = knowledge, witnesses
        self._now, self._types = now, types

    def reason(self, claim: RecordType, signs: Iterable[Record]) -> Record:
        """Why it thinks that a claim is true: a `Reason`.

        It has no cues where nothing speaks for it that could be named.
        """
        found = self._reasons(claim, next(it for it in signs if claims(claim, it)))
        if found is None:
            return record(claim=claim, p=0.0, cues=[], reminders=[])
        lessons = [] if found.lesson is None else [found.lesson]
        return record(
            claim=claim,
            p=found.degree,
            cues=[record(name=it.cue, share=it.share) for it in found.cues],
            reminders=[self._reminder(lesson) for lesson in lessons],
        )

    def recall_words(self, *words: Record) -> list[Record]:
        """In how many lessons each word was said to hold, as `Recalled`.

        Of a single word also which others it was corrected from: those that a lesson
        denied in the turn in which it was taught, the most often first.
        """
        alone = len(words) == 1
        taught = self._knowledge.memory.counts()
        return [
            record(
                sign=word,
                lessons=float(taught.get((KINDS[word.kind], word_of(word).name), 0)),
                confused=self._confused_words(word) if alone else [],
            )
            for word in words
        ]

    def lesson_keys(self, words: Iterable[Record]) -> tuple[str, ...]:
        """The keys of all lessons in some words."""
        return tuple(str(key) for word in words for key in self._keys(word))

    def latest(self, count: int) -> list[Record]:
        """So many of the newest lessons, of whatever dialogue, as `Reminder`."""
        if not count:
            return []
        return [self._reminder(it) for it in self._knowledge.memory.latest(count)]

    def _keys(self, word: Record) -> tuple[int, ...]:
        kind, name = KINDS[word.kind], word_of(word).name
        return self._knowledge.memory.keys_of(kind, name)

    def _confused_words(self, word: Record) -> list[Record]:
        """The words that were denied when a word was taught, the most often first."""
        lessons = self._knowledge.memory.lessons()
        keys = set(self._keys(word))
        taught = {_turn(it) for it in lessons if it.holds and it.key in keys}
        denied = Counter(
            sign_of(it.word, self._types)
            for it in lessons
            if not it.holds and it.word.kind == KINDS[word.kind] and _turn(it) in taught
        )
        return [other for other, _ in denied.most_common()]

    def _reasons(self, claim: RecordType, word: Record) -> Reasons | None:
        name, look = word_of(word).name, str(value_at(claim, "look"))
        x = thing_at(claim, "target") or ""
        if word.kind == "relation":
            y, front = thing_at(claim, "landmark") or "", value_at(claim, "frame")
            stand = self._witnesses.configuration(x, y, look, str(front))
            if stand is None:
                return None
            return self._knowledge.relation_reasons(name, stand)
        percept = self._witnesses.percept(x, look)
        if percept is None:
            return None
        if word.kind == "noun":
            heard = self._witnesses.evidence(x, look)
            return self._knowledge.reasons(name, percept, heard=heard)
        return self._knowledge.attribute_reasons(name, percept)

    def _reminder(self, lesson: Lesson) -> Record:
        """A lesson, and how long ago it was: a `Reminder`, in local time."""
        then = datetime.fromisoformat(lesson.turn.time)
        at = then.astimezone()
        return record(
            key=str(lesson.key),
            sign=sign_of(lesson.word, self._types),
            examples=float(lesson.holds),
            text=lesson.turn.text,
            dialogue=str(lesson.turn.dialogue),
            turn=str(lesson.turn.number),
            age=max((self._now - then).total_seconds(), 0.0),
            day=at.date().isoformat(),
            time=at.strftime("%H:%M"),
        )


def _turn(lesson: Lesson) -> tuple[int, int]:
    return lesson.turn.dialogue, lesson.turn.number
