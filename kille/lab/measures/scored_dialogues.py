"""Dialogues as they are measured: their answers scored, their effort by phase.

Degrees of all words are taken in once, so that many dialogues fit in memory.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple, TypeVar

from kille.lab.dialogues import Answer, Played, Turn
from kille.lab.measures.statistics import brier
from kille.lab.study import Run

REFERENCE = "reference"
"""The kind of answers that say which thing is meant, not which word is right."""

_Key = TypeVar("_Key", bound=Hashable)


class Scored(NamedTuple):
    """An answer and what it is worth; `nth` counts the answers of its phase.

    `brier` and `margin` are None where no degrees were given.
    """

    nth: int
    turn: int
    phase: str
    kind: str
    right: str
    said: str
    judge: str
    way: str
    accepted: bool
    degree: float
    brier: float | None
    margin: float | None
    lessons: int

    @property
    def is_right(self) -> bool:
        """Whether it is what the tutor holds to be so."""
        return self.said == self.right

    @property
    def is_word(self) -> bool:
        """Whether a word was asked for, not a thing."""
        return self.kind != REFERENCE


class Effort(NamedTuple):
    """What a phase took: turns, the tutor's words and corrections, robot's questions.

    A turn in which something was shown and nothing said is no turn of talk.
    """

    phase: str
    turns: int
    words: int
    corrections: int
    questions: int


@dataclass(frozen=True)
class Dialogue:
    """A dialogue as it is measured."""

    run: Run
    answers: tuple[Scored, ...]
    efforts: tuple[Effort, ...]
    lessons: int
    seconds: float
    turns: tuple[Turn, ...] = ()

    @property
    def pair(self) -> tuple[str, str, int]:
        """What it has in common with the dialogues of other theories."""
        return self.run.pair


def scored(run: Run, played: Played, seconds: float) -> Dialogue:
    """The dialogue as it is measured.

    >>> answer = Answer(2, "test", "noun", "cup", "cup", "assert", 0.8, {"cup": 0.8})
    >>> dialogue = scored(Run("a", "Ann", "table", 1), Played((), (answer,)), 0.1)
    >>> round(dialogue.answers[0].brier, 2)
    0.08
    """
    count: dict[str, int] = {}
    answers = []
    for answer in played.answers:
        nth = count[answer.phase] = count.get(answer.phase, 0) + 1
        answers.append(_scored(nth, answer))
    return Dialogue(
        run,
        tuple(answers),
        _efforts(played),
        played.lessons,
        seconds,
        played.turns,
    )


def _scored(nth: int, answer: Answer) -> Scored:
    known = bool(answer.degrees)
    return Scored(
        nth=nth,
        turn=answer.turn,
        phase=answer.phase,
        kind=answer.kind,
        right=answer.right,
        said=answer.said,
        judge=answer.judge,
        way=answer.way,
        accepted=answer.accepted,
        degree=answer.degree,
        brier=brier([answer.right], [_shared(answer)]) if known else None,
        margin=answer.margin if known else None,
        lessons=answer.lessons,
    )


def _shared(answer: Answer) -> dict[str, float]:
    """The degrees as chances: words that are judged apart may hold of one thing."""
    whole = max(1.0, sum(answer.degrees.values()))
    return {word: degree / whole for word, degree in answer.degrees.items()}


def _efforts(played: Played) -> tuple[Effort, ...]:
    phases = dict.fromkeys(turn.phase for turn in played.turns)
    efforts = []
    for phase in phases:
        turns = [turn for turn in played.turns if turn.phase == phase]
        efforts.append(
            Effort(
                phase,
                turns=sum(turn.words > 0 for turn in turns),
                words=sum(turn.words for turn in turns),
                corrections=sum(turn.corrects for turn in turns),
                questions=sum(turn.asks for turn in turns),
            )
        )
    return tuple(efforts)


def of_theory(dialogues: Iterable[Dialogue], theory: str) -> list[Dialogue]:
    """The dialogues of a theory, in their order."""
    return [it for it in dialogues if it.run.theory == theory]


def parted(
    dialogues: Sequence[Dialogue], by: Callable[[Scored], _Key]
) -> dict[_Key, list[Dialogue]]:
    """The dialogues once for each key of an answer, with just the answers that have it.

    All of them are there for every key, so that they remain comparable in pairs.
    """
    keys = dict.fromkeys(by(answer) for it in dialogues for answer in it.answers)
    found: dict[_Key, list[Dialogue]] = {key: [] for key in keys}
    for dialogue in dialogues:
        answers: dict[_Key, list[Scored]] = {}
        for answer in dialogue.answers:
            answers.setdefault(by(answer), []).append(answer)
        for key, them in found.items():
            them.append(replace(dialogue, answers=tuple(answers.get(key, ()))))
    return found
