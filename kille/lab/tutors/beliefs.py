"""What a simulated tutor believes in a task, and how they speak of it.

All chance is that of the task: what a tutor believes does not depend on the robot.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from kille.dialogue.beliefs import knows
from kille.lab.scenes.scene import Occasion
from kille.lab.tutors.spatial_judges import Speaker
from kille.lab.tutors.tutor import Asked, Says, Task
from kille.lab.tutors.words import Words
from kille.lab.worlds.sayings import LESSON_ACTS, Phrase
from kille.lab.worlds.worlds import STEP, Thing
from ttr import Record


@dataclass(frozen=True)
class Manner:
    """How a tutor is: their words and how they speak of places; `other` is a judge.

    They have only the words of their `vocabulary`, or all where that is empty. In a
    share of lessons, the `errors`, they say what is true of other `kinds`, `hues` or
    places. They answer as many questions of a task as they have `patience`, and say
    "Thank you." in a share of cases, by their `politeness`. If they know which cues
    `matter` for nouns, they ask why after a wrong one, and say of cues that were given
    as reasons and do not matter that they do not. If they `orient` the robot,
    they tell it which way a landmark faces before they speak of places.
    """

    words: Words
    speaker: Speaker
    other: Speaker
    kinds: tuple[str, ...] = ()
    hues: tuple[str, ...] = ()
    vocabulary: tuple[str, ...] = ()
    errors: float = 0.0
    feedback: str = "both"
    patience: int = 3
    politeness: float = 0.0
    matters: tuple[str, ...] = ()
    orients: bool = False


@dataclass(frozen=True, eq=False)
class Beliefs:
    """What a tutor of this manner believes in a task."""

    manner: Manner
    task: Task

    @property
    def words(self) -> Words:
        """The words of the tutor."""
        return self.manner.words

    @property
    def has_words(self) -> bool:
        """Whether the tutor has a word for what the task is about."""
        return self.task.of is None or self.has_word(self.task.of)

    def has_word(self, occasion: Occasion) -> bool:
        """Whether the tutor has a word for this."""
        return not self.manner.vocabulary or self.right_word(occasion) in self._own

    @property
    def _own(self) -> set[str]:
        """The words of the vocabulary, as the tutor says them."""
        return {self.words.word_for(it) for it in self.manner.vocabulary}

    # --- what is so ------------------------------------------------------------------

    def right_word(self, occasion: Occasion) -> str:
        """The word that the tutor takes to be right; empty without one for a place."""
        if occasion.said:
            return self.words.word_for(occasion.said)
        match occasion.kind:
            case "noun":
                return self.words.word_for(occasion.thing.kind)
            case "adjective":
                return self.words.word_for(occasion.thing.colour)
        return self._place(self.manner.speaker, occasion, "place")

    def _place(self, speaker: Speaker, occasion: Occasion, chance: str) -> str:
        front = "" if occasion.landmark is None else occasion.landmark.front
        word = speaker.says(_offset(occasion), front, self.task.chance(chance))
        return self.words.word_for(word)

    @cached_property
    def frame(self) -> str:
        """In whose frame the tutor speaks of places now."""
        return self.manner.speaker.frame(self.task.chance("place"))

    def spoken_word(self, occasion: Occasion) -> str:
        """The word that the tutor says: the right one, or now and then another."""
        return self._or_slip(self.right_word(occasion), occasion, "error")

    def _or_slip(self, word: str, occasion: Occasion, by: str) -> str:
        chance = self.task.chance(by)
        others = [it for it in self._other_words(occasion) if it != word]
        errs = chance.random() < self.manner.errors and others
        return chance.choice(others) if errs else word

    def _other_words(self, occasion: Occasion) -> list[str]:
        """The words that the tutor might say by mistake."""
        names = {"noun": self.manner.kinds, "adjective": self.manner.hues}
        words = names.get(occasion.kind) or self.manner.speaker.words
        called = {self.words.word_for(it) for it in words}
        return sorted(called & self._own if self.manner.vocabulary else called)

    def question(self, occasion: Occasion) -> Asked:
        """The question for the word that is right here."""
        right = self.right_word(occasion)
        accepted, judge = frozenset({right}), self._judges_word(occasion)
        if occasion.kind == "relation" and not occasion.said:
            front = "" if occasion.landmark is None else occasion.landmark.front
            well = self.manner.speaker.accepts(_offset(occasion), front)
            accepted |= {self.words.word_for(it) for it in well}
        return Asked(occasion.kind, right, occasion.x, occasion.y, accepted, judge)

    def _judges_word(self, occasion: Occasion) -> str:
        """What another person says, who errs as often.

        Nothing of what people have said themselves: nobody else was asked.
        """
        if occasion.said:
            return ""
        word = self.right_word(occasion)
        if occasion.kind == "relation":
            word = self._place(self.manner.other, occasion, "judge")
        return self._or_slip(word, occasion, "judge's error")

    # --- how it is said --------------------------------------------------------------

    def lesson(self, s: Record | None) -> Says:
        """What is so; things are called by their nouns if the robot knows these."""
        occasion = self.task.occasion
        kind, word = occasion.kind, self.spoken_word(occasion)
        text = self.words.lesson(kind, word, self.landmark_phrase(s))
        return Says(text, LESSON_ACTS[kind], of=occasion.landmark)

    def correction(self, s: Record) -> Says:
        """What is so instead of what the robot said."""
        occasion = self.task.occasion
        word = self.spoken_word(occasion)
        text = self.words.correction(occasion.kind, word, self.landmark_phrase(s))
        return Says(text, "correct", corrects=True, of=occasion.landmark)

    def landmark_phrase(self, s: Record | None) -> Phrase | None:
        """A phrase for what a thing is beside, if that is talked of."""
        landmark = self.task.occasion.landmark
        return None if landmark is None else self.phrase(landmark, s)

    def phrase(self, thing: Thing, s: Record | None) -> Phrase:
        """A phrase for a thing that the robot may understand, and only for this one.

        That is its noun, if it knows that, or its colour; or both.
        """
        noun = self.words.sign("noun", self.words.word_for(thing.kind))
        known = s is not None and knows(s.private.nouns, noun)
        if known and self.is_only(thing.kind):
            return self.words.phrase_for(thing, "noun")
        return self.colour_phrase(thing)

    def colour_phrase(self, thing: Thing) -> Phrase:
        """A phrase for a thing by its colour; with its noun, if that is not enough."""
        if not thing.colour:
            return self.words.phrase_for(thing, "noun")
        by = ("adjective",) if self.is_only(thing.colour) else ("adjective", "noun")
        return self.words.phrase_for(thing, *by)

    def is_only(self, look: str) -> bool:
        """Whether one thing only is of this kind, or this colour, of those in view."""
        world = self.task.occasion.world
        things = [world.thing(it) for it in world.in_view]
        return sum(look in (it.kind, it.colour) for it in things) == 1


def _offset(occasion: Occasion) -> tuple[float, float]:
    """Where a thing is from what it is beside: metres right and away."""
    assert occasion.y is not None
    right, away = occasion.world.offset(occasion.x, occasion.y)
    return STEP * right, STEP * away
