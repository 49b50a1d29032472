"""Whose left is it? What the robot asks about perspectives, and what it does then."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from kille.dialogue.meanings import denial, predicate_at, value_at

Scenes = Callable[..., Any]

KNOWN = {
    ("cup", "o1"): 0.9,
    ("car", "o2"): 0.9,
    ("to_the_left_of", "o1", "o2"): 0.9,
    ("in_front_of", "o1", "o2", "faces_left"): 0.9,
    ("in_front_of", "o3", "o2"): 0.9,
    ("to_the_left_of", "o3", "o2", "faces_left"): 0.9,
    ("cup", "o3"): 0.9,
    ("is_red", "o1"): 0.9,
    ("is_blue", "o3"): 0.9,
}
WORDS = {
    "nouns": ["cup", "car"],
    "adjectives": ["red", "blue"],
    "relations": ["to the left of", "in front of"],
}
WHOSE = "As I see it, or as the car sees it?"
LEFT, FRONT = "The cup is to the left of the car.", "The cup is in front of the car."


@pytest.fixture
def table(scene: Scenes) -> Any:
    """A red cup to the left of a car; the car faces left, towards the cup."""
    robot = scene(3, known=KNOWN, **WORDS)
    assert robot.hear("Where is the red cup?") == LEFT
    assert robot.hear("The car faces left.") == "OK."
    return robot


def test_facing_is_kept(table: Any) -> None:
    (turned,) = table.state.shared.turned
    assert (turned.x, turned.front) == ("o2", "faces_left")


@pytest.mark.parametrize(
    ("text", "front"),
    [
        ("The car faces left.", "faces_left"),
        ("The car is turned to the right.", "faces_right"),
        ("The car is facing away.", "faces_away"),
        ("The car faces you.", "faces_towards"),
        ("The car looks towards me.", "faces_towards"),
    ],
)
def test_ways_to_face(scene: Scenes, text: str, front: str) -> None:
    robot = scene(3, known=KNOWN, **WORDS)
    robot.hear(text)
    assert [it.front for it in robot.state.shared.turned] == [front]


def test_facing_another_way_replaces_it(table: Any) -> None:
    table.hear("The car faces you.")
    assert [it.front for it in table.state.shared.turned] == ["faces_towards"]


@pytest.mark.parametrize(
    ("answer", "frame", "said"),
    [
        ("As you see it.", "viewer", LEFT),
        ("As I see it.", "viewer", LEFT),
        ("Mine.", "viewer", LEFT),
        ("From here.", "viewer", LEFT),
        ("As the car sees it.", "landmark", FRONT),
        ("From the car.", "landmark", FRONT),
        ("From the car's side.", "landmark", FRONT),
        ("I mean the car's left.", "landmark", FRONT),
        ("The car's left.", "landmark", FRONT),
        ("Its left.", "landmark", FRONT),
    ],
)
def test_whose_perspective(table: Any, answer: str, frame: str, said: str) -> None:
    assert table.hear("Where is the red cup?") == WHOSE
    assert len(table.state.shared.qud) == 1
    assert table.hear(answer) == said
    assert table.state.shared.frame == frame
    assert table.state.shared.qud == ()
    assert table.hear("Where is the red cup?") == said


def test_not_asked_where_it_does_not_matter(scene: Scenes) -> None:
    known = {**KNOWN, ("to_the_left_of", "o1", "o2", "faces_away"): 0.9}
    robot = scene(3, known=known, **WORDS)
    robot.hear("The car faces away.")
    assert robot.hear("Where is the red cup?") == LEFT


def test_a_correction_is_answered_anew(table: Any) -> None:
    table.hear("Where is the red cup?")
    table.hear("As you see it.")
    assert table.hear("No, I mean the car's left.") == FRONT
    assert table.hear("No, from here.") == LEFT
    assert table.hear("Where is the red cup?") == LEFT


def test_another_game_leaves_it_open(table: Any) -> None:
    table.hear("From the car.")
    assert table.state.shared.frame == "landmark"
    table.hear("Where is the red cup?")
    assert table.state.shared.frame == "landmark"
    table.hear("What is this?")
    assert table.state.shared.frame == ""
    assert table.hear("Where is the red cup?") == WHOSE


def test_what_faces_no_way_is_stood_beside_as_the_viewer_sees_it(scene: Scenes) -> None:
    known = {**KNOWN, ("to_the_right_of", "o2", "o1"): 0.9}
    relations = ["to the right of", *WORDS["relations"]]
    robot = scene(3, known=known, **{**WORDS, "relations": relations})
    robot.hear("The car faces left.")
    robot.hear("From the car.")
    assert robot.state.shared.frame == "landmark"
    assert robot.hear("Where is the car?") == "The car is to the right of the cup."


def test_asked_for_every_lesson_of_a_relation(table: Any) -> None:
    assert table.hear("The red cup is near the car.") == WHOSE
    assert table.state.private.lessons == ()
    table.hear("As the car sees it.")
    (lesson,) = table.state.private.lessons
    assert str(lesson.content["frame"]) == "Front@faces_left"


def test_a_lesson_is_learned_anew_in_the_other_perspective(table: Any) -> None:
    table.hear("The red cup is near the car.")
    table.hear("As you see it.")
    assert "near" in table.hear("No, the car's left.")
    (lesson,) = table.state.private.lessons
    assert str(lesson.content["frame"]) == "Front@faces_left"
    (agreed,) = table.state.shared.commitments
    assert agreed == lesson.content


@pytest.mark.parametrize(
    ("question", "as_it_sees_it", "as_the_car_sees_it"),
    [
        ("Is the red cup to the left of the car?", "Yes", "No"),
        ("Is the blue cup to the left of the car?", "No", "Yes"),
    ],
)
def test_whose_is_asked_whichever_says_yes(
    table: Any, question: str, as_it_sees_it: str, as_the_car_sees_it: str
) -> None:
    assert table.hear(question) == WHOSE
    assert table.hear("As you see it.").startswith(as_it_sees_it)
    assert table.hear("No, as the car sees it.").startswith(as_the_car_sees_it)


def test_a_question_whose_answer_depends_on_it(table: Any) -> None:
    assert table.hear("Is the red cup to the left of the car?") == WHOSE
    table.hear("From the car.")
    assert table.state.shared.frame == "landmark"


def test_a_phrase_that_depends_on_it(table: Any) -> None:
    assert table.hear("What is the cup to the left of the car?") == WHOSE
    assert table.hear("As the car sees it.") == "This is a cup."
    assert table.state.shared.salient[0] == "o3"
    assert table.state.shared.frame == "landmark"


def test_something_else_drops_the_question(table: Any) -> None:
    table.hear("Where is the red cup?")
    assert table.hear("What is this?") == "This is a cup."
    assert table.state.shared.qud == ()


def test_a_correction_waits_for_the_perspective(table: Any) -> None:
    """What the robot had claimed is still what is corrected."""
    table.hear("Where is the red cup?")
    table.hear("As you see it.")
    table.hear("What is this?")
    table.hear("Where is the red cup?")
    table.hear("From the car.")
    assert len(table.state.shared.pending) == 1
    table.hear("No, it is near the car.")
    rejected, right = table.state.private.lessons
    assert "~in_front_of" in str(rejected.content)
    assert str(right.content["frame"]) == "Front@faces_left"


@pytest.mark.parametrize("answer", ["Yes.", "That is correct."])
def test_yes_is_no_answer_to_whose(table: Any, answer: str) -> None:
    """Nothing is learned by it: neither of two was agreed to."""
    table.hear("Where is the red cup?")
    table.hear(answer)
    assert table.state.private.lessons == ()
    assert table.state.shared.qud == ()


def test_no_front_is_known(scene: Scenes) -> None:
    robot = scene(3, known=KNOWN, **WORDS)
    said = robot.hear("As the car sees it.")
    assert said == "I do not know which way the car faces."
    assert robot.state.shared.frame == ""


def test_what_was_denied_of_a_place_is_denied_in_the_other_perspective(
    scene: Scenes,
) -> None:
    robot = scene(3, known=KNOWN, nouns=["cup", "car"], adjectives=["red", "blue"])
    robot.hear("The car faces left.")
    robot.hear("No, the red cup is not to the left of the car.")
    said = robot.hear("From your side.")
    assert said == 'OK, this relation is not called "to the left of".'
    assert robot.hear("From its side.") == said
    (lesson,) = robot.state.private.lessons
    assert predicate_at(denial(lesson.content), "rel").name == "to_the_left_of"
    assert value_at(lesson.content, "frame") == "faces_left"


def test_whose_is_asked_by_the_best_word_of_many(scene: Scenes) -> None:
    """To both the worst one is the same."""
    words = {**WORDS, "relations": ["to the left of", "in front of", "under"]}
    robot = scene(3, known=KNOWN, **words)
    robot.hear("The car faces left.")
    assert robot.hear("Where is the red cup?") == WHOSE
