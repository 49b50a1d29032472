"""Votes of features for words, and what chance would give."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.perception.descriptor_index import NOBODY, Neighbours
from kille.perception.votes import UNTAUGHT, beyond_chance, votes


def found(*rows: dict[int, float]) -> Neighbours:
    """The neighbours of each feature: the distance of each word's descriptor."""
    width = max(len(row) for row in rows)
    words = np.full((len(rows), width), NOBODY, np.intp)
    apart = np.full((len(rows), width), np.inf, np.float32)
    for i, row in enumerate(rows):
        words[i, : len(row)], apart[i, : len(row)] = list(row), list(row.values())
    return Neighbours(words, apart)


@st.composite
def neighbours(draw: st.DrawFn) -> Neighbours:
    shape = draw(st.tuples(st.integers(0, 8), st.integers(0, 6)))
    chance = np.random.default_rng(draw(st.integers(0, 1000)))
    words = chance.integers(-1, 4, shape)
    apart = chance.uniform(0, 1.2, shape).astype(np.float32)
    apart[words == NOBODY] = np.inf
    return Neighbours(words, apart)


def test_a_vote_weighs_what_the_next_other_word_is_farther() -> None:
    cast = votes(found({0: 0.1, 1: 0.4}), 3, 1)
    assert cast == pytest.approx([1 - 0.1 / 0.4, 0, 0])


def test_a_rival_is_no_nearer_than_what_nobody_taught() -> None:
    assert votes(found({1: 0.1, 0: 0.9}), 2, 1)[1] == pytest.approx(1 - 0.1 / UNTAUGHT)
    assert votes(found({1: 0.1}), 2, 1)[1] == pytest.approx(1 - 0.1 / UNTAUGHT)
    assert votes(found({1: 0.6}), 2, 1).tolist() == [0, 0]


def test_the_same_picture_under_two_words_votes_for_neither() -> None:
    assert votes(found({0: 0.0, 1: 0.0}), 2, 1).tolist() == [0, 0]


def test_votes_are_means_over_scans() -> None:
    both = found({0: 0.1}, {0: 0.1}, {1: 0.2})
    assert votes(both, 2, 2) == pytest.approx(votes(both, 2, 1) / 2)


@given(neighbours())
def test_each_feature_has_one_vote_at_most(some: Neighbours) -> None:
    cast = votes(some, 4, 1)
    assert cast.shape == (4,)
    assert (cast >= 0).all()
    assert cast.sum() <= len(some.words) + 1e-9


@given(neighbours(), st.permutations(range(6)))
def test_the_order_of_neighbours_does_not_matter(
    some: Neighbours, order: list[int]
) -> None:
    columns = [i for i in order if i < some.words.shape[1]]
    mixed = Neighbours(some.words[:, columns], some.distances[:, columns])
    assert votes(mixed, 4, 1) == pytest.approx(votes(some, 4, 1))


def test_a_word_with_much_in_memory_needs_more_votes() -> None:
    cast, sizes = np.array([5.0, 5.0]), np.array([100, 900])
    few, many = beyond_chance(cast, sizes, 100)
    assert few == pytest.approx(3 * many)


def test_more_features_give_more_by_chance() -> None:
    cast, sizes = np.array([5.0]), np.array([100])
    assert beyond_chance(cast, sizes, 50) > beyond_chance(cast, sizes, 500)
    assert np.isfinite(beyond_chance(np.zeros(1), np.zeros(1, np.intp), 0)).all()
