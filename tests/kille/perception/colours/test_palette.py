"""The colours of a thing: robust to shading, highlights and a cast; cue and pixels."""

from __future__ import annotations

import numpy as np
import pytest

from kille.perception.colours import (
    BASIC,
    Palette,
    colour_chances,
    colour_words,
    colours_in,
    colours_of,
    pack_palette,
    plain,
    unpack_palette,
    xkcd,
)
from kille.perception.cues import CUES, Patch
from kille.perception.segment import region_of
from kille.scene import Frame, Region

RED, WHITE = (200, 25, 30), (235, 235, 235)
BASICS = xkcd().among(BASIC)


def scene(
    *stripes: tuple[int, int, int],
    shade: tuple[float, float] = (1.0, 1.0),
    cast: tuple[float, float, float] = (1, 1, 1),
) -> tuple[Frame, Region]:
    """A striped ball before a white wall, shaded from one side to the other."""
    height, width = 120, 160
    rows, columns = np.mgrid[:height, :width]
    mask = (rows - 60) ** 2 + (columns - 80) ** 2 < 40**2
    picture = np.full((height, width, 3), 225.0)
    which = np.clip((columns - 40) * len(stripes) // 80, 0, len(stripes) - 1)
    light = shade[0] + (shade[1] - shade[0]) * np.clip((rows - 20) / 80, 0, 1)
    ball = np.array(stripes, float)[which] * light[..., None]
    picture[mask] = ball[mask]
    noise = np.random.default_rng(0).normal(0, 4, picture.shape)
    colour = np.clip(picture * cast + noise, 0, 255).astype(np.uint8)
    frame = Frame(colour, None, None, 0.0, {})
    return frame, region_of(frame, mask)


def best(palette: Palette) -> str:
    degrees = colour_words(palette, BASICS)
    return max(degrees, key=lambda word: degrees[word])


@pytest.mark.parametrize(
    "case",
    [
        {},
        {"shade": (1.1, 0.55)},
        {"cast": (1.0, 0.88, 0.97)},
        {"cast": (0.6, 0.6, 0.6)},
        {"cast": (0.85, 0.9, 1.0), "shade": (1.0, 0.6)},
    ],
)
def test_a_ball_is_red_in_any_light(
    case: dict[str, tuple[float, ...]],
) -> None:
    palette = colours_of(*scene(RED, **case))
    assert palette is not None
    assert best(palette) == "red"
    assert colour_words(palette)["red"] > 0.6


def test_a_highlight_is_no_colour_of_the_thing() -> None:
    frame, region = scene(RED)
    frame.colour[50:60, 75:85] = 255
    palette = colours_of(frame, region)
    assert palette is not None
    assert palette.shares.tolist() == [1.0]
    assert best(palette) == "red"


def test_a_thing_may_be_red_and_white() -> None:
    palette = colours_of(*scene(RED, WHITE))
    assert palette is not None
    assert len(palette.shares) == 2
    assert palette.shares == pytest.approx(0.5, abs=0.05)
    degrees = colour_words(palette, BASICS)
    assert min(degrees["red"], degrees["white"]) > 0.6
    assert max(p for word, p in degrees.items() if word not in ("red", "white")) < 0.5


def test_a_thing_is_hardly_of_the_colour_of_a_small_part() -> None:
    thing = Palette([0.9, 0.1], [[48, 66, 48], [100, 0, 0]])
    degrees = colour_words(thing)
    assert degrees["red"] > 0.9
    assert degrees["white"] < 0.25


def test_vague_parts_do_not_add_up_to_a_certain_whole() -> None:
    vague = [[58.0, 48, 55], [58.5, 48, 55]]
    whole = colour_words(Palette([0.5, 0.5], vague))
    assert whole == pytest.approx(colour_words(plain(vague[0])), abs=0.05)


def test_the_cue_alone_tells_the_colours() -> None:
    frame, region = scene((60, 95, 170), WHITE)
    vector = CUES["colour"].measure(Patch(frame, region))
    assert vector is not None
    palette = colours_in(vector)
    assert palette.shares[:2] == pytest.approx(0.5, abs=0.08)
    assert {best(plain(lab)) for lab in palette.lab[:2]} == {"blue", "white"}


@pytest.mark.parametrize("vector", [np.ones(7), np.zeros(1352), np.full(1352, np.nan)])
def test_what_is_no_cue_of_colour_is_refused(vector: np.ndarray) -> None:
    with pytest.raises(ValueError, match="the cue colour has"):
        colours_in(vector.astype(np.float32))


@pytest.mark.parametrize("value", [0, 255])
def test_all_black_and_all_white(value: int) -> None:
    colour = np.full((20, 30, 3), value, np.uint8)
    frame = Frame(colour, None, None, 0.0, {})
    palette = colours_of(frame, region_of(frame, np.ones((20, 30), bool)))
    assert palette is not None
    assert best(palette) == ("white" if value else "black")


def test_a_huge_picture_has_the_colours_of_a_small_one() -> None:
    frame, region = scene(RED, WHITE)
    big = frame.colour.repeat(36, axis=0).repeat(48, axis=1)
    huge = Frame(big, None, None, 0.0, {})
    mask = region.mask.repeat(36, axis=0).repeat(48, axis=1)
    small, large = colours_of(frame, region), colours_of(huge, region_of(huge, mask))
    assert small is not None
    assert large is not None
    assert colour_words(large, BASICS) == pytest.approx(
        colour_words(small, BASICS), abs=0.1
    )


def test_one_pixel_and_none() -> None:
    frame = Frame(np.full((1, 1, 3), 128, np.uint8), None, None, 0.0, {})
    region = region_of(frame, np.ones((1, 1), bool))
    palette = colours_of(frame, region)
    assert palette is not None
    assert palette.shares.tolist() == [1.0]
    empty = Region(np.zeros((1, 1), bool), region.box, None)
    assert colours_of(frame, empty) is None


def test_what_is_chosen_sums_to_one() -> None:
    assert sum(
        colour_chances(Palette([3, 1], [[48, 66, 48], [90, 0, 0]])).values()
    ) == (pytest.approx(1))


def test_palettes_are_kept_as_numbers() -> None:
    palette = Palette([0.2, 0.7, 0.1], [[90, 0, 0], [48, 66, 48], [0, 0, 0]])
    again = unpack_palette(pack_palette(palette))
    assert again.shares == pytest.approx([0.7, 0.2, 0.1])
    assert again.lab == pytest.approx(np.array([[48, 66, 48], [90, 0, 0], [0, 0, 0]]))
    with pytest.raises(ValueError, match="a packed palette has 16 numbers"):
        unpack_palette(np.ones(3, np.float32))


@pytest.mark.parametrize(
    ("shares", "lab"),
    [
        ([], np.empty((0, 3))),
        ([1.0], [[1, 2]]),
        ([0.0], [[1, 2, 3]]),
        ([-1.0, 2.0], [[1, 2, 3], [4, 5, 6]]),
        ([1.0], [[np.nan, 2, 3]]),
    ],
)
def test_what_is_no_palette_is_refused(shares: list[float], lab: list[float]) -> None:
    with pytest.raises(ValueError, match="a palette takes"):
        Palette(shares, lab)
