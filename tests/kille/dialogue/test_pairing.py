"""Two things at once: they were mixed up, or are of one kind."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.dialogue.meanings import is_denial, value_at
from ttr import Record

KNOWN = {("cup", "o1"): 0.9, ("book", "o2"): 0.9}


@pytest.fixture
def table(scene: Callable[..., Any]) -> Any:
    """What looks like a cup, and what looks like a book."""
    return scene(2, nouns=["cup", "book"], known=KNOWN)


def names(s: Record) -> list[str]:
    """The lessons of a state: which thing is what, or is not."""
    return [
        f"{value_at(it.content['target'], 'x')} "
        f"{'not ' * is_denial(it.content)}{it.sign.form}"
        for it in s.private.lessons
    ]


SWAPS = ("You mixed them up.", "You have swapped them.", "They are mixed up.")


@pytest.mark.parametrize("text", SWAPS)
def test_what_is_swapped_is_asked_about(table: Any, text: str) -> None:
    table.hear("What do you see?")
    assert table.hear(text).splitlines() == [
        "Do you mean that the one on the left (#1) is a book?",
        "And that the one on the right (#2) is a cup?",
    ]
    assert names(table.state) == []
    assert table.hear("Yes.").splitlines() == [
        "OK, the one on the left (#1) is a book, not a cup.",
        "OK, the one on the right (#2) is a cup, not a book.",
    ]
    assert names(table.state) == ["o1 not cup", "o1 book", "o2 not book", "o2 cup"]
    assert table.acts("Is #1 a book?") == ["say_yes"]
    assert table.acts("Is #2 a cup?") == ["say_yes"]


def test_what_was_taught_is_unlearned(table: Any) -> None:
    table.hear("#1 is a cup.")
    table.hear("#2 is a book.")
    table.hear(SWAPS[0])
    table.hear("Yes.")
    assert names(table.state) == ["o1 book", "o2 cup"]
    table.hear("You mixed them up.")
    table.hear("Yes.")
    assert names(table.state) == ["o1 cup", "o2 book"]


@pytest.mark.parametrize("answer", ["No.", "Forget that.", "Forget the last thing."])
def test_what_is_not_swapped_stays(table: Any, answer: str) -> None:
    table.hear(SWAPS[0])
    assert table.acts(answer) == ["let_be"]
    assert names(table.state) == []
    assert not table.state.shared.qud


def test_two_things_of_one_name_are_not_mixed_up(scene: Callable[..., Any]) -> None:
    known = {("cup", "o1"): 0.9, ("cup", "o2"): 0.9}
    robot = scene(2, nouns=["cup"], known=known)
    assert robot.acts(SWAPS[0]) == ["wonder"]
    assert scene(2).acts(SWAPS[0]) == ["wonder"]
    assert scene(1, nouns=["cup"], known=known).acts(SWAPS[0]) == ["wonder"]


def test_of_three_things_it_is_the_two_talked_about(scene: Callable[..., Any]) -> None:
    known = {**KNOWN, ("banana", "o3"): 0.9}
    robot = scene(3, nouns=["cup", "book", "banana"], known=known)
    for number in (1, 3):
        robot.hear(f"What is #{number}?")
    robot.hear(SWAPS[0])
    robot.hear("Yes.")
    assert names(robot.state) == ["o1 not cup", "o1 banana", "o3 not banana", "o3 cup"]


def test_an_axiom_against_it_is_objected_to(table: Any) -> None:
    table.hear("A cup is a kind of vessel.")
    table.hear("Yes.")
    table.hear("#2 is not a vessel.")
    before = names(table.state)
    assert table.acts(SWAPS[0]) == ["object_kind"]
    assert table.acts("Yes.") != ["corrected", "corrected"]
    assert names(table.state) == before


def test_kinds_of_one_another_are_not_mixed_up(table: Any) -> None:
    table.hear("A book is a kind of cup.")
    assert table.acts(SWAPS[0]) == ["wonder"]


@pytest.mark.parametrize(
    ("known", "answer"),
    [
        (KNOWN, "No, I take one for a cup, and the other one for a book."),
        ({("cup", "o1"): 0.9, ("cup", "o2"): 0.9}, "Yes, I take both for a cup."),
        ({("cup", "o1"): 0.9}, "I do not know."),
    ],
)
def test_are_they_the_same(
    scene: Callable[..., Any], known: dict[tuple[str, str], float], answer: str
) -> None:
    robot = scene(2, nouns=["cup", "book"], known=known)
    for text in ("Are these the same?", "Are they of the same kind?"):
        assert robot.hear(text) == answer
    assert names(robot.state) == []


def test_it_is_understood_in_swedish(scene: Callable[..., Any]) -> None:
    known = {("kopp", "o1"): 0.9, ("bok", "o2"): 0.9}
    robot = scene(2, nouns=["kopp", "bok"], known=known, language="sv")
    assert robot.hear("Är de här likadana?") == (
        "Nej, jag tar den ena för en kopp och den andra för en bok."
    )
    assert robot.acts("Du blandade ihop dem.") == ["ask_meant", "ask_meant_too"]
    assert robot.acts("Ja.") == ["corrected", "corrected"]
    assert names(robot.state) == ["o1 not kopp", "o1 bok", "o2 not bok", "o2 kopp"]


# --- law: what was swapped is affirmed ------------------------------------------------


@given(st.lists(st.booleans(), max_size=5), st.booleans())
def test_what_was_swapped_is_affirmed(
    scene: Callable[..., Any], answers: list[bool], taught: bool
) -> None:
    robot = scene(2, nouns=["cup", "book"], known=KNOWN)
    called = ["cup", "book"]
    for number, noun in enumerate(called, start=1):
        if taught:
            robot.hear(f"#{number} is a {noun}.")
    for yes in answers:
        assert robot.acts(SWAPS[0]) == ["ask_meant", "ask_meant_too"]
        robot.hear("Yes." if yes else "No.")
        called = called[::-1] if yes else called
    for number, noun in enumerate(called, start=1):
        assert robot.acts(f"Is #{number} a {noun}?") == ["say_yes"]
