"""Who speaks: "Wait." keeps the floor, and nothing is started while it is kept."""

from __future__ import annotations

from typing import Any

import pytest

KNOWN = {("cup", "o1"): 0.9, ("book", "o2"): 0.9}


@pytest.fixture
def robot(scene: Any) -> Any:
    """A robot that would like to know how a cup and a book stand, and has been shown
    both before."""
    robot = scene(things=2, nouns=["cup", "book"], known=KNOWN)
    robot.hear("Hello.")
    return robot


def test_it_would_ask_otherwise(robot: Any) -> None:
    assert robot.look() == ["ask_relation"]


def test_while_the_floor_is_kept_it_starts_nothing(robot: Any) -> None:
    assert robot.hear("Wait.") == 'OK. I wait until you say "Go on."'
    assert robot.state.shared.floor == ("tutor",)
    for _ in range(3):
        assert robot.look() == []
    assert robot.look(kept=[]) == []


def test_while_the_floor_is_kept_it_answers(robot: Any) -> None:
    robot.hear("Hold on.")
    assert robot.acts("What is this?") == ["assert_name"]
    assert robot.acts("Thank you.") == ["welcome"]
    assert robot.look() == []


def test_go_on_gives_the_floor_back_and_it_asks(robot: Any) -> None:
    robot.hear("Wait.")
    assert robot.acts("Go on.") == ["ask_relation"]
    assert robot.state.shared.floor == ()
    assert robot.acts("Go on.") == ["noted"]
    assert robot.look() == []


def test_go_on_without_anything_to_say(scene: Any) -> None:
    robot = scene(things=0)
    robot.hear("Wait.")
    assert robot.hear("Go on.") == "OK."
    assert robot.state.shared.floor == ()
    assert robot.hear("Go on.") == "OK."


def test_what_was_claimed_may_be_confirmed_after_waiting(robot: Any) -> None:
    robot.hear("What is this?")
    claimed = robot.state.shared.pending
    robot.hear("Wait.")
    assert robot.state.shared.pending == claimed != ()
    assert robot.acts("That is correct.") == ["learned"]


def test_what_was_asked_may_be_answered_after_waiting(scene: Any) -> None:
    robot = scene(things=1, nouns=["cup"])
    assert robot.acts("This is a cupp.") == ["offer_word"]
    robot.hear("One moment.")
    assert robot.acts("Go on.") == ["noted"]
    assert robot.acts("Yes.") == ["learned"]


def test_who_waits_in_a_sentence_does_not_keep_the_floor(robot: Any) -> None:
    from kille.dialogue.language import understand

    [said] = understand("Wait, what is this?")
    assert not any("hold_floor" in str(it.type) for it in said.readings)


def test_a_learner_by_itself_learns_nothing_while_the_floor_is_kept(scene: Any) -> None:
    robot = scene(things=1, nouns=["cup"], known=KNOWN, mode="autonomous")
    robot.hear("Wait.")
    assert robot.look() == []
    robot.hear("Go on.")
    assert robot.look() == ["learned_alone"]
