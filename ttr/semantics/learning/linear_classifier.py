"""A linear classifier over types, whose log-odds are sums of weights.

For each label, log p/(1 − p) = b + Σ wᵢ over the features that a situation's type is
below. The weights are fitted together, so features that occur together share a weight
instead of counting twice. Larsson and Bernardy 2021 use a linear model where
frequencies and naive Bayes go wrong.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

from ttr.errors import TTRError, suggestion
from ttr.semantics.learning.counts import NO_THEORY
from ttr.semantics.learning.evidence import NO_EVIDENCE, Evidence
from ttr.semantics.learning.evidence_classifier import EvidenceBased
from ttr.semantics.learning.features import Features, features_below
from ttr.semantics.learning.logistic_regression import Example, fit_weights, logistic
from ttr.signature.signature import Signature
from ttr.types.syntax import TypeNode

_WIDEST = 1e6
"""The largest variance: a flatter prior may not make weights unique in floats."""


@dataclass(frozen=True, repr=False)
class LogOdds(EvidenceBased):
    """Log-odds of each label against all others, linear in the features.

    The weights are the most probable ones given the evidence. Their prior is normal
    with mean 0 and this variance, which smooths them and makes them unique. They depend
    on nothing but the evidence, so that its order does not matter and taking it back
    leaves no trace.

    >>> from ttr import Basic
    >>> Red, Round = Basic("Red"), Basic("Round")
    >>> fruit = LogOdds((Red, Round)).learned(Red & Round, "apple", key=1)
    >>> fruit = fruit.learned(Round, "pear", key=2)
    >>> print({label: round(p, 3) for label, p in fruit.probabilities(Red).items()})
    {'apple': 0.591, 'pear': 0.409}
    """

    features: tuple[TypeNode, ...]
    variance: float = 1.0
    theory: Signature = NO_THEORY
    evidence: Evidence = NO_EVIDENCE

    def __post_init__(self) -> None:
        super().__post_init__()
        is_number = isinstance(self.variance, int | float)
        if not is_number or not 0.0 < self.variance <= _WIDEST:
            raise TTRError(
                "the variance of weights is a number above 0 and at most "
                f"{_WIDEST:.0f}, found {self.variance!r}"
            )

    @property
    def weights(self) -> dict[str, tuple[float, ...]]:
        """For each label: the constant weight b, then those of the features."""
        return dict(self._weights)

    @cached_property
    def _weights(self) -> dict[str, tuple[float, ...]]:
        rows = self.evidence.rows()
        return {
            label: fit_weights(
                [Example(_inputs(f), one == label, n) for f, one, n in rows],
                len(self.features) + 1,
                self.variance,
            )
            for label in self.evidence.labels
        }

    def log_odds(self, x: TypeNode, label: str) -> float:
        """log p/(1 − p) = b + Σ wᵢ, where p is that of the label against all others.

        Raises `TTRError` for a label that was never learned.
        """
        if not isinstance(label, str) or label not in self._weights:
            known = self.evidence.labels
            raise TTRError(
                f"the label {label!r} was never learned",
                hint=suggestion(str(label), known),
            )
        weights = self._weights[label]
        return math.fsum(weights[i] for i in _inputs(self._features(x)))

    def probabilities(self, x: TypeNode) -> dict[str, float]:
        """The probability of each label for what is of x.

        Each is that against all others; if they sum to more than 1, they are scaled.
        """
        inputs = _inputs(self._features(x))
        found = {
            label: logistic(math.fsum(weights[i] for i in inputs))
            for label, weights in self._weights.items()
        }
        whole = max(1.0, math.fsum(found.values()))
        return {label: p / whole for label, p in found.items()}

    def _features(self, x: TypeNode) -> Features:
        return features_below(x, self.features, self.theory)


def _inputs(features: Features) -> tuple[int, ...]:
    """The indices of the weights that count: 0, and those of the features that hold."""
    return (0, *(i for i, holds in enumerate(features, 1) if holds))
