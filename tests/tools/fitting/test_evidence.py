"""Fitting how evidence is weighed: the right answers become most probable."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from kille.perception.descriptor_index import View
from kille.perception.evidence import Weighing
from kille.perception.likeness import Kernel
from tools.fitting import evidence
from tools.fitting.evidence import (
    Asked,
    _surprise,
    episode,
    fit_weighing,
    measure_degrees,
    numbers_of,
    right,
    widths,
)

NONE = np.zeros((0, 128), np.uint8)


def asked(seed: int, count: int = 30) -> list[Asked]:
    """Questions about three words, where the second number says what is right."""
    chance = np.random.default_rng(seed)
    found = []
    for _ in range(count):
        column = int(chance.integers(-1, 3))
        numbers = chance.uniform(0, 1, (3, 4)) * [1, 1, 1, -1]
        numbers[:, 0] = 1
        if column >= 0:
            numbers[column, 1] += 1
        found.append(Asked(numbers, column))
    return found


EPISODES: Sequence[Sequence[Asked]] = [asked(0), asked(1, 10)]


def test_the_slope_is_that_of_the_surprise() -> None:
    at = np.array([-0.5, 0.7, 0.2, 0.1])
    _, slope = _surprise(at, EPISODES)
    for number, step in enumerate(1e-6 * np.eye(4)):
        rise = _surprise(at + step, EPISODES)[0] - _surprise(at - step, EPISODES)[0]
        assert slope[number] == pytest.approx(rise / 2e-6, abs=1e-5)


def test_the_fitted_weighing_surprises_least() -> None:
    weighed = fit_weighing(EPISODES, {})
    least, _ = _surprise(numbers_of(weighed), EPISODES)
    assert weighed.score > 1
    assert weighed.base < 0
    for step in 0.05 * np.eye(4):
        for moved in (numbers_of(weighed) + step, numbers_of(weighed) - step):
            if (moved[1:] >= 0).all():
                assert _surprise(moved, EPISODES)[0] > least


def test_who_is_named_and_who_is_told_from_strangers() -> None:
    weighed = Weighing(0.0, 1.0, 0.0, 0.0, {})
    sure, wrong, stranger = (
        Asked(np.array([[1.0, a, 0, 0], [1.0, b, 0, 0]]), column)
        for a, b, column in ((4, 0, 0), (3, 0, 1), (3, 0, -1))
    )
    assert right([sure, wrong, stranger], weighed) == (0.5, 0.75)


def test_an_episode_asks_of_taught_and_of_untaught_words() -> None:
    chance = np.random.default_rng(0)
    words = ["cup", "car", "cap", "book"]
    views = [
        View("", word, NONE, {"colour": chance.random(4, np.float32)})
        for word in words
        for _ in range(12)
    ]
    width = widths([views], ["colour", "shape"])
    assert width.keys() == {"colour"}
    assert 0 < width["colour"] < 4
    kernels = {"colour": Kernel(1.0, width["colour"])}
    columns = [it.column for it in episode(views, kernels, words, chance)]
    assert min(columns) == -1
    assert max(columns) >= 0


def test_degrees_are_measured_of_words_that_nothing_was_fitted_to(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(evidence, "EPISODES", 40)
    chance = np.random.default_rng(0)
    middles = {word: chance.random(4) for word in ("cup", "car", "cap", "book")}
    views = [
        View("", word, NONE, {"colour": np.float32(at + 0.05 * chance.random(4))})
        for word, at in middles.items()
        for _ in range(12)
    ]
    once, again = (list(measure_degrees([views, views], 1)) for _ in range(2))
    assert once == again
    assert [line.partition(":")[0] for line in once] == [
        "all taught, as fitted",
        "all taught, calibrated",
        "all taught, calibrated and told",
        "half taught, as fitted",
        "half taught, calibrated",
        "half taught, calibrated and told",
    ]
    assert all("right 1.000" in line for line in once[:3])
