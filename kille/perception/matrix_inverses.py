"""Update the inverse of a matrix in which only some rows and columns are new.

With A the part that stayed, A⁻¹ is computed from the old inverse, and the new inverse
from A⁻¹, both by the Schur complement. This takes about n² operations for each row
added or removed, where a new inverse takes n³. Source: Hager 1989, "Updating the
inverse of a matrix".
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[np.float64]
Places = NDArray[np.intp]


def update_inverse(inverse: Numbers, matrix: Numbers, before: Places) -> Numbers:
    """Invert a matrix (n, n), given the inverse (m, m) of its former state.

    `before` (n,) says where each row and its column were then; -1 is new.

    >>> old = np.diag([2.0, 4.0])
    >>> new = np.diag([4.0, 5.0])
    >>> update_inverse(np.linalg.inv(old), new, np.array([1, -1])).tolist()
    [[0.25, 0.0], [0.0, 0.2]]
    """
    stayed, new = np.flatnonzero(before >= 0), np.flatnonzero(before < 0)
    part = _inverse_of_part(inverse, before[stayed])
    if not len(new):
        return part
    right, below = matrix[np.ix_(stayed, new)], matrix[np.ix_(new, stayed)]
    across, along = part @ right, below @ part
    corner = np.linalg.inv(matrix[np.ix_(new, new)] - below @ across)
    part += across @ (corner @ along)
    whole = np.empty_like(matrix)
    whole[np.ix_(stayed, stayed)] = part
    whole[np.ix_(stayed, new)] = -across @ corner
    whole[np.ix_(new, stayed)] = -corner @ along
    whole[np.ix_(new, new)] = corner
    return whole


def _inverse_of_part(inverse: Numbers, stayed: Places) -> Numbers:
    """The inverse of the part of the matrix that stayed, in the order given."""
    gone = np.setdiff1d(np.arange(len(inverse)), stayed)
    part = inverse[np.ix_(stayed, stayed)]
    if not len(gone):
        return part
    right, below = inverse[np.ix_(stayed, gone)], inverse[np.ix_(gone, stayed)]
    part -= right @ np.linalg.solve(inverse[np.ix_(gone, gone)], below)
    return part
