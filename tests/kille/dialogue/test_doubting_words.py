"""What is in doubt is asked about before it is learned, and may be let go of."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from kille.dialogue.meanings import is_denial
from ttr import Record, replace

TAKES_BACK = ("Forget that.", "Forget the last thing.")


def taught(s: Record) -> list[str]:
    """The lessons of the dialogue, as the thing and the word that each is about."""
    return [
        f"{'not ' * is_denial(it.content)}{it.sign.form}" for it in s.private.lessons
    ]


@pytest.fixture
def table(scene: Callable[..., Any]) -> Any:
    """Two things, of which the first is pointed at; the robot knows no word for it."""
    return scene(things=2)


def point_at(robot: Any, x: str) -> None:
    """Have the tutor point at a thing."""
    robot._take(replace(robot.seen("Glance"), {"view.focus": [x], "view.pointed": [x]}))


# --- what is taken back before it is learned ------------------------------------------


@pytest.mark.parametrize("text", TAKES_BACK)
def test_a_doubtful_word_is_let_go_of(table: Any, text: str) -> None:
    assert table.acts("This is sugar.") == ["ask_kind"]
    assert table.acts(text) == ["let_be"]
    assert taught(table.state) == []
    assert table.state.shared.qud == ()


@pytest.mark.parametrize("text", TAKES_BACK)
def test_a_word_that_is_no_noun_is_let_go_of(table: Any, text: str) -> None:
    assert table.acts("This is sugar.") == ["ask_kind"]
    assert table.acts("No.") == ["ask_how"]
    assert table.acts(text) == ["let_be"]
    assert taught(table.state) == []


@pytest.mark.parametrize("text", TAKES_BACK)
def test_a_second_noun_is_let_go_of_and_the_first_one_stays(
    table: Any, text: str
) -> None:
    table.hear("This is a cup.")
    assert table.acts("This is a mug.") == ["ask_both"]
    assert table.acts(text) == ["let_be"]
    assert taught(table.state) == ["cup"]
    assert table.acts("Yes.") == ["wonder"]
    assert taught(table.state) == ["cup"]


def test_what_is_named_is_forgotten_whatever_is_asked(table: Any) -> None:
    table.hear("This is a cup.")
    assert table.acts("This is a mug.") == ["ask_both"]
    assert table.acts("Forget that this is a cup.") == ["forgot"]
    assert taught(table.state) == []
    assert table.state.shared.qud == ()


def test_what_is_let_go_of_is_asked_about_anew(table: Any) -> None:
    table.hear("This is sugar.")
    table.hear("Forget that.")
    assert table.acts("This is sugar.") == ["ask_kind"]
    assert table.acts("Yes.") == ["learned"]
    assert taught(table.state) == ["sugar"]


# --- a lesson about another thing, while it asks if this one is both ------------------


@pytest.mark.parametrize("word", ["book", "mug", "cup"])
def test_a_lesson_about_another_thing_drops_the_question(table: Any, word: str) -> None:
    table.hear("This is a cup.")
    assert table.acts("This is a mug.") == ["ask_both"]
    point_at(table, "o2")
    answer = table.hear(f"This is a {word}.")
    assert answer == f"OK, the one on the right (#2) is a {word}."
    assert taught(table.state) == ["cup", word]
    assert table.state.shared.qud == ()
    assert table.acts("Yes.") == ["wonder"]
    assert taught(table.state) == ["cup", word]


def test_a_quality_of_this_thing_drops_the_question(table: Any) -> None:
    table.hear("This is a cup.")
    assert table.acts("This is a mug.") == ["ask_both"]
    assert table.hear("This is red.") == "OK, the one on the left (#1) is red."
    assert taught(table.state) == ["cup", "red"]
    assert table.state.shared.qud == ()


def test_another_thing_that_is_named_drops_the_question(
    scene: Callable[..., Any],
) -> None:
    robot = scene(things=2, nouns=["book"], known={("book", "o2"): 0.9})
    robot.hear("This is a cup.")
    assert robot.acts("This is a mug.") == ["ask_both"]
    assert robot.hear("The book is a mug.") == "OK, the one on the right (#2) is a mug."
    assert taught(robot.state) == ["cup", "mug"]


def test_the_same_noun_again_answers_the_question(table: Any) -> None:
    table.hear("This is a cup.")
    assert table.acts("This is a mug.") == ["ask_both"]
    answer = table.hear("This is a mug.")
    assert answer == "OK, the one on the left (#1) is a mug, not a cup."
    assert taught(table.state) == ["mug"]


def test_a_third_noun_is_asked_about_in_its_turn(table: Any) -> None:
    table.hear("This is a cup.")
    assert table.acts("This is a mug.") == ["ask_both"]
    answer = table.hear("This is a beaker.")
    assert answer == "Is it both a cup and a beaker?"
    assert taught(table.state) == ["cup"]
