"""Several lessons in one breath are asked about together, and learned from one yes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from kille.dialogue.language import understand
from kille.dialogue.meanings import is_denial
from kille.dialogue.reference import thing_at
from kille.dialogue.robust_reading.situations import situation_of
from kille.dialogue.robust_reading.text_hearing import hear_in_parts
from kille.dialogue.tutoring import hear_sentences
from ttr import Record, replace


def taught(s: Record) -> list[str]:
    """The lessons of the dialogue, by their words and things."""
    return [
        " ".join(["not"] * is_denial(it.content) + [it.sign.form, str(thing_of(it))])
        for it in s.private.lessons
    ]


def thing_of(lesson: Record) -> str | None:
    return thing_at(lesson.content, "target")


def hear(robot: Any, text: str) -> list[str]:
    """What the robot does, told a text that is read by its parts."""
    heard = hear_in_parts(understand(text), situation_of(robot.state))
    said: list[str] = []
    for sentence in heard.moves:
        said += robot._acts(robot._take(hear_sentences(sentence)))
    return said


def without_pointing(robot: Any) -> Any:
    """The robot, in front of a tutor who points at nothing."""
    robot._take(replace(robot.seen("Glance"), {"view.pointed": []}))
    return robot


@pytest.fixture
def table(scene: Callable[..., Any]) -> Any:
    return without_pointing(scene(2))


def test_things_are_taken_from_left_to_right(table: Any) -> None:
    hear(table, "pen, pencil")
    assert taught(table.state) == []
    table.hear("Yes.")
    assert taught(table.state) == ["pen o1", "pencil o2"]


def test_a_no_teaches_nothing_of_it(table: Any) -> None:
    hear(table, "This is a pen and that is a pencil")
    table.hear("No.")
    assert taught(table.state) == []
    assert not table.state.shared.qud


def test_forget_that_lets_all_of_it_go(table: Any) -> None:
    hear(table, "pen left, pencil right")
    assert table.acts("Forget that.") == ["let_be"]
    table.hear("Yes.")
    assert taught(table.state) == []


def test_where_the_sides_are_said_they_count(table: Any) -> None:
    hear(table, "pencil right, pen left")
    table.hear("Yes.")
    assert taught(table.state) == ["pencil o2", "pen o1"]


def test_what_is_left_out_is_what_was_said_before(table: Any) -> None:
    hear(table, "The left one is a pen, the right one isn't")
    assert taught(table.state) == ["pen o1", "not pen o2"]


def test_two_words_for_one_thing(scene: Callable[..., Any]) -> None:
    robot = scene(1)
    hear(robot, "This is a lift, also called an elevator")
    robot.hear("Yes.")
    assert taught(robot.state) == ["lift o1", "elevator o1"]


def test_of_more_things_than_words_it_is_open_which_are_meant(
    scene: Callable[..., Any],
) -> None:
    robot = without_pointing(scene(3))
    hear(robot, "pen, pencil")
    robot.hear("Yes.")
    assert len(taught(robot.state)) < 2


def test_with_nothing_in_view_nothing_is_asked(scene: Callable[..., Any]) -> None:
    robot = scene(0)
    hear(robot, "pen, pencil")
    assert not robot.state.shared.qud
    assert taught(robot.state) == []


def test_the_one_that_is_pointed_at_may_be_called_anything(table: Any) -> None:
    pointed = {"view.focus": ["o2"], "view.pointed": ["o2"]}
    table._take(replace(table.seen("Glance"), pointed))
    table.hear("The bent one is a clip.")
    assert taught(table.state) == ["clip o2"]


def test_yes_is_no_answer_to_which_of_two(scene: Callable[..., Any]) -> None:
    robot = scene(1)
    robot.hear("This is a cup.")
    robot.hear("This is a mug.")
    assert robot.acts("No.") == ["ask_which"]
    assert robot.acts("Yes.") == ["ask_which"]
    assert robot.acts("No.") == ["ask_which"]
    robot.hear("It is a mug.")
    assert taught(robot.state) == ["mug o1"]
