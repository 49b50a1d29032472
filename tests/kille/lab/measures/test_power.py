"""How many dialogues it takes is what it takes when it is tried."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from kille.lab.measures.power import least_difference, power_of, runs_needed

SPREADS = st.floats(0.01, 2)
DIFFERENCES = st.floats(0.01, 1)


@given(SPREADS, DIFFERENCES)
def test_so_many_pairs_show_the_difference(spread: float, d: float) -> None:
    runs = runs_needed(spread, d)
    assert runs is not None
    if runs < 6:
        return
    assert least_difference(spread, runs) <= d * (1 + 1e-9)
    assert not least_difference(spread, runs - 1) < d * (1 - 1e-9)


@pytest.mark.parametrize(("spread", "d"), [(0.2, 0.1), (0.2, 0.05), (1.0, 0.2)])
def test_the_approximation_is_that_of_the_t_test(spread: float, d: float) -> None:
    runs = runs_needed(spread, d)
    assert runs is not None
    beyond = d / spread * math.sqrt(runs)
    border = stats.t.ppf(0.975, runs - 1)
    seen = stats.nct.sf(border, runs - 1, beyond) + stats.nct.cdf(
        -border, runs - 1, beyond
    )
    assert seen == pytest.approx(0.8, abs=0.02)


def test_the_approximation_is_right_when_it_is_tried() -> None:
    apart = np.random.default_rng(2).normal(0, 0.2, 60)
    runs = runs_needed(float(apart.std(ddof=1)), 0.1)
    assert runs is not None
    found = power_of(apart, 0.1, runs, np.random.default_rng(1), rounds=1000)
    assert found == pytest.approx(0.8, abs=0.05)


def test_without_a_difference_one_is_seldom_told_of() -> None:
    apart = np.random.default_rng(2).normal(0, 0.2, 60)
    found = power_of(apart, 0.0, 30, np.random.default_rng(1), rounds=1000)
    assert found == pytest.approx(0.05, abs=0.025)


@pytest.mark.parametrize(
    ("spread", "d"), [(math.nan, 0.1), (0.2, 0.0), (0.2, math.nan)]
)
def test_what_is_not_known_is_not_told(spread: float, d: float) -> None:
    assert runs_needed(spread, d) is None


def test_too_few_pairs_show_nothing() -> None:
    assert math.isnan(least_difference(0.2, 1))
    assert math.isnan(power_of([0.1], 0.1, 5, np.random.default_rng(1)))
