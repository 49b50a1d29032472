"""Spatial words learned from few examples: which template does each word mean?

All that is known of a word beforehand is that it means one of many graded templates
(see `kille.perception.relations.templates`); its name is never looked at. Each lesson
makes some templates more and others less likely, and the degree of a word is the mean
of what its templates say, in log odds, by how likely they are.

A word that was *said* of x is more likely meant narrowly (Tenenbaum's size principle):

    p(x | word means h) = (h(x) + r z_h) / (mean of h where things stand + r z_h),

with z_h the share of all places that h covers. r lets a lesson be grossly wrong: the
tutor slipped, or the thing was not where it was seen. A word that was *judged* of x, as
in "no, it is not near", says nothing about where things stand: it tells how likely the
template is, and how sharp, how strict and how usual the word is
(see `kille.perception.relations.judgements`).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from kille.perception.learners import Key, own_key
from kille.perception.relations.judgements import Judgements, degrees_at, log_odds
from kille.perception.relations.shown_templates import templates_shown
from kille.perception.relations.template_space import space
from kille.scene import Configuration
from ttr.showing import NotebookValue, Part

Vector = NDArray[np.float64]

_SLIPS = 0.1  # r: about a tenth of the lessons may be wrong
_TRUTH = 0.3  # how much of it is that what is said is true
_DOUBTED = 0.1  # how far that may be wrong
_RECALLED = 100  # lessons of a word among which one is looked for as a reason
_BEFOREHAND = 16.0  # how many places the usual ones count for
_FARTHER = 2.0  # times the farthest that was heard: there is no doubt yet
_DOUBT = 0.35  # of the logarithm of the distance


@dataclass(frozen=True)
class SpatialLesson:
    """A word said of a configuration, or judged to fit it to a degree."""

    x: Configuration
    label: str
    degree: float | None

    @property
    def denies(self) -> bool:
        """Is it a plain "no"?"""
        return self.degree == 0


@dataclass(frozen=True, eq=False)
class SpatialMeaning:
    """What a word means: how likely each template is, (h,), and the mean line from
    the log odds of the templates to those of the word."""

    likely: Vector
    shift: float
    slopes: Vector


@dataclass(frozen=True, eq=False)
class TemplateEvidence:
    """What the lessons of one word say of each template: how well what was said of it
    fits, how much of what was said it covers, (h,), and what was judged."""

    said: Vector
    covered: Vector
    judged: Judgements
    times_said: int = 0

    @property
    def lessons(self) -> int:
        """The number of lessons."""
        return self.times_said + self.judged.count

    def plus(self, lesson: SpatialLesson) -> TemplateEvidence:
        """Add one lesson."""
        degrees = space().degrees([lesson.x])[0].astype(np.float64)
        if lesson.degree is not None:
            return replace(self, judged=self.judged.plus(degrees, lesson.degree, 1))
        return replace(
            self,
            said=self.said + _fit_of_said(degrees),
            covered=self.covered + degrees,
            times_said=self.times_said + 1,
        )

    def meaning(self, elsewhere: Vector, count: int) -> SpatialMeaning:
        """What the word means; `elsewhere` is what templates cover of so many places
        where other words were said."""
        breadth = space().breadth
        usual = (_BEFOREHAND * breadth + elsewhere) / (_BEFOREHAND + count)
        fit = self.said - self.times_said * np.log(usual + _SLIPS * breadth)
        judged = self.judged.fit
        scores = space().log_prior + fit + judged.score
        likely = np.exp(scores - scores.max())
        likely /= likely.sum()
        return SpatialMeaning(
            likely, float(likely @ judged.shift), likely * judged.slope
        )


def template_odds(seen: Sequence[Configuration]) -> Vector:
    """The log odds (n, h) of all templates at some configurations."""
    return log_odds(space().degrees(seen))


def _no_evidence() -> TemplateEvidence:
    none = np.zeros(len(space().breadth))
    return TemplateEvidence(none, none, Judgements.none(len(none)))


def _fit_of_said(degrees: Vector) -> Vector:
    """How well the templates (h,) fit one lesson, apart from where things tend to
    be."""
    true = _DOUBTED + (1 - _DOUBTED) * degrees
    fit: Vector = np.log(degrees + _SLIPS * space().breadth) + _TRUTH * np.log(true)
    return fit


class RelationMemory(NotebookValue):
    """A learner of spatial words from configurations.

    A notebook shows the templates of its words, seen from above.

    >>> from kille.scene import Configuration
    >>> left, right = Configuration((-0.3, 0, 0)), Configuration((0.3, 0, 0))
    >>> memory = RelationMemory()
    >>> for _ in range(3):
    ...     memory.learn_one(left, "left")
    ...     memory.learn_one(right, "right")
    >>> degrees = memory.predict_proba_one(Configuration((0.4, 0.1, 0)))
    >>> max(degrees, key=degrees.get)
    'right'
    """

    def __init__(self) -> None:
        self._heard: dict[Key, SpatialLesson] = {}
        self._evidence: dict[str, TemplateEvidence] = {}
        self._believed: _Beliefs | None = None

    def copy(self) -> RelationMemory:
        """A copy that knows the same; either learns without the other."""
        twin = RelationMemory()
        twin.become(self)
        return twin

    def become(self, other: RelationMemory) -> None:
        """Take over all that the other knows; afterwards either learns by itself."""
        self._heard, self._evidence = dict(other._heard), dict(other._evidence)
        self._believed = other._believed

    @property
    def labels(self) -> tuple[str, ...]:
        """The learned words in alphabetical order."""
        return tuple(sorted(self._evidence))

    @property
    def farthest(self) -> float:
        """The farthest distance in metres of which a word was said; inf if none was."""
        return self._beliefs.farthest if self._evidence else math.inf

    def _shown_as_(self) -> Part:
        return templates_shown(self, self.labels)

    def learn_one(
        self, x: Configuration, label: str, *, key: Key | None = None
    ) -> None:
        """Learn that the word was said of x; ValueError if the key is taken."""
        self._learn(SpatialLesson(x, label, None), key)

    def judge_one(
        self, x: Configuration, label: str, degree: float, *, key: Key | None = None
    ) -> None:
        """Learn that the word fits x to a degree; 0 means "no, it does not".

        ValueError if the key is taken or the degree is not in [0, 1].
        """
        if not 0 <= degree <= 1:
            raise ValueError(f"a degree is in [0, 1], and {degree} is not")
        self._learn(SpatialLesson(x, label, degree), key)

    def _learn(self, lesson: SpatialLesson, key: Key | None) -> None:
        if key in self._heard:
            raise ValueError(f"the key {key!r} was learned before; forget it first")
        old = self._evidence.get(lesson.label) or _no_evidence()
        self._evidence[lesson.label] = old.plus(lesson)
        self._heard[own_key(self._heard) if key is None else key] = lesson
        self._believed = None

    def forget(self, key: Key) -> None:
        """Undo a lesson, as if it had never been given; KeyError if there was none.

        The other lessons are added up again, since subtracting one would leave rounding
        errors.
        """
        label = self._heard.pop(key).label
        evidence = _no_evidence()
        for lesson in self._heard.values():
            evidence = evidence.plus(lesson) if lesson.label == label else evidence
        if evidence.lessons:
            self._evidence[label] = evidence
        else:
            del self._evidence[label]
        self._believed = None

    def degrees(self, x: Configuration) -> dict[str, float]:
        """How well each learned word fits x by itself: several may hold at once."""
        if not self._evidence:
            return {}
        return dict(zip(self.labels, self._degrees(x).tolist(), strict=True))

    def degrees_of(
        self, seen: Sequence[Configuration], odds: Vector | None = None
    ) -> list[dict[str, float]]:
        """The degrees of each word for several configurations at once.

        `odds` (n, h) are what `template_odds` gives for them, for whoever asks again
        after other lessons.
        """
        if not self._evidence or not seen:
            return [{} for _ in seen]
        found = self._believed_at(template_odds(seen) if odds is None else odds)
        found *= np.array([self._confidence(it) for it in seen])[:, None]
        labels = self.labels
        return [dict(zip(labels, row, strict=True)) for row in found.tolist()]

    def nearest(self, x: Configuration, label: str) -> Key | None:
        """The lesson in a word whose configuration was most like x.

        Configurations are compared by the likely templates of the word, among its
        newest lessons; None if the word was only denied. KeyError for an unknown word.
        """
        likely = self._beliefs.meanings[self._column(label)].likely
        own = [
            (key, it.x)
            for key, it in self._heard.items()
            if it.label == label and not it.denies
        ][-_RECALLED:]
        if not own:
            return None
        here, *there = space().degrees([x, *(stand for _, stand in own)])
        unlike = [float(likely @ np.abs(it - here)) for it in there]
        return own[int(np.argmin(unlike))][0]

    def _column(self, label: str) -> int:
        if label not in self._evidence:
            raise KeyError(label)
        return self.labels.index(label)

    def predict_proba_one(self, x: Configuration) -> dict[str, float]:
        """The probability that each word is said of x; the rest is for no word.

        Of the words that fit, those said oftener where they fit are likelier.
        """
        if not self._evidence:
            return {}
        degrees = self._degrees(x)
        chosen = self._beliefs.usual * degrees
        shares = degrees.max() * chosen / max(chosen.sum(), 1e-12)
        return dict(zip(self.labels, shares.tolist(), strict=True))

    def _degrees(self, x: Configuration) -> Vector:
        here: Vector = self._believed_at(template_odds([x]))[0]
        return here * self._confidence(x)

    def _believed_at(self, odds: Vector) -> Vector:
        """The degrees (n, w) of all words from the log odds (n, h) of the templates."""
        found: Vector = degrees_at(odds @ self._beliefs.slopes + self._beliefs.shifts)
        return found

    def _confidence(self, x: Configuration) -> float:
        """1 within the distances taught, falling to 0 far beyond them."""
        far = math.hypot(*x.offset) / (_FARTHER * max(self._beliefs.farthest, 1e-6))
        if not far > 1:
            return 1.0
        return math.exp(-0.5 * (math.log(far) / _DOUBT) ** 2)

    @property
    def _beliefs(self) -> _Beliefs:
        if self._believed is None:
            self._believed = self._work_out_beliefs()
        return self._believed

    def _work_out_beliefs(self) -> _Beliefs:
        every = [self._evidence[word] for word in self.labels]
        covered = np.sum([it.covered for it in every], axis=0)
        counts = np.array([it.times_said for it in every])
        meanings = tuple(
            it.meaning(covered - it.covered, int(counts.sum()) - it.times_said)
            for it in every
        )
        # "No" tells nothing of how far words reach.
        held = [it.x for it in self._heard.values() if not it.denies]
        distances = [math.hypot(*x.offset) for x in held]
        known = [it for it in distances if math.isfinite(it)]
        fitting = np.array([it.likely @ covered for it in meanings])
        usual = (counts + 1) / (fitting + 1)
        return _Beliefs(
            meanings,
            usual,
            max(known, default=math.inf),
            np.stack([it.slopes for it in meanings], axis=1),
            np.array([it.shift for it in meanings]),
        )


@dataclass(frozen=True, eq=False)
class _Beliefs:
    """What each word means; how usual each is where it fits, (w,); the farthest
    distance heard of, in metres; and the lines of all meanings: slopes (h, w) and
    shifts (w,)."""

    meanings: tuple[SpatialMeaning, ...]
    usual: Vector
    farthest: float
    slopes: Vector
    shifts: Vector
