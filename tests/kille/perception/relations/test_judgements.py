"""Judgements as a regression on every template."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.perception.relations import RelationMemory
from kille.perception.relations.judgements import Judgements, degrees_at, log_odds
from kille.scene import Configuration


def judged(degrees: list[float], said: list[float]) -> Judgements:
    """Of two templates: one with these degrees, and one that fits everywhere."""
    sums = Judgements.none(2)
    for h, degree in zip(degrees, said, strict=True):
        sums = sums.plus(np.array([h, 1.0]), degree, 1)
    return sums


@given(st.floats(0, 1))
def test_log_odds_lead_back_to_degrees(degree: float) -> None:
    assert float(degrees_at(log_odds(degree))) == pytest.approx(degree, abs=1e-9)


def test_nothing_judged_tells_templates_not_apart() -> None:
    fit = Judgements.none(3).fit
    assert np.ptp(fit.score) == 0
    assert fit.shift == pytest.approx(np.zeros(3))
    assert fit.slope == pytest.approx(np.ones(3))


def test_a_template_that_goes_with_what_was_judged_is_likelier() -> None:
    fit = judged([0.9, 0.1, 0.8, 0.2], [1.0, 0.0, 0.9, 0.1]).fit
    assert fit.score[0] > fit.score[1] + 2


def test_a_rarely_ticked_word_is_told_from_one_that_fits_nowhere() -> None:
    """Where it fits best a fifth tick it: its template is found, its line is lower."""
    fit = judged([0.9, 0.05, 0.1, 0.9, 0.05] * 3, [0.2, 0.0, 0.0, 0.3, 0.0] * 3).fit
    assert fit.score[0] > fit.score[1] + 1
    assert fit.shift[0] < -0.5


def test_judgements_have_no_order_and_are_forgotten() -> None:
    chance = np.random.default_rng(0)
    degrees, said = chance.random(20).tolist(), chance.random(20).tolist()
    once, other = judged(degrees, said), judged(degrees[::-1], said[::-1])
    assert once.fit.score == pytest.approx(other.fit.score)
    more = once.plus(np.array([0.3, 0.6]), 1.0, 1)
    less = more.plus(np.array([0.3, 0.6]), 1.0, -1)
    assert less.fit.score == pytest.approx(once.fit.score)
    assert less.fit.shift == pytest.approx(once.fit.shift)


def test_a_memory_ranks_by_a_word_that_few_tick() -> None:
    memory, chance = RelationMemory(), np.random.default_rng(1)
    for share in chance.random(24).tolist():
        memory.judge_one(held(share), "in", 0.25 * (share > 0.5))
    inside, outside = (memory.degrees(held(share))["in"] for share in (0.95, 0.05))
    assert 0.5 > inside > 1.2 * outside


def held(share: float) -> Configuration:
    return Configuration((0.05, 0, 0), contact=1.0, support=0.5, containment=share)
