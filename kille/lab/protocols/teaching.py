"""Teaching a learner and asking it: what the protocols for objects have in common."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from kille.lab.measures.statistics import accuracy, margin, wilson
from kille.lab.results import Figure
from kille.lab.scenes.stills import Lesson
from kille.lab.theories.candidates import Make

NOTHING = "nothing known"
"""How the answer is called of who knows no word for a thing."""


@dataclass(frozen=True)
class Answer:
    """The degrees of the words for a thing, and the right word for it."""

    word: str
    degrees: Mapping[str, float]

    @property
    def said(self) -> str:
        """The word of the highest degree; of equal ones the first in the alphabet."""
        if not any(self.degrees.values()):
            return NOTHING
        return min(self.degrees, key=lambda word: (-self.degrees[word], word))

    @property
    def best(self) -> float:
        """The degree of what is said."""
        return max(self.degrees.values(), default=0.0)

    @property
    def right(self) -> bool:
        """Whether what is said is the right word."""
        return self.said == self.word

    @property
    def margin(self) -> float:
        """The degree of the right word less that of the best other."""
        return margin(self.degrees, self.word)


def taught(make: Make, lessons: Iterable[Lesson]) -> Any:
    """A learner that was taught these in this order."""
    learner = make()
    for percept, word in lessons:
        learner.learn_one(percept, word)
    return learner


def asked(
    learner: Any, questions: Sequence[Lesson], step: Callable[[], None] = lambda: None
) -> list[Answer]:
    """Its answers; `step` is called after each."""
    answers = []
    for percept, word in questions:
        answers.append(Answer(word, learner.predict_proba_one(percept)))
        step()
    return answers


def mean_degrees(answers: Sequence[Answer]) -> Answer:
    """The answers to one question, asked several times, as one: their means."""
    words = sorted({word for answer in answers for word in answer.degrees})
    means = {
        word: float(np.mean([answer.degrees.get(word, 0.0) for answer in answers]))
        for word in words
    }
    return Answer(answers[0].word, means)


def share_right(answers: Sequence[Answer]) -> float:
    """The share of the answers that are right."""
    return accuracy([it.word for it in answers], [it.said for it in answers])


def right_cells(answers: Sequence[Answer]) -> tuple[str, float, str]:
    """Three cells: how many of how many are right, their share, its band."""
    right = sum(answer.right for answer in answers)
    band = wilson(right, len(answers))
    return (
        f"{right} of {len(answers)}",
        share_right(answers),
        f"{percent(band[0])}–{percent(band[1])}",
    )


def percent(share: float) -> str:
    """A share as people write it.

    >>> percent(0.834)
    '83 %'
    """
    return f"{share:.0%}".replace("%", " %")


def confusion_figure(title: str, answers: Sequence[Answer]) -> Figure:
    """Which words were answered for which; a column more if nothing was, now and then.

    >>> answers = [Answer("cup", {"cup": 0.6}), Answer("car", {"cup": 0.5})]
    >>> confusion_figure("two", answers).data["counts"]
    [[1, 0], [1, 0]]
    """
    words = list(dict.fromkeys(answer.word for answer in answers))
    said = {answer.said for answer in answers}
    others = sorted(said - {*words, NOTHING})
    columns = [*words, *others, *([NOTHING] if NOTHING in said else [])]
    counts = [
        [sum(it.word == word and it.said == one for it in answers) for one in columns]
        for word in words
    ]
    return Figure(
        "confusion", title, {"labels": words, "columns": columns, "counts": counts}
    )


def mistaken(answers: Sequence[Answer]) -> str:
    """What was taken for what, each mistake once, with how often it was made.

    >>> mistaken([Answer("cap", {"cup": 0.6}), Answer("cap", {"cup": 0.5})])
    'cap → cup (2)'
    """
    mistakes = [f"{it.word} → {it.said}" for it in answers if not it.right]
    counts = {it: mistakes.count(it) for it in dict.fromkeys(mistakes)}
    listed = [it if count == 1 else f"{it} ({count})" for it, count in counts.items()]
    return ", ".join(listed) or "nothing"
