"""The tutor asks what was said of all things of a kind."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.dialogue.criteria import degree_of

HANDLES = (
    "You told me that mugs generally have handles, but I cannot see parts of things."
)


@pytest.fixture
def table(scene: Callable[..., Any]) -> Any:
    """A mug, and the words for it."""
    known = {("mug", "o1"): 0.9, ("is_white", "o1"): 0.9}
    return scene(nouns=["mug", "cup"], adjectives=["white", "blue"], known=known)


@pytest.mark.parametrize(
    ("told", "asked", "answer"),
    [
        ("Mugs have handles.", "Do mugs have handles?", HANDLES),
        ("Mugs have handles.", "Does a mug have a handle?", HANDLES),
        (
            "Mugs are usually white.",
            "Are mugs white?",
            "You told me that mugs are usually white.",
        ),
        (
            "Mugs are seldom white.",
            "Are mugs usually white?",
            "You told me that mugs are seldom white.",
        ),
        (
            "The colour does not matter for mugs.",
            "Does the colour matter for mugs?",
            "You told me not to go by the colour of mugs.",
        ),
        (
            "It is the shape for mugs.",
            "Is the shape important for mugs?",
            "You told me to go by the shape of mugs.",
        ),
    ],
)
def test_what_was_told_is_cited(table: Any, told: str, asked: str, answer: str) -> None:
    assert table.acts(asked)[0] == "unknown_generic"
    before = table.state.private.criteria
    assert before == ()
    table.hear(told)
    assert table.hear(asked) == answer
    table.hear("Forget that.")
    assert table.state.private.criteria == ()


def test_what_nobody_said_it_says_so(table: Any) -> None:
    assert table.hear("Do mugs have lids?") == (
        "Nobody has told me whether mugs have lids."
    )
    assert table.acts("Are mugs blue?") == ["unknown_generic", "mean_noun"]
    assert table.hear("Does the size matter for mugs?") == (
        "Nobody has told me whether the size matters for mugs."
    )
    assert (
        table.hear("Do forks have handles?")
        == "I have not learned what a fork is. Please show me one."
    )
    assert table.hear("Are mugs cups?") == (
        "Nobody has told me that a mug is a kind of cup."
    )


def test_it_goes_for_kinds_of_them(table: Any) -> None:
    table.hear("Cups have handles.")
    table.hear("A mug is a kind of cup.")
    assert table.acts("Do mugs have handles?") == ["know_kind", "cite_generic"]
    assert table.acts("Do cups have handles?") == ["cite_generic"]


def test_without_a_noun_it_is_about_the_claim(table: Any) -> None:
    assert table.acts("Does the colour matter?") == ["which_subject"]
    table.hear("What is this?")
    assert table.hear("Does the colour matter?") == (
        "Nobody has told me whether the colour matters for mugs."
    )
    assert table.acts("That is correct.") == ["learned"]


@pytest.mark.parametrize(
    ("told", "asked", "answer"),
    [
        (
            "Muggar är oftast vita.",
            "Är muggar vita?",
            "Du har sagt att muggar oftast är vita.",
        ),
        (
            "Färgen spelar ingen roll för muggar.",
            "Spelar färgen någon roll för muggar?",
            "Du har sagt att jag inte ska gå efter färgen hos muggar.",
        ),
        (
            "Muggar har handtag.",
            "Har muggar handtag?",
            "Du har sagt att muggar i allmänhet har handtag, men delar av saker kan "
            "jag inte se.",
        ),
    ],
)
def test_it_is_told_in_swedish(
    scene: Callable[..., Any], told: str, asked: str, answer: str
) -> None:
    robot = scene(nouns=["mugg"], adjectives=["white"], language="sv")
    assert robot.hear(asked).startswith("Ingen har sagt mig om ")
    robot.hear(told)
    assert robot.hear(asked) == answer


# --- law: what was taught of a kind is affirmed ---------------------------------------

SAID = ("always", "usually", "often", "sometimes", "seldom", "never")


@given(
    st.lists(
        st.tuples(
            st.sampled_from(["mug", "cup"]),
            st.sampled_from(["white", "blue"]),
            st.sampled_from(SAID),
        ),
        max_size=6,
    )
)
def test_what_was_taught_of_a_kind_is_affirmed(
    scene: Callable[..., Any], said: list[tuple[str, str, str]]
) -> None:
    robot = scene(nouns=["mug", "cup"], adjectives=["white", "blue"])
    told: dict[tuple[str, str], str] = {}
    for noun, quality, often in said:
        robot.hear(f"{noun.title()}s are {often} {quality}.")
        told[noun, quality] = often
    assert len(robot.state.private.criteria) == len(told)
    for noun in ("mug", "cup"):
        for quality in ("white", "blue"):
            answer = robot.hear(f"Are {noun}s {quality}?")
            often = told.get((noun, quality), "")
            assert (f"that {noun}s are {often} {quality}" in answer) is bool(often)
            assert answer.startswith("Nobody") is not bool(often)
    assert all(0.0 < degree_of(it.content) < 1.0 for it in robot.state.private.criteria)
