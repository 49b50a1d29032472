"""The scripted lesson: a tutor teaches the robot ten objects and where things are.

It follows the paper's protocol: a round of lessons about ten objects, a round of
questions about them in other poses, then lessons and questions about how two of them
stand. Source: Dobnik and de Graaf 2017, section 4.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from kille.agent.agent import Agent
from kille.agent.attention import NumberedLook
from kille.agent.exchanges import Exchange
from kille.dialogue.lexicon import lexicon
from kille.sensors.synthetic.catalogue import TOY_NAMES

PLACES = {
    "to the left of": "left of",
    "to the right of": "right of",
    "in front of": "in front of",
    "behind": "behind",
}
"""What the tutor calls a place, and how the table is laid for it."""

_LESSONS_A_PLACE = 2


@dataclass(frozen=True)
class DemoAnswer:
    """How the robot answered a question: its best word against the right one.

    `margin` is the degree of the right word less that of the best other.
    """

    word: str
    said: str
    margin: float

    @property
    def right(self) -> bool:
        """Whether the best word is the right one."""
        return self.said == self.word


@dataclass(frozen=True, eq=False)
class DemoStep:
    """A step of the demonstration: what happened in the world, or a turn.

    `answer` is there when the turn was a question of the test, `view` when what was in
    focus then belongs on the picture sheet.
    """

    world: str = ""
    turn: Exchange | None = None
    answer: DemoAnswer | None = None
    view: NumberedLook | None = None


def demonstration(robot: Agent) -> Iterator[DemoStep]:
    """Teaches and tests a robot on a stage with the ten objects, step by step."""
    for word in TOY_NAMES:
        yield from _world(robot, f"show {word}")
        yield _say(robot, f"This is {lexicon().with_article(word)}.")
    for word in TOY_NAMES:
        yield from _world(robot, f"show {word}")
        turn = _say(robot, "What is this?").turn
        yield DemoStep(turn=turn, answer=_answer(robot, word), view=robot.view)
    yield _say(robot, "That is correct.")
    yield from _places(robot)


def _places(robot: Agent) -> Iterator[DemoStep]:
    yield from _world(robot, "show car")
    for _ in range(_LESSONS_A_PLACE):
        for phrase, spot in PLACES.items():
            yield from _world(robot, f"place book {spot} car")
            yield _say(robot, f"The book is {phrase} the car.")
    for phrase, spot in PLACES.items():
        yield from _world(robot, f"place book {spot} car")
        turn = _say(robot, "Where is the book?").turn
        yield DemoStep(turn=turn, answer=_answer(robot, phrase))


def _world(robot: Agent, command: str) -> Iterator[DemoStep]:
    """Something happens in the world; the robot may speak of its own accord."""
    said = robot.do(command)
    yield DemoStep(world=command)
    if said:
        yield DemoStep(turn=robot.exchanges[-1])


def _say(robot: Agent, text: str) -> DemoStep:
    robot.hear(text)
    return DemoStep(turn=robot.exchanges[-1])


def _answer(robot: Agent, word: str) -> DemoAnswer:
    """The robot's beliefs about its last question, held against the right word."""
    degrees = {b.sign.form: b.p for b in robot.state.private.beliefs}
    others = [p for form, p in degrees.items() if form != word]
    margin = degrees.get(word, 0.0) - max(others, default=0.0)
    best = max(degrees, key=lambda form: degrees[form], default="")
    return DemoAnswer(word, best, margin)
