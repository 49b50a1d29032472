"""What is recorded of a dialogue: its turns, and the answers to what was asked.

All of it follows from the study and the run; how long it took is kept apart.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

__all__ = ["Answer", "Played", "Turn"]


class Turn(NamedTuple):
    """What the tutor said or did, and what the robot answered, sentence by sentence.

    `act` is their move (`instruct`, `ask_name`, …), or `shows` where something
    happened; then `given` is the look or the command, from which it can be played
    again. `words` are how many they said; `asks` says whether the robot asked something
    of its own accord, `corrects` whether they corrected the robot.

    >>> turn = Turn(1, "teach", "This is a cup.", "instruct", "", "Okay.")
    >>> turn.answer
    'Okay.'
    """

    number: int
    phase: str
    tutor: str
    act: str
    given: str
    answer: str
    words: int = 0
    asks: bool = False
    corrects: bool = False
    rules: tuple[str, ...] = ()


class Answer(NamedTuple):
    """What the robot answered to a question to which the tutor knows the answer.

    `kind` is that of the word asked for: noun, adjective, relation; or `reference`,
    where a thing was to be found. `right` is what the tutor holds to be right, `said`
    what the robot said, empty where it said nothing; `way` is how it put it (`assert`,
    `think`, `hedge`, `admit`). `degrees` are those of all words that it could have
    said. `accepted` says whether the tutor might well have said it, too; `judge` is
    what another person would have said, if one was asked.

    >>> answer = Answer(2, "test", "noun", "cup", "cup", "assert", 0.8, {"cup": 0.8})
    >>> answer.is_right
    True
    """

    turn: int
    phase: str
    kind: str
    right: str
    said: str
    way: str
    degree: float = math.nan
    degrees: Mapping[str, float] = {}
    accepted: bool = False
    judge: str = ""
    lessons: int = 0
    """How many lessons the robot has had by then, of all words."""
    tutor: str = ""
    """Who has asked: there may be several."""
    thing: str = ""
    """What was asked about, by its name in the scene."""

    @property
    def is_right(self) -> bool:
        """Did it say what the tutor holds to be right?"""
        return self.said == self.right

    @property
    def margin(self) -> float:
        """The degree of the right word less that of the best other."""
        return margin(self.degrees, self.right)


def margin(degrees: Mapping[str, float], word: str) -> float:
    """The degree of the word less that of the best other: above 0 where it wins.

    >>> round(margin({"cup": 0.5, "car": 0.2, "cap": 0.3}, "cup"), 3)
    0.2
    """
    others = [degree for it, degree in degrees.items() if it != word]
    return degrees.get(word, 0.0) - max(others, default=0.0)


@dataclass(frozen=True)
class Played:
    """A dialogue as it went.

    >>> asked = Turn(1, "test", "What is this?", "ask_name", "", "This is a cup.")
    >>> answer = Answer(1, "test", "noun", "cup", "cup", "assert")
    >>> played = Played((asked,), (answer,))
    >>> sum(it.is_right for it in played.answers), len(played.turns)
    (1, 1)
    """

    turns: tuple[Turn, ...]
    answers: tuple[Answer, ...]
    lessons: int = 0
    """How many lessons the robot kept."""
    facts: Mapping[str, float] = field(default_factory=dict)
    """What else was counted, by name."""
