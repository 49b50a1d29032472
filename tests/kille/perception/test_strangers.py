"""Strangers: what a robot is told of what it was asked decides how sure it may be."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.perception.descriptor_index import View
from kille.perception.objects import ObjectMemory
from kille.perception.strangers import LATEST, log_odds_of_strangers
from kille.scene import Box, Percept, Region

NONE = np.zeros((0, 128), np.uint8)
told = st.lists(st.booleans(), max_size=2 * LATEST)


def thing(colour: float) -> Percept:
    traits = {"colour": np.float32([colour, 0, 0]), "size": np.float32([colour])}
    region = Region(np.zeros((0, 0), np.bool_), Box(0, 0, 0, 0), None)
    return Percept(region, (), lambda: traits)


def taught() -> ObjectMemory:
    places = {"cup": 0.0, "mug": 0.6, "book": 2.0}
    return ObjectMemory(
        View(f"{word} {number}", word, NONE, thing(at + number / 20).traits)
        for word, at in places.items()
        for number in range(4)
    )


THINGS = [thing(at) for at in (0.0, 0.5, 1.3, 2.1, 9.0)]
MEMORY = taught()


def degrees(known: list[bool]) -> list[dict[str, float]]:
    MEMORY.reckon_with(known)
    try:
        return [MEMORY.predict_proba_one(it) for it in THINGS]
    finally:
        MEMORY.reckon_with([])


def assert_no_higher(some: list[bool], others: list[bool]) -> None:
    for one, other in zip(degrees(some), degrees(others), strict=True):
        assert all(one[word] <= other[word] + 1e-12 for word in one)


@given(told, st.data())
def test_the_more_were_strange_the_lower_are_all_degrees(known, data):
    strange = [it and data.draw(st.booleans()) for it in known]
    assert_no_higher(strange, known)
    assert_no_higher([*known, False], known)
    assert_no_higher(known, [*known, True])


@given(told)
def test_what_is_told_never_makes_it_less_sure_than_nothing_told(known):
    assert_no_higher([], known)


@given(told)
def test_which_word_fits_best_is_not_changed(known):
    for one, other in zip(degrees(known), degrees([]), strict=True):
        assert max(one, key=one.get) == max(other, key=other.get)


@given(told, told)
def test_only_the_latest_count(long_ago, known):
    latest = [*known, *[True] * LATEST][-LATEST:]
    assert degrees([*long_ago, *latest]) == degrees(latest)


def test_the_strength_of_none_of_the_words_is_multiplied_by_the_odds():
    known = [True] * 5 + [False]
    odds = math.exp(log_odds_of_strangers(known))
    assert odds == pytest.approx(1.5 / 5.5)
    for one, other in zip(degrees(known), degrees([]), strict=True):
        for word in one:
            ratio = one[word] / (1 - sum(one.values()))
            before = other[word] / (1 - sum(other.values()))
            assert ratio == pytest.approx(before / odds)


def test_a_copy_reckons_with_as_many():
    memory = taught()
    memory.reckon_with([True, True])
    assert memory.copy().familiarity == (True, True)
    other = ObjectMemory()
    other.become(memory)
    assert other.predict_proba_one(THINGS[1]) == memory.predict_proba_one(THINGS[1])
