"""What a robot gives as reasons, and recalls, from what it saw and was told."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import UTC, datetime, timedelta

import pytest

from kille import Agent
from kille.perception.colours import colours_of
from kille.scene import Percept
from ttr import Record


class Clock:
    """A clock that somebody sets."""

    def __init__(self) -> None:
        self.now = datetime(2026, 11, 21, 14, 5, tzinfo=UTC)

    def __call__(self) -> datetime:
        return self.now


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.fixture
def robot(clock: Clock) -> Iterator[Agent]:
    with Agent("synthetic:empty?seed=11", now=clock) as robot:
        robot.do("show cup")
        robot.hear("This is a cup.")
        yield robot


def move(robot: Agent) -> Record:
    """What the robot did last."""
    said = robot.exchanges[-1].said[-1].judgement
    assert said is not None
    assert isinstance(said.sit, Record)
    return said.sit


def test_a_lesson_learned_from_a_yes_is_what_was_said_first(robot: Agent) -> None:
    assert robot.hear("I have brought you a mug today.").startswith("Do you mean")
    assert robot.hear("Yes.") == "Is it both a cup and a mug?"
    robot.hear("Yes.")
    assert '("I have brought you a mug today.")' in robot.hear("Why is this a mug?")


def test_a_lesson_that_confirms_a_claim_is_the_claim(robot: Agent) -> None:
    robot.hear("What is this?")
    robot.hear("Yes.")
    [lesson] = robot.memory.lessons()[-1:]
    assert lesson.turn.text == "This is a cup."


def test_a_reason_goes_back_to_its_lesson(robot: Agent, clock: Clock) -> None:
    clock.now += timedelta(minutes=2)
    answer = robot.hear("Why is this a cup?")
    assert '2 minutes ago ("This is a cup.")' in answer
    [reason] = move(robot).reasons
    [reminder] = reason.reminders
    lesson = robot.memory.lesson_without_sight(int(reminder.key))
    assert (reminder.text, reminder.turn) == (lesson.turn.text, str(lesson.turn.number))
    assert reminder.age == 120.0
    assert robot.memory.picture(int(reminder.key)) is not None
    shares = [cue.share for cue in reason.cues]
    assert shares == sorted(shares, reverse=True)
    assert sum(shares) == pytest.approx(1.0)
    assert reason.p > 0.6


def test_the_lesson_may_be_of_an_earlier_dialogue(robot: Agent, clock: Clock) -> None:
    robot.do("restart")
    clock.now += timedelta(days=3)
    assert "ago" not in robot.hear("Why is this a cup?")
    [reason] = move(robot).reasons
    assert reason.reminders[0].dialogue == "1"


def test_what_was_never_taught_has_no_lesson() -> None:
    with Agent("synthetic:empty?seed=11") as robot:
        robot.do("show apple")
        colour = max(
            ("red", "green", "yellow"), key=lambda word: degree_of(robot, word)
        )
        assert robot.hear(f"Why is this {colour}?") == (
            f"Because of its colour: that is what people call {colour}."
        )


def degree_of(robot: Agent, word: str) -> float:
    robot.hear(f"Why is this {word}?")
    return float(move(robot).degrees[0])


def test_lessons_are_counted_over_dialogues(robot: Agent) -> None:
    robot.do("restart")
    robot.hear("This is a cup.")
    robot.hear("What is a cup?")
    [recalled] = move(robot).recalled
    assert recalled.lessons == 2.0


def test_a_word_is_forgotten_with_all_its_lessons(robot: Agent) -> None:
    robot.do("restart")
    robot.hear("This is a cup.")
    robot.hear("This is striped.")
    robot.hear("Forget cup.")
    assert [it.word.name for it in robot.memory.lessons()] == ["is_striped"]
    assert len(move(robot).dropped) == 2


@pytest.mark.parametrize(
    "turns",
    [
        ["This is a mug.", "Forget that."],
        ["This is not a mug.", "Forget that."],
        ["This is a mug.", "Forget mug."],
        ["This is striped.", "Forget striped."],
        ["This is a cap.", "This is not a cap."],
        ["This is red.", "Forget the last thing."],
        ["No, this is a mug.", "Forget that.", "This is a cup.", "Forget that."],
    ],
)
def test_what_is_forgotten_leaves_no_trace(turns: list[str], clock: Clock) -> None:
    with Agent("synthetic:empty?seed=11", now=clock) as robot:
        robot.do("show cap")
        robot.hear("This is a cap.")
        robot.do("show cup")
        assert robot.view is not None
        [percept] = robot.view.look.percepts
        before = known(robot, percept)
        for text in turns:
            robot.hear(text)
        assert known(robot, percept) == before


def known(robot: Agent, percept: Percept) -> object:
    """How probable every word is of a thing, which words are known, and the lessons."""
    knowledge, private = robot._knowledge, robot.state.private
    palette = colours_of(percept.frame, percept.region) if percept.frame else None
    return (
        knowledge.objects.predict_proba_one(percept),
        knowledge.attributes.degrees(knowledge.objects.traits_of(percept)),
        knowledge.colours.degrees(palette) if palette is not None else None,
        [it.form for it in (*private.nouns, *private.adjectives)],
        [it.key for it in robot.memory.lessons()],
        robot.state.shared.commitments,
    )
