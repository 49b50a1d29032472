"""Inverses that are kept while rows and columns come and go."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.perception.matrix_inverses import update_inverse


@given(st.integers(0, 1000), st.integers(0, 12), st.integers(0, 5), st.integers(0, 5))
def test_it_is_the_inverse_whatever_came_and_went(
    seed: int, stayed: int, came: int, went: int
) -> None:
    chance = np.random.default_rng(seed)
    size = stayed + came + went
    everything = chance.random((size, size)) + size * np.eye(size)
    names = chance.permutation(size)
    then, now = names[: stayed + went], chance.permutation(names[went:])
    where = {name: place for place, name in enumerate(then)}
    before = np.array([where.get(name, -1) for name in now], np.intp)
    matrix = everything[np.ix_(now, now)]
    old = np.linalg.inv(everything[np.ix_(then, then)])
    assert update_inverse(old, matrix, before) == pytest.approx(np.linalg.inv(matrix))
