"""Why, how sure, what is known: what is said of claims and words."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.dialogue.answer_details import details
from kille.dialogue.lexicon import lexicon
from kille.dialogue.meanings import noun
from ttr import Model, Record, record, replace
from ttr.types import TypeNode

KNOWN = {
    ("cup", "o1"): 0.87,
    ("mug", "o1"): 0.08,
    ("book", "o2"): 0.9,
    ("is_red", "o1"): 0.9,
    ("to_the_left_of", "o1", "o2"): 0.8,
    ("behind", "o1", "o2"): 0.1,
}

REMINDER = record(
    key="7",
    sign=noun("cup"),
    examples=1.0,
    text="This is a cup.",
    dialogue="1",
    turn="3",
    age=130.0,
    day="2026-11-21",
    time="14:05",
)

CUES = [("paint", 0.4), ("form", 0.3), ("size", 0.2), ("hue", 0.1)]

MORE: dict[str, Any] = {"qualities": [], "reminders": []}
"""What is recalled of a word besides."""


def reasoning(planned: TypeNode, model: Model) -> tuple[Record, Model]:
    """A body that has reasons, and counts lessons."""
    move, model = model.create(planned)
    cues = [record(name=name, share=share) for name, share in CUES]
    reasons = [
        record(claim=claim, p=0.87, cues=cues, reminders=[REMINDER])
        for claim in move.explains
    ]
    recalled = [
        record(sign=it, lessons=2.0, **MORE, confused=[]) for it in move.recalls
    ]
    return replace(move, {"reasons": reasons, "recalled": recalled}), model


@pytest.fixture
def table(scene: Callable[..., Any]) -> Any:
    return scene(
        things=2,
        nouns=["cup", "mug", "book"],
        adjectives=["red", "blue"],
        relations=["to the left of", "behind"],
        known=KNOWN,
        act=reasoning,
    )


# --- how sure ------------------------------------------------------------------------


def test_how_sure_it_is_of_what_a_thing_is(table: Any) -> None:
    table.hear("What is this?")
    answer = table.hear("How sure are you?")
    assert answer == "I am quite sure (.87); it might be a mug (.08)."


def test_how_sure_it_is_of_where_a_thing_is(table: Any) -> None:
    table.hear("Where is the cup?")
    answer = table.hear("Are you sure?")
    assert answer == "I am quite sure (.80); it might be behind it (.10)."


@pytest.mark.parametrize(
    ("text", "answer"),
    [
        ("How sure are you that this is a mug?", "I am not sure at all (.08)"),
        ("Are you sure that the cup is red?", "I am very sure (.90)"),
        (
            "Are you sure that this is a unicorn?",
            "I have not learned what a unicorn is",
        ),
    ],
)
def test_how_sure_it_is_of_what_is_asked(table: Any, text: str, answer: str) -> None:
    assert table.hear(text).startswith(answer)


def test_it_is_as_sure_of_what_it_was_told_as_it_has_said(table: Any) -> None:
    table.hear("This is blue.")
    assert table.hear("Is it blue?") == "Yes, it is blue."
    assert table.hear("How sure are you?") == "I am very sure (1.00)."
    assert table.acts("Why?") == ["explain_quality"]
    table.hear("This is not red.")
    assert table.hear("Is it red?") == "No, it is not red."
    assert table.hear("How sure are you?") == "I am very sure (1.00)."


def test_why_it_is_sure_of_what_it_has_just_learned(table: Any) -> None:
    table.hear("This is a cup.")
    assert table.acts("Are you sure?") == ["tell_certainty"]
    assert table.acts("Why?") == ["explain_name"]
    assert table.acts("Are you sure?") == ["tell_certainty"]


def test_what_was_claimed_may_still_be_confirmed(table: Any) -> None:
    table.hear("What is this?")
    table.hear("How sure are you?")
    table.hear("Why?")
    table.hear("What do you know?")
    assert table.hear("That is correct.") == "OK, the one on the left (#1) is a cup."


def test_who_has_claimed_nothing_is_sure_of_nothing(table: Any) -> None:
    assert table.hear("How sure are you?") == "I have not claimed anything."
    assert table.hear("Why?") == "I have not claimed anything."


@given(st.floats(0, 1), st.floats(0, 1))
def test_more_certain_words_need_a_higher_degree(p: float, q: float) -> None:
    def rank(degree: float) -> int:
        nothing = dict.fromkeys(
            ("reasons", "recalls", "recalled", "lost", "undone"), ()
        )
        worded = details(lexicon(), record(degrees=[degree], **nothing))
        return list(lexicon().sections["sureness"]).index(worded["sureness"])

    low, high = sorted((p, q))
    assert rank(low) >= rank(high)


# --- why -----------------------------------------------------------------------------


def test_why_a_thing_is_what_it_is(table: Any) -> None:
    table.hear("What is this?")
    assert table.hear("Why?") == (
        "Because of its colour and shape: it looks like what you called a cup "
        '2 minutes ago ("This is a cup."). Next comes a mug, far behind.'
    )


@pytest.mark.parametrize(
    ("text", "act"),
    [
        ("Why is this a cup?", "explain_name"),
        ("Why do you think that it is a cup?", "explain_name"),
        ("Why is the cup red?", "explain_quality"),
        ("Why is the cup to the left of the book?", "explain_relation"),
        ("Why is this a mug?", "tell_certainty"),
        ("Why is this blue?", "tell_certainty"),
        ("Why is this a unicorn?", "unknown_noun"),
        ("Why is this striped?", "unknown_adjective"),
        ("Why is the cup near the book?", "unknown_relation"),
    ],
)
def test_why_something_is_so(table: Any, text: str, act: str) -> None:
    assert table.acts(text) == [act]


def test_a_claim_that_goes_back_to_no_lesson(scene: Callable[..., Any]) -> None:
    one = scene(nouns=["cup"], adjectives=["red"], known=KNOWN)
    assert one.hear("Why is this red?") == "That is what people call red."
    assert one.hear("Why is this a cup?") == "I cannot say why."


@pytest.mark.parametrize(
    ("age", "time", "said"),
    [
        (3.0, "14:05", "a moment ago"),
        (61.0, "14:05", "a minute ago"),
        (3599.0, "14:05", "59 minutes ago"),
        (3 * 3600.0, "14:05", "today at 14:05"),
        (10 * 3600.0, "14:05", "yesterday at 14:05"),
        (33 * 3600.0, "14:05", "yesterday at 14:05"),
        (34 * 3600.0, "14:05", "on 2026-11-21 at 14:05"),
        (1e9, "00:00", "on 2026-11-21 at 00:00"),
    ],
)
def test_when_it_was_taught(
    scene: Callable[..., Any], age: float, time: str, said: str
) -> None:
    def act(planned: TypeNode, model: Model) -> tuple[Record, Model]:
        move, model = reasoning(planned, model)
        old = replace(REMINDER, {"age": age, "time": time})
        reasons = [replace(it, {"reminders": [old]}) for it in move.reasons]
        return replace(move, {"reasons": reasons}), model

    one = scene(nouns=["cup"], known=KNOWN, act=act)
    assert f" {said} (" in one.hear("Why is this a cup?")


# --- what is known -------------------------------------------------------------------


def test_the_words_that_are_known(table: Any) -> None:
    assert table.hear("What do you know?").split("\n") == [
        "I know these words for things: "
        "book (2 lessons), cup (2 lessons) and mug (2 lessons).",
        "I know these words for how things are: blue (2 lessons) and red (2 lessons).",
        "I know these words for where things are: "
        "behind (2 lessons) and to the left of (2 lessons).",
    ]


def test_what_it_knows_best_comes_first_and_what_nobody_taught_has_no_count(
    scene: Callable[..., Any],
) -> None:
    lessons = {"book": 0.0, "cup": 1.0, "mug": 3.0}

    def act(planned: TypeNode, model: Model) -> tuple[Record, Model]:
        move, model = model.create(planned)
        counted = [
            record(sign=it, lessons=lessons[it.form], **MORE, confused=[])
            for it in move.recalls
        ]
        return replace(move, {"recalled": counted}), model

    one = scene(nouns=lessons, act=act)
    assert one.hear("What do you know?") == (
        "I know these words for things: mug (3 lessons), cup (one lesson) and book."
    )


def test_who_knows_no_word_says_so(scene: Callable[..., Any]) -> None:
    one = scene(colours=[])
    assert one.hear("What words do you know?") == "I do not know any words yet."


def test_of_many_words_some_are_named(scene: Callable[..., Any]) -> None:
    one = scene(nouns=[f"thing{n}" for n in range(100)])
    assert one.hear("What do you know?").endswith(" and 88 more.")


@pytest.mark.parametrize(
    ("text", "meaning"),
    [
        ("What is a cup?", noun("cup").meaning),
        ("What does red mean?", "[look : Look, x : Ind, a : is_red(x, look)]"),
        ("What does behind mean?", "rel : behind(target.x, landmark.x, look, frame)"),
    ],
)
def test_what_a_word_means_is_a_type(table: Any, text: str, meaning: object) -> None:
    table.hear(text)
    [said] = table.state.private.last
    assert str(meaning) in str(said["content"].value)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("What is a cup?", "A cup is what you showed me twice."),
        ("What does behind mean?", '"behind" says how two things stand; you showed me'),
        ("Have you seen a cup before?", "You have not shown me that."),
        (
            "Have you ever seen a unicorn?",
            "I have not learned what a unicorn is. Please show me one.",
        ),
    ],
)
def test_what_a_word_means_is_said_in_words(table: Any, text: str, told: str) -> None:
    assert table.hear(text).startswith(told)


def test_when_a_word_was_taught(scene: Callable[..., Any]) -> None:
    def act(planned: TypeNode, model: Model) -> tuple[Record, Model]:
        move, model = model.create(planned)
        recalled = [
            record(
                sign=it, lessons=3.0, confused=[], qualities=[], reminders=[REMINDER]
            )
            for it in move.recalls
        ]
        return replace(move, {"recalled": recalled}), model

    robot = scene(1, nouns=["cup"], act=act)
    said = robot.hear("When did I show you a cup?")
    assert said.startswith("You showed me a cup three times, the last time ")
    assert robot.hear("What was the last thing I taught you?") == (
        "I do not know any words yet."
    )
    robot.hear("This is a cup.")
    assert robot.hear("What was the last thing I taught you?") == said


@pytest.mark.parametrize(
    ("confused", "told"),
    [
        ([], "is what you showed me twice."),
        (["mug"], 'is what you showed me twice. I may take it for "mug".'),
        (["mug", "bowl"], 'I may take it for "mug" and "bowl".'),
    ],
)
def test_what_it_may_take_a_word_for(
    scene: Callable[..., Any], confused: list[str], told: str
) -> None:
    def act(planned: TypeNode, model: Model) -> tuple[Record, Model]:
        move, model = model.create(planned)
        others = list(map(noun, confused))
        recalled = [
            record(sign=it, lessons=2.0, **MORE, confused=others) for it in move.recalls
        ]
        return replace(move, {"recalled": recalled}), model

    assert scene(nouns=["cup"], act=act).hear("What is a cup?").endswith(told)


def test_what_a_word_means_that_was_never_learned(table: Any) -> None:
    assert (
        table.hear("What is a unicorn?")
        == "I have not learned what a unicorn is. Please show me one."
    )


def test_why_it_does_not_know(scene: Callable[..., Any]) -> None:
    robot = scene(1)
    assert robot.acts("What is this?") == ["admit_name"]
    assert robot.acts("Why?") == ["lack_lessons"]
