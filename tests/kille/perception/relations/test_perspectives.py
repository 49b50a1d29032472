"""Perspectives: left and right are whose they are, and a thing's front is in front."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.perception.relations import RelationMemory
from kille.perception.relations.perspectives import AWAY, FRONTS, seen_from
from kille.scene import Configuration

metres = st.floats(-2, 2)
stands = st.builds(
    Configuration,
    st.tuples(metres, metres, metres),
    viewed=st.none() | st.tuples(metres, metres, metres),
    others=st.lists(st.tuples(metres, metres, metres), max_size=2).map(tuple),
    heading=st.none() | st.floats(-3, 3),
)

LEFT, NEARER = (-0.3, 0.0, 0.0), (0.0, -0.3, 0.0)


@given(stands)
def test_the_viewers_own_perspective_changes_nothing(stand: Configuration) -> None:
    assert seen_from(stand, AWAY) is stand


@given(stands, st.sampled_from(sorted(FRONTS)))
def test_nothing_moves_nearer_or_higher(stand: Configuration, front: str) -> None:
    seen = seen_from(stand, front)
    for then, now in zip(
        (stand.offset, *stand.others), (seen.offset, *seen.others), strict=True
    ):
        assert math.hypot(*now) == pytest.approx(math.hypot(*then))
        assert now[2] == then[2]
    assert (seen.contact, seen.landmark_size) == (stand.contact, stand.landmark_size)


@given(stands)
def test_to_turn_around_twice_is_to_be_back(stand: Configuration) -> None:
    offset = seen_from(seen_from(stand, "towards"), "towards").offset
    assert offset == pytest.approx(stand.offset)
    for there, back in (("left", "right"), ("right", "left")):
        offset = seen_from(seen_from(stand, there), back).offset
        assert offset == pytest.approx(stand.offset)


@pytest.mark.parametrize("front", sorted(FRONTS))
def test_a_heading_turns_with_the_rest(front: str) -> None:
    towards = 0.3
    offset = math.cos(towards), math.sin(towards), 0.0
    seen = seen_from(Configuration(offset, heading=towards), front)
    assert seen.heading is not None
    right, away, _ = seen.offset
    assert (right, away) == pytest.approx(
        (math.cos(seen.heading), math.sin(seen.heading))
    )


# Where something stands to a thing, as the viewer has it, and in which perspective.
@pytest.mark.parametrize(
    ("offset", "front", "word"),
    [
        ((0.3, 0.0, 0.0), "towards", "left"),
        ((0.0, 0.3, 0.0), "towards", "in_front"),
        ((0.0, -0.3, 0.0), "left", "left"),
        ((0.3, 0.0, 0.0), "left", "in_front"),
        ((0.0, -0.3, 0.0), "faces_left", "left"),
        ((-0.3, 0.0, 0.0), "faces_left", "in_front"),
        ((0.0, 0.3, 0.0), "faces_right", "left"),
        ((0.3, 0.0, 0.0), "faces_right", "in_front"),
        ((0.3, 0.0, 0.0), "faces_towards", "left"),
        ((0.0, -0.3, 0.0), "faces_towards", "in_front"),
        ((-0.3, 0.0, 0.0), "faces_away", "left"),
        ((0.0, 0.3, 0.0), "faces_away", "in_front"),
    ],
)
def test_words_of_the_viewer_hold_in_other_perspectives(
    offset: tuple[float, float, float], front: str, word: str
) -> None:
    memory = RelationMemory()
    for n in (0.8, 1.0, 1.2):
        memory.learn_one(Configuration(tuple(n * it for it in LEFT)), "left")
        memory.learn_one(Configuration(tuple(n * it for it in NEARER)), "in_front")
    degrees = memory.degrees(seen_from(Configuration(offset), front))
    other = "left" if word == "in_front" else "in_front"
    assert degrees[word] > 0.6
    assert degrees[other] < 0.3


def test_an_unknown_perspective_is_none() -> None:
    with pytest.raises(KeyError):
        seen_from(Configuration(LEFT), "sideways")
