"""Negative examples: lessons that deny a word, in the regression that tells words
apart.

"This is not a cup" is an example against `cup` alone. For this word, and for no other,
the system has a row more, with the target -1:

    (A  B) (a)   (y)
    (Bᵀ C) (b) = (-1)

with A the system of all words, B how like the examples against the word are to the
others, and C how like to each other, with the ridge on its diagonal. With α = A⁻¹ y,
which the word had without them,

    b = (C - Bᵀ A⁻¹ B)⁻¹ (-1 - Bᵀ α),   a = α - A⁻¹ B b

(the Schur complement). So the score of the word is near -1 where it was denied and
falls where things are like that; the scores of all others are what they were.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[np.float64]
Places = NDArray[np.intp]

DENIED = -1.0
"""The target where a word was denied."""


def weights_with_denials(
    alone: Numbers, through: Numbers, border: Numbers, among: Numbers, words: Places
) -> tuple[Numbers, Numbers]:
    """The weights (n, w) of the examples for all words, and those (m, w) of the
    negative examples.

    `alone` (n, w) is α, `border` (n, m) is B, `through` (n, m) is A⁻¹ B, `among` (m, m)
    is C, and `words` (m,) are the columns of the words that were denied.

    >>> one = np.ones((1, 1))
    >>> weights_with_denials(0.5 * one, 0.5 * one, one, 1.5 * one, np.array([0]))
    (array([[1.25]]), array([[-1.5]]))
    """
    weights, against = alone.copy(), np.zeros((len(words), alone.shape[1]))
    for word in np.unique(words):
        rows = np.flatnonzero(words == word)
        left = among[np.ix_(rows, rows)] - border[:, rows].T @ through[:, rows]
        lacking = DENIED - border[:, rows].T @ alone[:, word]
        against[rows, word] = np.linalg.solve(left, lacking)
        weights[:, word] -= through[:, rows] @ against[rows, word]
    return weights, against
