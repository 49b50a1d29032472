"""Are they all cups? Of how many of the things in view something is true."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

KNOWN = {
    ("cup", "o1"): 0.95,
    ("cup", "o2"): 0.95,
    ("book", "o3"): 0.95,
    ("is_red", "o1"): 0.95,
    ("is_red", "o2"): 0.95,
    ("is_blue", "o3"): 0.5,
}


@pytest.mark.parametrize(
    ("things", "asked", "answer"),
    [
        (2, "Are these both cups?", "Yes, both of them."),
        (2, "Are both of them red?", "Yes, both of them."),
        (2, "Are they all books?", "No, none of them."),
        (3, "Are all of these cups?", "No, only two of them."),
        (3, "Are they all books?", "No, only one of them: #3."),
        (3, "Is everything red?", "No, only two of them."),
        (3, "Are all the cups red?", "Yes, both of them."),
        (3, "Are all the books books?", "Yes, and I see only one."),
        (3, "Is every one of them blue?", "I do not know."),
        (
            3,
            "Are they all mugs?",
            "I have not learned what a mug is. Please show me one.",
        ),
        (
            3,
            "Are all the mugs red?",
            "I have not learned what a mug is. Please show me one.",
        ),
        (0, "Are they all cups?", "I see nothing on the table."),
        (3, "How many of them are red?", "Two."),
        (3, "How many of these are cups?", "Two."),
        (3, "How many of the cups are red?", "Two."),
        (3, "How many are books?", "One."),
        (3, "Is one of them a book?", "This is the book: #3."),
        (3, "Are any of these books?", "This is the book: #3."),
    ],
)
def test_all_both_and_none(
    scene: Callable[..., Any], things: int, asked: str, answer: str
) -> None:
    robot = scene(
        things, nouns=["cup", "book"], adjectives=["red", "blue"], known=KNOWN
    )
    assert robot.hear(asked) == answer


def test_all_three(scene: Callable[..., Any]) -> None:
    known = {("cup", f"o{n}"): 0.95 for n in (1, 2, 3)}
    robot = scene(3, nouns=["cup"], known=known)
    assert robot.hear("Are these all cups?") == "Yes, all three of them."
