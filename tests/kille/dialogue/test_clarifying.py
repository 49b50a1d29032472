"""Which one do you mean? What is asked about a phrase, and what becomes of answers."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from kille.dialogue.reference import things_in
from ttr import replace

Scenes = Callable[..., Any]

KNOWN = {
    ("cup", "o1"): 0.9,
    ("cup", "o2"): 0.85,
    ("book", "o3"): 0.95,
    ("is_red", "o1"): 0.9,
    ("is_blue", "o2"): 0.9,
    ("is_big", "o1"): 0.8,
    ("is_big", "o2"): 0.8,
    ("to_the_left_of", "o1", "o3"): 0.9,
    ("to_the_right_of", "o2", "o3"): 0.9,
}
WORDS = {
    "nouns": ["cup", "book"],
    "adjectives": ["red", "blue", "big"],
    "relations": ["to the left of", "to the right of"],
}
WHICH = "Do you mean the red cup or the blue cup?"
LEFT = "The cup is to the left of the book."
RIGHT = "The cup is to the right of the book."


@pytest.fixture
def table(scene: Scenes) -> Any:
    """A red cup to the left of a book, and a blue one to the right of it."""
    return scene(3, known=KNOWN, **WORDS)


@pytest.mark.parametrize(
    ("answer", "said"),
    [
        ("The red one.", LEFT),
        ("The red cup.", LEFT),
        ("This one.", LEFT),
        ("The blue one.", RIGHT),
        ("The second one.", RIGHT),
        ("The second.", RIGHT),
        ("The left one.", LEFT),
        ("The last one.", RIGHT),
        ("The other one.", RIGHT),
        ("The one to the right of the book.", RIGHT),
    ],
)
def test_answers(table: Any, answer: str, said: str) -> None:
    """The question goes on as if it had been specific from the start."""
    assert table.hear("Where is the cup?") == WHICH
    assert len(table.state.shared.qud) == 1
    assert table.hear(answer) == said
    assert table.state.shared.qud == ()


def test_options_are_the_move_made_specific(table: Any) -> None:
    table.hear("Where is the cup?")
    (issue,) = table.state.shared.qud
    asked = table.state.shared.qud[0].options
    assert issue.ask == "AskReferent"
    assert [str(it.content["target"]["x"]) for it in asked] == ["Ind@o1", "Ind@o2"]
    assert {it.text for it in asked} == {"Where is the cup?"}


def test_what_is_not_there_is_not_pointed_at(scene: Scenes) -> None:
    known = {("cup", "o1"): 0.9, ("book", "o2"): 0.9}
    robot = scene(2, nouns=["cup", "book"], known=known)
    assert robot.hear("Where is this book?") == "I do not see a book here."


def test_of_several_adjectives_it_says_which_one_it_does_not_know(table: Any) -> None:
    answer = table.hear("Where is the big striped cup?")
    assert answer == table.hear("Where is the striped cup?")
    assert '"striped"' in answer


def test_a_word_is_known_though_nothing_in_view_is_called_so(scene: Scenes) -> None:
    robot = scene(1)
    assert robot.acts("Where is the mug?") == ["unknown_noun"]
    assert robot.acts("This is a mug.") == ["learned"]
    assert robot.acts("Where is the mug?") == ["need_landmark"]
    robot.look(kept=())
    assert robot.acts("Where is the mug?") == ["see_no_such"]


def test_a_lesson_waits_for_the_answer(table: Any) -> None:
    assert table.hear("The cup is near the book.") == WHICH
    assert table.state.private.lessons == ()
    assert "near" in table.hear("The blue one.")
    (lesson,) = table.state.private.lessons
    assert str(lesson.content["target"]["x"]) == "Ind@o2"
    assert str(lesson.content["landmark"]["x"]) == "Ind@o3"


def test_what_was_chosen_for_one_phrase_is_not_what_the_other_means(table: Any) -> None:
    assert table.hear("The cup is behind the cup.") == WHICH
    assert "behind" in table.hear("The red one.")
    (lesson,) = table.state.private.lessons
    assert things_in(lesson.content) == ["o1", "o2"]


def test_what_was_chosen_is_what_is_talked_about(table: Any) -> None:
    table.hear("Where is the cup?")
    table.hear("The blue one.")
    assert table.state.shared.salient[0] == "o2"
    assert table.hear("Where is the cup?") == RIGHT
    assert table.hear("Where is the other cup?") == LEFT


@pytest.mark.parametrize(
    ("answer", "act"),
    [
        ("The big one.", "what_about"),
        ("Yes.", "wonder"),
        ("The book.", "what_about"),
    ],
)
def test_asked_back_once(table: Any, answer: str, act: str) -> None:
    """An answer that does not say which is asked back once, then dropped."""
    table.hear("Where is the cup?")
    assert table.hear(answer) == WHICH
    assert len(table.state.shared.qud) == 1
    assert table.acts(answer) == [act]
    assert table.state.shared.qud == ()


def test_asked_back_and_then_answered(table: Any) -> None:
    table.hear("Where is the cup?")
    table.hear("The big one.")
    assert table.hear("The second.") == RIGHT


@pytest.mark.parametrize("answer", ["No.", "Neither.", "None of them."])
def test_neither(table: Any, answer: str) -> None:
    table.hear("Where is the cup?")
    assert table.acts(answer) == ["resign"]
    assert table.state.shared.qud == ()
    assert table.acts("The red one.") == ["what_about"]


def test_who_is_thanked_still_knows_what_the_talk_is_about(table: Any) -> None:
    table.hear("What is the blue cup?")
    assert table.hear("Thank you.") == "You are welcome."
    assert table.hear("Where is the cup?") == RIGHT


def test_what_the_tutor_turns_to_is_what_the_talk_is_about(table: Any) -> None:
    table.hear("What is the red cup?")
    table._take(replace(table.seen("Glance"), {"view.focus": ("o2",)}))
    assert table.hear("Where is the cup?") == RIGHT


def test_something_else_drops_the_question(table: Any) -> None:
    """It is heard as itself, and the question is not answered any more."""
    table.hear("Where is the cup?")
    assert table.hear("What is this?") == "This is a cup."
    assert table.state.shared.qud == ()
    assert table.acts("The red one.") == ["assert_name"]  # "What is the red one?"


def test_the_same_question_is_asked_again_but_not_twice(table: Any) -> None:
    for _ in range(3):
        assert table.hear("Where is the cup?") == WHICH
        assert len(table.state.shared.qud) == 1


def test_some_of_three_are_asked_about(scene: Scenes) -> None:
    """An answer that leaves two of three makes the question smaller."""
    known = KNOWN | {("cup", "o3"): 0.9, ("is_red", "o3"): 0.9, ("is_big", "o3"): 0.8}
    known |= {("book", "o3"): 0.0, ("book", "o4"): 0.9}
    robot = scene(4, known=known, **WORDS)
    assert robot.hear("Where is the cup?") == "Which cup do you mean?"
    assert robot.acts("The red one.") == ["ask_referent"]
    assert len(robot.state.shared.qud[0].options) == 2
    assert "is on the left" in robot.hear("The first one.")


def test_two_phrases_are_asked_about_in_turn(scene: Scenes) -> None:
    known = {
        ("cup", "o1"): 0.9,
        ("cup", "o2"): 0.9,
        ("book", "o3"): 0.9,
        ("book", "o4"): 0.9,
        ("is_red", "o1"): 0.9,
        ("is_red", "o3"): 0.9,
        ("is_blue", "o2"): 0.9,
        ("is_blue", "o4"): 0.9,
    }
    robot = scene(4, known=known, **WORDS)
    assert robot.hear("The cup is near the book.") == WHICH
    assert robot.hear("The red one.") == "Do you mean the red book or the blue book?"
    assert "near" in robot.hear("The blue book.")
    (lesson,) = robot.state.private.lessons
    assert str(lesson.content["target"]["x"]) == "Ind@o1"
    assert str(lesson.content["landmark"]["x"]) == "Ind@o4"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("Where is the red book?", "I do not see a red book here."),
        (
            "Where is the blue cup to the left of the book?",
            "I do not see a blue cup to the left of the book here.",
        ),
        (
            "What is the cup near the box?",
            'I have not learned what "near" means. Please show me an example.',
        ),
    ],
)
def test_what_is_not_there(table: Any, text: str, said: str) -> None:
    assert table.hear(text) == said


def test_a_lesson_about_what_was_taken_away_is_not_learned(table: Any) -> None:
    """The question about it is dropped, and its answer is one to nothing."""
    assert table.hear("The cup is new.") == WHICH
    table.names, table.placed = ["o1", "o3"], ["o1", "o3"]
    table.look()
    assert table.state.shared.qud == ()
    assert table.acts("The blue one.") == ["what_about"]
    assert table.state.private.lessons == ()


def test_a_lesson_is_learned_in_the_latest_look(table: Any) -> None:
    """Whatever was asked, what is learned says in which look it was so."""
    table.hear("The cup is new.")
    table.hear("The blue one.")
    (lesson,) = table.state.private.lessons
    assert str(lesson.content["look"]) == "Look@look1"


def test_yes_to_two_confirms_nothing(table: Any) -> None:
    """Nor does it confirm what the robot had claimed before it asked."""
    table.hear("What is this?")
    table.hear("What is the book?")
    table.hear("Where is the cup?")
    table.hear("Yes.")
    table.hear("Yes.")
    assert table.state.private.lessons == ()


def test_nothing_is_there(scene: Scenes) -> None:
    empty = scene(0, **WORDS)
    assert empty.hear("Where is the cup?") == "I do not see a cup here."
    assert empty.acts("What is this?") == ["see_nothing"]


# --- phrases that name a landmark ----------------------------------------------------

BOTH_LEFT = {**KNOWN, ("to_the_left_of", "o2", "o3"): 0.9}


@pytest.mark.parametrize(
    ("text", "adjectives", "asked"),
    [
        ("Where is the cup to the left of the book?", ["red", "blue"], WHICH),
        ("Show me the cup to the left of the book.", [], "Which cup do you mean?"),
        ("Show me the one to the left of the book.", [], "Which one do you mean?"),
    ],
)
def test_a_landmark_is_not_what_is_asked_for(
    scene: Scenes, text: str, adjectives: list[str], asked: str
) -> None:
    words = {**WORDS, "adjectives": adjectives}
    assert scene(3, known=BOTH_LEFT, **words).hear(text) == asked


def test_what_is_found_beside_a_landmark_is_not_called_like_it(table: Any) -> None:
    table.hear("Show me the red one to the left of the book.")
    assert table.state.shared.pending == ()
    table.hear("Show me the red cup to the left of the book.")
    assert [it["c"].pred.name for it in table.state.shared.pending] == ["cup"]
