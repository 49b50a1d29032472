"""Corrections, rejections and denials: what is learned, unlearned and agreed on."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from kille.dialogue.commitments import lessons_in, same
from kille.dialogue.meanings import denial, is_denial, packaged_types, theory
from ttr import Record, RecordType, replace

KNOWN = {
    ("cup", "o1"): 0.9,
    ("mug", "o1"): 0.4,
    ("book", "o2"): 0.9,
    ("is_red", "o1"): 0.9,
    ("to_the_left_of", "o1", "o2"): 0.9,
}


@pytest.fixture
def table(scene: Callable[..., Any]) -> Any:
    """A cup and a book, and a robot that knows both."""
    return scene(
        things=2,
        nouns=["cup", "mug", "book"],
        adjectives=["red", "blue"],
        relations=["to the left of", "behind"],
        known=KNOWN,
    )


def taught(s: Record) -> list[str]:
    """The lessons of a dialogue, in words."""
    return [
        f"not {it.sign.form}" if is_denial(it.content) else str(it.sign.form)
        for it in s.private.lessons
    ]


def agreed(s: Record) -> set[object]:
    return set(s.shared.commitments)


# --- what the robot claimed -----------------------------------------------------------


def test_a_claim_that_is_corrected_is_learned_not_to_be_so(table: Any) -> None:
    table.hear("What is this?")
    assert (
        table.hear("No, this is a mug.")
        == "OK, the one on the left (#1) is a mug, not a cup."
    )
    assert taught(table.state) == ["not cup", "mug"]
    assert table.state.shared.pending == ()


def test_a_correction_of_a_hedge_weakens_both(scene: Callable[..., Any]) -> None:
    known = {("book", "o1"): 0.4, ("mug", "o1"): 0.35}
    one = scene(nouns=["book", "mug", "cup"], known=known)
    assert one.acts("What is this?") == ["hedge_name"]
    assert one.acts("No, this is a cup.") == ["corrected"]
    assert taught(one.state) == ["not book", "not mug", "cup"]


def test_a_correction_of_a_hedge_names_both(scene: Callable[..., Any]) -> None:
    known = {("cup", "o1"): 0.6, ("bowl", "o1"): 0.5}
    one = scene(nouns=["cup", "bowl", "mug"], known=known)
    one.hear("What is this?")
    said = one.hear("No, this is a mug.")
    assert said == "OK, this is a mug, not a bowl or a cup."


def test_a_correction_of_a_hedge_to_one_of_the_two(scene: Callable[..., Any]) -> None:
    known = {("book", "o1"): 0.4, ("mug", "o1"): 0.35}
    one = scene(nouns=["book", "mug"], known=known)
    one.hear("What is this?")
    assert one.hear("No, this is a mug.") == "OK, this is a mug, not a book."
    assert taught(one.state) == ["not book", "mug"]


def test_a_no_weakens_what_was_claimed(table: Any) -> None:
    table.hear("What is this?")
    assert table.hear("No.") == "I see. Please tell me, then."
    assert taught(table.state) == ["not cup"]


def test_a_no_to_a_hedge_weakens_both(scene: Callable[..., Any]) -> None:
    known = {("book", "o1"): 0.4, ("mug", "o1"): 0.35}
    one = scene(nouns=["book", "mug"], known=known)
    one.hear("What is this?")
    assert one.acts("That is wrong.") == ["ask_again"]
    assert taught(one.state) == ["not book", "not mug"]


def test_after_no_what_was_rejected_is_not_learned_by_a_yes(table: Any) -> None:
    table.hear("What is this?")
    table.hear("No.")
    assert table.acts("Yes.") == ["wonder"]
    assert taught(table.state) == ["not cup"]


def test_a_claim_is_learned_once(table: Any) -> None:
    table.hear("What is this?")
    assert table.acts("That is correct.") == ["learned"]
    assert table.acts("That is correct.") == ["wonder"]
    assert taught(table.state) == ["cup"]


def test_a_place_is_corrected(table: Any) -> None:
    table.hear("Where is the cup?")
    answer = table.hear("No, it is behind the book.")
    assert answer == 'OK, this relation is called "behind", not "to the left of".'
    assert taught(table.state) == ["not to the left of", "behind"]


def test_without_depth_no_place_is_learned(scene: Callable[..., Any]) -> None:
    flat = scene(things=2, placed=0, nouns=["cup", "book"], known=KNOWN)
    assert flat.acts("No, the cup is behind the book.") == ["need_depth"]
    assert flat.acts("The cup is not behind the book.") == ["need_depth"]
    assert taught(flat.state) == []


# --- what was taught ------------------------------------------------------------------


def test_a_lesson_that_is_corrected_is_unlearned(table: Any) -> None:
    table.hear("This is a mug.")
    assert (
        table.hear("No, this is a cup.")
        == "OK, the one on the left (#1) is a cup, not a mug."
    )
    assert taught(table.state) == ["cup"]


def test_only_the_thing_that_is_meant_is_corrected(scene: Callable[..., Any]) -> None:
    two = scene(things=2, nouns=["cup", "book"], known={("book", "o2"): 0.9})
    two.hear("The book is blue.")
    two.hear("This is red.")
    two.hear("No, it is green.")
    assert taught(two.state) == ["blue", "green"]


def test_only_what_is_said_of_the_same_is_corrected(table: Any) -> None:
    table.hear("This is blue.")
    table.hear("This is a mug.")
    assert (
        table.hear("No, it is red.") == "OK, the one on the left (#1) is red, not blue."
    )
    assert taught(table.state) == ["mug", "red"]


def test_what_is_rejected_is_unlearned(table: Any) -> None:
    table.hear("This is a mug.")
    assert (
        table.hear("This is not a mug.") == "OK, the one on the left (#1) is not a mug."
    )
    assert taught(table.state) == []
    assert agreed(table.state) == set()


def test_what_nobody_taught_is_learned_not_to_be_so(table: Any) -> None:
    assert (
        table.hear("This is not a mug.") == "OK, the one on the left (#1) is not a mug."
    )
    assert taught(table.state) == ["not mug"]


def test_what_was_rejected_may_be_so_after_all(table: Any) -> None:
    table.hear("This is not a mug.")
    table.hear("This is a mug.")
    assert taught(table.state) == ["mug"]


def test_a_word_that_was_only_denied_is_not_known(scene: Callable[..., Any]) -> None:
    one = scene()
    one.hear("This is not a unicorn.")
    assert one.state.private.nouns == ()


def test_what_a_thing_is_has_nothing_to_do_with_how_it_is(table: Any) -> None:
    table.hear("What is this?")
    assert table.acts("No, this is blue.") == ["learned_quality"]
    assert taught(table.state) == ["blue"]


@pytest.mark.parametrize(
    "text",
    [
        "It's not a mug, it's a cup.",
        "This isn't a mug, it is a cup.",
        "No, this is a cup, not a mug.",
        "It is a cup, not a mug.",
    ],
)
def test_a_correction_may_name_what_it_rejects(table: Any, text: str) -> None:
    assert table.hear(text) == "OK, the one on the left (#1) is a cup, not a mug."
    assert taught(table.state) == ["not mug", "cup"]


def test_who_takes_one_word_for_another_and_back_only_teaches_it(table: Any) -> None:
    assert (
        table.hear("It's not a mug, it's a mug.")
        == "OK, the one on the left (#1) is a mug."
    )
    assert taught(table.state) == ["mug"]


def test_what_is_named_is_rejected_rather_than_what_was_claimed(table: Any) -> None:
    table.hear("What is this?")
    assert (
        table.hear("It's not a book, it's a mug.")
        == "OK, the one on the left (#1) is a mug, not a book."
    )
    assert taught(table.state) == ["not book", "mug"]


def test_what_is_gone_is_not_corrected_in_another_thing(table: Any) -> None:
    table.hear("This is a mug.")
    gone = replace(table.seen(), {"kept": ()})
    table._take(gone)
    assert table.hear("No, this is a cup.") == "OK, the one on the left (#1) is a cup."
    assert taught(table.state) == ["mug", "cup"]


@pytest.mark.parametrize("first", ["Where is the cup?", "The cup is near the book."])
def test_what_stands_beside_one_thing_may_stand_beside_another(
    scene: Callable[..., Any], first: str
) -> None:
    known = {("cup", "o1"): 0.9, ("book", "o2"): 0.9, ("box", "o3"): 0.7}
    known |= {("near", "o1", "o2"): 0.9}
    nouns = ["cup", "book", "box"]
    robot = scene(3, nouns=nouns, relations=["near"], known=known)
    robot.hear(first)
    before = robot.state.private.lessons
    answer = robot.hear("No, the cup is near the box.")
    assert answer == 'OK, this relation is called "near".'
    assert robot.state.private.lessons[:-1] == before


def test_what_was_claimed_of_another_thing_is_not_corrected(table: Any) -> None:
    table.hear("What is this?")
    table.now = table.now._replace(
        model=table.now.model.given("look2", theory()["Look"])
    )
    table._take(replace(table.seen(), {"kept": (), "view.look": "look2"}))
    assert table.hear("No, this is a mug.") == "OK, the one on the left (#1) is a mug."
    assert taught(table.state) == ["mug"]


# --- laws -----------------------------------------------------------------------------

WORDS = ("cup", "mug", "book")
SAID = st.sampled_from(
    [f"This is a {word}." for word in WORDS]
    + [f"This is not a {word}." for word in WORDS]
    + [f"No, this is a {word}." for word in WORDS]
    + [
        "What is this?",
        "Yes.",
        "No.",
        "This is red.",
        "No, it isn't red.",
        "Forget it.",
    ]
)


def told(one: Any, texts: Sequence[str]) -> Any:
    """The same scene after these sentences, each in a look of its own."""
    for number, text in enumerate(texts, start=2):
        look = f"look{number}"
        model = one.now.model.given(look, theory()["Look"])
        one.now = one.now._replace(model=model)
        one._take(replace(one.seen("Glance"), {"view.look": look}))
        one.hear(text)
    return one


def test_what_was_taught_in_an_earlier_look_is_unlearned(table: Any) -> None:
    told(table, ["This is a mug.", "This is not a mug."])
    assert taught(table.state) == []
    told(table, ["This is not a cup.", "This is a cup."])
    assert taught(table.state) == ["cup"]


@given(st.lists(SAID, max_size=8))
@example(["This is a mug.", "This is not a cup.", "This is a cup.", "This is a cup."])
def test_no_two_lessons_about_a_thing_contradict_each_other(
    scene: Callable[..., Any], texts: list[str]
) -> None:
    one = told(scene(nouns=WORDS, adjectives=["red"], known=KNOWN), texts)
    contents = [it.content for it in one.state.private.lessons]
    assert not any(same(denial(a), b) for a in contents for b in contents)


@given(st.lists(SAID, max_size=8))
def test_what_is_agreed_on_is_what_the_lessons_say(
    scene: Callable[..., Any], texts: list[str]
) -> None:
    one = told(scene(nouns=WORDS, adjectives=["red"], known=KNOWN), texts)
    assert agreed(one.state) == {it.content for it in one.state.private.lessons}


@given(st.lists(SAID, max_size=5), st.sampled_from(WORDS), st.sampled_from(WORDS))
def test_a_mistake_that_is_corrected_leaves_no_trace(
    scene: Callable[..., Any], texts: list[str], wrong: str, right: str
) -> None:
    def after(*more: str) -> list[str]:
        one = scene(nouns=WORDS, adjectives=["red"], known=KNOWN)
        return taught(told(one, (*texts, "Thank you.", *more)).state)

    slip, correction = f"This is a {wrong}x.", f"No, this is a {right}."
    assert after(slip, "Yes.", correction) == after(f"This is a {right}.", "Yes.")


@given(st.lists(SAID, max_size=6))
def test_a_no_takes_back_the_last_lesson_that_says_what_was_rejected(
    scene: Callable[..., Any], texts: list[str]
) -> None:
    one = scene(nouns=WORDS, adjectives=["red"], known=KNOWN)
    told(one, (*texts, "What is this?"))

    def keys(claim: RecordType) -> list[str]:
        return [it.key for it in lessons_in(one.state, claim, types=packaged_types())]

    before = {claim: keys(claim) for claim in one.state.shared.pending}
    one.hear("No.")
    for claim, lessons in before.items():
        assert keys(claim) == lessons[:-1]
        assert bool(keys(denial(claim))) is (len(lessons) < 2)
