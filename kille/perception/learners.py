"""The interface of a learner (learn, predict, forget), and the laws it obeys.

A learner is taught one observation at a time, as a tutor teaches. Its degrees are
those of words, in [0, 1]; one minus their sum is the degree of everything that it
has not been taught.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from itertools import count
from typing import Protocol, TypeVar

__all__ = ["Key", "Learner", "check_degrees", "check_learner", "own_key"]

Key = int | str
"""Identifies an observation, so that it can be forgotten.

>>> from kille.perception.learners import Key
>>> from kille.perception.relations import RelationMemory
>>> from kille.scene import Configuration
>>> key: Key = "the lesson of Monday"
>>> memory, left = RelationMemory(), Configuration((-0.3, 0, 0))
>>> memory.learn_one(left, "left", key=key)
>>> memory.nearest(left, "left")
'the lesson of Monday'
"""

X = TypeVar("X")
X_contra = TypeVar("X_contra", contravariant=True)

_SLACK = 1e-5  # products of float32 depend on how many are made at once


class Learner(Protocol[X_contra]):
    """Learns words from one observation at a time, and tells how well each fits.

    >>> from kille.scene import Configuration
    >>> left, right = Configuration((-0.3, 0, 0)), Configuration((0.3, 0, 0))
    >>> from kille.perception.relations import RelationMemory
    >>> learner: Learner[Configuration] = RelationMemory()
    >>> learner.learn_one(left, "left", key=1)
    >>> learner.forget(1)
    >>> learner.predict_proba_one(left)
    {}
    """

    def learn_one(self, x: X_contra, label: str, *, key: Key | None = None) -> None:
        """Learn that the word applies to x; ValueError if the key is taken.

        Without a key it gets one of its own.
        """
        ...

    def predict_proba_one(self, x: X_contra) -> dict[str, float]:
        """The degree in [0, 1] of each word for x; they sum to 1 at most."""
        ...

    def forget(self, key: Key) -> None:
        """Undo a lesson, as if it had never been given; KeyError if there was none."""
        ...


def own_key(taken: Collection[Key]) -> Key:
    """A new key, different from all those taken.

    >>> own_key({0, 3, "a"})
    4
    """
    return next(key for key in count(len(taken)) if key not in taken)


def check_degrees(degrees: Mapping[str, float]) -> None:
    """Check the laws of one answer's degrees; AssertionError names the broken law.

    >>> check_degrees({"cup": 0.7, "mug": 0.7})
    Traceback (most recent call last):
    AssertionError: degrees sum to 1 at most
    """
    _law(
        all(-_SLACK <= p <= 1 + _SLACK for p in degrees.values()),
        "degrees are in [0, 1]",
    )
    _law(sum(degrees.values()) <= 1 + _SLACK, "degrees sum to 1 at most")


def check_learner(
    make: Callable[[], Learner[X]], examples: Sequence[tuple[X, str]]
) -> None:
    """Check the laws of a learner on examples of at least two words.

    AssertionError names the law that does not hold; ValueError if the examples are of
    fewer than two words.

    >>> from kille.scene import Configuration
    >>> left, right = Configuration((-0.3, 0, 0)), Configuration((0.3, 0, 0))
    >>> from kille.perception.relations import RelationMemory
    >>> check_learner(RelationMemory, [(left, "left"), (right, "right")] * 2)
    >>> check_learner(RelationMemory, [(left, "left")])
    Traceback (most recent call last):
        ...
    ValueError: check_learner needs examples of at least two words
    """
    if len({label for _, label in examples}) < 2:
        raise ValueError("check_learner needs examples of at least two words")
    _check_nothing_learned(make, examples)
    _check_degrees(make, examples)
    _check_sameness(make, examples)
    _check_forgetting(make, examples)
    _check_keys(make, examples)


def _teach(
    make: Callable[[], Learner[X]], examples: Sequence[tuple[X, str]]
) -> Learner[X]:
    learner = make()
    for key, (x, label) in enumerate(examples):
        learner.learn_one(x, label, key=key)
    return learner


def _check_nothing_learned(
    make: Callable[[], Learner[X]], examples: Sequence[tuple[X, str]]
) -> None:
    for x, _ in examples:
        _law(make().predict_proba_one(x) == {}, "who has learned nothing knows no word")


def _check_degrees(
    make: Callable[[], Learner[X]], examples: Sequence[tuple[X, str]]
) -> None:
    for some in range(1, len(examples) + 1):
        learner = _teach(make, examples[:some])
        words = {label for _, label in examples[:some]}
        for x, _ in examples:
            degrees = learner.predict_proba_one(x)
            _law(set(degrees) <= words, "only learned words have a degree")
            check_degrees(degrees)


def _check_sameness(
    make: Callable[[], Learner[X]], examples: Sequence[tuple[X, str]]
) -> None:
    learner, twin = _teach(make, examples), _teach(make, examples)
    for x, _ in examples:
        degrees = learner.predict_proba_one(x)
        _law(learner.predict_proba_one(x) == degrees, "asking changes nothing")
        _law(twin.predict_proba_one(x) == degrees, "the same lessons, the same degrees")


def _check_forgetting(
    make: Callable[[], Learner[X]], examples: Sequence[tuple[X, str]]
) -> None:
    for gone in range(len(examples)):
        learner, never = _teach(make, examples), make()
        learner.forget(gone)
        for key, (x, label) in enumerate(examples):
            if key != gone:
                never.learn_one(x, label, key=key)
        for x, _ in examples:
            _law(
                _close(learner.predict_proba_one(x), never.predict_proba_one(x)),
                "to forget is to be as if it had never been learned",
            )


def _check_keys(
    make: Callable[[], Learner[X]], examples: Sequence[tuple[X, str]]
) -> None:
    learner = _teach(make, examples)
    x, label = examples[0]
    _law(_raises(ValueError, lambda: learner.learn_one(x, label, key=0)), "keys differ")
    _law(_raises(KeyError, lambda: learner.forget("no such key")), "no key, KeyError")
    before = learner.predict_proba_one(x)
    learner.learn_one(x, label, key="a key")
    learner.forget("a key")
    _law(_close(learner.predict_proba_one(x), before), "what is forgotten is gone")
    learner.learn_one(x, label)


def _law(holds: bool, law: str) -> None:
    if not holds:
        raise AssertionError(law)


def _close(one: Mapping[str, float], other: Mapping[str, float]) -> bool:
    return one.keys() == other.keys() and all(
        abs(one[word] - other[word]) <= _SLACK for word in one
    )


def _raises(error: type[Exception], act: Callable[[], object]) -> bool:
    try:
        act()
    except error:
        return True
    return False
