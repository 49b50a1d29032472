"""Teaching a learner and asking it, for all protocols for objects."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from kille.lab.measures.confusion_figures import confusion_figure
from kille.lab.measures.statistics import accuracy, margin, wilson
from kille.lab.results import Estimate, Figure
from kille.lab.scenes.stills import Lesson
from kille.lab.theories.candidates import Make

NOTHING = "nothing known"
"""The answer of a learner that knows no word for a thing."""


@dataclass(frozen=True)
class ObjectAnswer:
    """A learner's degrees of the words for a thing, and the right word for it.

    `strangers` is the share of strangers that it reckoned with.
    """

    word: str
    degrees: Mapping[str, float]
    strangers: float = 0.5

    @property
    def said(self) -> str:
        """The word of the highest degree; of equal ones the first in the alphabet."""
        if not any(self.degrees.values()):
            return NOTHING
        return min(self.degrees, key=lambda word: (-self.degrees[word], word))

    @property
    def best(self) -> float:
        """The degree of the word that is said."""
        return max(self.degrees.values(), default=0.0)

    @property
    def right(self) -> bool:
        """Is the word that is said the right one?"""
        return self.said == self.word

    @property
    def margin(self) -> float:
        """The degree of the right word less that of the best other."""
        return margin(self.degrees, self.word)


def teach(make: Make, lessons: Iterable[Lesson]) -> Any:
    """A new learner that was taught these lessons in this order."""
    learner = make()
    for percept, word in lessons:
        learner.learn_one(percept, word)
    return learner


def ask(
    learner: Any, questions: Sequence[Lesson], step: Callable[[], None] = lambda: None
) -> list[ObjectAnswer]:
    """The answers of a learner to these questions; `step` is called after each."""
    answers = []
    for percept, word in questions:
        answers.append(ObjectAnswer(word, learner.predict_proba_one(percept)))
        step()
    return answers


def mean_degrees(answers: Sequence[ObjectAnswer]) -> ObjectAnswer:
    """The answers to one question, asked several times, as one: their mean degrees."""
    words = sorted({word for answer in answers for word in answer.degrees})
    means = {
        word: float(np.mean([answer.degrees.get(word, 0.0) for answer in answers]))
        for word in words
    }
    return ObjectAnswer(answers[0].word, means)


def share_right(answers: Sequence[ObjectAnswer]) -> float:
    """The share of the answers that are right."""
    return accuracy([it.word for it in answers], [it.said for it in answers])


def estimate_right(answers: Sequence[ObjectAnswer]) -> Estimate:
    """The share of the answers that are right, with its confidence interval."""
    right = sum(answer.right for answer in answers)
    return Estimate(share_right(answers), *wilson(right, len(answers)))


def right_cells(answers: Sequence[ObjectAnswer]) -> tuple[str, float, str]:
    """Three cells: how many of how many are right, their share, its interval."""
    share = estimate_right(answers)
    return (
        f"{sum(answer.right for answer in answers)} of {len(answers)}",
        share.value,
        f"{_percent(share.low)}–{_percent(share.high)}",
    )


def _percent(share: float) -> str:
    """Format a share as people write it.

    >>> _percent(0.834)
    '83 %'
    """
    return f"{share:.0%}".replace("%", " %")


def answers_figure(title: str, answers: Sequence[ObjectAnswer]) -> Figure:
    """The confusions of these answers, in which *nothing known* comes last.

    >>> answers = [ObjectAnswer("cup", {"cup": 0.6}), ObjectAnswer("car", {"cup": 0.5})]
    >>> answers_figure("two", answers).data["counts"]
    [[1, 0], [1, 0]]
    """
    right, said = [it.word for it in answers], [it.said for it in answers]
    return confusion_figure(title, list(dict.fromkeys(right)), right, said, NOTHING)


def format_mistakes(answers: Sequence[ObjectAnswer]) -> str:
    """Format what was taken for what, each mistake once with how often it was made.

    >>> format_mistakes([ObjectAnswer("cap", {"cup": 0.6})] * 2)
    'cap → cup (2)'
    """
    mistakes = [f"{it.word} → {it.said}" for it in answers if not it.right]
    counts = {it: mistakes.count(it) for it in dict.fromkeys(mistakes)}
    listed = [it if count == 1 else f"{it} ({count})" for it, count in counts.items()]
    return ", ".join(listed) or "nothing"
