"""Guided dialogues with the games of tutoring, and what talk should be like in them.

How many dialogues there are says the Hypothesis profile; `benchmarks/dialogues.py`
plays thousands, and says which rules they applied.
"""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kille.dialogue.meanings import record_type
from kille.lab.robots.simulated import SimulatedRobot
from kille.lab.scenes.scene import Occasion
from kille.lab.tutors.exploring import exploring_tutor
from kille.lab.tutors.heard_sayings import NONSENSE
from kille.lab.tutors.tested_game import roles_in
from kille.lab.worlds.dialogue_properties import OF_TUTORING
from kille.lab.worlds.games import learned_words, simulated_game, world_of
from kille.lab.worlds.perception import glance_event
from kille.lab.worlds.robot_profiles import ROBOTS
from kille.lab.worlds.worlds import draw_world
from ttr.testing import ALL, Suite
from ttr.testing.strategies import play
from ttr.updates.checks import faults_of

PROPERTIES = (*OF_TUTORING, *(one for one in ALL if one.name != "P6"))
"""Whether a rule is of use is asked of many more dialogues, in all strategies."""

MOST = 10_000
EXAMPLES = min(settings().max_examples, MOST)
TURNS = 8


def played(examples: int, language: str = "en", seed: int = 0, **strategy: str) -> str:
    """What is wrong in so many dialogues."""
    suite = Suite(
        simulated_game(draw_world(1 + seed), language=language, **strategy),
        exploring_tutor(language),
        properties=PROPERTIES,
        roles=roles_in(language),
        turns=TURNS,
        examples=examples,
        seed=seed,
    )
    return suite.played().explain_failure()


def test_there_is_no_fault_before_anything_is_played():
    assert [
        str(it)
        for it in faults_of(simulated_game(draw_world(1)))
        if it.severity == "error"
    ] == []


@pytest.mark.slow
def test_guided_dialogues():
    assert played(EXAMPLES // 2) == ""


def test_guided_dialogues_in_swedish():
    assert played(EXAMPLES // 6, "sv", 1) == ""


def test_guided_dialogues_with_an_autonomous_robot():
    assert played(EXAMPLES // 6, seed=2, mode="autonomous", wording="four") == ""


def test_guided_dialogues_with_a_robot_that_only_does_what_it_is_told():
    assert played(EXAMPLES // 6, seed=3, mode="driven") == ""


@pytest.mark.slow
def test_what_was_taught_on_another_day_is_unlearned_by_name_only():
    robot = next(it for it in ROBOTS if it.name == "assisted, on another day")
    suite = Suite(
        robot.game(18 + ROBOTS.index(robot)),
        exploring_tutor(),
        properties=PROPERTIES,
        roles=roles_in("en"),
        turns=12,
        examples=max(20, EXAMPLES // 3),
        seed=18 + ROBOTS.index(robot),
    )
    assert suite.played().explain_failure() == ""


# --- misheard, and corrected (P15) ---------------------------------------------------

# History is what tells that a turn was taken back: the keys of lessons, in which order
# things were talked of (`here`, `salient`, `topic`), the words that a robot has failed
# at, what the tutor spent (`cost`), and what was said last. All else is the same, also
# what every word is true of.


def told(*texts: str, language: str = "en"):
    """The run after these texts, in front of one world."""
    game = simulated_game(draw_world(1), language=language)
    dialogue = play(game, texts)
    assert dialogue.fault is None
    return dialogue.now


MISHEARD = [
    (["This is a cup."], ["This is a cap.", "No, this is a cup."]),
    (["This is a cup."], ["This is a cap.", "No, a cup."]),
    (["This is a cup."], ["This is a cap.", "Forget that.", "This is a cup."]),
    (["This is big."], ["This is pig.", "No, this is big."]),
    (["This is a cup."], ["This is a cap.", "Forget cap.", "This is a cup."]),
]


@pytest.mark.parametrize(("right", "wrong"), MISHEARD)
def test_what_was_misheard_and_corrected_is_as_if_it_had_been_heard(right, wrong):
    end = "Hello."
    one, other = told(*right, end), told(*wrong, end)
    for part in ("nouns", "adjectives", "relations", "agenda", "beliefs", "strategy"):
        assert one.state.private[part] == other.state.private[part], part
    for part in ("pending", "commitments", "qud", "frame", "turned"):
        assert one.state.shared[part] == other.state.shared[part], part
    assert [it.content for it in one.state.private.lessons] == [
        it.content for it in other.state.private.lessons
    ]
    known = {it.sign: [x.of for x in it.lessons] for it in learned_words(one.model)}
    after = {it.sign: [x.of for x in it.lessons] for it in learned_words(other.model)}
    assert known == {sign: of for sign, of in after.items() if of or sign in known}


# --- learning and unlearning, in talk (P12) ------------------------------------------


@given(
    st.lists(st.sampled_from(["a cup", "a mug", "big", "red", "round"]), max_size=4),
    st.sampled_from(["a cup", "a mug", "big", "red"]),
)
@settings(max_examples=20, deadline=None)
def test_to_forget_a_lesson_is_never_to_have_had_it(some, last):
    # An answer to a question may correct, which is more than a lesson: it is dropped.
    before = [*(f"This is {word}." for word in some), "Hello."]
    one = told(*before)
    other = told(*before, f"This is {last}.", "Forget the last thing.")
    taught = {it.sign: [x.of for x in it.lessons] for it in learned_words(one.model)}
    after = {it.sign: [x.of for x in it.lessons] for it in learned_words(other.model)}
    assert taught == {sign: of for sign, of in after.items() if of or sign in taught}
    for part in ("nouns", "adjectives", "relations"):
        assert one.state.private[part] == other.state.private[part]


# --- whatever is said (P17) ----------------------------------------------------------

anything = st.one_of(
    st.text(max_size=60),
    st.sampled_from(NONSENSE),
    st.sampled_from(["Yes.", "No.", "Why?", "The red one.", "What is this?", "Is it?"]),
    st.sampled_from(["This is a cup.", "Where is the cup?", "Forget that."]),
)


@given(st.lists(anything, max_size=6), st.sampled_from(["en", "sv"]))
@settings(deadline=None)
def test_whatever_is_said_there_is_an_answer_and_a_state(texts, language):
    game = simulated_game(draw_world(1), language=language)
    dialogue = play(game, texts)
    assert dialogue.fault is None, dialogue.fault
    for turn in dialogue.turns:
        if turn.heard is not None:
            assert turn.said
            assert all(game.say(move).strip() for move in turn.said)
        for move in turn.said:
            assert not move.sit.teaches or "text" in str(turn.heard)
    now = dialogue.now
    assert now.model.judge(now.state, record_type("State")).holds


FOUND_BY_CHANCE = [
    ["This is a cup.", "Forget that.", "Is the cup between the book and the box?"],
    [*["Why?"] * 7, "Is it bigger?", "And the red one?"],
]
"""Dialogues in which a rule once failed, found by `benchmarks/sentences.py`."""


@pytest.mark.parametrize("texts", FOUND_BY_CHANCE)
def test_dialogues_that_once_failed(texts):
    world = draw_world(1)
    robot = SimulatedRobot(simulated_game(world))
    for seen in (world.point_at(world.in_view[0]), world):
        robot.see(Occasion("noun", seen, 1))
    assert all(robot.hear(text).text for text in texts)


@pytest.mark.parametrize("text", ["cup " * 2500, "?" * 10_000, "\U0001f600" * 10_000])
def test_ten_thousand_characters(text):
    game = simulated_game(draw_world(1))
    dialogue = play(game, [text])
    assert dialogue.fault is None
    assert not dialogue.now.state.private.lessons


def test_hundreds_of_turns():
    game = simulated_game(draw_world(1))
    texts = ["This is a cup.", "What is this?", "Yes.", "Where is it?", "No.", "Why?"]
    now = game.begin()
    for number in range(300):
        before = world_of(now.state)
        shown = before.point_at(before.in_view[number % 4])
        now = game.take(now, glance_event(shown, before)).run
        text = texts[number % len(texts)]
        turn = game.take(now, game.hear(text))
        assert turn.said, (number, text)
        now = turn.run
    assert now.model.judge(now.state, record_type("State")).holds
