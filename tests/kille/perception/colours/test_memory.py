"""Colour words of a tutor: laws of learners, borders that move, words never heard."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.perception.colours import ColourMemory, Palette, lab_of, plain, xkcd
from kille.perception.learners import check_learner

RED = plain(lab_of([205, 25, 30]))
ORANGE = plain(lab_of([240, 130, 30]))
BLUE = plain(lab_of([30, 60, 200]))
LILAC = plain(lab_of([160, 120, 190]))

palettes = st.lists(
    st.tuples(st.floats(0.1, 1), st.tuples(*[st.integers(0, 255)] * 3)),
    min_size=1,
    max_size=3,
).map(lambda parts: Palette([s for s, _ in parts], lab_of([rgb for _, rgb in parts])))
lessons = st.lists(
    st.tuples(palettes, st.sampled_from(["red", "röd", "zap"])), max_size=6
)


def choice(memory: ColourMemory, x: Palette) -> str:
    chances = memory.predict_proba_one(x)
    return max(chances, key=lambda word: chances[word])


def test_it_keeps_the_laws_of_learners() -> None:
    flag = Palette([0.5, 0.5], [[48, 66, 48], [95, 0, 0]])
    check_learner(
        ColourMemory,
        [(RED, "red"), (BLUE, "blue"), (flag, "red"), (ORANGE, "red"), (BLUE, "zap")],
    )


def test_who_has_learned_nothing_knows_the_prior_only() -> None:
    assert ColourMemory().degrees(RED) == ColourMemory().predict_proba_one(RED) == {}
    assert ColourMemory(xkcd()).labels == tuple(sorted(xkcd().names))
    assert choice(ColourMemory(xkcd()), RED) == "red"


@given(taught=lessons, x=palettes)
def test_degrees_and_chances_are_in_bounds(
    taught: list[tuple[Palette, str]], x: Palette
) -> None:
    for memory in (ColourMemory(), ColourMemory(prior=xkcd())):
        for palette, word in taught:
            memory.learn_one(palette, word)
        degrees, chances = memory.degrees(x), memory.predict_proba_one(x)
        assert set(degrees) == set(chances) == set(memory.labels)
        assert all(0 <= p <= 1 for p in [*degrees.values(), *chances.values()])
        assert sum(chances.values()) <= 1 + 1e-9


@given(taught=lessons, x=palettes, order=st.randoms(use_true_random=False))
def test_the_order_of_lessons_does_not_matter(
    taught: list[tuple[Palette, str]], x: Palette, order: object
) -> None:
    memory, other = ColourMemory(xkcd()), ColourMemory(xkcd())
    numbered = list(enumerate(taught))
    for key, (palette, word) in numbered:
        memory.learn_one(palette, word, key=key)
    order.shuffle(numbered)  # type: ignore[attr-defined]
    for key, (palette, word) in numbered:
        other.learn_one(palette, word, key=key)
    assert memory.degrees(x) == pytest.approx(other.degrees(x), abs=1e-6)
    assert memory.predict_proba_one(x) == pytest.approx(
        other.predict_proba_one(x), abs=1e-6
    )


@given(taught=lessons, x=palettes)
def test_what_is_forgotten_was_never_there(
    taught: list[tuple[Palette, str]], x: Palette
) -> None:
    memory = ColourMemory(xkcd())
    before = memory.degrees(x), memory.predict_proba_one(x), memory.labels
    for key, (palette, word) in enumerate(taught):
        memory.learn_one(palette, word, key=key)
        memory.degrees(x)
    for key in range(len(taught)):
        memory.forget(key)
    assert (memory.degrees(x), memory.predict_proba_one(x), memory.labels) == before


def test_one_odd_lesson_shifts_little_and_ten_win() -> None:
    memory = ColourMemory(xkcd())
    memory.learn_one(ORANGE, "red")
    assert choice(memory, ORANGE) == "orange"
    assert memory.degrees(ORANGE)["red"] < 0.3
    for _ in range(9):
        memory.learn_one(ORANGE, "red")
    assert choice(memory, ORANGE) == "red"
    degrees = memory.degrees(ORANGE)
    assert degrees["red"] > degrees["orange"]
    assert choice(memory, BLUE) == "blue"
    assert memory.degrees(BLUE)["red"] < 0.05


def test_every_lesson_moves_the_border_the_same_way() -> None:
    memory = ColourMemory(xkcd())
    degrees = []
    for _ in range(8):
        degrees.append(memory.degrees(ORANGE)["red"])
        memory.learn_one(ORANGE, "red")
    assert degrees == sorted(degrees)


def test_a_lesson_that_all_expect_changes_hardly_anything() -> None:
    memory = ColourMemory(xkcd())
    before = memory.degrees(RED)
    for _ in range(20):
        memory.learn_one(RED, "red")
    after = memory.degrees(RED)
    assert max(abs(after[word] - before[word]) for word in before) < 0.1


def test_a_word_of_another_language_denies_nothing() -> None:
    memory = ColourMemory(xkcd())
    before = memory.degrees(RED)["red"]
    for _ in range(10):
        memory.learn_one(RED, "röd")
    assert memory.degrees(RED)["röd"] > 0.9
    assert memory.degrees(RED)["red"] == pytest.approx(before)
    assert memory.degrees(BLUE)["röd"] < 0.05


@pytest.mark.parametrize("word", ["red", "green", "brown", "purple"])
def test_a_word_is_learned_from_a_few_colours_it_is_used_for(word: str) -> None:
    """As if nobody had known it: shown five of its colours, it is told from others."""
    prior = xkcd()
    column = prior.names.index(word)
    colours = lab_of(np.random.default_rng(1).integers(0, 256, (2000, 3)))
    holds = prior.degrees(colours)[:, column]
    memory = ColourMemory()
    for lab in colours[holds > 0.9][:5]:
        memory.learn_one(plain(lab), "zap")
    found = [memory.degrees(plain(lab))["zap"] for lab in colours[:400]]
    assert np.corrcoef(found, holds[:400])[0, 1] > 0.6


def test_of_a_thing_of_two_colours_the_tutor_means_the_red_one() -> None:
    flag = Palette([0.7, 0.3], [[95, 0, 0], [48, 66, 48]])
    memory = ColourMemory(xkcd())
    for _ in range(10):
        memory.learn_one(flag, "red")
    assert memory.degrees(plain([95, 0, 0]))["red"] < 0.4


def test_a_copy_learns_alone() -> None:
    memory = ColourMemory()
    memory.learn_one(LILAC, "lila")
    twin = memory.copy()
    twin.learn_one(RED, "röd")
    assert memory.labels == ("lila",)
    assert twin.labels == ("lila", "röd")
    assert twin.degrees(LILAC)["lila"] == memory.degrees(LILAC)["lila"]


def test_contradicting_lessons_share_the_choice() -> None:
    memory = ColourMemory()
    for key in range(10):
        memory.learn_one(RED, "röd" if key % 2 else "rouge", key=key)
    chances = memory.predict_proba_one(RED)
    assert chances["röd"] == pytest.approx(chances["rouge"])
    assert 0.8 < sum(chances.values()) < 1


# --- what was denied ------------------------------------------------------------------


def test_a_colour_that_was_denied_is_not_said_of_it_again() -> None:
    memory = ColourMemory(xkcd())
    before, chances = memory.degrees(RED), memory.predict_proba_one(RED)
    memory.deny_one(RED, "red")
    after = memory.degrees(RED)
    assert after["red"] < 0.5 < before["red"]
    assert {**after, "red": 0} == {**before, "red": 0}
    assert memory.degrees(BLUE) == pytest.approx(ColourMemory(xkcd()).degrees(BLUE))
    fewer = memory.predict_proba_one(RED)
    assert fewer["red"] < 0.5 * chances["red"]
    assert {**fewer, "red": 0} == {**chances, "red": 0}


def test_a_new_word_is_denied_too_but_not_known_by_that() -> None:
    memory = ColourMemory()
    memory.deny_one(RED, "zap", key="no")
    assert memory.labels == ()
    assert memory.degrees(RED) == memory.predict_proba_one(RED) == {}
    memory.learn_one(ORANGE, "zap")
    assert memory.degrees(RED)["zap"] < memory.degrees(ORANGE)["zap"]
    memory.forget("no")
    assert memory.degrees(ORANGE)["zap"] == pytest.approx(1)


@given(taught=lessons, x=palettes, word=st.sampled_from(["red", "zap"]))
def test_a_denial_is_forgotten_to_the_last_bit(
    taught: list[tuple[Palette, str]], x: Palette, word: str
) -> None:
    memory = ColourMemory(xkcd())
    for palette, said in taught:
        memory.learn_one(palette, said)
    before = memory.degrees(x), memory.predict_proba_one(x)
    for teach in (memory.deny_one, memory.learn_one):
        teach(x, word, key="more")
        degrees, chances = memory.degrees(x), memory.predict_proba_one(x)
        assert all(0 <= p <= 1 for p in [*degrees.values(), *chances.values()])
        assert sum(chances.values()) <= 1 + 1e-9
        memory.forget("more")
        assert (memory.degrees(x), memory.predict_proba_one(x)) == before


def test_the_nearest_lesson_in_a_colour_is_of_the_likest_colours() -> None:
    memory = ColourMemory(xkcd())
    assert memory.nearest(RED, "red") is None
    memory.learn_one(ORANGE, "red", key=1)
    memory.learn_one(RED, "red", key=2)
    assert memory.nearest(plain(lab_of([210, 30, 35])), "red") == 2
    assert memory.knows("red")
    assert not memory.knows("zap")
