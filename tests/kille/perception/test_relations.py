"""Spatial words: the laws of a learner, the paper's places, open words."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.perception.learners import check_learner
from kille.perception.relations import RelationMemory

Offset = tuple[float, float, float]

DIRECTIONS = {
    "to the right of": (1, 0),
    "behind": (0, 1),
    "to the left of": (-1, 0),
    "in front of": (0, -1),
}


def places(jitter: float, seed: int) -> list[Offset]:
    """Two rings of eight places around a landmark, as in the paper's experiment."""
    chance = np.random.default_rng(seed)
    angles = np.radians(np.arange(0, 360, 45))
    return [
        (r * np.cos(a) + dx, r * np.sin(a) + dy, 0.0)
        for r in (0.12, 0.28)
        for a in angles
        for dx, dy in [chance.normal(0, jitter, 2)]
    ]


def acceptable(offset: Offset) -> set[str]:
    """The words whose direction is within 60 degrees of the offset's."""
    here = np.array(offset[:2]) / np.hypot(*offset[:2])
    return {word for word, way in DIRECTIONS.items() if here @ np.array(way) > 0.5}


def said(offset: Offset, chance: np.random.Generator) -> str:
    return str(chance.choice(sorted(acceptable(offset))))


def taught(seed: int) -> RelationMemory:
    memory, chance = RelationMemory(), np.random.default_rng(seed)
    for round_ in range(3):
        for i, offset in enumerate(places(0.02, 10 * seed + round_)):
            memory.learn_one(offset, said(offset, chance), key=f"{round_}.{i}")
    return memory


def best(degrees: dict[str, float]) -> str:
    return max(degrees, key=lambda word: degrees[word])


EXAMPLES: list[tuple[Offset, str]] = [
    ((0.2, 0.0, 0.0), "right"),
    ((-0.2, 0.02, 0.0), "left"),
    ((0.15, 0.05, 0.0), "right"),
    ((0.0, 0.2, 0.0), "behind"),
    ((0.02, 0.0, 0.2), "on"),
]


def test_the_laws_of_a_learner() -> None:
    check_learner(RelationMemory, EXAMPLES)


def test_a_copy_knows_the_same_and_learns_for_itself() -> None:
    memory = taught(1)
    place = (0.2, 0.0, 0.0)
    degrees = memory.predict_proba_one(place)
    twin = memory.copy()
    assert twin.predict_proba_one(place) == degrees
    twin.learn_one((0.0, 0.0, 0.3), "above", key="new")
    assert best(twin.predict_proba_one((0.0, 0.0, 0.3))) == "above"
    assert "above" not in memory.labels
    assert memory.predict_proba_one(place) == degrees


@pytest.mark.parametrize("seed", range(5))
def test_most_answers_are_acceptable_after_48_lessons(seed: int) -> None:
    memory = taught(seed)
    asked = places(0.02, 700 + seed) + places(0.02, 800 + seed)
    right = [best(memory.predict_proba_one(it)) in acceptable(it) for it in asked]
    assert len(right) == 32
    assert np.mean(right) >= 0.8


def test_words_for_the_same_places_share_the_degree() -> None:
    memory = RelationMemory()
    for key, word in enumerate(["left", "beside", "left", "beside"]):
        memory.learn_one((-0.2, 0.0, 0.0), word, key=key)
    degrees = memory.predict_proba_one((-0.2, 0.0, 0.0))
    assert degrees == pytest.approx({"left": 0.5, "beside": 0.5}, abs=0.05)


def test_one_word_fits_where_it_was_heard_and_less_elsewhere() -> None:
    memory = RelationMemory()
    memory.learn_one((-0.2, 0.0, 0.0), "left", key=0)
    assert memory.predict_proba_one((-0.2, 0.0, 0.0)) == {"left": 1.0}
    assert memory.predict_proba_one((-0.18, 0.03, 0.0))["left"] > 0.9
    assert memory.predict_proba_one((0.2, 0.0, 0.0))["left"] < 0.2


@given(st.floats(0.8, 3.0), st.floats(0, 6.28))
def test_far_from_all_that_was_heard_no_word_fits(far: float, angle: float) -> None:
    degrees = taught(0).predict_proba_one(
        (far * np.cos(angle), far * np.sin(angle), 0.0)
    )
    assert sum(degrees.values()) < 0.1


def test_labels_are_the_words_that_are_still_known() -> None:
    memory = RelationMemory()
    for key, (offset, word) in enumerate(EXAMPLES):
        memory.learn_one(offset, word, key=key)
    assert memory.labels == ("behind", "left", "on", "right")
    memory.forget(1)
    assert memory.labels == ("behind", "on", "right")


def test_a_learner_that_breaks_a_law_is_found_out() -> None:
    class Stubborn(RelationMemory):
        def forget(self, key: object) -> None:
            pass

    class Boastful(RelationMemory):
        def predict_proba_one(self, x: Offset) -> dict[str, float]:
            return dict.fromkeys(super().predict_proba_one(x), 1.0)

    with pytest.raises(AssertionError, match="never been learned"):
        check_learner(Stubborn, EXAMPLES)
    with pytest.raises(AssertionError, match="sum to 1"):
        check_learner(Boastful, EXAMPLES)
    with pytest.raises(ValueError, match="two words"):
        check_learner(RelationMemory, EXAMPLES[:1])
