"""Taking the turn after a silence: what is remarked on, when, and when not."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kille.dialogue.strategies import TURNS, strategy
from ttr import Record, record

KNOWN = {("cup", "o1"): 0.9, ("book", "o2"): 0.9}
THINGS = ("o1", "o2", "o3")


def watching_event(
    things: Sequence[str] = THINGS,
    came: Sequence[str] = (),
    went: Sequence[str] = (),
    silence: float = 2.0,
    still: float = 2.0,
) -> Record:
    """A look while nobody speaks."""
    view = record(
        look="look1",
        things=list(things),
        placed=list(things),
        focus=list(things[:1]),
        pointed=[],
    )
    kept = [x for x in things if x not in came]
    return record(
        view=view, kept=kept, came=came, went=went, silence=silence, still=still
    )


class Watcher:
    """A robot that watches things, of which it has seen the first two."""

    def __init__(self, scene: Any, **settings: Any) -> None:
        self.scene = scene(
            things=3, nouns=["cup", "book"], known=KNOWN, turns="lively", **settings
        )

    def watch(self, **event: Any) -> list[str]:
        """What the robot does then, by the names of its acts."""
        return self.scene._acts(self.scene._take(watching_event(**event)))

    def hear(self, text: str) -> list[str]:
        return self.scene.acts(text)

    @property
    def state(self) -> Record:
        return self.scene.state


@pytest.fixture
def robot(scene: Any) -> Watcher:
    return Watcher(scene)


def test_what_it_does_not_know_it_asks_about(robot: Watcher) -> None:
    assert robot.watch(came=["o3"]) == ["ask_new"]
    assert robot.state.view.focus == ("o3",)
    assert robot.hear("A lamp.") == ["learned"]
    assert robot.state.shared.commitments[-1]["target"]["x"].value == "o3"


def test_what_it_knows_it_asks_to_have_confirmed(robot: Watcher) -> None:
    assert robot.watch(came=["o2"]) == ["ask_new_name"]
    assert len(robot.state.shared.pending) == 1
    assert robot.hear("Yes.") == ["learned"]


def test_what_is_gone_and_what_has_moved(robot: Watcher) -> None:
    assert robot.watch(things=["o2", "o3"], went=["o1"]) == ["tell_gone"]
    robot = Watcher(type(robot.scene))
    assert robot.watch(came=["o1"], went=["o1"]) == ["tell_moved"]
    robot = Watcher(type(robot.scene))
    assert robot.watch(things=["o1", "o2"], went=["o3"]) == ["tell_gone"]
    assert robot.scene.hear("What did you say?") == "Something is gone."


@pytest.mark.parametrize("soon", [{"silence": 1.4}, {"still": 1.4}])
def test_before_the_silence_is_long_enough_it_says_nothing(
    robot: Watcher, soon: dict[str, float]
) -> None:
    assert robot.watch(came=["o3"], **soon) == []
    assert len(robot.state.private.news) == 1
    assert robot.watch() == ["ask_new"]


def test_each_change_is_told_in_a_turn_of_its_own(robot: Watcher) -> None:
    assert robot.watch(things=["o2", "o3"], came=["o3"], went=["o1"]) == ["ask_new"]
    assert robot.watch(things=["o2", "o3"]) == ["tell_gone"]
    assert robot.watch(things=["o2", "o3"]) == []


def test_what_the_tutor_speaks_after_is_no_news(robot: Watcher) -> None:
    robot.watch(came=["o3"], silence=0.5)
    robot.hear("Hello.")
    assert robot.state.private.news == ()
    assert robot.watch() == []


def test_it_asks_after_a_longer_silence_unless_its_question_is_open(
    robot: Watcher,
) -> None:
    assert robot.watch(silence=7.9) == []
    assert robot.watch(silence=8.1) == ["ask_relation"]
    assert robot.watch(silence=90.0) == []
    robot.hear("Thank you.")
    assert robot.watch(silence=8.1) == ["ask_thing"]


def test_nothing_is_taken_while_the_tutor_is_asked_something(scene: Any) -> None:
    robot = Watcher(scene)
    assert robot.hear("This is a cupp.") == ["offer_word"]
    assert robot.watch(came=["o3"], silence=60.0, still=60.0) == []


def test_by_default_no_turn_is_taken(scene: Any) -> None:
    robot = Watcher(scene)
    robot.scene = scene(things=3, nouns=["cup", "book"], known=KNOWN)
    assert robot.watch(came=["o3"], silence=9e9, still=9e9) == []


def test_the_turns_of_a_strategy() -> None:
    silences = {name: strategy(turns=name).turns for name in TURNS}
    assert [it.name for it in silences.values()] == list(TURNS)
    assert strategy().turns == silences["answering"]
    assert silences["answering"].remark == silences["answering"].ask == 0.0
    assert 0.0 < silences["lively"].remark < silences["lively"].ask
    with pytest.raises(ValueError, match="there is no chatty"):
        strategy(turns="chatty")


# --- laws ----------------------------------------------------------------------------

HELD, FREE = "Wait.", "Go on."
changes = st.lists(st.sampled_from(THINGS), max_size=2, unique=True)
events = st.one_of(
    st.sampled_from([HELD, FREE, "Hello.", "What is this?", "Yes.", "No."]),
    st.tuples(changes, changes, st.sampled_from([0.5, 2.0, 9.0])),
)


@given(st.lists(events, max_size=12))
def test_while_the_floor_is_kept_no_turn_is_taken(scene: Any, happened: Any) -> None:
    robot = Watcher(scene)
    for event in happened:
        held = bool(robot.state.shared.floor)
        if isinstance(event, str):
            robot.hear(event)
            assert bool(robot.state.shared.floor) == (
                event == HELD or (held and event != FREE)
            )
            continue
        came, went, seconds = event
        done = robot.watch(came=came, went=went, silence=seconds, still=seconds)
        assert not (held and done)
        assert len(done) <= 1


@settings(max_examples=max(10, settings().max_examples // 3))
@given(st.lists(events, max_size=8))
def test_without_a_change_nothing_is_said_twice(scene: Any, happened: Any) -> None:
    robot = Watcher(scene)
    for event in happened:
        if isinstance(event, str):
            robot.hear(event)
        else:
            came, went, seconds = event
            robot.watch(came=came, went=went, silence=seconds, still=seconds)
    said: list[str] = []
    for _ in range(8):
        robot.hear("Thank you.")
        done = robot.watch(silence=99.0, still=99.0)
        said += [robot.scene.game.say(it) for it in robot.scene.turns[-1].said if done]
    assert len(said) == len(set(said))
