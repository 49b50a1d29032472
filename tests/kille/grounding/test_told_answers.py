"""What a tutor tells after an answer: whether the thing was known, and no more."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from kille.agent.agent import Agent
from kille.dialogue.beliefs import is_sure
from kille.grounding.lessons_and_learners import Knowledge
from kille.grounding.told_answers import find_familiarity
from kille.memory import Memory
from kille.perception.look import look
from kille.perception.strangers import LATEST
from kille.sensors.synthetic import open_synthetic
from ttr import record, replace

SAID = {
    "en": {
        "ask": "What is this?",
        "cup": "This is a cup.",
        "book": "This is a book.",
        "no": "No.",
        "yes": "Yes.",
        "a book": "It is a book.",
        "not": "This is not a book.",
        "corrects": "No, this is a mug.",
        "whether": "Is this a cup?",
        "forget": "Forget the book.",
    },
    "sv": {
        "ask": "Vad är det här?",
        "cup": "Det här är en kopp.",
        "book": "Det här är en bok.",
        "no": "Nej.",
        "yes": "Ja.",
        "a book": "Det är en bok.",
        "not": "Det här är inte en bok.",
        "corrects": "Nej, det här är en mugg.",
        "whether": "Är det här en kopp?",
        "forget": "Glöm boken.",
    },
}

STORIES = [
    ("what is shown unasked tells nothing", "@cup cup @book book", ()),
    ("a thing that it cannot name is told", "@cup cup @book ask book", (False,)),
    ("a claim is confirmed", "@cup cup again @cup ask yes", (True,)),
    ("what was just taught is tried out", "@cup cup ask yes", ()),
    ("a claim is corrected by a new word", "@cup cup ask corrects", (False,)),
    (
        "a word that it knew",
        "@cup cup @book book @cup again @book ask a_book",
        (True,),
    ),
    ("a denial first", "@cup cup @book book again @cup ask no a_book", (True,)),
    ("only a denial", "@book book again @book ask not", ()),
    ("another question", "@cup cup again @cup whether yes", ()),
    ("one answer is told once", "@cup cup @book ask book book", (False,)),
    ("what is forgotten was not told", "@cup cup @book ask book forget", ()),
    ("both", "@cup cup @book ask book ask yes again @cup ask yes", (False, True)),
]


@pytest.fixture
def memory() -> Iterator[Memory]:
    with Memory.transient() as it:
        yield it


def play(robot: Agent, story: str, language: str = "en") -> None:
    """Play a story; `again` begins another dialogue."""
    for step in story.split():
        if step == "again":
            robot.do("restart")
        elif step.startswith("@"):
            robot.do(f"show {step[1:]}")
        else:
            robot.hear(SAID[language][step.replace("_", " ")])


@pytest.mark.parametrize("language", SAID)
@pytest.mark.parametrize(("story", "known"), [it[1:] for it in STORIES])
def test_what_is_told(
    story: str, known: tuple[bool, ...], language: str, memory: Memory
) -> None:
    robot = Agent(sensor="synthetic:empty?seed=11", memory=memory, language=language)
    play(robot, story, language)
    assert find_familiarity(memory) == known


def test_only_the_latest_are_told(memory: Memory) -> None:
    robot = Agent(sensor="synthetic:empty?seed=11", memory=memory)
    play(robot, "@cup cup" + " again @cup ask yes" * (LATEST + 2))
    assert find_familiarity(memory) == (True,) * LATEST


def test_a_thing_that_was_never_taught_is_told_among_others(memory: Memory) -> None:
    with Agent(sensor="synthetic:empty?seed=11", memory=memory) as robot:
        for number, thing in enumerate(("cup", "book"), start=1):
            robot.do(f"place {thing} at {0.3 * number - 0.45:.2f} 0")
        robot.hear("#1 This is a cup.")
        for number in (1, 2):
            robot.hear(f"#{number} What is this?")
            robot.hear("It is a cup.")
        assert find_familiarity(memory) == (True,)


def test_a_robot_that_starts_again_judges_the_same(tmp_path: Path) -> None:
    file, stage = tmp_path / "memory.db", open_synthetic("synthetic:empty?seed=11")
    stage.show("cup")
    percept = look(stage, 2).percepts[0]
    with Agent(sensor="synthetic:empty?seed=11", memory=file) as robot:
        play(robot, "@cup cup @book ask book again @cup ask yes")
        first = robot._knowledge.objects.predict_proba_one(percept)
        play(robot, "again @book ask yes")
        objects = robot._knowledge.objects
        assert objects.familiarity == (False, True, True)
        degrees = objects.predict_proba_one(percept)
        assert sum(degrees.values()) > sum(first.values())
    with Memory.open(file) as memory:
        again = Knowledge(memory).objects
        assert again.familiarity == (False, True, True)
        assert again.predict_proba_one(percept) == pytest.approx(degrees)


def test_what_fails_was_not_told(memory: Memory) -> None:
    robot = Agent(sensor="synthetic:empty?seed=11", memory=memory)
    play(robot, "@cup cup again @cup ask yes")
    known = robot._knowledge
    seen: list[tuple[bool, ...]] = []

    def fail() -> None:
        with known.together():
            known.forget(memory.latest()[-1].key)
            seen.append(known.objects.familiarity)
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        fail()
    assert seen == [()]
    assert known.objects.familiarity == find_familiarity(memory) == (True,)


def test_the_fewer_strangers_the_farther_ahead_a_name_must_be(memory: Memory) -> None:
    robot = Agent(sensor="synthetic:empty?seed=11", memory=memory)
    play(robot, "@cup cup again @cup ask")
    assert robot.state.private.strategy.strangers == 0.5
    play(robot, "yes ask")
    assert robot.state.private.strategy.strangers == 0.25
    cup, *_ = robot.state.private.nouns
    name, rival = (record(p=p, sign=cup) for p in (0.7, 0.27))
    assert not is_sure(robot.state, [name, rival])  # .3 ahead does not do any more
    nobody_told = replace(robot.state, {"private.strategy.strangers": 0.5})
    assert is_sure(nobody_told, [name, rival])
    play(robot, "again @cup ask")
    assert robot.state.private.strategy.strangers == 0.25
