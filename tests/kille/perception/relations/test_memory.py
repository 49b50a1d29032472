"""Spatial words by templates: what is learned, from how little, and how surely."""

from __future__ import annotations

import math
import re
import time
from base64 import b64decode
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kille.perception.learners import check_learner
from kille.perception.relations import AngleRule, PaperRelations, RelationMemory
from kille.scene import Configuration
from rich_values import check_html

WAYS = {
    "till höger om": (1, 0),
    "bakom": (0, 1),
    "zap": (-1, 0),
    "in front of": (0, -1),
}
"""A tutor may call the sides what they like."""

ODD = [
    Configuration((math.nan, 0, 0)),
    Configuration((math.inf, 0, 0)),
    Configuration((0, 0, 0)),
    Configuration((0.1, 0, 0), viewed=(0, 0, 1)),
    Configuration((0.1, 0, 0), viewed=(math.nan, 0, 1)),
    Configuration((0.1, 0, 0), target_size=0.0, landmark_size=math.nan),
    Configuration((0.1, 0, 0), target_size=-1.0),
    Configuration((0.1, 0, 0), target_size=math.inf),
    Configuration((0.1, 0, 0), others=((math.nan, 0, 0), (0, 0, 0), (0.1, 0, 0))),
    Configuration((1e9, 0, 0)),
    Configuration((1e-12, 0, 0)),
    Configuration((0.1, 0, 0), heading=math.nan, contact=math.nan, support=2.0),
    Configuration((1e300, -1e155, 0.1), target_size=5e-324, landmark_size=1e300),
    Configuration((1e-170, 0, 0), others=((1e300, 0, 0), (1e-300, 0, 0))),
]


def at(right: float, away: float, up: float = 0.0) -> Configuration:
    return Configuration((right, away, up), target_size=0.15, landmark_size=0.15)


def around(
    bearing: float, far: float, chance: np.random.Generator | None = None
) -> Configuration:
    turn = 0.0 if chance is None else chance.normal(0, 0.3)
    return at(far * math.cos(bearing + turn), far * math.sin(bearing + turn))


def said(word: str, count: int, chance: np.random.Generator) -> list[Configuration]:
    right, away = WAYS[word]
    return [
        around(math.atan2(away, right), chance.uniform(0.1, 0.4), chance)
        for _ in range(count)
    ]


def taught(lessons: int, seed: int = 0) -> RelationMemory:
    chance, memory = np.random.default_rng(seed), RelationMemory()
    for word in WAYS:
        for x in said(word, lessons, chance):
            memory.learn_one(x, word)
    return memory


def best(degrees: dict[str, float]) -> str:
    return max(degrees, key=lambda word: degrees[word])


EXAMPLES = [
    (at(0.2, 0.0), "right"),
    (at(-0.2, 0.02), "left"),
    (at(0.15, 0.05), "right"),
    (at(0.0, 0.2), "behind"),
    (Configuration((0.02, 0, 0.1), contact=0.9, support=1.0, containment=0.0), "on"),
]


@pytest.mark.parametrize("make", [RelationMemory, PaperRelations, AngleRule])
def test_the_laws_of_a_learner(make: type[RelationMemory]) -> None:
    check_learner(make, EXAMPLES)


def test_a_copy_knows_the_same_and_learns_for_itself() -> None:
    memory = taught(2)
    place = at(0.2, 0.0)
    degrees = memory.predict_proba_one(place)
    twin = memory.copy()
    assert twin.predict_proba_one(place) == degrees
    for _ in range(3):
        twin.learn_one(at(0.0, 0.0, 0.3), "above")
    assert best(twin.predict_proba_one(at(0.0, 0.0, 0.3))) == "above"
    assert "above" not in memory.labels
    assert memory.predict_proba_one(place) == degrees


@pytest.mark.parametrize("word", WAYS)
def test_two_lessons_of_each_side_tell_the_sides_apart(word: str) -> None:
    memory, (right, away) = taught(2), WAYS[word]
    for far in (0.1, 0.2, 0.5):
        assert best(memory.degrees(at(far * right, far * away))) == word


def test_a_word_fits_the_less_the_farther_off_its_direction() -> None:
    memory = taught(4)
    degrees = [
        memory.degrees(around(math.radians(turn), 0.25))["till höger om"]
        for turn in range(0, 181, 20)
    ]
    assert degrees[:6] == sorted(degrees[:6], reverse=True)
    assert degrees[0] > 0.7
    assert max(degrees[6:]) < 0.1


def test_the_side_of_a_place_never_heard_of_is_known() -> None:
    """One place, and the word fits to the right of any landmark, not only there."""
    memory = RelationMemory()
    memory.learn_one(at(0.2, 0.0), "right")
    memory.learn_one(at(-0.2, 0.0), "left")
    memory.learn_one(at(0.0, 0.2), "behind")
    degrees = memory.degrees(at(0.3, 0.1))
    assert degrees["right"] > 0.5
    assert degrees["right"] > 2 * max(degrees["left"], degrees["behind"])


def test_several_words_may_hold_at_once() -> None:
    chance = np.random.default_rng(3)
    memory = taught(6)
    for bearing in chance.uniform(-math.pi, math.pi, 12):
        memory.learn_one(around(bearing, chance.uniform(0.08, 0.14)), "near")
    close = memory.degrees(at(-0.12, 0.0))
    far = memory.degrees(at(-0.4, 0.0))
    assert close["zap"] > 0.7
    assert close["near"] > 0.7
    assert far["zap"] > 0.7
    assert far["near"] < 0.3
    assert sum(memory.predict_proba_one(at(-0.12, 0.0)).values()) <= 1


def test_sizes_matter_for_near() -> None:
    memory, chance = taught(4), np.random.default_rng(3)
    for bearing in chance.uniform(-math.pi, math.pi, 12):
        memory.learn_one(around(bearing, chance.uniform(0.1, 0.2)), "near")
    cups = Configuration((0.6, 0, 0), target_size=0.15, landmark_size=0.15)
    chairs = Configuration((0.6, 0, 0), target_size=0.8, landmark_size=0.8)
    assert memory.degrees(chairs)["near"] > memory.degrees(cups)["near"] + 0.3


def test_a_word_for_a_landmarks_own_front_is_understood() -> None:
    """Taught of cars that face anywhere, it follows the car and not the viewer."""
    memory, chance = RelationMemory(), np.random.default_rng(5)
    for _ in range(12):
        front, far = chance.uniform(-math.pi, math.pi), chance.uniform(0.15, 0.35)
        place = (far * math.cos(front), far * math.sin(front), 0.0)
        memory.learn_one(Configuration(place, heading=front), "before")
    ahead = Configuration((0, 0.2, 0), heading=math.pi / 2)
    behind = Configuration((0, 0.2, 0), heading=-math.pi / 2)
    assert memory.degrees(ahead)["before"] > 0.8
    assert memory.degrees(behind)["before"] < 0.2


def test_held_words_are_told_by_contact_and_support() -> None:
    memory = taught(3)
    for share in (0.7, 0.8, 0.9, 1.0):
        borne = Configuration((0, 0, 0.1), contact=1.0, support=share, containment=0.0)
        inside = Configuration(
            (0, 0, 0.02), contact=1.0, support=1.0, containment=share
        )
        memory.learn_one(borne, "on")
        memory.learn_one(inside, "in")
        memory.judge_one(inside, "on", 0.0)
    over = Configuration((0, 0, 0.1), contact=0.0, support=0.0, containment=0.0)
    borne = Configuration((0.01, 0, 0.1), contact=1.0, support=0.9, containment=0.0)
    inside = Configuration((0, 0, 0.03), contact=1.0, support=1.0, containment=0.9)
    assert memory.degrees(borne)["on"] > 0.6 > memory.degrees(over)["on"]
    assert memory.degrees(inside)["in"] > 0.6 > memory.degrees(over)["in"]


def test_a_quarter_of_the_lessons_may_be_grossly_wrong() -> None:
    chance, memory = np.random.default_rng(7), RelationMemory()
    for word in WAYS:
        for i, x in enumerate(said(word, 12, chance)):
            stray = at(*chance.uniform(-0.4, 0.4, 2))
            memory.learn_one(stray if i % 4 == 0 else x, word)
    for word, (right, away) in WAYS.items():
        assert best(memory.degrees(at(0.25 * right, 0.25 * away))) == word


def test_no_is_learned_from() -> None:
    memory = RelationMemory()
    for bearing in (0.0, 1.5, 3.0, -1.5):
        memory.learn_one(around(bearing, 0.2), "near")
    before = memory.degrees(at(0.5, 0.0))["near"]
    memory.judge_one(at(0.5, 0.0), "near", 0.0)
    memory.judge_one(at(0.0, -0.5), "near", 0.0)
    assert memory.degrees(at(0.5, 0.0))["near"] < min(before, 0.2)
    assert memory.degrees(at(0.2, 0.0))["near"] > 0.4
    with pytest.raises(ValueError, match="degree"):
        memory.judge_one(at(0.5, 0.0), "near", math.nan)


@settings(max_examples=40)
@given(
    st.sampled_from(sorted(WAYS)),
    st.floats(0.05, 1.5),
    st.floats(-math.pi, math.pi),
    st.integers(1, 4),
)
def test_a_no_weakens_that_word_there_and_is_forgotten_exactly(
    word: str, far: float, bearing: float, lessons: int
) -> None:
    """Also beyond all that was heard: a denial never makes a word fit better."""
    memory, place = taught(lessons), around(bearing, far)
    asked = [place, *(at(0.25 * right, 0.25 * away) for right, away in WAYS.values())]
    before = [memory.degrees(x) for x in asked]
    memory.judge_one(place, word, 0.0, key="no")
    after = [memory.degrees(x) for x in asked]
    assert after[0][word] < before[0][word]
    for old, new in zip(before, after, strict=True):
        assert {**new, word: old[word]} == old
    memory.forget("no")
    assert [memory.degrees(x) for x in asked] == before


def test_a_correction_is_a_no_and_a_lesson() -> None:
    """ "No, it is behind the book": not left there, and behind."""
    memory, place = taught(3), around(math.radians(140), 0.25)
    before = memory.degrees(place)
    assert best(before) == "zap"
    memory.judge_one(place, "zap", 0.0, key="no")
    memory.learn_one(place, "bakom", key="behind")
    after = memory.degrees(place)
    assert after["zap"] < before["zap"] - 0.2
    assert after["bakom"] > before["bakom"]
    assert best(memory.predict_proba_one(place)) == "bakom"
    memory.forget("behind")
    memory.forget("no")
    assert memory.degrees(place) == before


def test_words_for_the_same_places_share_the_choice() -> None:
    memory = taught(4)
    for x in said("zap", 4, np.random.default_rng(0)):
        memory.learn_one(x, "left")
    shares = memory.predict_proba_one(at(-0.25, 0.0))
    assert shares["zap"] == pytest.approx(shares["left"], abs=0.15)
    assert memory.degrees(at(-0.25, 0.0))["left"] > 0.8


def test_one_word_fits_best_where_it_was_heard() -> None:
    memory = RelationMemory()
    memory.learn_one(at(-0.2, 0.0), "left")
    here, other = memory.degrees(at(-0.2, 0.0)), memory.degrees(at(0.2, 0.0))
    assert here["left"] > 0.5
    assert here["left"] > 2 * other["left"]


@given(st.floats(1.6, 30.0), st.floats(0, 6.28))
def test_far_from_all_that_was_heard_no_word_fits(far: float, angle: float) -> None:
    assert sum(taught_once().degrees(around(angle, far)).values()) < 0.2


def taught_once(made: list[RelationMemory] = []) -> RelationMemory:  # noqa: B006
    if not made:
        made.append(taught(4))
    return made[0]


def test_labels_are_the_words_that_are_still_known() -> None:
    memory = RelationMemory()
    for key, (x, word) in enumerate(EXAMPLES):
        memory.learn_one(x, word, key=key)
    assert memory.labels == ("behind", "left", "on", "right")
    memory.forget(1)
    assert memory.labels == ("behind", "on", "right")


@pytest.mark.parametrize("make", [RelationMemory, PaperRelations, AngleRule])
def test_whatever_is_heard_the_degrees_are_degrees(make: type[RelationMemory]) -> None:
    learner = make()
    for word in ("a", "b"):
        for x in ODD:
            learner.learn_one(x, word)
            for asked in (*ODD, at(0.2, 0.1)):
                degrees = learner.predict_proba_one(asked)
                assert all(0 <= it <= 1 for it in degrees.values())
                assert sum(degrees.values()) <= 1 + 1e-6


def test_contradictory_lessons_leave_doubt() -> None:
    memory = RelationMemory()
    for word in ("left", "right"):
        for _ in range(5):
            memory.learn_one(at(0.2, 0.0), word)
    shares = memory.predict_proba_one(at(0.2, 0.0))
    assert shares["left"] == pytest.approx(shares["right"])


def test_thousands_of_lessons_stay_quick() -> None:
    memory, chance = RelationMemory(), np.random.default_rng(0)
    places = chance.normal(0, 0.2, (1500, 3))
    start = time.process_time()
    for i, place in enumerate(places):
        right, away, up = place.tolist()
        memory.learn_one(Configuration((right, away, up)), f"word {i % 12}")
        if i % 10 == 0:
            memory.degrees(at(0.1, 0.1))
    assert (time.process_time() - start) / len(places) < 0.02


def test_the_angle_rule_can_be_told_what_a_word_is_about() -> None:
    blind, told = AngleRule(), AngleRule({"left": "left"})
    for rule in (blind, told):
        rule.learn_one(at(-0.2, 0.1), "left")
        rule.learn_one(at(-0.1, 0.3), "behind")
    assert told.degrees(at(-0.3, 0.0))["left"] > 0.5 > told.degrees(at(0, 0.3))["left"]


def test_the_papers_way_has_an_answer_everywhere() -> None:
    paper = PaperRelations()
    for word, (right, away) in WAYS.items():
        paper.learn_one(at(0.2 * right, 0.2 * away), word)
    for far in (0.1, 5.0):
        degrees = paper.predict_proba_one(at(0.0, far))
        assert best(degrees) == "bakom"
        assert sum(degrees.values()) == pytest.approx(1.0)


def test_a_lesson_that_cannot_be_taken_leaves_nothing_behind() -> None:
    memory = taught(2)
    before = memory.degrees(at(0.2, 0.0))
    with pytest.raises(TypeError):
        memory.learn_one(Configuration(None), "left", key="odd")  # type: ignore[arg-type]
    with pytest.raises(KeyError):
        memory.forget("odd")
    assert memory.degrees(at(0.2, 0.0)) == before


# --- forgetting, asking of many, reasons ----------------------------------------------

stands = st.builds(
    Configuration,
    st.tuples(*[st.floats(-0.5, 0.5)] * 3),
    viewed=st.just((0.0, 1.0, -0.4)),
    contact=st.none() | st.floats(0, 1),
)
told = st.tuples(stands, st.sampled_from(["near", "left"]), st.booleans())


def teach(
    memory: RelationMemory, x: Configuration, word: str, holds: bool, key: object
) -> None:
    if holds:
        memory.learn_one(x, word, key=key)
    else:
        memory.judge_one(x, word, 0.0, key=key)


@given(before=st.lists(told, max_size=5), more=told, asked=stands)
def test_to_forget_is_exact_to_the_last_bit(
    before: list[tuple[Configuration, str, bool]],
    more: tuple[Configuration, str, bool],
    asked: Configuration,
) -> None:
    memory = RelationMemory()
    for key, lesson in enumerate(before):
        teach(memory, *lesson, key)
    then = memory.degrees(asked), memory.predict_proba_one(asked)
    kept = memory.copy()
    teach(memory, *more, "more")
    memory.forget("more")
    assert (memory.degrees(asked), memory.predict_proba_one(asked)) == then
    if before:
        memory.forget(0)
        memory.become(kept)
        assert (memory.degrees(asked), memory.predict_proba_one(asked)) == then


@given(before=st.lists(told, max_size=4), asked=st.lists(stands, max_size=4))
def test_many_are_judged_as_each_of_them(
    before: list[tuple[Configuration, str, bool]], asked: list[Configuration]
) -> None:
    memory = RelationMemory()
    for key, lesson in enumerate(before):
        teach(memory, *lesson, key)
    together = memory.degrees_of(asked)
    assert len(together) == len(asked)
    for degrees, x in zip(together, asked, strict=True):
        assert degrees == pytest.approx(memory.degrees(x), abs=1e-6)


def test_the_nearest_lesson_is_so_in_what_the_word_means() -> None:
    memory = RelationMemory()
    near, far = Configuration((-0.1, 0.0, 0.0)), Configuration((0.0, 0.5, 0.0))
    memory.judge_one(Configuration((-0.5, 0.0, 0.0)), "near", 0.0, key="no")
    assert memory.nearest(near, "near") is None
    memory.learn_one(far, "near", key="far")
    memory.learn_one(near, "near", key="near")
    assert memory.nearest(Configuration((0.1, 0.0, 0.0)), "near") == "near"
    assert memory.nearest(Configuration((0.1, 0.6, 0.0)), "near") == "far"
    with pytest.raises(KeyError):
        memory.nearest(near, "left")


def test_a_notebook_shows_where_words_hold() -> None:
    memory = RelationMemory()
    assert "knows no spatial word" in memory._repr_html_()
    for word, (right, away) in WAYS.items():
        memory.learn_one(at(0.3 * right, 0.3 * away), word)
    shown = memory._repr_html_()
    check_html(shown)
    pictures = re.findall(r'svg\+xml;base64,([^"]*)" alt="where “([^”]+)” ', shown)
    assert [word for _, word in pictures] == sorted(WAYS)
    for drawn, word in pictures:
        squares = ElementTree.fromstring(b64decode(drawn)).findall(
            ".//*[@fill-opacity]"
        )
        strongest = max(squares, key=lambda it: float(it.get("fill-opacity", 0)))
        x, y = (
            float(strongest.get("x", 0)) - 34 - 96,
            18 + 96 - float(strongest.get("y", 0)),
        )
        assert x * WAYS[word][0] + y * WAYS[word][1] > 0
    for number in range(20):
        memory.learn_one(at(0.3, 0.0), f"word {number}")
    assert "… 12 more" in memory._repr_html_()
