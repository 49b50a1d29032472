"""Words for how things are: independent, cautious at first, and about one aspect."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.perception.attributes import ASPECTS, AttributeMemory
from kille.scene import Traits

CHANCE = np.random.default_rng(11)
# As light and as vivid as each other: the same L and opposite a.
RED, BLUE = np.eye(1352, dtype=np.float32)[
    [(4 * 13 + 10) * 13 + 6, (4 * 13 + 2) * 13 + 6]
]
STRIPED, PLAIN = np.eye(177, dtype=np.float32)[[10, 90]]


def thing(
    colour: np.ndarray = RED, length: float = 0.12, pattern: np.ndarray = PLAIN
) -> Traits:
    """A thing whose other traits are its own, as those of different things are."""
    size = np.log([length, 0.75 * length, 0.5 * length])
    texture = CHANCE.normal(size=512).astype(np.float32)
    return {
        "colour": colour,
        "size": size.astype(np.float32),
        "pattern": pattern,
        "texture": texture / np.linalg.norm(texture),
    }


def taught(
    word: str, so: Sequence[Traits], not_so: Sequence[Traits] = ()
) -> AttributeMemory:
    memory = AttributeMemory()
    for x in so:
        memory.learn_one(x, word)
    for x in not_so:
        memory.deny_one(x, word)
    return memory


THINGS = [
    thing(colour, length, pattern)
    for colour in (RED, BLUE)
    for length in (0.08, 0.3)
    for pattern in (STRIPED, PLAIN)
]
lessons = st.lists(
    st.tuples(
        st.sampled_from(THINGS), st.sampled_from(["is_odd", "is_big"]), st.booleans()
    ),
    max_size=7,
)


def told(memory: AttributeMemory, taught: Sequence[tuple[Traits, str, bool]]) -> None:
    for key, (x, word, holds) in enumerate(taught):
        (memory.learn_one if holds else memory.deny_one)(x, word, key=key)


def judged(memory: AttributeMemory) -> list[object]:
    return [(memory.degrees(x), memory.denials(x)) for x in THINGS]


@pytest.mark.slow
@given(before=lessons, more=st.sampled_from(THINGS), holds=st.booleans())
def test_to_forget_is_exact(
    before: list[tuple[Traits, str, bool]], more: Traits, holds: bool
) -> None:
    memory = AttributeMemory()
    told(memory, before)
    then = judged(memory)
    (memory.learn_one if holds else memory.deny_one)(more, "is_odd", key="more")
    judged(memory)
    memory.forget("more")
    assert judged(memory) == then
    with pytest.raises(KeyError):
        memory.forget("more")


@given(before=lessons, more=st.sampled_from(THINGS), holds=st.booleans())
def test_a_lesson_says_nothing_of_other_words(
    before: list[tuple[Traits, str, bool]], more: Traits, holds: bool
) -> None:
    memory = AttributeMemory()
    told(memory, before)
    then = [memory.degrees(x) for x in THINGS]
    (memory.learn_one if holds else memory.deny_one)(more, "is_new")
    for x, degrees in zip(THINGS, then, strict=True):
        now = memory.degrees(x)
        assert {word: now[word] for word in degrees} == degrees
        assert set(now) - set(degrees) == ({"is_new"} if holds else set())
        assert all(0 <= p <= 1 for p in now.values())


def test_one_example_is_enough_to_know_it_again_and_not_to_be_sure_elsewhere() -> None:
    shown = thing(RED, 0.1)
    memory = taught("is_odd", [shown])
    assert memory.degrees(shown)["is_odd"] > 0.85
    other = memory.degrees(thing(BLUE, 0.3, STRIPED))["is_odd"]
    assert 0.02 < other < 0.45
    assert max(memory.speaks_of("is_odd").values()) < 0.5


def test_it_is_found_out_that_a_word_is_about_colour() -> None:
    reds = [thing(RED, length, STRIPED) for length in (0.08, 0.2, 0.4)]
    blues = [thing(BLUE, length, STRIPED) for length in (0.08, 0.4)]
    memory = taught("is_red", reds, blues)
    assert next(iter(memory.speaks_of("is_red"))) == "colour"
    assert memory.degrees(thing(RED, 0.3, PLAIN))["is_red"] > 0.6
    assert memory.degrees(thing(BLUE, 0.3, PLAIN))["is_red"] < 0.2


def test_it_is_found_out_that_a_word_is_about_size_and_holds_of_what_is_larger() -> (
    None
):
    large = [thing(RED, 0.3, PLAIN), thing(BLUE, 0.28, STRIPED)]
    small = [thing(RED, 0.07, PLAIN), thing(BLUE, 0.08, STRIPED)]
    big, little = taught("is_big", large, small), taught("is_little", small, large)
    assert big.degrees(thing(RED, 0.5, STRIPED))["is_big"] > 0.7
    assert big.degrees(thing(BLUE, 0.05, PLAIN))["is_big"] < 0.1
    assert little.degrees(thing(BLUE, 0.05, PLAIN))["is_little"] > 0.7
    assert little.degrees(thing(RED, 0.5, STRIPED))["is_little"] < 0.1


def test_it_is_found_out_that_a_word_is_about_a_pattern() -> None:
    striped = [thing(RED, 0.1, STRIPED), thing(BLUE, 0.3, STRIPED)]
    plain = [thing(RED, 0.3, PLAIN), thing(BLUE, 0.1, PLAIN)]
    memory = taught("is_striped", striped, plain)
    assert next(iter(memory.speaks_of("is_striped"))) == "pattern"
    assert memory.degrees(thing(RED, 0.2, STRIPED))["is_striped"] > 0.6


def test_several_words_hold_at_once() -> None:
    memory = taught("is_red", [thing(RED, 0.3)])
    memory.learn_one(thing(RED, 0.3), "is_big")
    degrees = memory.degrees(thing(RED, 0.3))
    assert degrees["is_red"] > 0.6
    assert degrees["is_big"] > 0.6


def test_what_is_corrected_is_not_said_again() -> None:
    asked = thing(BLUE, 0.1)
    memory = taught("is_odd", [thing(BLUE, 0.12)])
    before = memory.degrees(asked)["is_odd"]
    memory.deny_one(asked, "is_odd")
    assert memory.degrees(asked)["is_odd"] < 0.3 < before


def test_a_word_that_was_only_denied_is_open_but_not_there() -> None:
    shown, other = thing(RED, 0.1), thing(BLUE, 0.4, STRIPED)
    memory = taught("is_odd", [], [shown])
    assert memory.labels == ()
    assert memory.degrees(shown) == {}
    assert memory.denials(shown)["is_odd"] > 0.95
    assert memory.denials(other)["is_odd"] < 0.5
    memory.learn_one(other, "is_odd")
    assert memory.denials(shown) == {}


def test_what_cannot_be_told_is_judged_by_the_rest() -> None:
    memory = taught("is_odd", [{"colour": RED}, {}])
    for traits in ({}, {"colour": np.full(1352, np.inf, np.float32)}):
        assert 0 < memory.degrees(traits)["is_odd"] < 0.5
    assert memory.degrees({"colour": RED})["is_odd"] > memory.degrees({})["is_odd"]
    memory.learn_one({"colour": np.ones(3, np.float32)}, "is_odd")
    assert 0 < memory.degrees({"colour": RED})["is_odd"] <= 1


def test_the_nearest_lesson_is_so_in_what_the_word_speaks_of() -> None:
    reds = [thing(RED, 0.1), thing(RED, 0.3), thing(RED, 0.6)]
    memory = AttributeMemory()
    for key, x in enumerate(reds):
        memory.learn_one(x, "is_red", key=key)
    memory.deny_one(thing(BLUE, 0.1), "is_red", key="no")
    assert memory.nearest(reds[1], "is_red") == 1
    assert memory.nearest({}, "is_red") is None
    for word in ("is_blue", ""):
        with pytest.raises(KeyError):
            memory.nearest(reds[0], word)


def test_a_copy_learns_for_itself_and_may_be_returned_to() -> None:
    memory = taught("is_odd", THINGS[:2], THINGS[2:3])
    then, twin = judged(memory), memory.copy()
    twin.learn_one(THINGS[4], "is_odd", key="new")
    assert judged(memory) == then != judged(twin)
    with pytest.raises(ValueError, match="learned before"):
        twin.deny_one(THINGS[4], "is_odd", key="new")
    twin.become(memory)
    assert judged(twin) == then


def test_every_aspect_is_positive_definite() -> None:
    for aspect in ASPECTS.values():
        known = [it for x in THINGS if (it := aspect.measure(x)) is not None]
        if known:
            kernel = aspect.kernel(np.array(known), np.array(known))
            assert kernel == pytest.approx(kernel.T)
            assert np.linalg.eigvalsh(kernel).min() > -1e-9
