"""Dialogues as they are measured: their answers scored, their effort phase by phase.

The degrees of all words become two scores, so that many dialogues fit in memory.
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


class ScoredAnswer(NamedTuple):
    """An answer and its scores; `nth` counts the answers of its phase.

    `brier` and `margin` are None where no degrees were given; `is_possible` is False
    where they were, but the right word had none, so that it could not be said.
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
    is_possible: bool = True

    @property
    def is_right(self) -> bool:
        """Is it what the tutor holds to be right?"""
        return self.said == self.right

    @property
    def is_word(self) -> bool:
        """Was a word asked for, not a thing?"""
        return self.kind != REFERENCE


class Effort(NamedTuple):
    """What a phase took: turns, the tutor's words and corrections, robot's questions.

    Turns in which something was shown and nothing said do not count.
    """

    phase: str
    turns: int
    words: int
    corrections: int
    questions: int


@dataclass(frozen=True)
class ScoredDialogue:
    """A dialogue as it is measured.

    >>> from kille.lab.dialogues import Played
    >>> from kille.lab.study import Run
    >>> run = Run("a", "Ann", "table", 1)
    >>> score_dialogue(run, Played((), (), lessons=3), 0.1).lessons
    3
    """

    run: Run
    answers: tuple[ScoredAnswer, ...]
    efforts: tuple[Effort, ...]
    lessons: int
    seconds: float
    turns: tuple[Turn, ...] = ()

    @property
    def pair(self) -> tuple[str, str, int]:
        """The tutor, scene and seed, shared with dialogues of other theories."""
        return self.run.pair


def score_dialogue(run: Run, played: Played, seconds: float) -> ScoredDialogue:
    """Score the answers of a dialogue, and count its effort phase by phase.

    >>> answer = Answer(2, "test", "noun", "cup", "cup", "assert", 0.8, {"cup": 0.8})
    >>> played = Played((), (answer,))
    >>> dialogue = score_dialogue(Run("a", "Ann", "table", 1), played, 0.1)
    >>> round(dialogue.answers[0].brier, 2)
    0.08
    """
    count: dict[str, int] = {}
    answers = []
    for answer in played.answers:
        nth = count[answer.phase] = count.get(answer.phase, 0) + 1
        answers.append(_score_answer(nth, answer))
    return ScoredDialogue(
        run,
        tuple(answers),
        _efforts(played),
        played.lessons,
        seconds,
        played.turns,
    )


def _score_answer(nth: int, answer: Answer) -> ScoredAnswer:
    known = bool(answer.degrees)
    return ScoredAnswer(
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
        brier=brier([answer.right], [_as_probabilities(answer)]) if known else None,
        margin=answer.margin if known else None,
        lessons=answer.lessons,
        is_possible=not known or answer.degrees.get(answer.right, 0.0) > 0.0,
    )


def _as_probabilities(answer: Answer) -> dict[str, float]:
    """The degrees divided by their sum if that is above 1.

    It can be: words that are judged independently may hold of the same thing.
    """
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


def dialogues_of(
    dialogues: Iterable[ScoredDialogue], theory: str
) -> list[ScoredDialogue]:
    """The dialogues of a theory, in the order given."""
    return [it for it in dialogues if it.run.theory == theory]


def split_dialogues(
    dialogues: Sequence[ScoredDialogue], by: Callable[[ScoredAnswer], _Key]
) -> dict[_Key, list[ScoredDialogue]]:
    """Split the answers of dialogues by a key of each answer.

    For every key there are all dialogues, so that they remain comparable in pairs, each
    with just the answers that have this key.
    """
    keys = dict.fromkeys(by(answer) for it in dialogues for answer in it.answers)
    parts: dict[_Key, list[ScoredDialogue]] = {key: [] for key in keys}
    for dialogue in dialogues:
        answers: dict[_Key, list[ScoredAnswer]] = {}
        for answer in dialogue.answers:
            answers.setdefault(by(answer), []).append(answer)
        for key, part in parts.items():
            part.append(replace(dialogue, answers=tuple(answers.get(key, ()))))
    return parts
