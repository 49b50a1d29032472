"""Speaking over the robot: what it had not yet said is not said."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.dialogue.meanings import packaged_types, predicate_at
from ttr import Record, record

KNOWN = {("cup", "o1"): 0.9}


def act(T: Any) -> str:
    return predicate_at(T, "e").name


class Speaker:
    """A robot that may be cut off after some of the moves of its latest turn."""

    def __init__(self, scene: Any, **settings: Any) -> None:
        self.scene = scene(things=1, nouns=["cup"], known=KNOWN, **settings)

    def hear(self, text: str) -> list[str]:
        return self.scene.acts(text)

    def cut(self, whole: int = 0, uttered: str = "") -> None:
        """Cut it off when so many moves, and so much of the next, have been said."""
        said = self.scene.turns[-1].said
        begun = said[: whole + bool(uttered)]
        unsaid = [it.type for it in said[whole:]]
        latest = begun[-1].sit if begun else record()
        self.scene._take(record(unsaid=unsaid, uttered=uttered, latest=latest))

    @property
    def shared_state(self) -> Record:
        shared: Record = self.scene.state.shared
        return shared


@pytest.fixture
def robot(scene: Any) -> Speaker:
    return Speaker(scene)


def test_the_state_says_what_was_cut_off_and_what_of_it_was_uttered(
    robot: Speaker,
) -> None:
    robot.hear("What is this?")
    claimed = robot.shared_state.pending
    robot.cut(uttered="This is")
    [cut] = robot.shared_state.cut
    assert cut.uttered == "This is"
    assert [act(it) for it in cut.moves] == ["assert_name"]
    assert cut.pending == claimed
    assert robot.shared_state.pending == ()
    assert robot.hear("Yes.") == ["wonder"]
    assert robot.shared_state.cut == ()


@pytest.mark.parametrize("again", ["Pardon?", "What did you say?", "Go on."])
def test_what_is_said_again_is_under_discussion_again(
    robot: Speaker, again: str
) -> None:
    robot.hear("What is this?")
    robot.cut(uttered="This")
    assert robot.hear(again) == ["assert_name"]
    assert robot.shared_state.cut == ()
    assert robot.hear("Yes.") == ["learned"]


def test_a_lesson_whose_acknowledgement_was_cut_off_is_not_learned_again(
    robot: Speaker,
) -> None:
    robot.hear("This is a cup.")
    lessons = robot.scene.state.private.lessons
    robot.cut()
    assert robot.scene.state.private.lessons == lessons
    assert robot.hear("Go on.") == ["learned"]
    assert robot.scene.state.private.lessons == lessons


def test_a_question_that_was_begun_may_be_answered(robot: Speaker) -> None:
    assert robot.hear("This is a cupp.") == ["offer_word"]
    robot.cut(uttered="Do you mean")
    assert robot.hear("Yes.") == ["learned"]


def test_a_question_of_which_nothing_was_heard_may_not(robot: Speaker) -> None:
    assert robot.hear("This is a cupp.") == ["offer_word"]
    robot.cut()
    assert robot.shared_state.qud == ()
    assert robot.hear("Yes.") == ["wonder"]


@given(st.integers(0, 1), st.sampled_from(["", "This"]), st.booleans())
def test_what_was_wholly_said_is_not_said_again(
    scene: Any, whole: int, uttered: str, waits: bool
) -> None:
    robot = Speaker(scene)
    robot.hear("What is this?")
    said = robot.scene.turns[-1].said
    if whole < len(said):
        robot.cut(whole, uttered)
    if waits:
        robot.hear("Wait.")
    rest = [act(it.type) for it in said[whole:]]
    assert robot.hear("Go on.") == (rest or ["noted"])
    assert robot.hear("Go on.") == ["noted"]


def test_states_that_were_cut_off_are_states(robot: Speaker) -> None:
    robot.hear("What is this?")
    robot.cut(uttered="This is")
    types = packaged_types()
    assert robot.scene.now.model.judge(robot.scene.state, types["State"]).holds
