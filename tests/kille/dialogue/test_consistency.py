"""What was said counts in every later answer."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.dialogue.meanings import adjective, is_denial, noun, value_at
from kille.dialogue.taxonomy import is_kind_of
from ttr import Record, record, replace


def taught(s: Record) -> list[str]:
    """The lessons of the dialogue, by their words."""
    return [
        f"{'not ' * is_denial(it.content)}{it.sign.form}" for it in s.private.lessons
    ]


KNOWN = {
    ("cup", "o1"): 0.9,
    ("book", "o2"): 0.9,
    ("is_red", "o1"): 0.9,
    ("is_red", "o2"): 0.0,
}


@pytest.fixture
def table(scene: Callable[..., Any]) -> Any:
    """A red cup and a book of some other colour."""
    return scene(2, nouns=["cup", "book"], adjectives=["red"], known=KNOWN)


# --- what was taught of a thing counts when it is talked of ---------------------------


def test_what_was_called_red_is_the_red_one(table: Any) -> None:
    assert table.hear("Show me the red one.") == "This is the red one: #1."
    table.hear("The cup is not red.")
    table.hear("The book is red.")
    assert table.hear("Show me the red one.") == "This is the red one: #2."
    assert table.hear("What is the red one?") == "This is a book."
    assert table.hear("How many red things are there?") == "One."
    assert table.hear("Is the red one a book?") == "Yes, the red one is a book."


def test_what_was_called_red_has_no_other_colour(scene: Callable[..., Any]) -> None:
    known = {("is_red", "o1"): 0.6, ("is_crimson", "o1"): 0.9}
    words = ["red", "crimson"]
    robot = scene(1, adjectives=words, colours=map(adjective, words), known=known)
    robot.hear("This is red.")
    assert robot.hear("What colour is it?") == "This is red."


def test_what_was_called_a_mug_is_the_mug(table: Any) -> None:
    table.hear("Actually, the book is a mug.")
    assert table.hear("Show me the mug.") == "This is the mug: #2."


def test_what_is_not_red_after_all_is_not_the_red_one(table: Any) -> None:
    table.hear("The cup is not red.")
    assert table.acts("Show me the red one.") == ["see_no_such"]
    table.hear("Forget that the cup is not red.")
    assert table.hear("Show me the red one.") == "This is the red one: #1."


# --- how one thing stands to another says where the other one is ----------------------


def test_a_place_is_told_the_other_way_round(scene: Callable[..., Any]) -> None:
    known = {("cup", "o1"): 0.9, ("book", "o2"): 0.9, ("left_of", "o1", "o2"): 0.9}
    robot = scene(2, nouns=["cup", "book"], relations=["left of"], known=known)
    answer = "The cup is left of the book."
    assert robot.hear("Where is the cup?") == answer
    assert robot.hear("Where is the book?") == answer
    assert robot.acts("Yes.") == ["learned_relation"]


def test_a_place_for_which_there_is_a_word_is_told_by_that(
    scene: Callable[..., Any],
) -> None:
    known = {("cup", "o1"): 0.9, ("book", "o2"): 0.9}
    known |= {("left_of", "o1", "o2"): 0.9, ("right_of", "o2", "o1"): 0.9}
    relations = ["left of", "right of"]
    robot = scene(2, nouns=["cup", "book"], relations=relations, known=known)
    assert robot.hear("Where is the book?") == "The book is right of the cup."


# --- why, after it was confirmed, corrected or taught ---------------------------------


def test_why_after_a_claim_was_confirmed(table: Any) -> None:
    table.hear("What is this?")
    assert table.acts("Yes.") == ["learned"]
    assert table.acts("Why?") == ["explain_name"]
    assert table.acts("How sure are you?") == ["tell_certainty"]


def test_why_after_a_claim_was_corrected(scene: Callable[..., Any]) -> None:
    known = {("cup", "o1"): 0.9, ("mug", "o1"): 0.5}
    robot = scene(nouns=["cup", "mug"], known=known)
    robot.hear("What is this?")
    assert robot.acts("No, this is a mug.") == ["corrected"]
    assert robot.acts("Why?") == ["explain_name"]


def test_why_after_a_lesson(table: Any) -> None:
    table.hear("This is red.")
    assert table.acts("Why?") == ["explain_quality"]


def test_why_after_something_else_is_about_nothing(table: Any) -> None:
    table.hear("This is red.")
    table.hear("Hello.")
    assert table.acts("Why?") == ["no_claim"]


# --- a no after several lessons -------------------------------------------------------


@pytest.mark.parametrize("times", [2, 5])
def test_a_no_takes_back_the_last_of_several_confirmations(
    scene: Callable[..., Any], times: int
) -> None:
    robot = scene(nouns=["cup"], known={("cup", "o1"): 0.9})
    for _ in range(times):
        robot.hear("What is this?")
        assert robot.acts("Yes.") == ["learned"]
    robot.hear("What is this?")
    assert robot.hear("No.") == "I see. Please tell me, then."
    assert taught(robot.state) == ["cup"] * (times - 1)
    assert [it.form for it in robot.state.private.nouns] == ["cup"]
    assert robot.acts("Is this a cup?") == ["say_yes"]


def test_a_no_to_what_was_taught_once_is_a_lesson_that_it_is_not_so(
    scene: Callable[..., Any],
) -> None:
    robot = scene(nouns=["cup"], known={("cup", "o1"): 0.9})
    robot.hear("This is a cup.")
    robot.hear("What is this?")
    robot.hear("No.")
    assert taught(robot.state) == ["not cup"]


def test_whoever_says_what_is_not_so_means_all_lessons(
    scene: Callable[..., Any],
) -> None:
    robot = scene(nouns=["cup"], known={("cup", "o1"): 0.9})
    robot.hear("This is a cup.")
    robot.hear("This is a cup.")
    robot.hear("This is not a cup.")
    assert taught(robot.state) == []


# --- forget that, in a new dialogue ---------------------------------------------------


@pytest.fixture
def taught_robot(scene: Callable[..., Any]) -> Any:
    """A robot that was taught the word cup in another dialogue."""
    known, cup = {("cup", "o1"): 0.9}, record(sign=noun("cup"), lessons=2.0)
    return scene(2, nouns=["cup"], known=known, taught=[cup])


def test_it_asks_before_it_forgets_a_word_of_another_dialogue(
    taught_robot: Any,
) -> None:
    taught_robot.hear("What is this?")
    assert taught_robot.acts("Forget that.") == ["ask_forget"]
    assert taught_robot.acts("Yes.") == ["forgot_noun"]
    assert taught_robot.state.private.taught == ()


def test_it_keeps_the_word_if_the_tutor_says_no(taught_robot: Any) -> None:
    taught_robot.hear("What is this?")
    taught_robot.hear("Forget that.")
    assert taught_robot.acts("No.") == ["noted"]
    assert len(taught_robot.state.private.taught) == 1
    assert taught_robot.acts("Yes.") == ["wonder"]


def test_anything_else_drops_the_question(taught_robot: Any) -> None:
    taught_robot.hear("What is this?")
    taught_robot.hear("Forget that.")
    assert taught_robot.acts("What is this?") == ["assert_name"]
    assert taught_robot.acts("Yes.") == ["learned"]


def test_a_lesson_of_this_dialogue_is_forgotten_first(taught_robot: Any) -> None:
    taught_robot.hear("This is a cup.")
    taught_robot.hear("What is this?")
    assert taught_robot.acts("Forget that.") == ["forgot"]
    taught_robot.hear("What is this?")
    assert taught_robot.acts("Forget that.") == ["ask_forget"]


def test_where_nothing_was_said_the_latest_lesson_is_forgotten(
    taught_robot: Any,
) -> None:
    assert taught_robot.acts("Forget that.") == ["forgot_last"]
    assert taught_robot.acts("Forget that.") == ["forget_nothing"]


def test_what_was_called_by_rivals_is_not_called_what_it_is_not(
    scene: Callable[..., Any],
) -> None:
    known = {("cup", "o1"): 0.6, ("vessel", "o2"): 0.3}
    robot = scene(2, nouns=["cup", "mug", "vessel"], known=known)
    robot.hear("A cup is a kind of mug.")
    robot.hear("This is a mug.")
    robot.hear("This is a cup.")
    assert robot.acts("You mixed them up.") == ["ask_meant", "ask_meant_too"]
    robot.hear("Yes.")
    robot.hear("A cup is a kind of vessel.")
    assert "cup" not in robot.hear("What is this?")


# --- law: what was taught is affirmed -------------------------------------------------

THINGS = ("o1", "o2")
NOUNS = ("cup", "mug", "vessel")
QUALITIES = ("red", "round")
WORDS = (*NOUNS, *QUALITIES)

LESSONS = st.tuples(st.sampled_from(THINGS), st.sampled_from(WORDS), st.booleans())
KINDS = st.tuples(st.sampled_from(NOUNS), st.sampled_from(NOUNS))
SWAPS = st.just(("swap",))
DEGREES = st.fixed_dictionaries(
    {
        (word, x): st.sampled_from([0.0, 0.3, 0.6, 0.95])
        for word in WORDS
        for x in THINGS
    }
)

ANSWERS = {"ask_both": "Yes.", "ask_kind_still": "Yes.", "ask_meant_too": "Yes."}
"""What the tutor says when the robot asks before it learns."""


def claim(word: str) -> str:
    """What is said of a thing by a word."""
    return f"a {word}" if word in NOUNS else word


def point_at(robot: Any, x: str) -> None:
    """Have the tutor point at a thing."""
    robot._take(replace(robot.seen("Glance"), {"view.focus": [x], "view.pointed": [x]}))


def tell(robot: Any, text: str) -> None:
    """Say something, and answer what the robot asks before it learns it."""
    act = robot.acts(text)[-1]
    if act in ANSWERS:
        robot.acts(ANSWERS[act])


COUNTS = {
    "I see none.": (0, 0),
    "Perhaps one, but I am not sure.": (0, 1),
    "Perhaps two, but I am not sure.": (0, 2),
    "One.": (1, 1),
    "One, and perhaps one more.": (1, 2),
    "Two.": (2, 2),
}
"""How many things at least and at most an answer says that there are."""


SAID = st.one_of(LESSONS, LESSONS, LESSONS, KINDS, SWAPS)


@given(st.lists(SAID, min_size=1, max_size=12), DEGREES)
def test_what_was_taught_is_affirmed(
    scene: Callable[..., Any],
    said: list[tuple[str, str, bool] | tuple[str, str] | tuple[str]],
    degrees: dict[tuple[str, str], float],
) -> None:
    known = {
        (word if word in NOUNS else f"is_{word}", x): p
        for (word, x), p in degrees.items()
    }
    robot = scene(2, nouns=NOUNS, adjectives=QUALITIES, known=known)
    for one in said:
        match one:
            case (x, word, so):
                point_at(robot, x)
                tell(robot, f"This is {'' if so else 'not '}{claim(word)}.")
            case (lower, upper):
                tell(robot, f"A {lower} is a kind of {upper}.")
            case ("swap",):
                tell(robot, "You mixed them up.")
    held = [
        (str(value_at(it.content["target"], "x")), it.sign, not is_denial(it.content))
        for it in robot.state.private.lessons
    ]
    signs = robot.state.private.nouns
    follow = [
        (x, upper, True)
        for x, sign, so in held
        for upper in signs
        if so and sign.kind == "noun" and is_kind_of(robot.state, sign, upper)
    ]
    told = {(x, sign.form): so for x, sign, so in [*held, *follow]}
    for x, sign, so in [*held, *follow]:
        point_at(robot, x)
        [act] = robot.acts(f"Is this {claim(sign.form)}?")
        number = THINGS.index(x) + 1
        assert robot.acts(f"Is #{number} {claim(sign.form)}?") == [act]
        assert (act == "say_yes") is so, (x, sign.form, so, act)
        assert so or act in ("say_no", "say_rather"), (x, sign.form, act)
    for x in THINGS:
        about = [(sign.form, so) for y, sign, so in [*held, *follow] if y == x]
        assert not any((form, not so) in about for form, so in about)
        check_name(robot, x, {form: so for form, so in about if form in NOUNS})
    for word in WORDS:
        check_things(robot, word, [told.get((x, word)) for x in THINGS])


def check_name(robot: Any, x: str, told: dict[str, bool]) -> None:
    """What a thing is called is what it was called, and nothing that was denied."""
    point_at(robot, x)
    [act] = robot.acts("What is this?")
    first, *rest = [it.form for it in robot.state.shared.latest.signs] or [None]
    assert not any(told.get(it) is False for it in (first, *rest)), (first, rest, told)
    if any(told.values()):
        assert act in ("assert_name", "hedge_name")
        assert told.get(first), (act, first, told)


def check_things(robot: Any, word: str, told: list[bool | None]) -> None:
    """Of what was called something there is that many, and it is what is shown."""
    least, most = COUNTS[robot.hear(f"How many {plural(word)} are there?")]
    assert told.count(True) <= least, (word, told)
    assert most <= len(told) - told.count(False), (word, told)
    phrase = f"the {word}" if word in NOUNS else f"the {word} one"
    if sorted(map(str, told)) == ["False", "True"]:
        assert f"#{told.index(True) + 1}" in robot.hear(f"Show me {phrase}.")
        [act] = robot.acts(f"Where is {phrase}?")
        assert act in ("need_landmark", "admit_place", "tell_place"), act
    if told == [False, False]:
        assert robot.acts(f"Show me {phrase}.") == ["see_no_such"]


def plural(word: str) -> str:
    """How the things of which a word holds are counted."""
    return f"{word}s" if word in NOUNS else f"{word} things"
