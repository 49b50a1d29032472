"""Attribute words, learned from few examples: which aspect does each describe?

For a word w and an aspect c (see `kille.perception.attributes.aspects`) a Gaussian
process says how far w holds: its mean is -1 beforehand, since most words do not hold of
most things; a lesson is an observation of +1 where w was said to hold, and of -1 where
it was denied, with noise for slips of the tutor. What w speaks of is not known. How
probable the lessons are by each aspect, the marginal likelihood, says how likely that
is: the things of which w holds are alike in it, and unlike those of which it does not.

    P(c | lessons) ∝ P(c) N(y; -1, K_c + s²),
    degree of w for x = Σ_c P(c | lessons) Φ(μ_c(x) / √(σ_c²(x) + s²))

With one lesson every aspect is as likely as before, and the degree is high only where
things are alike in most of them; a word that was denied only is not known to hold of
anything. Each word is judged by its own lessons: several may hold at once. All follows
from the lessons as they stand, in order, so that they are forgotten without a trace.

Source: Rasmussen & Williams 2006, *Gaussian Processes for Machine Learning*, 2.2, 5.4.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kille.perception.attributes.aspects import ASPECTS, Aspect
from kille.perception.learners import Key, own_key
from kille.scene import Traits

Numbers = NDArray[np.float64]

_MEAN = -1.0  # before any lesson
_NOISE = 0.15  # s²
_NEWEST = 40  # lessons of a word that count

_PHI = np.vectorize(lambda x: 0.5 * (1 + math.erf(x / math.sqrt(2))), otypes=[float])


@dataclass(frozen=True, eq=False)
class _Lesson:
    label: str
    traits: Traits
    holds: bool


@dataclass(frozen=True, eq=False)
class _Process:
    """What the lessons in a word say in one aspect.

    `rows` (n, k) are the lessons whose aspect is known, `inverse` (n, n) that of K + s²
    and `pull` (n,) that times the residuals; `evidence` is the marginal log likelihood.
    """

    aspect: Aspect
    rows: Numbers
    inverse: Numbers
    pull: Numbers
    evidence: float

    def degree(self, x: Numbers | None) -> float:
        """The probability that the word applies to a thing with these numbers."""
        mean, variance = _MEAN, 1.0
        if x is not None:
            variance = float(self.aspect.kernel(x[None], x[None])[0, 0])
        if x is not None and len(self.rows):
            alike = self.aspect.kernel(x[None], self.rows)[0]
            mean += float(alike @ self.pull)
            variance -= float(alike @ self.inverse @ alike)
        return float(_PHI(mean / math.sqrt(max(variance, 0.0) + _NOISE)))

    def likeness(self, x: Numbers | None) -> float:
        """How similar these numbers are to those of the most similar lesson."""
        if x is None or not len(self.rows):
            return 0.0
        return max(_in_common(self.aspect, x, row) for row in self.rows)


@dataclass(frozen=True, eq=False)
class _Belief:
    """What is believed about a word: a process and a probability for each aspect."""

    processes: Sequence[_Process]
    likely: Numbers

    def likeness(self, measured: Mapping[str, Numbers | None]) -> float:
        """How similar a thing is to the most similar lesson."""
        alike = [it.likeness(measured[it.aspect.name]) for it in self.processes]
        return float(np.clip(self.likely @ np.array(alike), 0, 1))

    def degree(self, measured: Mapping[str, Numbers | None]) -> float:
        """The probability that the word applies to a thing measured so."""
        degrees = [it.degree(measured[it.aspect.name]) for it in self.processes]
        return float(min(1.0, self.likely @ np.array(degrees)))


class AttributeMemory:
    """A learner of attribute words, from the traits of things.

    `aspects` are those that words may speak of.

    >>> big = {"size": np.array([0.3, 0.3, 0.3], np.float32)}
    >>> memory = AttributeMemory()
    >>> memory.learn_one(big, "big")
    >>> [*memory.degrees(big)]
    ['big']
    """

    def __init__(self, aspects: Mapping[str, Aspect] = ASPECTS) -> None:
        self._aspects = aspects
        self._lessons: dict[Key, _Lesson] = {}
        self._beliefs: dict[str, _Belief] = {}

    def copy(self) -> AttributeMemory:
        """A copy that knows the same; either learns without the other."""
        twin = AttributeMemory()
        twin.become(self)
        return twin

    def become(self, other: AttributeMemory) -> None:
        """Take over all that the other knows; afterwards either learns by itself."""
        self._aspects = other._aspects
        self._lessons, self._beliefs = dict(other._lessons), dict(other._beliefs)

    @property
    def labels(self) -> tuple[str, ...]:
        """The words that are known to apply to something, in alphabetical order."""
        return tuple(sorted({it.label for it in self._lessons.values() if it.holds}))

    def learn_one(self, x: Traits, label: str, *, key: Key | None = None) -> None:
        """Learn that the word applies to x; ValueError if the key is taken."""
        self._learn(_Lesson(label, x, True), key)

    def deny_one(self, x: Traits, label: str, *, key: Key | None = None) -> None:
        """Learn that the word does not apply to x; ValueError if the key is taken."""
        self._learn(_Lesson(label, x, False), key)

    def _learn(self, lesson: _Lesson, key: Key | None) -> None:
        if key in self._lessons:
            raise ValueError(f"the key {key!r} was learned before; forget it first")
        self._lessons[own_key(self._lessons) if key is None else key] = lesson
        self._beliefs.pop(lesson.label, None)

    def forget(self, key: Key) -> None:
        """Undo a lesson, as if it had never been given; KeyError if there was none."""
        self._beliefs.pop(self._lessons.pop(key).label, None)

    def degrees(self, x: Traits) -> dict[str, float]:
        """How well each word applies, in [0, 1]; several may apply at once."""
        measured = {name: it.measure(x) for name, it in self._aspects.items()}
        return {word: self._belief(word).degree(measured) for word in self.labels}

    def denials(self, x: Traits) -> dict[str, float]:
        """How similar x is, in [0, 1], to a thing that each word was denied of.

        Of words that were only denied: nothing says where they hold, but not there.
        """
        measured = {name: it.measure(x) for name, it in self._aspects.items()}
        only = {it.label for it in self._lessons.values()} - {*self.labels}
        return {word: self._belief(word).likeness(measured) for word in sorted(only)}

    def speaks_of(self, label: str) -> dict[str, float]:
        """The probability that the word describes each aspect, most probable first.

        KeyError for a word that is not known.
        """
        belief = self._belief_of_known(label)
        shares = zip(self._aspects, belief.likely.tolist(), strict=True)
        return dict(sorted(shares, key=lambda item: -item[1]))

    def nearest(self, x: Traits, label: str) -> Key | None:
        """The lesson whose thing is most like x in the aspects that the word describes.

        None if that cannot be told; KeyError for a word that is not known.
        """
        belief = self._belief_of_known(label)
        own = [
            (key, it.traits)
            for key, it in self._lessons.items()
            if it.label == label and it.holds
        ][-_NEWEST:]
        alike = np.zeros(len(own))
        for aspect, share in zip(self._aspects.values(), belief.likely, strict=True):
            here = aspect.measure(x)
            for number, (_, traits) in enumerate(own):
                there = aspect.measure(traits)
                alike[number] += share * _in_common(aspect, here, there)
        return own[int(alike.argmax())][0] if alike.any() else None

    def _belief_of_known(self, label: str) -> _Belief:
        if label not in self.labels:
            raise KeyError(label)
        return self._belief(label)

    def _belief(self, label: str) -> _Belief:
        if label not in self._beliefs:
            own = [it for it in self._lessons.values() if it.label == label]
            self._beliefs[label] = _believe(self._aspects, own[-_NEWEST:])
        return self._beliefs[label]


def _believe(aspects: Mapping[str, Aspect], lessons: Sequence[_Lesson]) -> _Belief:
    """Weigh all aspects by how well they explain the lessons."""
    processes = [_process(aspect, lessons) for aspect in aspects.values()]
    scores = np.array([math.log(it.aspect.prior) + it.evidence for it in processes])
    shown = np.array([bool(len(it.rows)) for it in processes])
    if shown.any():  # a word hardly speaks of what nobody could see
        scores = np.where(shown, scores, -np.inf)
    likely = np.exp(scores - scores.max())
    return _Belief(processes, likely / likely.sum())


def _process(aspect: Aspect, lessons: Sequence[_Lesson]) -> _Process:
    """The Gaussian process of the lessons in one aspect.

    A lesson in which the aspect is unknown is independent of the others.
    """
    measured = [aspect.measure(it.traits) for it in lessons]
    known = [it for it in measured if it is not None]
    rows = np.array(known, np.float64).reshape(len(known), -1 if known else 0)
    told = np.array([it is not None for it in measured], bool)
    residuals = np.array([1.0 if it.holds else -1.0 for it in lessons]) - _MEAN
    system = aspect.kernel(rows, rows) + _NOISE * np.eye(len(rows))
    inverse = np.asarray(np.linalg.inv(system), np.float64)
    pull = inverse @ residuals[told]
    alone = residuals[~told] ** 2 / (1 + _NOISE) + math.log(1 + _NOISE)
    misfit = residuals[told] @ pull + np.linalg.slogdet(system)[1] + alone.sum()
    return _Process(aspect, rows, inverse, pull, -0.5 * float(misfit))


def _in_common(aspect: Aspect, some: Numbers | None, other: Numbers | None) -> float:
    """How similar two things are in an aspect: 1 for a thing and itself."""
    if some is None or other is None:
        return 0.0
    both = np.stack([some, other])
    kernel = aspect.kernel(both, both)
    return float(kernel[0, 1] / math.sqrt(kernel[0, 0] * kernel[1, 1]))
