"""Fits vague borders to what they should give, by their gradient.

A loss takes the logarithms (n, w) of the words' degrees and of the words' weights, and
gives its value with its gradients in both.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Numbers: TypeAlias = NDArray[np.float64]
Loss: TypeAlias = Callable[[Numbers, Numbers], tuple[float, Numbers, Numbers]]

_VAGUE = (np.log(1.35), np.log(33))  # Lab units: no border is sharper or vaguer
_HOLD = 1e-4  # keeps borders that no colour speaks about where they started
_ROUNDS = 400
_EXACT = {"gtol": 1e-7, "ftol": 1e-10}
_NEARLY_SURE = -1e-9  # of a degree the logarithm: that of 1 - 1 is not to be taken
_UNIT = 10.0  # Lab units: so edges and the logarithms of vagueness are of one size


def agreement(shares: Numbers) -> Loss:
    """The cross-entropy of degrees that should be these (n, w); weights are idle."""

    def loss(degrees: Numbers, weights: Numbers) -> tuple[float, Numbers, Numbers]:
        true = np.minimum(degrees, _NEARLY_SURE)
        rest = -np.expm1(true)
        value = -(shares * true + (1 - shares) * np.log(rest)).sum()
        slope = (1 - shares) * np.exp(true) / rest - shares
        return value / len(shares), slope / len(shares), np.zeros_like(weights)

    return loss


def choice(shares: Numbers) -> Loss:
    """The cross-entropy of choosing words with these shares (n, w), which sum to 1."""

    def loss(degrees: Numbers, weights: Numbers) -> tuple[float, Numbers, Numbers]:
        likely = degrees + weights
        likely = likely - likely.max(axis=1, keepdims=True)
        likely -= np.log(np.exp(likely).sum(axis=1, keepdims=True))
        slope = (np.exp(likely) - shares) / len(shares)
        return -(shares * likely).sum() / len(shares), slope, slope.sum(axis=0)

    return loss


def minimise(
    places: Numbers, start: Numbers, weights: Numbers, loss: Loss
) -> tuple[Numbers, Numbers]:
    """The edges (w, 3, 4) and weights (w,) at which the loss is least.

    places (n, w, 3) are those of the colours on the words' axes, and `start` the edges
    to begin with.
    """
    from scipy.optimize import minimize

    first = start / _UNIT
    first[..., 1::2] = np.log(start[..., 1::2])
    count, shape = len(weights), first.shape

    def function(numbers: Numbers) -> tuple[float, Numbers]:
        weighed, moved = numbers[:count], numbers[count:].reshape(shape)
        value, of_weights, of_edges = _loss_of(places, moved, weighed, loss)
        away = moved - first
        value += _HOLD * float((away**2).sum()) / count
        of_edges += 2 * _HOLD * away / count
        return value, np.concatenate([of_weights, of_edges.ravel()])

    found = minimize(
        function,
        np.concatenate([weights, first.ravel()]),
        jac=True,
        method="L-BFGS-B",
        bounds=[(None, None)] * count + [(None, None), _VAGUE] * (first.size // 2),
        options={"maxiter": _ROUNDS, "maxfun": 2 * _ROUNDS, **_EXACT},
    ).x
    edges = found[count:].reshape(shape).copy()
    edges[..., 0::2] *= _UNIT
    edges[..., 1::2] = np.exp(edges[..., 1::2])
    return edges, found[:count]


def _loss_of(
    places: Numbers, moved: Numbers, weights: Numbers, loss: Loss
) -> tuple[float, Numbers, Numbers]:
    """The loss, and its gradients in the weights (w,) and in the numbers (w, 3, 4).

    These are edges in units of `_UNIT` and the logarithms of how vague they are; of a
    degree σ(above) σ(below) the logarithm is summed over the axes.
    """
    above = (places - _UNIT * moved[..., 0]) * np.exp(-moved[..., 1])
    below = (_UNIT * moved[..., 2] - places) * np.exp(-moved[..., 3])
    degrees = -(np.logaddexp(0, -above) + np.logaddexp(0, -below)).sum(axis=2)
    value, slope, of_weights = loss(degrees, weights)
    rising = slope[..., None] * _beyond(above)
    falling = slope[..., None] * _beyond(below)
    of_edges = [
        -_UNIT * rising.sum(axis=0) * np.exp(-moved[..., 1]),
        -(rising * above).sum(axis=0),
        _UNIT * falling.sum(axis=0) * np.exp(-moved[..., 3]),
        -(falling * below).sum(axis=0),
    ]
    return value, of_weights, np.stack(of_edges, axis=-1)


def _beyond(steps: Numbers) -> Numbers:
    """σ(-steps): how much of a border's degree is still missing."""
    return np.asarray(np.exp(-np.logaddexp(0, steps)))
