"""A learner: an object around an immutable classifier, taught step by step."""

from __future__ import annotations

from contextlib import suppress
from itertools import count
from typing import Protocol, Self, runtime_checkable

from ttr.errors import TTRError
from ttr.semantics.learning.evidence import Key, KeyTakenError
from ttr.types.syntax import TypeNode, kind_of


@runtime_checkable
class TypeClassifier(Protocol):
    """A classifier as an immutable value: `NaiveBayes` and `LogOdds` are such."""

    @property
    def labels(self) -> tuple[str, ...]:
        """The labels that were learned, in alphabetical order."""
        ...

    def learned(self, x: TypeNode, label: str, *, key: Key) -> Self:
        """The classifier after a lesson: what is of x has this label."""
        ...

    def retracted(self, key: Key) -> Self:
        """The classifier as if the lesson of a key had never been."""
        ...

    def probabilities(self, x: TypeNode) -> dict[str, float]:
        """The probability of each label for what is of x; they sum to at most 1."""
        ...


class Learner:
    """An object that learns, predicts and forgets, around a classifier.

    `classifier` is the value of what was learned so far, to keep or to compare.

    >>> from ttr import Basic
    >>> from ttr.semantics.learning.naive_bayes import NaiveBayes
    >>> Red, Round = Basic("Red"), Basic("Round")
    >>> learner = Learner(NaiveBayes((Red, Round)))
    >>> learner.learn_one(Red & Round, "apple", key=1)
    >>> learner.learn_one(Round, "pear", key=2)
    >>> learner.predict_proba_one(Red & Round)
    {'apple': 1.0, 'pear': 0.0}
    >>> learner.forget(2)
    >>> learner.predict_proba_one(Round)
    {'apple': 1.0}
    """

    def __init__(self, classifier: TypeClassifier) -> None:
        if not isinstance(classifier, TypeClassifier):
            raise TTRError(
                f"a learner needs a classifier, found {kind_of(classifier)}",
                hint="write Learner(LogOdds(features)), or NaiveBayes",
            )
        self.classifier = classifier
        self._lessons = 0

    @property
    def labels(self) -> tuple[str, ...]:
        """The labels that were learned, in alphabetical order."""
        return self.classifier.labels

    def copy(self) -> Learner:
        """A learner with the same lessons, which from now on learns by itself."""
        pupil = Learner(self.classifier)
        pupil._lessons = self._lessons
        return pupil

    def __deepcopy__(self, _: object) -> Learner:
        return self.copy()

    def learn_one(self, x: TypeNode, label: str, *, key: Key | None = None) -> None:
        """Learn that what is of x has this label; raises `KeyTakenError`.

        A lesson without a key gets the next free one of "lesson 1", "lesson 2", …
        """
        if key is not None:
            self.classifier = self.classifier.learned(x, label, key=key)
            return
        for number in count(self._lessons + 1):
            with suppress(KeyTakenError):
                key = f"lesson {number}"
                self.classifier = self.classifier.learned(x, label, key=key)
                self._lessons = number
                return

    def predict_proba_one(self, x: TypeNode) -> dict[str, float]:
        """The probability of each label for what is of x; they sum to at most 1."""
        return self.classifier.probabilities(x)

    def forget(self, key: Key) -> None:
        """Be as if the lesson of a key had never been; raises `NoSuchKeyError`."""
        self.classifier = self.classifier.retracted(key)
