"""A learner, taught one observation at a time, around an immutable classifier."""

from __future__ import annotations

from contextlib import suppress
from itertools import count
from typing import Protocol, Self, runtime_checkable

from ttr.errors import TTRError
from ttr.semantics.learning.evidence import Key, KeyTaken
from ttr.types.syntax import TypeNode, kind_of

__all__ = ["Classifier", "Learner"]


@runtime_checkable
class Classifier(Protocol):
    """What was learned, as a value: `NaiveBayes` and `LogOdds` are such."""

    @property
    def labels(self) -> tuple[str, ...]:
        """The labels that were learned, in alphabetical order."""
        ...

    def learned(self, x: TypeNode, label: str, *, key: Key) -> Self:
        """The classifier that has learned that what is of x is so called."""
        ...

    def retracted(self, key: Key) -> Self:
        """The classifier that has never learned what is known by the key."""
        ...

    def probabilities(self, x: TypeNode) -> dict[str, float]:
        """The probability of each label for what is of x; they sum to 1 at most."""
        ...


class Learner:
    """The two methods of a learner, and one to forget, around a classifier.

    `classifier` is what has been learned so far, a value to keep or to compare.

    >>> from ttr.semantics.learning.naive_bayes import NaiveBayes
    >>> from ttr.types.syntax import Basic
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

    def __init__(self, classifier: Classifier) -> None:
        if not isinstance(classifier, Classifier):
            raise TTRError(
                f"a learner is taught a classifier, found {kind_of(classifier)}",
                hint="write Learner(LogOdds(features)), or NaiveBayes",
            )
        self.classifier = classifier
        self._lessons = 0

    @property
    def labels(self) -> tuple[str, ...]:
        """The labels that were learned, in alphabetical order."""
        return self.classifier.labels

    def copy(self) -> Learner:
        """Another learner of the same, which is taught apart from this one."""
        pupil = Learner(self.classifier)
        pupil._lessons = self._lessons
        return pupil

    def __deepcopy__(self, _: object) -> Learner:
        return self.copy()

    def learn_one(self, x: TypeNode, label: str, *, key: Key | None = None) -> None:
        """Learns that what is of x is so called; `KeyTaken` if the key is taken.

        A lesson without a key gets the next one that is free of "lesson 1", "lesson 2"
        and so on.
        """
        if key is not None:
            self.classifier = self.classifier.learned(x, label, key=key)
            return
        for number in count(self._lessons + 1):
            with suppress(KeyTaken):
                key = f"lesson {number}"
                self.classifier = self.classifier.learned(x, label, key=key)
                self._lessons = number
                return

    def predict_proba_one(self, x: TypeNode) -> dict[str, float]:
        """The probability of each label for what is of x; they sum to 1 at most."""
        return self.classifier.probabilities(x)

    def forget(self, key: Key) -> None:
        """Be as if this had never been learned; `NoSuchKey` if it was not."""
        self.classifier = self.classifier.retracted(key)
