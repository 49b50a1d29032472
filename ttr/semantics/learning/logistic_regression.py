"""Logistic regression: the most probable weights, by Newton's method.

The posterior of weights with a normal prior has one maximum. Newton's steps lead there
from 0, shortened where they would go too far. The order of all sums is fixed, so the
same examples give the same weights to the last digit.
"""

from __future__ import annotations

import math
from typing import NamedTuple

_STEPS = 100
"""The most steps that are made; about ten are enough as a rule."""

_FLAT = 1e-10
"""The gradient for each example below which the maximum is reached."""

_Matrix = list[list[float]]


class Example(NamedTuple):
    """The indices of the weights that count, whether the label is right, how often."""

    inputs: tuple[int, ...]
    right: bool
    times: int


def logistic(z: float) -> float:
    """1 / (1 + e⁻ᶻ), the probability with these log-odds.

    >>> logistic(0.0), logistic(-800.0)
    (0.5, 0.0)
    """
    if z >= 0.0:
        return 1.0 / (1.0 + math.exp(-z))
    rising = math.exp(z)
    return rising / (1.0 + rising)


def fit_weights(
    examples: list[Example], size: int, variance: float
) -> tuple[float, ...]:
    """The weights that maximise Σ log p − Σ w² / (2 · variance).

    >>> once = [Example((0,), True, 3), Example((0,), False, 1)]
    >>> print(round(logistic(fit_weights(once, 1, 1e6)[0]), 4))
    0.75
    """
    weights = [0.0] * size
    loss = _loss(examples, weights, variance)
    enough = _FLAT * (1 + sum(example.times for example in examples))
    for _ in range(_STEPS):
        gradient, hessian = _derivatives(examples, weights, variance)
        if max(map(abs, gradient)) <= enough:
            break
        weights, loss, moved = _take_step(
            examples, weights, variance, loss, _solve(hessian, gradient)
        )
        if not moved:
            break
    return tuple(weights)


def _take_step(
    examples: list[Example],
    weights: list[float],
    variance: float,
    loss: float,
    step: list[float],
) -> tuple[list[float], float, bool]:
    """The weights after the step, halved until the loss falls."""
    length = 1.0
    while length > 1e-9:
        tried = [w - length * s for w, s in zip(weights, step, strict=True)]
        found = _loss(examples, tried, variance)
        if found < loss:
            return tried, found, True
        length /= 2.0
    return weights, loss, False


def _loss(examples: list[Example], weights: list[float], variance: float) -> float:
    """−Σ log p + Σ w² / (2 · variance)."""
    penalty = sum(w * w for w in weights) / (2.0 * variance)
    return penalty + math.fsum(
        n * _softplus(-z if right else z)
        for (_, right, n), z in zip(examples, _log_odds(examples, weights), strict=True)
    )


def _softplus(z: float) -> float:
    """log(1 + eᶻ)."""
    return max(z, 0.0) + math.log1p(math.exp(-abs(z)))


def _log_odds(examples: list[Example], weights: list[float]) -> list[float]:
    return [sum(weights[i] for i in example.inputs) for example in examples]


def _derivatives(
    examples: list[Example], weights: list[float], variance: float
) -> tuple[list[float], _Matrix]:
    """The gradient of the loss, and its Hessian."""
    size = len(weights)
    gradient = [w / variance for w in weights]
    hessian = [[0.0] * size for _ in range(size)]
    for i in range(size):
        hessian[i][i] = 1.0 / variance
    for (inputs, right, n), z in zip(
        examples, _log_odds(examples, weights), strict=True
    ):
        p = logistic(z)
        bent = n * p * (1.0 - p)
        for i in inputs:
            gradient[i] += n * (p - right)
            row = hessian[i]
            for j in inputs:
                row[j] += bent
    return gradient, hessian


def _solve(matrix: _Matrix, values: list[float]) -> list[float]:
    """The x with Ax = values, for a symmetric positive definite A.

    By Cholesky's decomposition A = LLᵀ.
    """
    size = len(values)
    lower: _Matrix = []
    for i in range(size):
        row: list[float] = []
        for j in range(i):
            inner = sum(a * b for a, b in zip(row, lower[j], strict=False))
            row.append((matrix[i][j] - inner) / lower[j][j])
        row.append(math.sqrt(matrix[i][i] - sum(a * a for a in row)))
        lower.append(row)
    half = list[float]()
    for i in range(size):
        known = sum(a * b for a, b in zip(lower[i], half, strict=False))
        half.append((values[i] - known) / lower[i][i])
    found = [0.0] * size
    for i in reversed(range(size)):
        known = sum(lower[k][i] * found[k] for k in range(i + 1, size))
        found[i] = (half[i] - known) / lower[i][i]
    return found
