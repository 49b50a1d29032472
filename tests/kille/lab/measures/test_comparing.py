"""Theories are compared by pairs of dialogues, with tests that keep their promise."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from kille.lab.dialogues import Answer, Played
from kille.lab.measures.comparison import (
    contrasts,
    differences,
    exchanges,
    holm,
    in_pairs,
    least_p,
    mcnemar,
    mcnemar_of,
    pairs_needed,
    permutation_p,
)
from kille.lab.measures.measures import ACCURACY, LESSONS, tallies
from kille.lab.measures.scored_dialogues import ScoredDialogue, score_dialogue
from kille.lab.study import Run

MAIZE = (49, -67, 8, 16, 6, 23, 28, 41, 14, 29, 56, 24, 75, 60, -48)
"""Darwin's: how much higher crossed plants grew than self-fertilised ones, 1/8 inch."""


def kept(lessons: Sequence[float], theory: str) -> list[ScoredDialogue]:
    """Dialogues in which so many lessons were kept."""
    return [
        ScoredDialogue(Run(theory, "Ann", "table", seed), (), (), int(it), 0.1)
        for seed, it in enumerate(lessons)
    ]


def talks(rights: Sequence[Sequence[bool]], theory: str) -> list[ScoredDialogue]:
    """Dialogues in which the answers were right or wrong."""
    found = []
    for seed, them in enumerate(rights):
        answers = tuple(
            Answer(turn, "test", "noun", "cup", "cup" if it else "car", "assert")
            for turn, it in enumerate(them)
        )
        run = Run(theory, "Ann", "table", seed)
        found.append(score_dialogue(run, Played((), answers), 0.1))
    return found


def p_of(apart: Sequence[float]) -> float:
    """The p of differences, by the measure that takes their mean."""
    first = tallies(LESSONS, kept([0] * len(apart), "a"))
    second = tallies(LESSONS, kept(apart, "b"))
    stays = exchanges(len(apart), np.random.default_rng(1))
    return permutation_p(LESSONS, first, second, stays)


def test_fisher_found_the_same_of_darwins_maize() -> None:
    """The design of experiments, section 21: 863 of 32,768 ways on either side."""
    assert p_of(MAIZE) == 1726 / 2**15


@given(st.lists(st.integers(-9, 9), min_size=2, max_size=9))
def test_the_permutation_test_is_that_of_others(apart: list[int]) -> None:
    def mean(x: np.ndarray, axis: int) -> np.ndarray:
        return x.mean(axis=axis)

    found = stats.permutation_test(
        (np.array(apart, float),), mean, permutation_type="samples", n_resamples=10_000
    )
    assert p_of(apart) == pytest.approx(found.pvalue)


@given(st.lists(st.integers(1, 30), min_size=5, max_size=8))
def test_the_permutation_test_does_not_cry_wolf(sizes: list[int]) -> None:
    """Of all ways in which signs can fall at most 5 % are told of as differences."""
    every = list(product((-1, 1), repeat=len(sizes)))
    ps = [
        p_of([sign * it for sign, it in zip(signs, sizes, strict=True)])
        for signs in every[: len(every) // 2]
    ]
    assert np.mean([p <= 0.05 for p in ps]) <= 0.05


def test_many_pairs_are_exchanged_by_chance() -> None:
    apart = np.random.default_rng(3).normal(0.4, 1, 40).round(1) * 10
    found = stats.permutation_test(
        (apart,),
        lambda x, axis: x.mean(axis=axis),
        permutation_type="samples",
        n_resamples=9_999,
        vectorized=True,
        rng=np.random.default_rng(3),
    )
    assert p_of(list(apart)) == pytest.approx(found.pvalue, abs=0.01)


def test_what_is_compared_the_other_way_round_is_the_other_way_round() -> None:
    rng = np.random.default_rng(5)
    one, other = rng.random((8, 10)) < 0.7, rng.random((8, 10)) < 0.5
    first, second = talks(one.tolist(), "a"), talks(other.tolist(), "b")
    there = differences([ACCURACY], in_pairs(first, second), np.random.default_rng(1))
    back = differences([ACCURACY], in_pairs(second, first), np.random.default_rng(1))
    a, b = there["accuracy"], back["accuracy"]
    assert a.estimate.value == pytest.approx(other.mean() - one.mean())
    assert (a.estimate.value, a.estimate.low) == pytest.approx(
        (-b.estimate.value, -b.estimate.high)
    )
    assert a.p == b.p
    assert a.spread == pytest.approx(
        (other.mean(axis=1) - one.mean(axis=1)).std(ddof=1)
    )


def test_what_is_the_same_in_each_pair_is_left_out() -> None:
    first, second = talks([[True, False]] * 4, "a"), talks([[True, False]] * 4, "b")
    assert (
        differences([ACCURACY], in_pairs(first, second), np.random.default_rng(1)) == {}
    )


def test_pairs_count_in_which_both_were_asked() -> None:
    one = [[True, False]] * 4 + [[True]] * 3
    other = [[True, True]] * 4 + [[]] * 3
    pairs = in_pairs(talks(one, "a"), talks(other, "b"))
    found = differences([ACCURACY], pairs, np.random.default_rng(1))["accuracy"]
    assert (found.pairs, found.estimate.value, found.p) == (4, 0.5, 2 / 2**4)
    assert np.isnan(found.estimate.low)


def test_theories_that_were_never_both_asked_have_no_difference() -> None:
    pairs = in_pairs(talks([[True]] * 3, "a"), talks([[]] * 3, "b"))
    found = differences([ACCURACY], pairs, np.random.default_rng(1))["accuracy"]
    assert found.pairs == 0
    assert np.isnan([found.p, found.spread, found.estimate.value]).all()


def test_pairs_are_of_one_tutor_scene_and_seed() -> None:
    one = [
        ScoredDialogue(Run("a", tutor, "table", 1), (), (), 0, 0.1)
        for tutor in ("Bo", "Ann", "Cy")
    ]
    other = [
        ScoredDialogue(Run("b", tutor, "table", seed), (), (), 0, 0.1)
        for tutor, seed in (("Ann", 1), ("Bo", 1), ("Cy", 2))
    ]
    assert [(a.run.tutor, b.run.tutor) for a, b in in_pairs(one, other)] == [
        ("Ann", "Ann"),
        ("Bo", "Bo"),
    ]


def test_theories_without_a_pair_are_not_compared() -> None:
    theories = {"a": kept([1, 2], "a"), "b": []}
    assert contrasts(theories, [("a", "b")], [LESSONS], np.random.default_rng(1)) == []


# --- question by question ------------------------------------------------------------


@given(st.integers(0, 60), st.integers(0, 60))
def test_mcnemar_is_the_binomial_test(one: int, other: int) -> None:
    told = stats.binomtest(one, one + other).pvalue if one + other else 1.0
    assert mcnemar(one, other) == pytest.approx(told)


def test_mcnemar_can_count_far() -> None:
    assert mcnemar(10_000, 10_000) == 1
    assert 0 < mcnemar(4_800, 5_200) < 0.001


def test_mcnemar_counts_what_just_one_has_right() -> None:
    first = talks([[True, True, False], [False, True]], "a")
    second = talks([[True, False, False], [True, True, True]], "b")
    found = mcnemar_of(in_pairs(first, second))
    assert (found.one, found.other) == (1, 1)


def test_mcnemar_is_of_words_not_of_things() -> None:
    def find(theory: str, thing: str) -> ScoredDialogue:
        answer = Answer(1, "find", "reference", "o1", thing, "point")
        return score_dialogue(
            Run(theory, "Ann", "table", 1), Played((), (answer,)), 0.1
        )

    found = mcnemar_of([(find("a", "o1"), find("b", "o2"))])
    assert (found.one, found.other) == (0, 0)


# --- many tests ----------------------------------------------------------------------


def test_holm_is_that_of_others() -> None:
    """What p.adjust(c(.01, .02, .03, .04, .05), "holm") gives in R."""
    found = holm([0.01, 0.02, 0.03, 0.04, 0.05])
    assert found == pytest.approx([0.05, 0.08, 0.09, 0.09, 0.09])


@given(st.lists(st.floats(0, 1), min_size=1, max_size=12))
def test_holm_keeps_the_order_and_is_never_worse_than_bonferroni(
    ps: list[float],
) -> None:
    found = holm(ps)
    assert all(p <= it <= min(1, p * len(ps)) for p, it in zip(ps, found, strict=True))
    ranked = [found[i] for i in np.argsort(ps, kind="stable")]
    assert ranked == sorted(ranked)


def test_what_is_no_number_is_no_test() -> None:
    nan = float("nan")
    assert holm([nan, 0.02])[1] == 0.02
    assert holm([nan])[0] != holm([nan])[0]


@pytest.mark.parametrize("count", [1, 2, 5, 8, 15, 16])
def test_the_least_p_is_that_of_pairs_that_all_differ_one_way(count: int) -> None:
    first = np.tile([0.0, 1.0], (count, 1))
    second = np.ones((count, 2))
    stays = exchanges(count, np.random.default_rng(1))
    found = permutation_p(ACCURACY, first, second, stays)
    assert found >= least_p(count)
    if count <= 15:
        assert found == least_p(count)


@pytest.mark.parametrize("tests", [1, 3, 10, 100])
def test_with_one_pair_less_than_needed_the_best_of_the_tests_fails(tests: int) -> None:
    needed = pairs_needed(tests, 0.05)
    assert needed is not None
    others = [1.0] * (tests - 1)
    assert min(holm([least_p(needed), *others])) < 0.05
    assert min(holm([least_p(needed - 1), *others])) >= 0.05
    assert pairs_needed(10_000, 0.05) is None
