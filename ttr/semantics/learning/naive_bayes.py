"""Naive Bayes: p(C | E₁, …, Eₙ) ∝ p(C) · p(E₁|C) · … · p(Eₙ|C).

The evidence is taken as independent given the class, so evidence that depends on other
evidence is counted twice. `LogOdds` does not do that.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeVar

from ttr.errors import IllFormedError
from ttr.probability import UNKNOWN, Degree
from ttr.safety.budgets import within_budget
from ttr.semantics.learning.counts import NO_THEORY, Counts
from ttr.semantics.learning.evidence import NO_EVIDENCE, Evidence
from ttr.semantics.learning.evidence_classifier import EvidenceBased
from ttr.semantics.learning.features import (
    Features,
    features_below,
    types_of,
)
from ttr.semantics.learning.smoothing import NO_SMOOTHING, Smoothing, as_smoothing
from ttr.signature.signature import Signature
from ttr.types.syntax import TypeNode, kind_of


@within_budget
def posterior(
    judgements: Counts,
    classes: Sequence[TypeNode],
    evidence: Sequence[TypeNode] = (),
    *,
    smoothing: Smoothing = NO_SMOOTHING,
) -> dict[TypeNode, Degree]:
    """The probability of each class, for something that is of all the evidence types.

    Priors and likelihoods are frequencies of the judgements; likelihoods are smoothed.
    Each class has [0, 1] where the evidence is impossible in all of them. Raises
    `IllFormedError` where no class is given. Source: Cooper, Dobnik, Lappin and Larsson
    2015.

    >>> from ttr import Basic
    >>> from ttr.judging import proposition
    >>> Apple, Pear, Red = Basic("Apple"), Basic("Pear"), Basic("Red")
    >>> J = Counts().learned(
    ...     proposition("a", Apple & Red), proposition("b", Apple & Red),
    ...     proposition("c", Pear & Red), proposition("d", Pear))
    >>> print(posterior(J, [Apple, Pear], [Red])[Apple])
    0.6667
    """
    if not isinstance(judgements, Counts):
        raise IllFormedError(f"the judgements are Counts, found {kind_of(judgements)}")
    found = dict.fromkeys(types_of(evidence, "evidence"))
    scores = {
        C: _score(
            judgements.p(C),
            [judgements.p(E, given=C, smoothing=smoothing) for E in found],
        )
        for C in types_of(classes, "classes")
    }
    if not scores:
        raise IllFormedError("naive Bayes needs at least one class, found none")
    return _normalise(scores)


_Score = tuple[float, float]
"""The logarithms of the least and the greatest product of some degrees."""


def _score(prior: Degree, likelihoods: Iterable[Degree]) -> _Score:
    degrees = [prior, *likelihoods]
    return sum(_log(p.lo) for p in degrees), sum(_log(p.hi) for p in degrees)


def _log(p: float) -> float:
    return math.log(p) if p > 0.0 else -math.inf


C = TypeVar("C")


def _normalise(scores: Mapping[C, _Score]) -> dict[C, Degree]:
    """Each score as a share of all: the least and the greatest."""
    top = max(hi for _, hi in scores.values())
    if top == -math.inf:
        return dict.fromkeys(scores, UNKNOWN)
    scaled = {
        one: (math.exp(lo - top), math.exp(hi - top))
        for one, (lo, hi) in scores.items()
    }
    return {one: _share(one, scaled) for one in scaled}


def _share(one: C, scaled: Mapping[C, _Score]) -> Degree:
    """A score as a share of all.

    Unlike in `degrees.share`, a score of 0 may be possible: it may have been rounded.
    """
    lo, hi = scaled[one]
    others = [score for other, score in scaled.items() if other != one]
    least = lo / (lo + sum(score[1] for score in others)) if lo else 0.0
    most = hi / (hi + sum(score[0] for score in others)) if hi else 0.0
    return Degree(least, max(least, most))


@dataclass(frozen=True, repr=False)
class NaiveBayes(EvidenceBased):
    """A naive Bayes classifier over types: labels by features.

    The features that a situation's type is below are evidence; others count for
    nothing. Equal where the same was learned under the same keys.

    >>> from ttr import Basic
    >>> Red, Round = Basic("Red"), Basic("Round")
    >>> fruit = NaiveBayes((Red, Round)).learned(Red & Round, "apple", key=1)
    >>> fruit = fruit.learned(Round, "pear", key=2)
    >>> fruit.probabilities(Round)
    {'apple': 0.5, 'pear': 0.5}
    """

    features: tuple[TypeNode, ...]
    smoothing: Smoothing = NO_SMOOTHING
    theory: Signature = NO_THEORY
    evidence: Evidence = NO_EVIDENCE

    def __post_init__(self) -> None:
        super().__post_init__()
        as_smoothing(self.smoothing)

    def probabilities(self, x: TypeNode) -> dict[str, float]:
        """The probability of each label for what is of x.

        All are 0 where no label is possible: without smoothing, features that never
        occurred with any of them.
        """
        found = features_below(x, self.features, self.theory)
        total = sum(self.evidence.times.values())
        scores = {
            label: self._score(label, found, total) for label in self.evidence.labels
        }
        shares = _normalise(scores) if scores else {}
        return {label: 0.0 if p == UNKNOWN else p.lo for label, p in shares.items()}

    def _score(self, label: str, found: Features, total: int) -> _Score:
        """log p(label) + Σ log p(feature | label), over the features that hold."""
        mine = [(f, n) for f, one, n in self.evidence.rows() if one == label]
        whole, extra = sum(n for _, n in mine), self.smoothing.pseudocount
        score = math.log(whole / total)
        for i in (i for i, holds in enumerate(found) if holds):
            times = sum(n for features, n in mine if features[i])
            score += _log(float((times + extra) / (whole + 2 * extra)))
        return score, score
