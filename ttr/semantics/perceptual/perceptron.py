"""Perceptrons in plain Python, whose parameters are weights and a threshold.

Both change by the same rule, with the error e = wanted − said for a percept x:

    w' = w + rate · e · x        t' = t − threshold_rate · e

A perceptron says 1 or 0; a graded perceptron says a number in between.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass

from ttr.errors import TTRError
from ttr.semantics.argument_checks import in_notation, in_one_line
from ttr.semantics.learning.logistic_regression import logistic
from ttr.semantics.perceptual.vectors import Vector, dot, finite_number, vector
from ttr.types.objects import Object, Record, record

_LONGEST = 1_000_000
"""The most numbers that a percept may have."""


def blank(dimensions: int) -> Record:
    """The parameters before any learning: weights and threshold 0.

    >>> print(blank(2))
    {t = 0.0, w = [0.0, 0.0]}
    """
    if type(dimensions) is not int or not 1 <= dimensions <= _LONGEST:
        raise TTRError(
            f"a percept has 1 number or more, found {in_one_line(dimensions)}",
            hint=f"it may have {_LONGEST} at most",
        )
    return record(w=[0.0] * dimensions, t=0.0)


@dataclass(frozen=True)
class _Linear(ABC):
    """What the perceptrons share: only what they make of w · x − t is their own."""

    rate: float = 1.0
    threshold_rate: float | None = None

    def __post_init__(self) -> None:
        _check_rates(self.rate, self.threshold_rate)

    @abstractmethod
    def _activation(self, z: float) -> float:
        """The degree where w · x − t is z."""

    def score(self, params: Record, x: Object, /) -> float:
        """w · x, which is compared with the threshold."""
        w, _, x = _weights_and_percept(params, x)
        return dot(w, x)

    def degree(self, params: Record, x: Object, /) -> float:
        """The degree to which the percept is of the class, from 0 to 1."""
        w, t, x = _weights_and_percept(params, x)
        return self._activation(dot(w, x) - t)

    def confirmed(self, params: Record, x: Object, /) -> Record:
        """The parameters after a step towards yes; the same if none is needed."""
        return self._step(params, x, 1.0)

    def rejected(self, params: Record, x: Object, /) -> Record:
        """The parameters after a step towards no; the same if none is needed."""
        return self._step(params, x, 0.0)

    def _step(self, params: Record, x: Object, wanted: float) -> Record:
        w, t, x = _weights_and_percept(params, x)
        error = wanted - self._activation(dot(w, x) - t)
        return _take_step(params, x, error, self.rate, self.threshold_rate)


@dataclass(frozen=True)
class Perceptron(_Linear):
    """Yes where w · x > t, else no; it learns only from its mistakes.

    A correction is one step of Rosenblatt's rule. Where it says no and should say yes,
    `rate` times the percept is added to the weights and the threshold falls by
    `threshold_rate`; the other way round where it says yes and should say no. The
    threshold is learned at the same rate unless `threshold_rate` is given, as if it
    were the weight of a constant −1; at the rate 0 it stays. Source: Larsson 2013; see
    docs/decisions/017-corrections.md.

    >>> right = record(w=[0.8, 0.01], t=0.09)
    >>> Perceptron().degree(right, (0.9, 0.1)), Perceptron().degree(right, (0.1, 0.5))
    (1.0, 0.0)
    >>> print(Perceptron(rate=0.5).confirmed(right, (0.1, 0.5)))
    {t = -0.41000000000000003, w = [0.8500000000000001, 0.26]}
    """

    def __str__(self) -> str:
        return f"a perceptron{_rates_in_words(self.rate, self.threshold_rate)}"

    def _activation(self, z: float) -> float:
        return float(z > 0.0)


@dataclass(frozen=True)
class GradedPerceptron(_Linear):
    """The degree 1 / (1 + exp(−steepness · (w · x − t))), by the logistic function.

    It learns from every lesson, in proportion to its error (the delta rule, which for
    this function is a step of logistic regression).

    >>> right = record(w=[0.8, 0.01], t=0.09)
    >>> round(GradedPerceptron(steepness=5).degree(right, (0.9, 0.1)), 3)
    0.959
    """

    steepness: float = 10.0

    def __post_init__(self) -> None:
        super().__post_init__()
        if not finite_number(self.steepness, "the steepness of a perceptron") > 0.0:
            raise TTRError(
                f"the steepness of a perceptron is above 0, found {self.steepness!r}"
            )

    def __str__(self) -> str:
        rates = _rates_in_words(self.rate, self.threshold_rate)
        return f"a graded perceptron{rates}, steepness {self.steepness:g}"

    def _activation(self, z: float) -> float:
        return logistic(self.steepness * z)


def _weights_and_percept(params: Record, x: Object) -> tuple[Vector, float, Vector]:
    """Weights, threshold and percept; `TTRError` where they do not fit together."""
    try:
        w, t = vector(params.w, "w"), finite_number(params.t, "t")
    except AttributeError:
        raise TTRError(
            f"the parameters of a perceptron are {{t = …, w = […]}}, "
            f"found {in_notation(params)}"
        ) from None
    x = vector(x)
    if len(x) != len(w):
        raise TTRError(
            f"there are {len(w)} weights, but the percept has {len(x)} numbers"
        )
    return w, t, x


def _take_step(
    params: Record, x: Vector, error: float, rate: float, threshold_rate: float | None
) -> Record:
    """The parameters after one step of the rule; the same where the error is 0.

    Fields other than the weights and the threshold stay as they are.
    """
    if error == 0.0:
        return params
    step = rate * error
    lower = step if threshold_rate is None else threshold_rate * error
    w = tuple([wi + step * xi for wi, xi in zip(params.w, x, strict=True)])
    t = params.t - lower
    if not all(map(math.isfinite, (*w, t))):
        raise TTRError(f"a step at rate {rate:g} makes the weights infinite")
    return Record({**params._fields, "w": w, "t": t})


def _rates_in_words(rate: float, threshold_rate: float | None) -> str:
    """The rates for printing; nothing where both are 1."""
    if threshold_rate is not None:
        return f" at the rates {rate:g} and {threshold_rate:g}"
    return "" if rate == 1.0 else f" at the rate {rate:g}"


def _check_rates(rate: float, threshold_rate: float | None) -> None:
    if not finite_number(rate, "the rate of a perceptron") > 0.0:
        raise TTRError(f"a perceptron learns at a rate above 0, found {rate!r}")
    if threshold_rate is None:
        return
    if not finite_number(threshold_rate, "the rate of the threshold") >= 0.0:
        raise TTRError(
            f"the threshold is learned at a rate of 0 or more, found {threshold_rate!r}"
        )
