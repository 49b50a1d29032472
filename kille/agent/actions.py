"""What the robot does when it makes a move: it learns, unlearns, recalls and points."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from datetime import datetime

from kille.agent.attention import AttentiveSensor
from kille.agent.dialogue_log import DialogueLog
from kille.agent.explanations import Explainer, sign_of
from kille.dialogue.criteria import (
    COMPONENT,
    CUE,
    PROPERTY,
    degree_of,
    signs_in,
    what_of,
)
from kille.dialogue.meanings import DialogueTypes, claims, is_denial, value_at, word_of
from kille.dialogue.reference import PARTS, phrase_at
from kille.dialogue.taxonomy import nouns_in
from kille.grounding.lessons_and_learners import Knowledge, LessonSource, Named
from kille.grounding.witness_functions import WitnessFunctions, number_of
from kille.memory import Kind, Word
from kille.memory.lessons import By
from kille.scene import Percept
from ttr import Model, Record, RecordType, record, replace
from ttr.types import PType, TypeNode

BY: Mapping[str, By] = {CUE: "cue", PROPERTY: "quality", COMPONENT: "part"}
"""By what a memory says that things are known, by the label in the content."""


MEASURED = ("height", "length", "distance")
"""What it tells of what it has measured of a thing."""


class MoveExecutor:
    """Makes the moves of a game: learns, unlearns, recalls and points, then says so.

    A lesson is kept with the turn and the look that it comes from. SensorError and
    MemoryFileError come from the sensor and the memory.
    """

    def __init__(
        self,
        knowledge: Knowledge,
        witnesses: WitnessFunctions,
        gaze: AttentiveSensor,
        log: DialogueLog,
        now: Callable[[], datetime],
        types: DialogueTypes,
    ) -> None:
        self._knowledge, self._witnesses = knowledge, witnesses
        self._gaze, self._log = gaze, log
        self._now, self._types = now, types

    def act(self, planned: TypeNode, model: Model) -> tuple[Record, Model]:
        """Make a planned move: the event, and the model in which it has been made."""
        move, model = model.create(planned)
        keys = tuple(str(self._learn(it, move.signs)) for it in move.teaches)
        kinds = tuple(str(self._learn_kind(it, move.signs)) for it in move.classifies)
        criteria = tuple(
            str(self._learn_criterion(it, move.signs)) for it in move.weighs
        )
        explainer = Explainer(
            self._knowledge, self._witnesses, self._now(), self._types
        )
        dropped = explainer.lesson_keys(move.drops)
        undone = explainer.latest(len(move.undoes))
        undone_keys = [it.key for it in undone]
        lost = self._unlearn((*move.forgets, *dropped, *undone_keys))
        if keys or kinds or criteria or move.forgets or dropped or undone:
            self._witnesses.reconsider()
            model = self._witnesses.in_model(model, move.signs, types=self._types)
        for x in move.points:
            self._gaze.point(str(number_of(x)))
        done = {
            "keys": keys,
            "kinds": kinds,
            "criteria": criteria,
            "dropped": dropped,
            "undone": undone or move.undone,
            "lost": lost,
            "reasons": [explainer.reason(it, move.signs) for it in move.explains],
            "recalled": explainer.recall_words(*move.recalls, among=move.signs),
            "cited": explainer.cite_lessons(move.cites),
            "measured": self._measure(move),
        }
        return replace(move, done), model

    def _measure(self, move: Record) -> list[Record]:
        """What it measures of the things that it is to measure, if of all of them."""
        found = []
        for x in move.measures:
            extents = self._witnesses.extents(x, str(value_at(move.content, "look")))
            if extents is None:
                return []
            measured = {it: getattr(extents, it) for it in MEASURED}
            found.append(record(measured, x=x))
        return found

    # --- learning --------------------------------------------------------------------

    def _learn(self, content: RecordType, signs: Sequence[Record]) -> int:
        """Learn that a content is so; returns the key of the lesson."""
        learned = next(it for it in signs if claims(content, it))
        match learned.kind:
            case "relation":
                return self._learn_relation(content, learned)
            case "noun":
                learn = self._knowledge.learn_noun
            case _:
                learn = self._knowledge.learn_attribute
        return learn(
            word_of(learned).name,
            learned.form,
            self._percept(content, "target"),
            self._evidence(value_at(content, "look")),
            article=learned.article,
            holds=not is_denial(content),
        )

    def _learn_kind(self, content: RecordType, signs: Sequence[Record]) -> int:
        """Learn that a kind is a kind of another; returns the key of the lesson."""
        lower, upper = (
            Word(word_of(it).name, it.form, "object", it.article)
            for it in nouns_in(content, signs)
        )
        return self._knowledge.learn_kind(self._log.record_source(), lower, upper)

    def _learn_criterion(self, content: RecordType, signs: Sequence[Record]) -> int:
        """Learn by what things of a kind are known; returns the key of the lesson."""
        subject, *others = signs_in(content, signs)
        noun = Word(word_of(subject).name, subject.form, "object", subject.article)
        label, _ = what_of(content)
        if label == CUE:
            cue = str(value_at(content, CUE))
            word = Word(cue, cue, "attribute")
        else:
            other = others[0]
            kind: Kind = "attribute" if label == PROPERTY else "object"
            word = Word(word_of(other).name, other.form, kind, other.article)
        return self._knowledge.learn_criterion(
            self._log.record_source(), noun, BY[label], word, degree_of(content)
        )

    def _learn_relation(self, content: RecordType, learned: Record) -> int:
        look, front = value_at(content, "look"), value_at(content, "frame")
        x, y = (value_at(phrase_at(content, part), "x") for part in PARTS)
        stand = self._witnesses.configuration(x, y, look, front)
        if stand is None:
            raise _missing_look_error(look)
        return self._knowledge.learn_relation(
            word_of(learned).name,
            learned.form,
            (
                self._thing_with_word(content, "target"),
                self._thing_with_word(content, "landmark"),
            ),
            stand,
            self._evidence(look),
            article=learned.article,
            holds=not is_denial(content),
        )

    def _thing_with_word(self, content: RecordType, part: str) -> Named:
        """A thing in a look, with the name of the word that is said of it there."""
        claim = phrase_at(content, part).get("c")
        name = claim.pred.name if isinstance(claim, PType) else ""
        return name, self._percept(content, part)

    def _percept(self, content: RecordType, part: str) -> Percept:
        x, look = value_at(phrase_at(content, part), "x"), value_at(content, "look")
        percept = self._witnesses.percept(x, look)
        if percept is None:
            raise _missing_look_error(look)
        return percept

    def _evidence(self, handle: str) -> LessonSource:
        look = self._witnesses.look(handle)
        time = 0.0 if look is None else look.frame.time
        return LessonSource(self._log.record_source(), self._gaze.sensor.name, time)

    # --- unlearning ------------------------------------------------------------------

    def _unlearn(self, keys: Collection[str]) -> tuple[Record, ...]:
        """Unlearn these lessons; returns the words that have no lesson left."""
        if not keys:
            return ()
        before = self._knowledge.memory.words()
        for key in keys:
            self._knowledge.forget(int(key))
        left = {
            word_of(sign_of(it, self._types)) for it in self._knowledge.memory.words()
        }
        gone = [sign_of(it, self._types) for it in before if not self._is_known(it)]
        return tuple(it for it in gone if word_of(it) not in left)

    def _is_known(self, word: Word) -> bool:
        """Whether it knows a word without having been taught it: that of a colour."""
        colour = word.name.removeprefix("is_").replace("_", " ")
        return word.kind == "attribute" and colour in self._knowledge.colours.labels


def _missing_look_error(look: str) -> RuntimeError:
    return RuntimeError(f"{look} was let go before its lesson")
