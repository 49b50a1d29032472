"""Several things at once: what is taught of all of them, and where they all are."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from kille.dialogue.meanings import is_denial
from kille.dialogue.reference import thing_at

Scenes = Callable[..., Any]

CUPS = {("cup", x): 0.9 for x in ("o1", "o2", "o3")}


def taught(s: Any) -> list[tuple[str | None, str]]:
    """Of which thing each lesson is, and its word."""
    return [
        (thing_at(it.content, "target"), str(it.sign.form)) for it in s.private.lessons
    ]


def test_each_thing_in_view_is_an_example(scene: Scenes) -> None:
    robot = scene(2)
    assert robot.hear("These are cups.") == "OK, I learned two cups."
    assert taught(robot.state) == [("o1", "cup"), ("o2", "cup")]


@pytest.mark.parametrize("text", ["This is a mug.", "This is not a cup."])
def test_what_the_tutor_called_something_else_is_none(scene: Scenes, text: str) -> None:
    robot = scene(3)
    robot.hear(text)
    before = taught(robot.state)
    assert robot.hear("These are cups.") == "OK, I learned two cups."
    assert [x for x, _ in taught(robot.state)] == ["o1", "o2", "o3"]
    assert taught(robot.state)[:1] == before


@pytest.mark.parametrize("text", ["This is a cup.", "This is not a mug."])
def test_what_does_not_speak_against_it_is_one(scene: Scenes, text: str) -> None:
    robot = scene(2)
    robot.hear(text)
    assert robot.acts("These are cups.") == ["learned_several"]
    assert {x for x, _ in taught(robot.state)[1:]} == {"o1", "o2"}


def test_what_was_said_of_where_a_thing_is_does_not_speak_against_it(
    scene: Scenes,
) -> None:
    known = {("cup", "o1"): 0.9, ("book", "o2"): 0.9}
    robot = scene(3, nouns=["cup", "book"], known=known)
    robot.hear("The cup is to the left of the book.")
    assert robot.hear("These are cups.") == "OK, I learned two cups."
    assert [x for x, _ in taught(robot.state)[1:]] == ["o1", "o3"]


def test_what_is_surely_something_else_is_none(scene: Scenes) -> None:
    robot = scene(3, nouns=["book"], known={("book", "o1"): 0.9})
    assert robot.hear("These are cups.") == "OK, I learned two cups."
    assert {x for x, _ in taught(robot.state)} == {"o2", "o3"}


@pytest.mark.parametrize(("things", "act"), [(0, "see_nothing"), (1, "need_single")])
def test_with_fewer_than_two_it_is_not_plain_what_is_meant(
    scene: Scenes, things: int, act: str
) -> None:
    robot = scene(things)
    assert robot.acts("These are cups.") == [act]
    assert taught(robot.state) == []


def test_each_is_pointed_at_and_nothing_is_left_to_confirm(scene: Scenes) -> None:
    robot = scene(3, nouns=["cup"], known=CUPS)
    assert robot.acts("Where are the cups?") == ["tell_place"] * 3
    assert robot.state.shared.pending == ()
    assert robot.acts("Yes.") == ["wonder"]


def test_the_one_that_there_is_may_be_confirmed(scene: Scenes) -> None:
    robot = scene(2, nouns=["cup"], known={("cup", "o2"): 0.9})
    assert robot.acts("Where are the cups?") == ["point_out"]
    assert robot.acts("Yes.") == ["learned"]
    assert [x for x, _ in taught(robot.state)] == ["o2"]


@pytest.mark.parametrize(
    ("text", "act"),
    [
        ("Where are the mugs?", "unknown_noun"),
        ("Where are the books?", "see_no_such"),
    ],
)
def test_what_is_not_there(scene: Scenes, text: str, act: str) -> None:
    robot = scene(2, nouns=["cup", "book"], known=CUPS)
    assert robot.acts(text) == [act]


def test_none_of_them_is_one(scene: Scenes) -> None:
    robot = scene(2)
    robot.hear("These are cups.")
    assert robot.hear("None of these is a mug.") == "OK, none of these is a mug."
    denied = [it.content for it in robot.state.private.lessons if it.sign.form == "mug"]
    assert [thing_at(it, "target") for it in denied] == ["o1", "o2"]
    assert all(map(is_denial, denied))


def test_what_none_of_them_is_was_a_mistake(scene: Scenes) -> None:
    robot = scene(2)
    robot.hear("These are cups.")
    robot.hear("None of them are cups.")
    assert all(is_denial(it.content) for it in robot.state.private.lessons)


def test_without_anything_in_view_none_of_them_is_nothing(scene: Scenes) -> None:
    assert scene(0).acts("None of these is a cup.") == ["see_nothing"]
