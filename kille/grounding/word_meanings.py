"""The robot's words as perceptual meanings: {params, bg, clf, interp}.

The learner that judges a word is the classifier of its meaning. So a word can be
printed, corrected and compared like any other meaning, on copies of what the robot has
learned; the robot itself learns through its memory only.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from operator import methodcaller
from typing import Any, Generic, Protocol, Self, TypeVar

from kille.dialogue.meanings import word_of
from kille.grounding.witness_functions import WitnessFunctions
from kille.perception.learners import Learner
from kille.perception.objects import ObjectMemory
from kille.perception.relations import RelationMemory
from kille.perception.relations.shown_templates import templates_shown
from kille.scene import Configuration
from ttr import Record
from ttr.semantics.perceptual import (
    ByLearner,
    Meaning,
    Speaker,
    interpretation,
    learner_params,
    meaning,
)
from ttr.showing import Part
from ttr.types import Path, PType

X = TypeVar("X")
X_contra = TypeVar("X_contra", contravariant=True)


class CopyableLearner(Learner[X_contra], Protocol[X_contra]):
    """A learner that can be copied with what it knows."""

    @property
    def labels(self) -> tuple[str, ...]:
        """The learned words."""
        ...

    def copy(self) -> Self:
        """A copy that knows the same."""
        ...


class KeylessLearner(Generic[X]):
    """A learner that is taught without keys, apart from the robot's memory."""

    def __init__(self, learner: CopyableLearner[X], lessons: int = 0) -> None:
        self._learner, self._lessons = learner, lessons

    @property
    def name(self) -> str:
        """What kind of learner it is."""
        return type(self._learner).__name__

    @property
    def labels(self) -> tuple[str, ...]:
        """The words that it knows."""
        return self._learner.labels

    def learn_one(self, x: X, y: str, /) -> None:
        """Take x as an instance of the word."""
        self._lessons += 1
        self._learner.learn_one(x, y, key=f"lesson {self._lessons} of a pupil")

    def predict_proba_one(self, x: X, /) -> dict[str, float]:
        """The degree of each word."""
        return self._learner.predict_proba_one(x)

    def copy(self) -> KeylessLearner[X]:
        """A copy that knows the same."""
        return KeylessLearner(self._learner.copy(), self._lessons)


class SingleRelationLearner(KeylessLearner[Configuration]):
    """A learner that is asked about one spatial word only.

    Several of them may hold of the same things, to degrees that sum to more than 1.
    """

    def __init__(self, learner: RelationMemory, word: str, lessons: int = 0) -> None:
        super().__init__(learner, lessons)
        self._relations, self._word = learner, word

    @property
    def labels(self) -> tuple[str, ...]:
        """The word, once it has been learned."""
        return tuple(word for word in self._relations.labels if word == self._word)

    def predict_proba_one(self, x: Configuration, /) -> dict[str, float]:
        """The degree of the word."""
        degrees = self._relations.degrees(x)
        return {word: degrees[word] for word in self.labels}

    def _shown_as_(self) -> Part:
        return templates_shown(self._relations, self.labels)

    def copy(self) -> SingleRelationLearner:
        """A copy that knows the same."""
        return SingleRelationLearner(self._relations.copy(), self._word, self._lessons)


class WordMeanings:
    """Makes the meanings of words, from the learners and the remembered looks."""

    def __init__(
        self,
        witnesses: WitnessFunctions,
        objects: ObjectMemory,
        relations: RelationMemory,
    ) -> None:
        self._witnesses, self._objects, self._relations = witnesses, objects, relations

    def speaker(
        self, name: str, nouns: Iterable[Record], relations: Iterable[Record]
    ) -> Speaker:
        """The speaker of these words; nouns share one learner, relations do not."""
        shared = _params(KeylessLearner(self._objects))
        meanings = {
            sign.form: _meaning(sign, shared, self._witnesses.percept) for sign in nouns
        }
        for sign in relations:
            own = _params(SingleRelationLearner(self._relations, word_of(sign).name))
            meanings[sign.form] = _meaning(sign, own, self._witnesses.configuration)
        return Speaker(name, meanings)


def _params(pupil: KeylessLearner[Any]) -> Record:
    return learner_params(pupil, copied=methodcaller("copy"))


def _meaning(
    sign: Record, params: Record, through: Callable[..., object | None]
) -> Meaning:
    """The meaning of a word, whose percept is found by the arguments it takes."""
    word = word_of(sign)
    label, claim = next(
        (label, field)
        for label, field in sign.meaning.fields
        if isinstance(field, PType) and field.pred is word
    )
    of = tuple([".".join(arg.labels) for arg in claim.args if isinstance(arg, Path)])
    method = ByLearner(word.name)
    interp = interpretation(sign.meaning, label)
    return meaning(interp, method, params, of=of, through=through)
