"""What was perhaps said: words, and what is seen, decide before the robot does."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from kille.dialogue.language import Sentence, Utterance, understand
from kille.dialogue.meanings import move_type, record_type, set_to
from kille.dialogue.tutoring import hear_sentences

Make = Callable[..., Any]

WORDS = ("cup", "cap")
CUP = {("cup", "o1"): 0.9, ("cap", "o1"): 0.02}
TEACHING = ("This_is_a_cup.", "This_is_a_cap.")


def taught(scene: Make, cup: float, cap: float, **about: Any) -> str:
    robot = scene(**({"nouns": WORDS, "known": CUP} | about))
    return str(robot.perhaps(**dict(zip(TEACHING, (cup, cap), strict=True))))


@pytest.mark.parametrize(
    ("cup", "cap", "answer"),
    [
        (0.6, 0.3, "OK, I learned a cup."),
        (0.4, 0.55, "OK, I learned a cup."),  # it looks like one
        (0.1, 0.9, "OK, I learned a cap."),  # but it was heard too well
        (0.2, 0.78, "Did you say a cup or a cap?"),
    ],
)
def test_what_is_seen_helps_to_hear(
    scene: Make, cup: float, cap: float, answer: str
) -> None:
    assert taught(scene, cup, cap) == answer


def test_near_ties_are_asked_about_and_settled(scene: Make) -> None:
    robot = scene(nouns=WORDS)
    tie = dict.fromkeys(TEACHING, 0.45)
    assert robot.perhaps(**tie) == "Did you say a cap or a cup?"
    assert len(robot.state.shared.qud[0].options) == 2
    assert not robot.state.private.lessons
    assert robot.hear("A cup.") == "OK, I learned a cup."
    assert not robot.state.shared.qud


@pytest.mark.parametrize(
    ("text", "answer"),
    [
        ("This_cup.", "What about it?"),
        ("What_did_you_say?", "Pardon? I did not hear you well."),
        ("Yes.", "I have not said anything that you could confirm."),
        ("Okay.", "OK."),
    ],
)
def test_whatever_was_said_after_all_is_answered(
    scene: Make, text: str, answer: str
) -> None:
    robot = scene(nouns=("cup",), known=CUP)
    robot.perhaps(**{text: 0.12})
    assert [it.ask for it in robot.state.shared.qud] == ["AskHeard"]
    assert robot.hear("Yes.") == answer


def test_a_word_that_is_known_is_rather_heard(scene: Make) -> None:
    robot = scene(nouns=("cup",))
    tie = dict.fromkeys(TEACHING, 0.5)
    assert robot.perhaps(**tie) == "OK, I learned a cup."


def test_one_that_was_hardly_heard_is_checked(scene: Make) -> None:
    # As in a flight booking: "to Bergen" .4, "to Bethlehem" .2: is it Bergen?
    robot = scene(nouns=WORDS, known={("cup", "o1"): 0.3, ("cap", "o1"): 0.1})
    assert robot.perhaps(**dict(zip(TEACHING, (0.2, 0.05), strict=True))) == (
        "Did you say a cup?"
    )
    assert robot.hear("Yes.") == "OK, I learned a cup."


def test_no_to_what_was_heard_asks_to_hear_it_again(scene: Make) -> None:
    robot = scene(nouns=WORDS, known=CUP)
    assert robot.perhaps(**{"This_is_a_cup.": 0.2}) == "Did you say a cup?"
    assert robot.hear("No.") == "Pardon? I did not hear you well."
    assert not robot.state.shared.qud
    assert not robot.state.private.lessons


@pytest.mark.parametrize("p", [0.05, 1e-5])
def test_below_a_floor_it_begs_your_pardon(scene: Make, p: float) -> None:
    robot = scene(nouns=WORDS)
    assert robot.perhaps(**{"This_is_a_cup.": p}) == "Pardon? I did not hear you well."


def test_questions_are_heard_by_what_there_is_to_see(scene: Make) -> None:
    known = {("cup", "o1"): 0.9, ("book", "o2"): 0.9}
    robot = scene(things=2, nouns=("cup", "cap", "book"), known=known)
    robot.perhaps(**{"Show_me_the_cap.": 0.5, "Show_me_the_cup.": 0.5})
    assert robot.state.shared.latest.points == ("o1",)


def test_what_is_certain_is_never_asked_about(scene: Make) -> None:
    robot = scene(nouns=WORDS, known=CUP)
    assert robot.perhaps(**{"This_is_a_cap.": 1.0}) == "OK, I learned a cap."


def test_what_is_seen_does_not_weigh_against_a_denial(scene: Make) -> None:
    """Also where a theory takes it as a correction: who denies sets something right."""
    denial, other = (understand(f"This is not a {word}.")[0] for word in WORDS)
    [said] = denial.readings
    corrects = set_to(move_type("Heard", "Correct"), **dict(said.type.fields))
    corrects = set_to(corrects, e=record_type("Correct")["e"])
    denial = Sentence(denial.text, (Utterance(said.text, corrects),))
    robot = scene(nouns=WORDS, known=CUP)
    (move,) = robot._take(hear_sentences(denial, other, p=[0.8, 0.2]))
    assert robot.game.say(move) == "OK, this is not a cup."


def test_what_is_heard_has_one_probability_for_each_text() -> None:
    cup, cap = (understand(text)[0] for text in ("This is a cup.", "This is a cap."))
    with pytest.raises(ValueError, match="shorter"):
        hear_sentences(cup, cap, p=[1.0])


# --- after the tests of OpenDial's example of reference ------------------------------

BALLS = {
    ("ball", "o1"): 0.9,
    ("box", "o2"): 0.7,
    ("is_red", "o1"): 0.95,
    ("is_blue", "o2"): 0.9,
    ("is_red", "o3"): 0.9,
    ("to_the_left_of", "o1", "o2"): 0.9,
}


@pytest.fixture
def balls(scene: Make) -> Any:
    return scene(
        things=3,
        nouns=("ball", "box", "newspaper"),
        adjectives=("red", "blue"),
        relations=("to the left of",),
        known=BALLS,
    )


@pytest.mark.parametrize(
    ("text", "act"),
    [
        ("Show me the red ball.", "point_out"),
        ("Show me the red one.", "ask_referent"),
        ("Show me the newspaper.", "see_no_such"),
        ("Show me the ball to the left of the box.", "point_out"),
    ],
)
def test_what_is_referred_to_is_chosen_asked_about_or_missing(
    balls: Any, text: str, act: str
) -> None:
    acts = {"ask_referent": {"ask_referent", "offer_referents"}}
    assert set(balls.acts(text)) <= acts.get(act, {act})


def test_a_new_word_that_was_heard_uncertainly_is_asked_about(scene: Any) -> None:
    robot = scene(1, nouns=["cup"])
    assert robot.perhaps(This_is_a_log=0.75) == "Did you say a log?"
    assert robot.state.private.lessons == ()
    assert robot.hear("Yes.") == "OK, I learned a log."


def test_a_new_word_that_was_heard_well_is_learned(scene: Any) -> None:
    robot = scene(1, nouns=["cup"])
    assert robot.perhaps(This_is_a_log=0.99) == "OK, I learned a log."


def test_letters_that_look_latin_are_latin(scene: Any) -> None:
    robot = scene(1, nouns=["cup"])
    robot.hear("This is a \u0441up.")
    assert [it.form for it in robot.state.private.nouns] == ["cup"]
