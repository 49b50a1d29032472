"""What a thing looks like as a whole: its colours, its size, and what they are for."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tabletop import Card, frame_of, percept_of, prototypes

from kille.perception.appearance import COLOURS, colour_of, size_of, traits_of
from kille.perception.index import View
from kille.perception.objects import ObjectMemory
from kille.perception.resemblance import Resemblance
from kille.perception.segment import region_of
from kille.scene import UNMEASURED, Frame, Percept, Region, Traits

CARD = Card(0.0, 0.8, 0.10, 0.14, seed=3)


def seen(card: Card = CARD, seed: int = 0) -> tuple[Frame, Region]:
    frame = frame_of(card, noise=0.001)
    return frame, region_of(frame, frame.outlines["0"])


SEEN = traits_of(*seen())
FEATURES = {
    prototype: percept_of(np.random.default_rng(0), prototypes(prototype))
    for prototype in (1, 2, 77)
}


def percept(traits: Traits, prototype: int = 1) -> Percept:
    return replace(FEATURES[prototype], measure=lambda: traits)


def taught(traits: Traits) -> ObjectMemory:
    memory = ObjectMemory()
    memory.learn_one(percept(traits), "cup", key="cup")
    memory.learn_one(percept(UNMEASURED, prototype=2), "book", key="book")
    return memory


def traits(**changes: object) -> Traits:
    return replace(SEEN, **changes)


def blue(frame: Frame) -> Frame:
    return replace(frame, colour=np.full_like(frame.colour, (10, 20, 200)))


def scaled(by: float) -> Traits:
    return traits(size=traits().size * np.float32(by))


def degree(memory: ObjectMemory, asked: Percept, word: str = "cup") -> float:
    return memory.predict_proba_one(asked)[word]


@pytest.mark.parametrize("card", [CARD, Card(0.1, 1.0, 0.2, 0.1), Card(-0.1, 0.6)])
def test_a_size_is_that_of_the_thing_wherever_it_stands(card: Card) -> None:
    size = size_of(*seen(card))
    width, height = sorted((card.width, card.height))
    assert size is not None
    assert size.dtype == np.float32
    assert size[:2] == pytest.approx((height, width), rel=0.2)
    assert size[2] < 0.02


def test_without_depth_there_is_no_size() -> None:
    frame, region = seen()
    assert size_of(replace(frame, depth=None), region) is None
    unread = np.full_like(frame.depth, np.nan)
    assert size_of(replace(frame, depth=unread), region) is None


def test_readings_of_the_background_at_the_rim_do_not_count() -> None:
    frame, region = seen()
    wide = np.roll(region.mask, 2, axis=1) | region.mask
    assert size_of(frame, region_of(frame, wide)) == pytest.approx(
        size_of(frame, region), abs=0.01
    )


def test_colours_have_length_one_and_change_little_from_frame_to_frame() -> None:
    one, other = colour_of(*seen(seed=1)), colour_of(*seen(seed=2))
    assert one.shape == (COLOURS,)
    assert one.dtype == np.float32
    assert np.linalg.norm(one) == pytest.approx(1, abs=1e-5)
    assert one @ other > 0.98


def test_a_slight_cast_changes_colours_less_than_another_colour_does() -> None:
    frame, region = seen()
    cast = np.clip(frame.colour * np.array([1.05, 1.0, 0.92]), 0, 255).astype(np.uint8)
    plain = colour_of(frame, region)
    assert plain @ colour_of(replace(frame, colour=cast), region) > 0.9
    assert plain @ colour_of(blue(frame), region) < 0.5


def test_a_region_without_pixels_has_no_traits() -> None:
    frame, _ = seen()
    nothing = region_of(frame, np.zeros(frame.colour.shape[:2], bool))
    assert colour_of(frame, nothing) is None
    assert size_of(frame, nothing) is None


@settings(deadline=None)
@given(st.floats(1.0, 3.0), st.floats(1.0, 3.0))
def test_the_farther_the_size_is_off_the_lower_the_degree(a: float, b: float) -> None:
    memory, (near, far) = taught(traits()), sorted((a, b))
    assert degree(memory, percept(scaled(far))) <= degree(memory, percept(scaled(near)))


def test_a_size_twice_as_large_lowers_the_degree() -> None:
    memory = taught(traits())
    plain = traits(colour=None)
    twice = replace(plain, size=2 * plain.size)
    same = degree(memory, percept(plain))
    other = degree(memory, percept(twice))
    assert other / (1 - other) < same / (1 - same) / 50


@settings(deadline=None)
@given(st.floats(0, 1))
def test_colour_never_rejects(share: float) -> None:
    memory = taught(traits())
    plain, blend = traits(colour=None), share * traits().colour
    mixed = blend + (1 - share) * traits().colour[::-1]
    colour = (mixed / np.linalg.norm(mixed)).astype(np.float32)
    with_colour = percept(replace(plain, colour=colour))
    assert degree(memory, with_colour) >= degree(memory, percept(plain))


def test_what_no_feature_confirms_is_not_asserted() -> None:
    stranger = percept(traits(), prototype=77)
    assert 0.3 < degree(taught(traits()), stranger) < 0.5


def test_colour_alone_is_no_reason_to_use_a_word() -> None:
    unsized = percept(traits(size=None), prototype=77)
    assert degree(taught(traits()), unsized) < 0.05
    assert degree(taught(traits(size=None)), percept(traits(), prototype=77)) < 0.05


def test_a_thing_without_features_may_be_known_by_its_looks() -> None:
    smooth = replace(percept(traits()), scans=())
    assert 0.3 < degree(taught(traits()), smooth) < 0.5
    assert taught(traits()).predict_proba_one(replace(smooth, measure=Traits)) == {}


@pytest.mark.parametrize("learned", [UNMEASURED, Traits(np.ones(7, np.float32))])
def test_without_traits_all_is_as_with_features_alone(learned: Traits) -> None:
    asked = percept(traits())
    alone = taught(UNMEASURED).predict_proba_one(percept(UNMEASURED))
    assert taught(learned).predict_proba_one(asked) == alone
    measured = taught(traits()).predict_proba_one(percept(UNMEASURED))
    assert measured == alone


def test_forgetting_forgets_the_looks_too() -> None:
    memory, asked = taught(traits()), percept(traits(), prototype=77)
    before = memory.predict_proba_one(asked)
    memory.learn_one(percept(scaled(3)), "cup", key="large")
    memory.predict_proba_one(asked)
    memory.forget("large")
    assert memory.predict_proba_one(asked) == before


def test_a_word_fits_as_well_as_the_view_that_fits_best() -> None:
    none = np.empty((0, 128), np.uint8)
    views = [View(i, "cup", none, scaled(by)) for i, by in enumerate((1, 2, 3))]
    fit = Resemblance([*views, View(3, "book", none)], ["book", "cup"]).fit(scaled(2))
    assert fit.size.tolist() == [1, pytest.approx(1)]
    assert fit.size_known.tolist() == [0, 1]
    assert fit.colour[0] == 0
    assert fit.colour[1] > 0.99


def test_traits_are_measured_once_and_only_when_asked_for() -> None:
    asked: list[int] = []

    def measure() -> Traits:
        asked.append(1)
        return UNMEASURED

    thing = replace(percept(UNMEASURED), measure=measure)
    assert asked == []
    assert thing.traits is thing.traits
    assert asked == [1]
