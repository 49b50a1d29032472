"""Which is bigger: comparatives and superlatives, by what is measured of things."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from kille.dialogue.language import understand

MORE = ("bigger than", "nearer than", "closest to")
CUP, BOOK = ("cup", "o1"), ("book", "o2")
KNOWN = {
    CUP: 0.9,
    BOOK: 0.95,
    ("bigger_than", "o2", "o1"): 0.99,
    ("bigger_than", "o2", "o3"): 0.99,
    ("bigger_than", "o1", "o3"): 0.6,
    ("bigger_than", "o3", "o1"): 0.4,
    ("closest_to", "o1", "o2"): 0.95,
}


@pytest.fixture
def three(scene: Callable[..., Any]) -> Any:
    """A cup, a book that is bigger, and something that is about as big as the cup."""
    return scene(3, nouns=["cup", "book"], seen=MORE, known=KNOWN)


@pytest.mark.parametrize(
    ("asked", "answer"),
    [
        ("Is the book bigger than the cup?", "Yes, the book is bigger than the cup."),
        (
            "Is the cup bigger than the book?",
            "No, I think the book is bigger than the cup.",
        ),
        ("The book is larger than the cup.", "Yes, the book is bigger than the cup."),
        (
            "No, the cup is much bigger than the book.",
            "No, I think the book is bigger than the cup.",
        ),
        (
            "Which is bigger, the cup or the book?",
            "The book is bigger than the cup: #2.",
        ),
        ("Is the cup or the book bigger?", "The book is bigger than the cup: #2."),
        ("Is the cup closest to the book?", "Yes, the cup is closest to the book."),
        ("Is the book closest to the cup?", "No, the book is not closest to the cup."),
        (
            "Is the cup heavier than the book?",
            'I have not learned what "heavier than" means. Please show me an example.',
        ),
    ],
)
def test_two_things_are_compared(three: Any, asked: str, answer: str) -> None:
    assert three.hear(asked) == answer


def test_a_comparison_is_no_lesson(three: Any) -> None:
    three.hear("The cup is bigger than the book.")
    three.hear("No!")
    assert not three.state.private.lessons
    assert not three.state.shared.pending


def test_what_is_about_as_big_is_not_decided(scene: Callable[..., Any]) -> None:
    known = {CUP: 0.9, BOOK: 0.9, ("bigger_than", "o1", "o2"): 0.55}
    robot = scene(2, nouns=["cup", "book"], seen=MORE, known=known)
    cannot = "I cannot tell: the difference is too small for me to see."
    for asked in (
        "Is the cup bigger than the book?",
        "Which is bigger, the book or the cup?",
        "Which one is bigger?",
        "What is the biggest thing?",
    ):
        assert robot.hear(asked) == cannot
    assert robot.hear("The bigger one is a mug.") == "Do you mean the cup or the book?"


def test_without_depth_nothing_is_compared(scene: Callable[..., Any]) -> None:
    robot = scene(2, placed=0, nouns=["cup", "book"], seen=MORE, known=KNOWN)
    assert robot.acts("Is the cup bigger than the book?") == ["need_depth"]


@pytest.mark.parametrize(
    ("asked", "answer"),
    [
        ("Which one is bigger?", "This is the book: #2."),
        ("Which of them is the biggest?", "This is the book: #2."),
        ("Show me the largest thing.", "This is the book: #2."),
        ("What is the biggest thing?", "This is a book."),
        ("The biggest one is red.", "OK, the one in the middle (#2) is red."),
    ],
)
def test_the_biggest_thing_is_chosen(three: Any, asked: str, answer: str) -> None:
    assert three.hear(asked) == answer


def test_the_smaller_of_two_cups(scene: Callable[..., Any]) -> None:
    known = {CUP: 0.9, ("cup", "o2"): 0.9, ("smaller_than", "o2", "o1"): 0.99}
    robot = scene(3, nouns=["cup"], seen=["smaller than"], known=known)
    assert robot.hear("Show me the smaller cup.") == "This is the cup: #2."
    assert robot.hear("Which is the smallest of the cups?") == "This is the cup: #2."


def test_what_it_is_bigger_than_may_be_left_out(scene: Callable[..., Any]) -> None:
    robot = scene(2, nouns=["cup", "book"], seen=MORE, known=KNOWN)
    said = robot.hear("Is the book bigger?")
    assert said == "Yes, the book is bigger than the cup."


@pytest.mark.parametrize("text", ["This is bigger.", "It is bigger.", "Den är större."])
def test_a_comparative_is_no_adjective(text: str) -> None:
    language = "sv" if text.startswith("Den") else "en"
    [said] = understand(text, language)
    assert all(it.kind == "relation" for one in said.readings for it in one.signs)


def test_a_comparative_describes(three: Any) -> None:
    said = three.hear("Show me the one bigger than the cup.")
    assert said == "This is the one bigger than the cup: #2."


def test_comparatives_mean_the_same_in_swedish(scene: Callable[..., Any]) -> None:
    robot = scene(2, nouns=["kopp", "bok"], language="sv", known={}, seen=MORE)
    assert robot.acts("Vilken är större, koppen eller boken?") != ["unknown_relation"]
    [said] = understand("Koppen är större än boken.", "sv")
    assert said.readings[0].type["content"].value["rel"].pred.name == "bigger_than"


# --- between --------------------------------------------------------------------------

ROW = {
    CUP: 0.9,
    BOOK: 0.95,
    ("banana", "o3"): 0.9,
    ("between", "o2", "o1", "o3"): 1.0,
    ("between", "o2", "o3", "o1"): 1.0,
}


@pytest.fixture
def row(scene: Callable[..., Any]) -> Any:
    """A cup, a book and a banana, from left to right."""
    return scene(3, nouns=["cup", "book", "banana"], seen=["between"], known=ROW)


@pytest.mark.parametrize(
    ("asked", "answer"),
    [
        ("What is between the cup and the banana?", "This is a book."),
        (
            "Which one is between the cup and the banana?",
            "This is the book between the cup and the banana: #2.",
        ),
        (
            "Is the book between the cup and the banana?",
            "Yes, the book is between the cup and the banana.",
        ),
        (
            "The book is between the banana and the cup.",
            "Yes, the book is between the banana and the cup.",
        ),
        (
            "Is the cup between the book and the banana?",
            "No, the cup is not between the book and the banana.",
        ),
        ("Is the book between the cup and the fork?", "I have not learned what a fork"),
    ],
)
def test_what_is_between(row: Any, asked: str, answer: str) -> None:
    assert row.hear(asked).startswith(answer)


def test_between_the_two_that_were_talked_about(row: Any) -> None:
    row.hear("Where is the cup?")
    row.hear("Where is the banana?")
    assert row.hear("What is between them?") == "This is a book."
    assert row.hear("Is the book between the two?") == "Yes, it is between the two."


def test_between_things_of_a_kind(scene: Callable[..., Any]) -> None:
    known = {("cup", "o1"): 0.9, ("cup", "o3"): 0.9, **ROW}
    del known["banana", "o3"]
    robot = scene(3, nouns=["cup", "book"], seen=["between"], known=known)
    assert robot.hear("What is between the cups?") == "This is a book."


def test_between_is_no_lesson(row: Any) -> None:
    row.hear("The cup is between the book and the banana.")
    assert not row.state.private.lessons


@pytest.mark.parametrize(
    ("p", "answer", "i_svar"),
    [
        (
            0.9,
            "Yes, the book is between the cup and the banana.",
            "Ja, boken är mellan koppen och bananen.",
        ),
        (0.5, "I do not know.", "Det vet jag inte."),
        (0.2, "I do not know.", "Det vet jag inte."),
        (
            0.1,
            "No, the book is not between the cup and the banana.",
            "Nej, boken är inte mellan koppen och bananen.",
        ),
    ],
)
def test_how_sure_it_says_what_is_between(
    scene: Callable[..., Any], p: float, answer: str, i_svar: str
) -> None:
    between = {("between", "o2", "o1", "o3"): p}
    known = {CUP: 0.9, BOOK: 0.9, ("banana", "o3"): 0.9, **between}
    robot = scene(3, nouns=["cup", "book", "banana"], seen=["between"], known=known)
    assert robot.hear("Is the book between the cup and the banana?") == answer
    known = {("kopp", "o1"): 0.9, ("bok", "o2"): 0.9, ("banan", "o3"): 0.9, **between}
    nouns = ["kopp", "bok", "banan"]
    swedish = scene(3, nouns=nouns, seen=["between"], known=known, language="sv")
    assert swedish.hear("Är boken mellan koppen och bananen?") == i_svar


def test_what_is_not_seen_has_nothing_between(scene: Callable[..., Any]) -> None:
    known = {CUP: 0.9, BOOK: 0.9}
    nouns = ["cup", "book", "banana"]
    robot = scene(3, nouns=nouns, seen=["between"], known=known)
    asked = "Is the book between the cup and the banana?"
    assert robot.hear(asked) == "I do not see what you mean."


# --- how big, and why -----------------------------------------------------------------


@pytest.fixture
def pair(scene: Callable[..., Any]) -> Any:
    """A cup that is bigger than a book."""
    known = {CUP: 0.9, BOOK: 0.95, ("bigger_than", "o1", "o2"): 0.99}
    return scene(2, nouns=["cup", "book"], known=known, seen=MORE)


@pytest.mark.parametrize(
    "asked",
    [
        "Is the cup bigger than the book?",
        "Is the book bigger than the cup?",
        "Which is bigger, the cup or the book?",
    ],
)
@pytest.mark.parametrize("then", ["Why?", "No.", "That is wrong."])
def test_a_comparison_rests_on_what_is_measured(
    pair: Any, asked: str, then: str
) -> None:
    pair.hear(asked)
    assert pair.hear(then) == "I go by what I measure of them."
    assert not pair.state.private.lessons
    assert not pair.state.shared.pending


def test_why_and_no_after_what_is_between(row: Any) -> None:
    for then in ("Why?", "No."):
        row.hear("Is the cup between the book and the banana?")
        assert row.acts(then) == ["explain_measure"]


def test_why_after_something_else_is_no_comparison(pair: Any) -> None:
    pair.hear("Is the cup bigger than the book?")
    pair.hear("What is this?")
    assert pair.acts("Why?") == ["explain_name"]
    pair.hear("Is the cup bigger than the book?")
    pair.hear("Hello.")
    assert pair.acts("Why?") == ["no_claim"]


@pytest.mark.parametrize(
    "text", ["How big is it?", "How tall is the cup?", "How far away is the cup?"]
)
def test_a_size_is_asked_for(pair: Any, text: str) -> None:
    assert pair.acts(text) == ["tell_size"]
    assert not pair.state.private.lessons


def test_what_is_not_seen_has_no_size(pair: Any) -> None:
    assert (
        pair.hear("How big is the fork?")
        == "I have not learned what a fork is. Please show me one."
    )


def test_no_size_without_depth(scene: Callable[..., Any]) -> None:
    robot = scene(1, placed=0, nouns=["cup"], known={CUP: 0.9})
    assert robot.acts("How big is the cup?") == ["need_depth"]


def test_sizes_are_asked_for_in_swedish(scene: Callable[..., Any]) -> None:
    known = {("kopp", "o1"): 0.9, ("bok", "o2"): 0.9, ("bigger_than", "o1", "o2"): 0.99}
    robot = scene(2, nouns=["kopp", "bok"], known=known, seen=MORE, language="sv")
    assert robot.acts("Hur stor är koppen?") == ["tell_size"]
    assert robot.acts("Hur långt bort ligger boken?") == ["tell_size"]
    assert robot.acts("Är koppen större än boken?") == ["say_yes"]
    assert robot.hear("Varför?") == "Jag går efter vad jag mäter hos dem."
