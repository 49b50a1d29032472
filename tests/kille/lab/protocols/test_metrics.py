"""Measures keep their laws, and rebuild the numbers of the paper."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats
from sklearn.metrics import cohen_kappa_score, roc_auc_score

from kille.lab.measures.statistics import (
    accuracy,
    auroc,
    bootstrap,
    brier,
    confusion,
    kappa,
    kappa_of_margins,
    margin,
    reliability,
    spearman,
    wilson,
)

WORDS = st.sampled_from(["left", "right", "near"])
PAIRS = st.lists(st.tuples(WORDS, WORDS), min_size=1, max_size=40)
SCORES = st.lists(st.integers(0, 6).map(float), min_size=1, max_size=12)


@given(PAIRS)
def test_kappa_is_that_of_others(pairs: list[tuple[str, str]]) -> None:
    one, other = zip(*pairs, strict=True)
    if {*one} == {*other} and len({*one}) == 1:
        assert kappa(one, other) == 1
        return
    assert kappa(one, other) == pytest.approx(cohen_kappa_score(one, other))


@given(PAIRS)
def test_kappa_is_that_of_the_margins(pairs: list[tuple[str, str]]) -> None:
    one, other = zip(*pairs, strict=True)
    labels = sorted({*one, *other})
    table = confusion(one, other, labels) / len(pairs)
    by_chance = float(table.sum(axis=1) @ table.sum(axis=0))
    assert kappa(one, other) == pytest.approx(
        kappa_of_margins(accuracy(one, other), by_chance)
    )


@pytest.mark.parametrize(
    ("agreed", "of", "by_chance", "told"),
    [(17, 32, 180 / 32**2, 0.4313), (15, 64, 782 / 64**2, 0.0537)],
)
def test_the_kappas_of_the_paper_follow_from_their_margins(
    agreed: int, of: int, by_chance: float, told: float
) -> None:
    assert kappa_of_margins(agreed / of, by_chance) == pytest.approx(told, abs=5e-5)


@given(SCORES, SCORES)
def test_auroc_is_that_of_others(these: list[float], others: list[float]) -> None:
    truth = [1] * len(these) + [0] * len(others)
    assert auroc(these, others) == pytest.approx(roc_auc_score(truth, these + others))
    assert auroc(these, others) == pytest.approx(1 - auroc(others, these))


@given(st.lists(st.tuples(st.integers(0, 5), st.integers(0, 5)), min_size=2))
def test_spearman_is_that_of_others(pairs: list[tuple[int, int]]) -> None:
    one, other = zip(*pairs, strict=True)
    if len({*one}) == 1 or len({*other}) == 1:
        assert math.isnan(spearman(one, other))
        return
    ranks = stats.rankdata(one), stats.rankdata(other)
    assert spearman(one, other) == pytest.approx(np.corrcoef(*ranks)[0, 1])


@given(st.integers(1, 60), st.data())
def test_a_band_is_around_its_share(count: int, data: st.DataObject) -> None:
    right = data.draw(st.integers(0, count))
    low, high = wilson(right, count)
    assert 0 <= low <= right / count <= high <= 1
    z = stats.norm.ppf(0.975)
    for end in (low, high):  # where the share is just z standard errors away
        spread = z * math.sqrt(end * (1 - end) / count)
        assert abs(right / count - end) == pytest.approx(spread, abs=1e-9)


def test_without_trials_a_share_may_be_anything() -> None:
    assert wilson(0, 0) == (0, 1)


def test_a_bootstrapped_band_is_of_its_seed() -> None:
    values = np.random.default_rng(7).uniform(0, 1, 30)
    bands = {bootstrap(values, np.random.default_rng(seed)) for seed in (1, 1, 2)}
    assert len(bands) == 2
    assert all(low < values.mean() < high for low, high in bands)


def test_of_nothing_there_is_no_number() -> None:
    found = [accuracy([], []), kappa([], []), auroc([], [1.0]), brier([], [])]
    found += [spearman([], []), spearman([1.0], [2.0])]
    found += bootstrap([], np.random.default_rng(7))
    assert all(math.isnan(it) for it in found)
    assert reliability([], []) == []


@given(st.dictionaries(WORDS, st.floats(0, 1), min_size=1))
def test_a_word_wins_just_if_its_margin_is_above_0(degrees: dict[str, float]) -> None:
    winners = [word for word in degrees if margin(degrees, word) > 0]
    best = max(degrees.values())
    at_best = [word for word in degrees if degrees[word] == best]
    assert winners == (at_best if len(at_best) == 1 and best > 0 else [])


def test_doubt_costs_less_than_a_wrong_word() -> None:
    doubt, wrong = brier(["cup"], [{"cup": 0.1}]), brier(["cup"], [{"car": 1.0}])
    assert 0 < doubt < wrong


def test_reliable_degrees_are_shares() -> None:
    chance = np.random.default_rng(7)
    degrees = chance.uniform(0, 1, 20_000)
    right = chance.uniform(0, 1, 20_000) < degrees
    for said, share, count in reliability(degrees, right):
        assert share == pytest.approx(said, abs=0.05)
        assert count > 1_000
