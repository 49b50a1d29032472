from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from kille.memory import (
    Arrangement,
    ObjectLesson,
    Picture,
    RelationLesson,
    Scan,
    Sighting,
    Turn,
    Word,
)
from kille.memory.lessons import has_same_content, lesson_of
from kille.scene import Configuration, Point

DESCRIPTORS = np.zeros((4, 128), np.uint8)
POINTS = np.zeros((4, 3), np.float32)


@pytest.mark.parametrize(
    ("descriptors", "points", "complaint"),
    [
        (DESCRIPTORS.astype(np.float32), POINTS, "descriptors must be uint8"),
        (DESCRIPTORS[:, :64], POINTS, r"descriptors must be uint8 \(4, 128\), not"),
        (DESCRIPTORS, POINTS.astype(np.float64), "points must be float32"),
        (DESCRIPTORS, POINTS[:3], r"points must be float32 \(4, 3\), not"),
        (DESCRIPTORS, POINTS[:, :2], r"points must be float32 \(4, 3\), not"),
    ],
)
def test_arrays_that_would_not_come_back_are_refused(
    descriptors: np.ndarray, points: np.ndarray, complaint: str
) -> None:
    with pytest.raises(ValueError, match=complaint):
        Scan(descriptors, points)


@pytest.mark.parametrize("bad", [math.nan, math.inf])
def test_a_place_is_finite_or_none(bad: float) -> None:
    with pytest.raises(ValueError, match="finite"):
        Sighting("synthetic", 0.0, (), Point(0.0, bad, 1.0))
    with pytest.raises(ValueError, match="finite"):
        Sighting("synthetic", bad, (), None)


@pytest.mark.parametrize("bad", [math.nan, math.inf])
def test_traits_are_finite_or_missing(bad: float) -> None:
    traits = {
        "size": np.zeros(3, np.float32),
        "colour": np.array([0.5, bad], np.float32),
    }
    with pytest.raises(ValueError, match="the trait colour needs finite numbers"):
        Sighting("synthetic", 0.0, (), None, traits)


@pytest.mark.parametrize("bad", [np.zeros(3), np.zeros((3, 1), np.float32)])
def test_a_trait_that_would_not_come_back_is_refused(bad: np.ndarray) -> None:
    with pytest.raises(ValueError, match="the trait colour must be float32"):
        Sighting("synthetic", 0.0, (), None, {"colour": bad})


@pytest.mark.parametrize("bad", [math.nan, math.inf])
def test_configurations_are_finite_or_unknown(bad: float) -> None:
    here, nowhere = (0.0, 0.0, 0.0), (0.0, bad, 0.0)
    for configuration in (
        Configuration(nowhere),
        Configuration(here, viewed=nowhere),
        Configuration(here, others=(here, nowhere)),
        Configuration(here, contact=bad),
    ):
        with pytest.raises(ValueError, match="an arrangement needs finite"):
            Arrangement("synthetic", 0.0, "book", "car", configuration)


def test_bytes_that_are_no_picture_are_refused(picture: Picture) -> None:
    crop = picture.crop
    assert crop is not None
    with pytest.raises(ValueError, match="a frame must be a JPEG picture"):
        Picture(crop.mask, ())
    with pytest.raises(ValueError, match="mask of a crop must be a PNG picture"):
        replace(crop, mask=crop.colour)
    with pytest.raises(ValueError, match="depth of a crop must be a PNG picture"):
        replace(crop, depth=b"")
    with pytest.raises(ValueError, match="must be a JPEG or PNG picture"):
        replace(crop, colour=b"GIF89a")


def test_a_word_is_as_long_as_any_sentence_and_no_longer() -> None:
    for length in (1, 1000):
        assert len(Word("a" * length, "a", "object").name) == length
    for length in (0, 1001):
        with pytest.raises(ValueError, match="1 to 1000 characters"):
            Word("a" * length, "a", "object")


@pytest.mark.parametrize("bad", ["\x1b[31m", "\n", "\u202e", "\u2067", "\ud800"])
@pytest.mark.parametrize(
    "word",
    [
        lambda text: Word(text, "cup", "object"),
        lambda text: Word("cup", text, "object"),
        lambda text: Word("cup", "cup", "object", text),
    ],
)
def test_a_word_has_no_characters_that_steer_a_terminal(
    word: Callable[[str], Word], bad: str
) -> None:
    assert word("a mug")
    with pytest.raises(ValueError, match="cannot have the character"):
        word(f"a{bad}mug")
    with pytest.raises(TypeError, match="is text, not b'mug'"):
        word(b"mug")  # type: ignore[arg-type]


def test_what_a_thing_is_and_where_it_is_are_not_the_same() -> None:
    word, turn = Word("left", "left", "relation"), Turn(1, 1, "tutor", "It.", "", "now")
    views = (
        Sighting("synthetic", 0.0, (), None),
        Arrangement("synthetic", 0.0, "cup", "car", Configuration((0.1, 0.0, 0.0))),
    )
    lessons = [lesson_of(1, word, turn, seen, holds=True) for seen in views]
    assert [type(it) for it in lessons] == [ObjectLesson, RelationLesson]
    same = [[has_same_content(a, b) for b in lessons] for a in lessons]
    assert same == [[True, False], [False, True]]


def test_two_sightings_are_two_though_the_same_was_seen(seen: Sighting) -> None:
    again = replace(seen)
    assert len({seen, again}) == 2
    assert seen != again
