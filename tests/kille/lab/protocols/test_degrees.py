"""Whether degrees mean what they say: what is counted, of taught and strange things."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from kille.dialogue.strategies import strategy
from kille.lab.measures.statistics import calibration_error
from kille.lab.protocols.degrees import (
    LIKELY,
    MARGIN,
    NAME_MARGIN,
    SURE,
    degrees,
    is_asserted,
)
from kille.lab.protocols.teaching import ObjectAnswer
from kille.lab.scenes.galleries import Gallery
from kille.lab.theories.candidates import candidates

Make = Any


def facts(gallery: Gallery, make: Make, seed: int = 3) -> dict[str, Any]:
    result = degrees(gallery, candidates(["it"], {"it": make}), seed=seed)
    found: Any = result.facts["methods"]
    return dict(found["it"])


def test_the_bands_are_those_of_the_papers_wording() -> None:
    bands = strategy(wording="paper").bands
    assert (bands.sure, bands.margin, bands.likely) == (SURE, MARGIN, LIKELY)
    assert bands.name_margin == NAME_MARGIN


@pytest.mark.parametrize(
    ("said", "asserted"),
    [
        ({"cup": 0.6, "mug": 0.3}, True),
        ({"cup": 0.59}, False),
        ({"cup": 0.61, "mug": 0.32}, False),
        ({}, False),
    ],
)
def test_what_is_asserted(said: dict[str, float], asserted: bool) -> None:
    assert is_asserted(ObjectAnswer("cup", said)) == asserted


def test_the_fewer_strangers_the_farther_ahead_is_what_is_asserted() -> None:
    said = {"cup": 0.7, "mug": 0.2}
    assert is_asserted(ObjectAnswer("cup", said, 0.3))
    assert not is_asserted(ObjectAnswer("cup", said, 0.1))


def test_degrees_that_are_right_are_not_off() -> None:
    chance = np.random.default_rng(7)
    said = chance.uniform(0, 1, 20_000)
    right = chance.uniform(0, 1, 20_000) < said
    assert calibration_error(said, right) < 0.02
    assert calibration_error(said / 2, right) == pytest.approx(0.25, abs=0.02)
    assert calibration_error([1.0, 1.0], [False, False]) == 1.0
    assert math.isnan(calibration_error([], []))


def test_who_is_always_certain_asserts_all_and_is_wrong_of_strangers(
    gallery: Gallery, colour: Make
) -> None:
    class Certain(colour):  # type: ignore[misc]
        def predict_proba_one(self, x: Any) -> dict[str, float]:
            degrees = super().predict_proba_one(x)
            best = max(degrees, key=lambda word: degrees[word])
            return {word: float(word == best) for word in degrees}

    for number, found in facts(gallery, Certain).items():
        assert number in {"1", "3"}
        assert found["asserted"] == found["right"] == [1.0] * 8
        assert found["wrong_taught"] == [0.0] * 8
        assert found["error_taught"] == 0.0
        # Two of three categories are taught: all that is said of the third is wrong.
        assert found["wrong_half"] == pytest.approx([1 / 3] * 8)
        assert found["error_half"] == pytest.approx(1 / 3)


def test_who_says_nothing_asserts_nothing(gallery: Gallery, mute: Make) -> None:
    for found in facts(gallery, mute).values():
        assert found["asserted"] == found["wrong_half"] == [0.0] * 8
        assert found["silent"] == [1.0] * 8


def test_the_seed_decides(gallery: Gallery, colour: Make) -> None:
    assert facts(gallery, colour) == facts(gallery, colour)
    assert facts(gallery, colour) != facts(gallery, colour, seed=4)


def test_who_can_reckon_with_strangers_is_told_of_them(
    gallery: Gallery, colour: Make
) -> None:
    class Reckoning(colour):  # type: ignore[misc]
        def reckon_with(self, known: list[bool]) -> None:
            raise AssertionError

        def predict_proba_one(self, x: Any) -> dict[str, float]:
            found = super().predict_proba_one(x)
            return {word: degree / 2 for word, degree in found.items()}

    taking_part = candidates(["it"], {"it": Reckoning})
    result = degrees(gallery, taking_part, seed=3)
    assert len(result.tables) == 6
    plain: Any = result.facts["methods"]
    told: Any = result.facts["told"]
    for number, found in told["it"].items():
        before = plain["it"][number]
        # All was taught, and that is told: what was too low by a half is less so.
        assert found["error_taught"] < before["error_taught"]
        assert np.mean(found["asserted_taught"]) > np.mean(before["asserted"])
    assert degrees(gallery, taking_part, seed=3).facts == result.facts


def test_its_tables_and_diagrams(gallery: Gallery, colour: Make) -> None:
    taking_part = candidates(["colour"], {"colour": colour})
    result = degrees(gallery, taking_part, seed=0)
    assert len(result.tables) == 4
    assert all(len(row) == len(it.columns) for it in result.tables for row in it.rows)
    assert [it.kind for it in result.figures] == ["reliability"] * 2
    for figure in result.figures:
        points = figure.data["series"]["colour"]
        assert sum(points["counts"]) == 8 * 6
        for low, share, high in zip(
            points["low"], points["y"], points["high"], strict=True
        ):
            assert low <= share <= high
