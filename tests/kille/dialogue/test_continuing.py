"""And this one? What was asked last is asked of another thing."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

KNOWN = {
    ("cup", "o1"): 0.95,
    ("book", "o2"): 0.95,
    ("is_red", "o1"): 0.95,
    ("is_blue", "o2"): 0.95,
    ("near", "o1", "o2"): 0.95,
    ("bigger_than", "o2", "o1"): 0.99,
}


@pytest.fixture
def table(scene: Callable[..., Any]) -> Any:
    """A red cup and a blue book."""
    return scene(
        2,
        nouns=["cup", "book"],
        adjectives=["red", "blue"],
        relations=["near"],
        seen=["bigger than"],
        known=KNOWN,
    )


@pytest.mark.parametrize(
    ("asked", "also", "answer"),
    [
        ("What is this?", "What about the other one?", "This is a book."),
        ("Is the cup red?", "How about the book?", "No, the book is not red."),
        ("Is the cup a book?", "And what about the book?", "Yes, the book is a book."),
        (
            "Is the cup bigger than the book?",
            "What about this?",
            "No, I think the book is bigger than the cup.",
        ),
        ("Where is the cup?", "What about the red one?", "The cup is near the book."),
        ("Show me the cup.", "What about the book?", "This is the book: #2."),
        ("Hello.", "What about the book?", "This is a book."),
    ],
)
def test_the_same_is_asked_of_another_thing(
    table: Any, asked: str, also: str, answer: str
) -> None:
    table.hear(asked)
    assert table.hear(also) == answer


def test_it_may_go_on(table: Any) -> None:
    table.hear("Is the cup red?")
    assert table.hear("What about the book?") == "No, the book is not red."
    assert table.hear("What about the cup?") == "Yes, the cup is red."
    table.hear("No!")
    assert table.state.private.lessons
