"""Cues: vectors of what a region looks like as a whole, and what they tell apart."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from tabletop import Card, frame_of

from kille.perception.cues import CUES, Cue, Patch, measure_cues
from kille.perception.cues.fisher import load_codebook, numbers, project_vector
from kille.perception.segment import region_of, whole
from kille.scene import Frame, Intrinsics, Region, Traits
from kille.sensors.captures import description_of, read_sequence

CARD = Card(0.0, 0.8, 0.10, 0.14, seed=3)
WHOLE = {"whole_texture", "whole_paint", "whole_form", "whole_pattern"}


def seen(card: Card = CARD, seed: int = 0) -> tuple[Frame, Region]:
    frame = frame_of(card, noise=0.001, seed=seed)
    return frame, region_of(frame, frame.outlines["0"])


def picture(colour: NDArray[np.uint8]) -> Frame:
    return Frame(colour, None, None, 0.0, {})


def drawn(draw: str, at: tuple[int, int] = (112, 112)) -> tuple[Frame, Region]:
    """A disc or a bar on grey, in a picture without depth."""
    colour = np.full((224, 224, 3), 120, np.uint8)
    if draw == "disc":
        cv2.circle(colour, at, 40, (200, 40, 30), -1)
    else:
        x, y = at
        cv2.rectangle(colour, (x - 70, y - 12), (x + 70, y + 12), (200, 40, 30), -1)
    frame = picture(colour)
    return frame, region_of(frame, colour[..., 0] > 150)


def distance(one: Traits, other: Traits, cue: str) -> float:
    return float(np.linalg.norm(one[cue] - other[cue]))


def test_every_cue_gives_its_length_of_finite_numbers() -> None:
    for traits in (measure_cues(*seen()), measure_cues(*drawn("disc"))):
        for name, vector in traits.items():
            assert vector.shape == (CUES[name].length,)
            assert vector.dtype == np.float32
            assert np.isfinite(vector).all()


def test_with_depth_all_cues_are_of_the_region_and_without_also_of_the_picture() -> (
    None
):
    assert set(measure_cues(*seen())) == set(CUES) - WHOLE
    assert set(measure_cues(*drawn("disc"))) == set(CUES) - {"size"}


@pytest.mark.parametrize("cue", sorted(set(CUES) - WHOLE))
def test_a_thing_is_more_like_itself_than_like_another(cue: str) -> None:
    one, again = measure_cues(*seen(seed=1)), measure_cues(*seen(seed=2))
    other = measure_cues(*seen(Card(0.0, 0.8, 0.22, 0.06, seed=9)))
    assert distance(one, again, cue) < 0.7 * distance(one, other, cue)


@pytest.mark.parametrize("cue", ["shape", "outline", "form", "colour", "paint"])
def test_where_in_the_picture_a_thing_is_does_not_count(cue: str) -> None:
    one, moved = (
        measure_cues(*drawn("disc")),
        measure_cues(*drawn("disc", at=(90, 140))),
    )
    assert distance(one, moved, cue) < 0.1


@pytest.mark.parametrize("cue", ["shape", "outline", "form"])
def test_shapes_differ(cue: str) -> None:
    disc, bar = measure_cues(*drawn("disc")), measure_cues(*drawn("bar"))
    assert distance(disc, bar, cue) > 0.3


def test_colours_have_length_one_and_change_little_from_frame_to_frame() -> None:
    one, other = measure_cues(*seen(seed=1)), measure_cues(*seen(seed=2))
    for cue in ("colour", "hue"):
        assert np.linalg.norm(one[cue]) == pytest.approx(1, abs=1e-5)
        assert distance(one, other, cue) < 0.1


def test_a_slight_cast_changes_colours_less_than_another_colour_does() -> None:
    frame, region = seen()
    cast = np.clip(frame.colour * np.array([1.05, 1.0, 0.92]), 0, 255).astype(np.uint8)
    blue = np.full_like(frame.colour, (10, 20, 200))
    plain, tinted, painted = (
        measure_cues(replace(frame, colour=colour), region)
        for colour in (frame.colour, cast, blue)
    )
    for cue in ("colour", "hue"):
        assert distance(plain, tinted, cue) < distance(plain, painted, cue) / 3


def test_hue_is_the_same_in_half_the_light_and_colour_is_not() -> None:
    frame, region = drawn("disc")
    darker = replace(frame, colour=(frame.colour * 0.7).astype(np.uint8))
    plain, dim = measure_cues(frame, region), measure_cues(darker, region)
    assert distance(plain, dim, "hue") < distance(plain, dim, "colour") / 2


@pytest.mark.parametrize("card", [CARD, Card(0.1, 1.0, 0.2, 0.1), Card(-0.1, 0.6)])
def test_a_size_is_that_of_the_thing_wherever_it_stands(card: Card) -> None:
    reach = np.exp(measure_cues(*seen(card))["size"]) - 0.01
    width, height = sorted((card.width, card.height))
    assert reach[:2] == pytest.approx((height, width), rel=0.2)
    assert reach[2] < 0.02


def test_readings_of_the_background_at_the_rim_do_not_count_as_size() -> None:
    frame, region = seen()
    wide = np.roll(region.mask, 2, axis=1) | region.mask
    one, other = (
        measure_cues(frame, region),
        measure_cues(frame, region_of(frame, wide)),
    )
    assert distance(one, other, "size") < 0.1


def test_what_surrounds_a_region_with_depth_is_neither_its_texture_nor_its_colour() -> (
    None
):
    frame, region = seen()
    noise = np.random.default_rng(0).integers(0, 255, frame.colour.shape, np.uint8)
    near = cv2.dilate(region.mask.astype(np.uint8), np.ones((41, 41))) > 0
    other = replace(frame, colour=np.where(near[..., None], frame.colour, noise))
    one, same = measure_cues(frame, region), measure_cues(other, region)
    for cue in ("texture", "paint", "pattern", "colour", "hue"):
        assert distance(one, same, cue) < 1e-3


def test_a_cue_of_ones_own_is_measured_like_the_others() -> None:
    def middle(patch: Patch) -> NDArray[np.float32]:
        return patch.lab.mean(axis=0).astype(np.float32)

    own: Mapping[str, Cue] = {"middle": Cue("middle", 3, middle)}
    assert list(measure_cues(*seen(), own)) == ["middle"]


SIGNS = [-1, 1, -1, 1, 1, 1, 1, 1, 1, -1, -1, -1, -1, -1, 1, -1]
LENS = Intrinsics(500.0, 500.0, 32.0, 24.0)
ODD_DEPTHS = [None, np.nan, 0.0, np.inf, -1.0, 0.7, 65.0]


@pytest.mark.parametrize("depth", ODD_DEPTHS)
@pytest.mark.parametrize("level", [0, 255])
@pytest.mark.parametrize("kind", ["none", "one", "all", "line"])
def test_odd_input_gives_finite_vectors_or_none(
    depth: float | None, level: int, kind: str
) -> None:
    colour = np.full((48, 64, 3), level, np.uint8)
    read = None if depth is None else np.full((48, 64), depth, np.float32)
    frame = Frame(colour, read, LENS, 0.0, {})
    mask = np.zeros((48, 64), bool)
    mask[{"none": np.s_[:0], "one": np.s_[3:4, 5:6], "all": np.s_[:]}.get(kind, 7)] = (
        True
    )
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        traits = measure_cues(frame, region_of(frame, mask))
    assert all(np.isfinite(vector).all() for vector in traits.values())
    if kind == "none":
        assert set(traits) <= WHOLE


@pytest.mark.parametrize("shape", [(1, 1), (3, 900), (900, 2), (2160, 3840)])
def test_pictures_of_any_size_can_be_measured(shape: tuple[int, int]) -> None:
    frame = picture(np.full((*shape, 3), 90, np.uint8))
    traits = measure_cues(frame, whole(frame))
    assert all(np.isfinite(vector).all() for vector in traits.values())


@settings(deadline=None, max_examples=25)
@given(st.integers(0, 2**32 - 1))
def test_any_mask_on_any_picture_gives_finite_vectors(seed: int) -> None:
    chance = np.random.default_rng(seed)
    shape = tuple(chance.integers(1, 60, 2))
    colour = chance.integers(0, 256, (*shape, 3), np.uint8)
    depth = np.where(chance.random(shape) < 0.5, chance.random(shape), np.nan)
    frame = Frame(colour, depth.astype(np.float32), LENS, 0.0, {})
    region = region_of(frame, chance.random(shape) < chance.random())
    traits = measure_cues(frame, region)
    assert all(np.isfinite(vector).all() for vector in traits.values())
    assert all(len(vector) == CUES[name].length for name, vector in traits.items())


@pytest.mark.parametrize("name", ["texture", "paint"])
def test_a_codebook_shares_descriptors_among_its_gaussians(name: str) -> None:
    from kille.perception.cues.dense import colours, edges

    book, window = load_codebook(name), Patch(*seen()).window
    assert window is not None
    found = {"texture": edges, "paint": colours}[name](window)
    shares = book.shares(numbers(found, book.mean, book.axes))
    assert shares.sum(axis=1) == pytest.approx(1, abs=1e-4)
    assert book.weights.sum() == pytest.approx(1, abs=1e-2)
    assert np.linalg.norm(book.fisher(found)) == pytest.approx(1, abs=1e-4)


def test_shortened_vectors_are_about_as_far_apart() -> None:
    chance = np.random.default_rng(0)
    one, other = chance.normal(size=(2, 4800)).astype(np.float32)
    far = np.linalg.norm(one - other)
    assert np.linalg.norm(project_vector(one) - project_vector(other)) == pytest.approx(
        far, rel=0.1
    )
    # The signs are the same on every machine, or stored vectors would lose their sense.
    first = project_vector(np.eye(1, 4800, dtype=np.float32)[0])[:16] * np.sqrt(512)
    assert np.rint(first).tolist() == SIGNS


def test_the_same_thing_is_known_again_in_real_frames(data: Path) -> None:
    description = description_of(data / "ycbv_scenes" / "0001")
    assert description is not None
    first, last = (read_sequence(description)[k].read() for k in (0, -1))
    one, other = (
        {
            word: measure_cues(frame, region_of(frame, mask))
            for word, mask in frame.outlines.items()
        }
        for frame in (first, last)
    )
    for cue in set(CUES) - WHOLE:
        for word, traits in one.items():
            nearest = min(other, key=lambda it: distance(traits, other[it], cue))
            assert nearest == word
