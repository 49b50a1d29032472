"""The words of the survey: what holds, what is chosen, and how vague it is."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.perception.colours import BASIC, lab_of, rgb_of, xkcd

FOCAL = {
    "black": (0, 0, 0),
    "white": (255, 255, 255),
    "grey": (128, 128, 128),
    "red": (229, 0, 0),
    "green": (21, 176, 26),
    "blue": (3, 67, 223),
    "yellow": (255, 255, 20),
    "orange": (249, 115, 6),
    "brown": (101, 55, 0),
    "pink": (255, 129, 192),
    "purple": (126, 30, 156),
}
"""The colours that were named so most often, as the survey's author published them."""

screen_colours = st.lists(
    st.tuples(*[st.integers(0, 255)] * 3), min_size=1, max_size=5
).map(lab_of)


@pytest.mark.parametrize("word", BASIC)
def test_a_basic_word_holds_of_its_best_colour_and_is_chosen_for_it(word: str) -> None:
    lab = lab_of([FOCAL[word]])
    words = xkcd().among(BASIC)
    assert words.degrees(lab)[0, words.names.index(word)] > 0.6
    assert words.names[int(words.chances(lab)[0].argmax())] == word


@given(lab=screen_colours)
def test_degrees_are_degrees_and_chances_sum_to_one(lab: np.ndarray) -> None:
    degrees, chances = xkcd().degrees(lab), xkcd().chances(lab)
    assert degrees.shape == chances.shape == (len(lab), len(xkcd().names))
    assert ((degrees >= 0) & (degrees <= 1)).all()
    assert (chances >= 0).all()
    assert chances.sum(axis=1) == pytest.approx(1)


@given(lab=screen_colours)
def test_fewer_words_compete_for_the_same_chances(lab: np.ndarray) -> None:
    few = xkcd().among(BASIC)
    columns = [xkcd().names.index(word) for word in BASIC]
    shares = xkcd().chances(lab)[:, columns]
    shares = shares / shares.sum(axis=1, keepdims=True)
    assert few.chances(lab) == pytest.approx(shares, abs=1e-9)
    assert few.degrees(lab) == pytest.approx(xkcd().degrees(lab)[:, columns])


def test_borders_are_vague() -> None:
    """From red to orange the one fades, the other comes up, and neither jumps."""
    lab = lab_of([(225, green, 30) for green in range(30, 150, 2)])
    words = xkcd().among(["red", "orange"])
    red, orange = words.degrees(lab).T
    assert red[0] > 0.9 > 0.1 > red[-1]
    assert orange[-1] > 0.9 > 0.1 > orange[0]
    assert (np.diff(red) <= 1e-9).all()
    assert np.abs(np.diff([red, orange])).max() < 0.12
    assert (np.minimum(red, orange) > 0.3).any()


def test_a_general_word_holds_where_another_is_chosen() -> None:
    words = xkcd()
    lab = lab_of([(160, 255, 160)])
    degrees = dict(zip(words.names, words.degrees(lab)[0], strict=True))
    chances = dict(zip(words.names, words.chances(lab)[0], strict=True))
    assert degrees["green"] > 0.5
    assert degrees["light green"] > 0.8
    assert chances["light green"] > 2 * words.availability.min()


def test_a_word_that_is_not_known_is_named() -> None:
    with pytest.raises(ValueError, match="no such colour word: mauvish"):
        xkcd().among(["red", "mauvish"])


def test_no_colours_have_no_degrees() -> None:
    assert xkcd().degrees(np.empty((0, 3))).shape == (0, len(xkcd().names))
    assert xkcd().chances(np.empty((0, 3))).shape == (0, len(xkcd().names))


@given(rgb=st.tuples(*[st.integers(0, 255)] * 3))
def test_colours_go_to_lab_and_back(rgb: tuple[int, int, int]) -> None:
    assert np.abs(rgb_of(lab_of(rgb)).astype(int) - rgb).max() <= 1
