"""Borders that are fitted to what known borders give are these borders again."""

from __future__ import annotations

import numpy as np
import pytest

from kille.perception.colours.borders import Borders, along
from tools.fitting.edges import agreement, choice, minimise

LAB = np.random.default_rng(3).uniform((5, -60, -60), (95, 60, 60), (250, 3))
HUES = np.array([30.0, 250.0])
TRUE = np.array(
    [
        [[20, 5, 70, 4], [10, 4, 60, 6], [-30, 5, 25, 3]],
        [[35, 3, 85, 6], [-5, 5, 50, 4], [-20, 4, 30, 5]],
    ],
    float,
)
START = np.tile([10.0, 8.0, 60.0, 8.0], (2, 3, 1)) - [[[0, 0, 0, 0]], [[10, 0, 0, 0]]]


def log_degrees(edges: np.ndarray) -> np.ndarray:
    return Borders(HUES, edges).log_degrees(LAB)


def test_truth_is_fitted() -> None:
    places = along(LAB, HUES)
    shares = np.exp(log_degrees(TRUE))
    edges, _ = minimise(places, START, np.zeros(2), agreement(shares))
    assert np.abs(np.exp(log_degrees(edges)) - shares).mean() < 0.02


def test_choice_is_fitted_with_the_weights() -> None:
    weighed = log_degrees(TRUE) + np.log([0.8, 0.2])
    shares = np.exp(weighed) / np.exp(weighed).sum(axis=1, keepdims=True)
    edges, weights = minimise(along(LAB, HUES), START, np.zeros(2), choice(shares))
    found = log_degrees(edges) + weights
    found = np.exp(found) / np.exp(found).sum(axis=1, keepdims=True)
    assert np.abs(found - shares).mean() < 0.02


@pytest.mark.parametrize("kind", [agreement, choice])
def test_slopes_are_those_of_the_loss(kind: type) -> None:
    shares = np.array([[0.2, 0.8], [0.6, 0.4], [1.0, 0.0]])
    loss = kind(shares)
    degrees, weights = np.log([[0.3, 0.5], [0.9, 0.2], [0.7, 0.1]]), np.array([0.1, -1])
    _, slope, of_weights = loss(degrees, weights)
    step = 1e-6
    for at in np.ndindex(degrees.shape):
        more = degrees.copy()
        more[at] += step
        rise = (loss(more, weights)[0] - loss(degrees, weights)[0]) / step
        assert slope[at] == pytest.approx(rise, abs=1e-4)
    for word in range(2):
        more = weights.astype(float)
        more[word] += step
        rise = (loss(degrees, more)[0] - loss(degrees, weights)[0]) / step
        assert of_weights[word] == pytest.approx(rise, abs=1e-4)
