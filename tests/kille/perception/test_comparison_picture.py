"""Pictures with letters: labels beside things, and reasons with what they rest on."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.perception.comparison_picture import (
    _JOIN,
    Side,
    _draw,
    comparison_picture,
    matched_details,
    side_of,
)
from kille.perception.lettering import text_width, wrap_text, write_label
from kille.perception.look import look
from kille.perception.picture_sheet import overview
from kille.scene import Box, Colour, Look, Percept
from kille.sensors.synthetic import open_synthetic


@pytest.fixture(scope="module")
def table() -> Look:
    stage = open_synthetic("synthetic:empty?seed=3")
    stage.show("cup")
    return look(stage, 1)


@pytest.fixture(scope="module")
def cup(table: Look) -> Percept:
    return table.percepts[0]


def side(thing: Percept) -> Side:
    assert thing.frame is not None
    return side_of(thing.frame, thing.region, thing.scans[0])


@given(st.text("abc åéж ", max_size=60), st.integers(40, 400))
def test_lines_are_as_wide_as_they_may_be_and_lose_no_word(
    text: str, width: int
) -> None:
    lines = wrap_text(text, width, 20)
    assert " ".join(lines).split() == text.split()
    assert all(text_width(it, 20) <= width or " " not in it for it in lines)


def test_letters_beyond_ascii_are_written() -> None:
    pictures = []
    for text in ("ö", "o", "ж"):
        picture = np.full((60, 200, 3), 255, np.uint8)
        write_label(picture, text, Box(10, 30, 60, 50), 20)
        pictures.append(picture)
    assert len({it.tobytes() for it in pictures}) == 3


@given(
    st.integers(-20, 199), st.integers(-20, 99), st.integers(1, 90), st.integers(1, 90)
)
def test_a_label_is_within_the_picture(
    left: int, top: int, wide: int, high: int
) -> None:
    picture = np.full((100, 200, 3), 255, np.uint8)
    place = write_label(picture, "2 cup", Box(left, top, left + wide, top + high), 16)
    assert 0 <= place.left < place.right <= 200
    assert (picture < 255).any()


def test_labels_of_things_at_one_place_do_not_cover_each_other() -> None:
    picture, thing = np.zeros((200, 200, 3), np.uint8), Box(50, 80, 90, 120)
    one = write_label(picture, "1", thing, 16)
    other = write_label(picture, "2", thing, 16, [one])
    assert other.top >= one.bottom or other.bottom <= one.top


def test_a_name_stands_beside_its_number(table: Look) -> None:
    bare, named = overview(table), overview(table, ["cup"])
    box = table.percepts[0].region.box
    changed = np.nonzero((bare != named).any(axis=2))
    assert len(changed[0])
    assert changed[0].max() < box.top
    assert np.array_equal(bare, overview(table, [""]))


def test_the_details_of_a_picture_match_themselves(cup: Percept) -> None:
    details = cup.scans[0]
    pairs = matched_details(details, details)
    assert len(pairs) > 10
    assert all(n == m for n, m in pairs)
    few = type(details)(details.descriptors[:1], details.pixels[:1], details.points[:1])
    assert matched_details(details, few) == []


def test_a_picture_shows_what_matches_and_how_much_each_cue_counted(
    cup: Percept,
) -> None:
    now = side(cup)
    one = comparison_picture("Because.", {"size": 0.9, "colour": 0.1}, now)
    two = comparison_picture("Because.", {"size": 0.9, "colour": 0.1}, now, now)
    assert one.shape == two.shape
    assert (one != two).any(axis=2)[:, one.shape[1] // 2 :].any()
    swapped = comparison_picture("Because.", {"size": 0.1, "colour": 0.9}, now)
    bars = (one != swapped).any(axis=2).nonzero()[0]
    assert bars.min() > 300


def has_lines(picture: Colour) -> bool:
    """Whether details are joined by lines in a picture."""
    return bool((picture[..., :3] == _JOIN).all(axis=2).any())


def test_a_picture_looks_alike_on_any_page(cup: Percept) -> None:
    sides = (side(cup), side(cup))
    drawn = comparison_picture("Because.", {"size": 0.9}, *sides).astype(float)
    assert (drawn[0, :, 3] == 0).all(), "it has no ground of its own"
    opacity = drawn[..., 3:] / 255
    for page in (0, 30, 255):
        seen = drawn[..., :3] * opacity + page * (1 - opacity)
        meant = _draw(page, "Because.", {"size": 0.9}, sides).astype(float)
        assert np.abs(seen - meant).max() <= 2


def test_things_without_details_are_compared_without_lines(cup: Percept) -> None:
    detailed = side(cup)
    bare = detailed._replace(features=None)
    assert has_lines(comparison_picture("They stand so.", {}, detailed, detailed))
    alone = comparison_picture("They stand so.", {}, bare, bare)
    assert not has_lines(alone)
    boxed = bare._replace(boxes=(Box(1, 1, 5, 5),))
    assert not np.array_equal(
        alone, comparison_picture("They stand so.", {}, boxed, boxed)
    )
