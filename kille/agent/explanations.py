"""Answers to why the robot thinks so, and to what it knows of a word.

The reasons for a judgement come from what was seen and what is remembered. They are
records of the dialogue's types `Reason` and `Recalled`.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from datetime import datetime

from kille.dialogue.criteria import criterion, nearest_often
from kille.dialogue.meanings import DialogueTypes, claims, value_at, word_of
from kille.dialogue.reference import thing_at
from kille.dialogue.taxonomy import subsumption
from kille.grounding.lessons_and_learners import Knowledge
from kille.grounding.reasons import Reasons
from kille.grounding.witness_functions import WitnessFunctions
from kille.memory import CriterionLesson, Kind, KindLesson, Lesson, Memory, Word
from ttr import Record, RecordType, record

KINDS: dict[str, Kind] = {
    "noun": "object",
    "adjective": "attribute",
    "relation": "relation",
}
"""The kinds of words in talk, and what they are called in a memory."""

_TALKED_OF: dict[Kind, str] = {
    **{kind: said for said, kind in KINDS.items()},
    "subkind": "noun",
    "criterion": "noun",
}


RECALLED = 12
"""How many of the latest lessons in a noun are looked at for how things usually are."""

OFTEN = 0.5
"""From which degree on an adjective counts as true of what was shown."""


def sign_of(word: Word, types: DialogueTypes) -> Record:
    """The sign of a word in memory; an adjective may mean one of another language."""
    means = word.name.removeprefix("is_").replace("_", " ")
    kind = _TALKED_OF[word.kind]
    means = means if kind == "adjective" else ""
    return types.sign(word.surface, kind, word.article, means)


def kind_of_lesson(lesson: KindLesson, memory: Memory, types: DialogueTypes) -> Record:
    """A lesson in which kind of thing is a kind of which, as a `Kind` of the dialogue.

    It was taught before all lessons of the dialogue.
    """
    upper = sign_of(lesson.seen.upper, types)
    lower = sign_of(lesson.word, types)
    taught = [word_of(sign_of(it, types)) for it in memory.words()]
    return record(
        key=str(lesson.key),
        signs=[lower, upper],
        content=subsumption(lower, upper),
        new=[it for it in (lower, upper) if word_of(it) not in taught],
        after=-1.0,
    )


def criterion_of_lesson(lesson: CriterionLesson, types: DialogueTypes) -> Record:
    """A lesson by what things of a kind are known, as a `Criterion` of the dialogue.

    It was taught before all lessons of the dialogue.
    """
    subject, seen = sign_of(lesson.word, types), lesson.seen
    if seen.by == "cue":
        matters = seen.degree > 0.0
        content = criterion(subject, cue=seen.name, matters=matters, types=types)
        signs = [subject]
    else:
        kind: Kind = "attribute" if seen.by == "quality" else "object"
        word = sign_of(Word(seen.name, seen.surface, kind, seen.article), types)
        content = criterion(
            subject,
            quality=word if seen.by == "quality" else None,
            part=word if seen.by == "part" else None,
            often=nearest_often(seen.degree, types=types),
            types=types,
        )
        signs = [subject, word]
    return record(key=str(lesson.key), signs=signs, content=content, after=-1.0)


class Explainer:
    """Explains judgements and words, by what a robot knows and sees at some time."""

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

        It has no cues if no cue speaks for the claim.
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

    def recall_words(
        self, *words: Record, among: Iterable[Record] = ()
    ) -> list[Record]:
        """In how many lessons each word was said to hold, as `Recalled`.

        For a single word also the latest of these, the words that it was confused with,
        which are those that lessons denied in the turns in which it was taught, the
        most frequent first, and those of the adjectives `among` some words that are
        true of most things that a noun was taught of.
        """
        alone = len(words) == 1
        taught = self._knowledge.memory.counts()
        return [
            record(
                sign=word,
                lessons=float(taught.get((KINDS[word.kind], word_of(word).name), 0)),
                confused=self._confused_words(word) if alone else [],
                qualities=self._usual_qualities(word, among) if alone else [],
                reminders=self._latest_of(word) if alone else [],
            )
            for word in words
        ]

    def lesson_keys(self, words: Iterable[Record]) -> tuple[str, ...]:
        """The keys of all lessons in some words."""
        return tuple(str(key) for word in words for key in self._keys(word))

    def cite_lessons(self, keys: Iterable[str]) -> list[Record]:
        """The lessons of these keys, as `Reminder`."""
        memory = self._knowledge.memory
        return [self._reminder(memory.lesson_without_sight(int(it))) for it in keys]

    def latest(self, count: int) -> list[Record]:
        """The newest `count` lessons of all dialogues, as `Reminder`."""
        if not count:
            return []
        return [self._reminder(it) for it in self._knowledge.memory.latest(count)]

    def _keys(self, word: Record) -> tuple[int, ...]:
        kind, name = KINDS[word.kind], word_of(word).name
        return self._knowledge.memory.keys_of(kind, name)

    def _confused_words(self, word: Record) -> list[Record]:
        """The words that were denied when a word was taught, most frequent first."""
        lessons = self._knowledge.memory.lessons()
        keys = set(self._keys(word))
        taught = {_turn(it) for it in lessons if it.holds and it.key in keys}
        denied = Counter(
            sign_of(it.word, self._types)
            for it in lessons
            if not it.holds and it.word.kind == KINDS[word.kind] and _turn(it) in taught
        )
        return [other for other, _ in denied.most_common()]

    def _latest_of(self, word: Record) -> list[Record]:
        """The latest lesson in which a word was said to hold."""
        lessons = (self._knowledge.memory.lesson(it) for it in self._keys(word))
        held = [it for it in lessons if it.holds]
        return [self._reminder(it) for it in held[-1:]]

    def _usual_qualities(self, noun: Record, among: Iterable[Record]) -> list[Record]:
        """The adjectives that are true of most things that a noun was taught of."""
        adjectives = [it for it in among if it.kind == "adjective"]
        if noun.kind != "noun" or not adjectives:
            return []
        keys = self._keys(noun)[-RECALLED:]
        degrees = [self._knowledge.qualities_of(it) for it in keys]
        held = [it for it in degrees if it is not None]
        found = []
        for sign in adjectives:
            name = word_of(sign).name
            true = sum(it.get(name, 0.0) >= OFTEN for it in held)
            if held and true > len(held) / 2:
                found.append((-true, sign.form, sign))
        return [sign for _, _, sign in sorted(found, key=lambda it: it[:2])][:2]

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
        if word.kind == "noun" and name not in self._knowledge.objects.labels:
            return None  # it is known as a kind of another only
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
            examples=float(lesson.holds and lesson.word.kind in KINDS.values()),
            text=lesson.turn.text,
            dialogue=str(lesson.turn.dialogue),
            turn=str(lesson.turn.number),
            age=max((self._now - then).total_seconds(), 0.0),
            day=at.date().isoformat(),
            time=at.strftime("%H:%M"),
        )


def _turn(lesson: Lesson) -> tuple[int, int]:
    return lesson.turn.dialogue, lesson.turn.number
