"""Yes/no questions, colours, finding, listing, counting, and saying it again."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from kille.dialogue.meanings import adjective, is_denial

Make = Callable[..., Any]

with_scenes = settings(suppress_health_check=[HealthCheck.function_scoped_fixture])

CUPS: dict[str, Any] = {"nouns": ("cup", "mug")}
COLOURS: dict[str, Any] = {
    "adjectives": ("red", "blue", "big"),
    "colours": (adjective("red"), adjective("blue")),
}

# --- is this a cup? ------------------------------------------------------------------


@pytest.mark.parametrize(
    ("cup", "mug", "answer"),
    [
        (0.9, 0.05, "Yes, this is a cup."),
        (0.6, 0.3, "Yes, this is a cup."),
        (0.6, 0.31, "Probably this is a cup."),
        (0.5, 0.45, "Probably this is a cup."),
        (0.05, 0.9, "No, I think this is a mug."),
        (0.25, 0.9, "I do not know."),
        (0.05, 0.3, "No, this is not a cup."),
        (0.1, 0.1, "No, this is not a cup."),
        (0.3, 0.2, "I do not know."),
    ],
)
def test_it_answers_as_certainly_as_it_is(
    scene: Make, cup: float, mug: float, answer: str
) -> None:
    robot = scene(**CUPS, known={("cup", "o1"): cup, ("mug", "o1"): mug})
    assert robot.hear("Is this a cup?") == answer


ORDER = ["No, I think", "No, this", "I do not know", "Probably", "Yes"]


@with_scenes
@given(low=st.floats(0, 1), high=st.floats(0, 1), mug=st.floats(0, 1))
def test_a_yes_needs_more_than_a_no(
    scene: Make, low: float, high: float, mug: float
) -> None:
    ranks = []
    for cup in sorted((low, high)):
        robot = scene(**CUPS, known={("cup", "o1"): cup, ("mug", "o1"): mug})
        said = robot.hear("Is this a cup?")
        ranks.append(next(n for n, it in enumerate(ORDER) if said.startswith(it)))
    assert max(ranks[0], 1) <= max(ranks[1], 1)


def test_a_yes_is_a_claim_that_can_be_confirmed_and_denied(scene: Make) -> None:
    known = {("cup", "o1"): 0.9}
    robot = scene(**CUPS, known=known)
    robot.hear("Is this a cup?")
    assert robot.hear("Yes.") == "OK, I learned a cup."
    robot.hear("Is this a cup?")
    assert robot.hear("No.") == "I see. Please tell me, then."


def test_a_no_is_a_claim_too(scene: Make) -> None:
    robot = scene(**CUPS, known={("cup", "o1"): 0.0})
    robot.hear("Is this a cup?")
    (claim,) = robot.state.shared.pending
    assert is_denial(claim)
    robot = scene(**CUPS, known={("mug", "o1"): 0.9})
    robot.hear("Is this a cup?")
    assert robot.hear("Yes.") == "OK, I learned a mug."


@pytest.mark.parametrize(
    ("text", "answer"),
    [
        (
            "Is this a unicorn?",
            "I have not learned what a unicorn is. Please show me one.",
        ),
        (
            "Is this striped?",
            'I have not learned what "striped" means. Please show me an example.',
        ),
        ("Is this red?", "Yes, it is red."),
        ("Is this blue?", "No, I think it is red."),
        ("Is this big?", "I do not know."),
        ("Is the cup red?", "Yes, the cup is red."),
    ],
)
def test_it_is_asked_how_things_are(scene: Make, text: str, answer: str) -> None:
    known = {("cup", "o1"): 0.9, ("is_red", "o1"): 0.8, ("is_big", "o1"): 0.4}
    robot = scene(nouns=("cup",), **COLOURS, known=known)
    assert robot.hear(text) == answer


PLACES: dict[str, Any] = {
    "things": 2,
    "nouns": ("book", "box"),
    "relations": ("to the left of", "to the right of"),
}
TWO = {("book", "o1"): 0.9, ("box", "o2"): 0.9}
LEFT = {("to_the_left_of", "o1", "o2"): 0.9}


@pytest.mark.parametrize(
    ("text", "answer"),
    [
        ("Is the book left of the box?", "Yes, the book is to the left of the box."),
        (
            "Is the book to the right of the box?",
            "No, I think the book is to the left of the box.",
        ),
        ("Is the box left of the book?", "No, the box is not to the left of the book."),
        (
            "Is the book above the box?",
            'I have not learned what "above" means. Please show me an example.',
        ),
    ],
)
def test_it_is_asked_where_things_are(scene: Make, text: str, answer: str) -> None:
    assert scene(**PLACES, known=TWO | LEFT).hear(text) == answer


def test_without_depth_it_cannot_tell_where_things_are(scene: Make) -> None:
    robot = scene(**PLACES, known=TWO | LEFT, placed=0)
    assert robot.acts("Is the book left of the box?") == ["need_depth"]


# --- what colour is this? ------------------------------------------------------------


@pytest.mark.parametrize(
    ("red", "blue", "act"),
    [
        (0.9, 0.0, "assert_quality"),
        (0.4, 0.3, "hedge_quality"),
        (0.3, 0.0, "guess_quality"),
        (0.1, 0.1, "admit_quality"),
    ],
)
def test_colours_are_said_as_certainly_as_they_are_known(
    scene: Make, red: float, blue: float, act: str
) -> None:
    known = {("is_red", "o1"): red, ("is_blue", "o1"): blue, ("is_big", "o1"): 1.0}
    robot = scene(**COLOURS, known=known)
    assert robot.acts("What colour is this?") == [act]
    assert len(robot.state.shared.pending) == {"h": 2, "a": 1, "g": 1}[act[0]] - (
        act == "admit_quality"
    )


# --- show me the cup -----------------------------------------------------------------


def test_it_points_at_what_it_finds(scene: Make) -> None:
    robot = scene(**PLACES, known=TWO | LEFT)
    assert robot.hear("Show me the book.") == (
        "This is the book: #1, to the left of the box."
    )
    assert robot.hear("Which one is the box?") == "This is the box: #2."
    assert robot.state.shared.latest.points == ("o2",)
    assert robot.state.view.focus == ("o2",)
    assert robot.hear("What is this?") == "This is a box."


def test_it_asks_which_one_and_finds_none(scene: Make) -> None:
    cups = {("cup", "o1"): 0.9, ("cup", "o2"): 0.9}
    robot = scene(things=2, nouns=("cup", "book"), known=cups)
    assert robot.acts("Point to the cup.") == ["ask_referent"]
    assert robot.acts("Find the book.") == ["see_no_such"]


# --- what do you see, and how many? --------------------------------------------------

SEEN = {
    ("cup", "o1"): 0.9,
    ("cup", "o2"): 0.8,
    ("mug", "o3"): 0.3,
    ("is_red", "o1"): 0.9,
}
VIEW: dict[str, Any] = {
    "things": 5,
    "nouns": ("cup", "mug", "book"),
    "adjectives": ("red",),
    "known": SEEN,
}


@pytest.mark.parametrize(
    ("text", "answer"),
    [
        (
            "What do you see?",
            "I see two cups, perhaps a mug, and two things that I do not know.",
        ),
        ("How many cups are there?", "Two."),
        ("How many red cups do you see?", "One."),
        ("How many mugs are there?", "Perhaps one, but I am not sure."),
        ("How many books are there?", "I see none."),
        ("How many things are on the table?", "Five."),
        (
            "How many unicorns are there?",
            "I have not learned what a unicorn is. Please show me one.",
        ),
    ],
)
def test_it_says_what_is_in_view(scene: Make, text: str, answer: str) -> None:
    assert scene(**VIEW).hear(text) == answer


def test_what_it_is_surest_of_comes_first(scene: Make) -> None:
    known = {("apple", "o1"): 0.7, ("book", "o2"): 0.9}
    robot = scene(2, nouns=("apple", "book"), known=known)
    assert robot.hear("What do you see?") == "I see a book and an apple."


def test_in_an_empty_view_there_is_nothing(scene: Make) -> None:
    robot = scene(things=0)
    assert robot.acts("What do you see?") == ["see_nothing"]
    assert robot.hear("How many things are there?") == "I see none."


@with_scenes
@given(things=st.integers(1, 8), cups=st.lists(st.floats(0, 1), min_size=8, max_size=8))
def test_everything_in_view_is_listed_once(
    scene: Make, things: int, cups: list[float]
) -> None:
    known = {("cup", f"o{n}"): p for n, p in enumerate(cups, start=1)}
    robot = scene(things=things, nouns=("cup",), known=known)
    robot.hear("What do you see?")
    parts = dict(robot.state.shared.latest.content.fields)
    assert len(parts) - 1 == things


# --- again ---------------------------------------------------------------------------


def test_it_says_the_same_again_and_learns_nothing_twice(scene: Make) -> None:
    robot = scene(**CUPS, known={("cup", "o1"): 0.9})
    assert robot.acts("Pardon?") == ["nothing_said"]
    said = robot.hear("This is a cup.")
    assert robot.hear("Pardon?") == said
    assert robot.hear("Say that again, please.") == said
    assert len(robot.state.private.lessons) == 1
    robot.hear("What is this?")
    robot.hear("What did you say?")
    assert robot.acts("That is correct.") == ["learned"]


def test_a_question_that_is_said_again_is_still_open(scene: Make) -> None:
    cups = {("cup", "o1"): 0.9, ("cup", "o2"): 0.9, ("is_red", "o1"): 0.9}
    robot = scene(things=2, nouns=("cup",), adjectives=("red",), known=cups)
    asked = robot.hear("What is the cup?")
    assert robot.hear("Pardon?") == asked
    assert robot.hear("The red one.") == "This is a cup."
