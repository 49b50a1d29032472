"""Words of simulated robots that learn in other ways than by their instances.

The games ask a word how far it is true of what is seen, and teach it by making another
of it. So whatever judges words stands behind a `LearnedWord`: one with a mean of its
own, or one that asks a learner which has heard all lessons in words of its kind.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from kille.dialogue.meanings import claims, value_at, word_of
from kille.lab.theories.pupils import Pupil, PupilLesson
from kille.lab.worlds.games import act, learned_words, word
from kille.lab.worlds.perception import Vector
from kille.lab.worlds.word_learning import LearnedWord, Observation
from kille.perception.likeness import Kernel
from kille.perception.relevance import Relevance
from kille.scene import Configuration
from ttr import Model, Record, RecordType
from ttr.types import TypeNode

MakeWord = Callable[[Record], LearnedWord]
"""Makes the word of a sign that was not taught yet."""


CUES = ("shape", "colour", "size")
"""By what a noun may be judged in a simulated world."""

_ALIKE = {cue: Kernel(1.0, 1.0) for cue in CUES}
"""The kernels of cues that count alike."""


class PrototypeWord(LearnedWord):
    """A word that is true of what is like the mean of all that it was said of.

    As often as it was said of something, so often it counts: with m the mean of k
    lessons and K the kernel, k K(m, x) takes the place of Σ K(xᵢ, x). Source: Rosch and
    Mervis 1975, "Family resemblances".
    """

    def support(self, aspect: int, of: Observation, holds: bool) -> float:
        """How much all lessons speak for the word, or against it, in an aspect."""
        lessons = (*self.prior, *self.lessons)
        told = [it.of[aspect] for it in lessons if it.holds is holds]
        if not told:
            return 0.0
        return len(told) * self.similarity(_mean(told), of[aspect], aspect)


class CueWord(LearnedWord):
    """A noun that is judged by shape, colour and size, as far as these count.

    What each of them says of a thing by itself is added up by its share. All shares are
    alike, but for what was said to matter for the word, or not to: that changes them as
    it does those of the whole robot's cues (`kille.perception.relevance`).
    """

    @property
    def aspects(self) -> Sequence[str]:
        """What the word may speak of."""
        return CUES if self.sign.kind == "noun" else super().aspects

    def weights(self) -> Sequence[float]:
        """The shares of the aspects; they sum to 1, if any is left."""
        if self.sign.kind != "noun":
            return super().weights()
        said = [(it.cue, it.matters) for it in self.criteria if it.cue]
        shares = Relevance.of(said).shares(_ALIKE)
        return [shares[cue] for cue in CUES]


@dataclass(frozen=True, eq=False)
class GuestWord(LearnedWord):
    """A word judged by a pupil who has heard the lessons in all words of its kind.

    What is known of a word without any lesson, as of colours, it judges by itself.
    """

    pupil: Pupil[Any] | None = None
    heard: tuple[PupilLesson[Any], ...] = ()

    def degree(self, of: Observation) -> float:
        """The degree to which it is true of what is seen."""
        if self.prior or self.pupil is None:
            return super().degree(of)
        degrees = self.pupil.degrees(self.heard, pupil_input(self.sign.kind, of))
        return min(max(degrees.get(word_of(self.sign).name, 0.0), 0.0), 1.0)


def pupil_input(kind: str, of: Observation) -> object:
    """What a pupil is shown: a relation as a configuration in metres, else numbers.

    >>> pupil_input("adjective", ((0.9, 0.1, 0.1), (0.5,)))
    (0.9, 0.1, 0.1, 0.5)
    >>> pupil_input("relation", ((0.0, 1.0), (0.3,))).offset
    (0.0, 0.3, 0.0)
    """
    if kind == "noun":
        return of[0]
    if kind != "relation":
        return tuple(number for aspect in of for number in aspect)
    (right, ahead), (far,) = of
    return Configuration((right * far, ahead * far, 0.0))


def with_known_colours(
    model: Model, makes: Mapping[str, MakeWord], signs: Sequence[Record]
) -> Model:
    """The model in which known words are of the class that is made for their kind.

    What a word is known to be true of without lessons stays known.
    """
    for sign in signs:
        before = word(model, word_of(sign))
        if before is None or before.lessons:
            continue
        made = replace(makes[sign.kind](sign), prior=before.prior)
        model = model.witnessed(word_of(sign), by=made)
    return model


def act_with(
    makes: Mapping[str, MakeWord],
) -> Callable[[TypeNode, Model], tuple[Record, Model]]:
    """The `act` of a robot whose new words are made by these functions."""

    def act_and_share(planned: TypeNode, model: Model) -> tuple[Record, Model]:
        move, after = act(planned, _with_new_words(planned, model, makes))
        return move, _share_lessons(after)

    return act_and_share


def _with_new_words(
    planned: TypeNode, model: Model, makes: Mapping[str, MakeWord]
) -> Model:
    """The model with all words that a planned move teaches."""
    assert isinstance(planned, RecordType)
    for content in value_at(planned, "teaches"):
        sign = next(it for it in value_at(planned, "signs") if claims(content, it))
        if word(model, word_of(sign)) is None:
            model = model.witnessed(word_of(sign), by=makes[sign.kind](sign))
    return model


def _share_lessons(model: Model) -> Model:
    """The model in which guests have heard the lessons of all words of their kind."""
    guests = [it for it in learned_words(model) if isinstance(it, GuestWord)]
    for kind in dict.fromkeys(it.sign.kind for it in guests):
        own = [it for it in guests if it.sign.kind == kind]
        heard = _all_lessons(own)
        for guest in own:
            if guest.heard != heard:
                by = replace(guest, heard=heard)
                model = model.witnessed(word_of(guest.sign), by=by)
    return model


def _all_lessons(guests: Sequence[GuestWord]) -> tuple[PupilLesson[Any], ...]:
    """All lessons, in the order in which they were given."""
    given = [(it, lesson) for it in guests if not it.prior for lesson in it.lessons]
    return tuple(
        PupilLesson(
            lesson.key,
            pupil_input(it.sign.kind, lesson.of),
            word_of(it.sign).name,
            lesson.holds,
        )
        for it, lesson in sorted(given, key=lambda found: found[1].number)
    )


def _mean(vectors: Sequence[Vector]) -> Vector:
    return tuple(
        math.fsum(column) / len(vectors) for column in zip(*vectors, strict=True)
    )
