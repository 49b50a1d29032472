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

    `act` is his move (`instruct`, `ask_name`, …), or `shows` where something happened;
    then `given` is the look or the command, from which it can be played again. `words`
    are how many he said; `asks` is whether the robot asked something of its own accord,
    `corrects` whether he set the robot right.
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
    where a thing was to be found. `right` is what the tutor holds to be so, `said` what
    the robot said, nothing where it did not say; `way` is how it put it (`assert`,
    `think`, `hedge`, `admit`). `degrees` are those of all words that it could have
    said. `accepted` is whether the tutor might well have said it, too; `judge` what
    another person would have said, if one was asked.
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
        """Whether the robot said what the tutor holds to be so."""
        return self.said == self.right

    @property
    def margin(self) -> float:
        """The degree of the right word less that of the best other."""
        others = [p for word, p in self.degrees.items() if word != self.right]
        return self.degrees.get(self.right, 0.0) - max(others, default=0.0)


@dataclass(frozen=True)
class Played:
    """A dialogue as it went."""

    turns: tuple[Turn, ...]
    answers: tuple[Answer, ...]
    lessons: int = 0
    """How many lessons the robot kept."""
    facts: Mapping[str, float] = field(default_factory=dict)
    """What else was counted, by name."""
