"""Calibration: lessons that are left out are judged as if they had never been given."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.perception.calibration import (
    STRANGE,
    Calibration,
    LeftOut,
    calibrate,
    leave_out,
)
from kille.perception.descriptor_index import View
from kille.perception.evidence import Weighing, weighing
from kille.perception.likeness import Examples, Kernel
from kille.perception.objects import ObjectMemory

NONE = np.zeros((0, 128), np.uint8)
KERNELS = {"colour": Kernel(1.0, 1.0), "size": Kernel(1.0, 1.0)}


def views(seed: int, lessons: int, *words: str, apart: float = 2.0) -> list[View]:
    """Lessons of words whose things are `apart`, each a little different."""
    chance = np.random.default_rng(seed)
    middles = {word: chance.normal(0, apart, 3) for word in words}
    return [
        View(
            f"{word} {number}",
            word,
            NONE,
            {
                "colour": (middles[word] + chance.normal(0, 0.4, 3)).astype(np.float32),
                "size": np.float32([middles[word][0] + chance.normal(0, 0.4)]),
            },
        )
        for number in range(lessons)
        for word in words
    ]


def examples(some: list[View]) -> Examples:
    return Examples(some, sorted({it.label for it in some}), KERNELS)


def right_scores(found: LeftOut) -> np.ndarray:
    """The score of the right word for each lesson that has one."""
    known = np.flatnonzero(found.columns != STRANGE)
    return found.scores[known, found.columns[known]]


def anew(kernel: np.ndarray, signs: np.ndarray, kept: np.ndarray) -> np.ndarray:
    """The scores (n, w) of all by a regression of the kept ones alone."""
    system = kernel[np.ix_(kept, kept)]
    return kernel[:, kept] @ np.linalg.solve(system, signs[kept])


@given(st.integers(0, 1000), st.integers(2, 4), st.integers(2, 7))
def test_what_is_left_out_is_scored_by_the_others_alone(seed, words, lessons):
    chance = np.random.default_rng(seed)
    owners = np.repeat(np.arange(words), lessons)
    count = len(owners)
    points = chance.normal(0, 1, (count, 2))
    likeness = np.exp(-((points[:, None] - points) ** 2).sum(axis=2))
    np.fill_diagonal(likeness, 1.0)
    system = likeness + 0.1 * np.eye(count)
    alike = np.minimum(likeness, 0.5) + 0.5 * np.eye(count)  # no two are one lesson
    unlike = np.abs(points[:, :1] - points[:, 0])
    found = leave_out(alike, np.linalg.inv(system), owners, unlike)
    assert found is not None
    signs = np.where(owners[:, None] == np.arange(words), 1.0, -1.0)
    known = found.columns != STRANGE
    assert known.sum() == (~known).sum() == count
    # Of each word as many are left out at a time: a part of its lessons in turn.
    folds = np.arange(lessons) * min(lessons, 5) // lessons
    expected, near = np.zeros((count, words)), np.zeros((count, words))
    for fold in range(folds.max() + 1):
        out = np.tile(folds == fold, words)
        # The system without them is that of the kernel with its ridge.
        expected[out] = anew(system, signs, np.flatnonzero(~out))[out]
        for word in range(words):
            kept = np.flatnonzero(~out & (owners == word))
            near[out, word] = unlike[np.ix_(out, kept)].min(axis=1)
    order = np.argsort(np.tile(folds, words), kind="stable")
    assert found.scores[known] == pytest.approx(expected[order], abs=1e-6)
    assert found.unlike[known] == pytest.approx(near[order])
    for word in range(words):
        own = owners == word
        alone = anew(system, signs, np.flatnonzero(~own))[own]
        others = np.arange(words) != word
        there = found.scores[~known][own]
        assert there[:, others] == pytest.approx(alone[:, others], abs=1e-6)
        assert (found.taught[~known][own] == others).all()
    assert found.weights[known].sum() == pytest.approx(found.weights[~known].sum())


def test_frames_of_one_scene_are_one_lesson():
    some = views(1, 4, "cup", "mug")
    frames = [replace(it, key=f"{it.key} again") for it in some]
    once, twice = examples(some).left_out(), examples([*some, *frames]).left_out()
    assert once is not None
    assert twice is not None
    assert twice.weights.sum() == pytest.approx(once.weights.sum())
    # What foretells a lesson because it is the same is left out with it.
    assert right_scores(twice).mean() < right_scores(once).mean() + 0.1
    alone = examples([some[0], replace(some[0], key="again"), some[1]])
    assert alone.left_out() is None


@pytest.mark.parametrize("lessons", [1, 2, 6])
def test_one_word_or_one_lesson_of_each_proves_nothing(lessons):
    assert examples(views(2, lessons, "cup")).left_out() is None
    assert examples(views(2, 1, "cup", "mug", "cap")).left_out() is None
    weighed = weighing()
    assert weighed.calibrate_by(None) is weighed


def left_out(scores: np.ndarray, columns: list[int]) -> LeftOut:
    every, right = np.ones(scores.shape, bool), np.array(columns, np.intp)
    return LeftOut(scores, np.zeros_like(scores), every, right, np.ones(len(right)))


def draw_left_out(slope: float, shift: float, count: int, seed: int = 0) -> LeftOut:
    """Lessons whose words are as probable as this calibration says."""
    chance = np.random.default_rng(seed)
    scores = chance.normal(0, 1.5, (count, 3))
    strengths = np.exp(slope * scores + shift)
    shares = strengths / (1 + strengths.sum(axis=1, keepdims=True))
    columns = [
        int(chance.choice([*range(3), STRANGE], p=[*row, 1 - row.sum()]))
        for row in shares
    ]
    return left_out(scores, columns)


@pytest.mark.parametrize(("slope", "shift"), [(1.0, 0.0), (2.0, -1.0), (0.7, 1.0)])
def test_many_lessons_give_the_slope_and_shift_that_hold(slope, shift):
    found = draw_left_out(slope, shift, 4000)
    by = calibrate(found, found.scores, np.zeros_like(found.scores))
    assert by.slope == pytest.approx(slope, abs=0.12)
    assert by.shift == pytest.approx(shift, abs=0.12)


@given(st.integers(0, 200))
def test_few_lessons_prove_little(seed):
    found = draw_left_out(2.0, -1.0, 4, seed)
    by = calibrate(found, found.scores, np.zeros_like(found.scores))
    assert abs(by.slope - 1) < 1.6
    assert abs(by.shift) < 1.6
    none = left_out(np.zeros((0, 3)), [])
    assert calibrate(none, none.scores, none.scores) == Calibration(1.0, 0.0)


@given(st.integers(0, 50), st.floats(-60, 60), st.floats(-60, 60))
def test_any_scores_give_numbers(seed, high, off):
    found = draw_left_out(1.0, 0.0, 12, seed)
    by = calibrate(found, high * found.scores + off, np.zeros_like(found.scores))
    assert 0.5 <= by.slope <= 3.0
    assert math.isfinite(by.shift)


def test_a_weighing_becomes_steeper_where_lessons_tell_words_apart():
    weighed = Weighing(-1.0, 2.0, 1.0, 1.0, KERNELS, 0.5)
    apart = examples(views(3, 6, "cup", "mug", "cap", apart=3.0)).left_out()
    mixed = examples(views(3, 6, "cup", "mug", "cap", apart=0.0)).left_out()
    steep, flat = weighed.calibrate_by(apart), weighed.calibrate_by(mixed)
    assert steep.score > 1.2 * weighed.score
    assert flat.score < weighed.score
    assert (steep.votes, steep.size) == (weighed.votes, weighed.size)
    # What has votes alone has nothing to calibrate.
    deaf = replace(weighed, score=0.0)
    assert deaf.calibrate_by(apart) is deaf


def test_degrees_follow_from_the_lessons_however_they_came():
    some = views(4, 5, "cup", "mug", "cap")
    memory, other = ObjectMemory(some), ObjectMemory()
    extra = replace(some[0], key="extra", label="mug")
    for view in (*some[:7], extra, *some[7:]):
        other.learn(view)
    assert memory._calibrated_weighing() != other._calibrated_weighing()
    other.forget("extra")
    once, again = memory._calibrated_weighing(), other._calibrated_weighing()
    assert (once.base, once.score) == pytest.approx((again.base, again.score))
    assert memory.copy()._calibrated_weighing() == once
