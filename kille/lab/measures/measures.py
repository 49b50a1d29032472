"""Measures of dialogues: each is a function of sums over dialogues.

Some numbers are counted in each dialogue, its tally; tallies are added, and a measure
is computed from their sum. To resample dialogues, or to exchange two of them, is then
only to add other tallies. So confidence intervals and tests are those of dialogues:
answers of one dialogue depend on each other, and are never taken to be independent.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kille.lab.measures.scored_dialogues import REFERENCE, ScoredAnswer, ScoredDialogue
from kille.lab.results import UNKNOWN, Estimate

Vector = NDArray[np.float64]

ROUNDS = 2000
"""How often dialogues are resampled for a confidence interval."""

FEWEST = 5
"""Fewer dialogues have no confidence interval: they say too little of how others vary.

Those count in which the measure is known.
"""


def ratio(sums: Vector) -> Vector:
    """The first number divided by the second; NaN where that is 0."""
    over = np.where(sums[..., 1] > 0, sums[..., 1], np.nan)
    found: Vector = sums[..., 0] / over
    return found


@dataclass(frozen=True)
class Measure:
    """A measure: its name and meaning, its tally, and its value of summed tallies.

    `better` is 1 where more is better, -1 where less is, 0 where it depends. `of` gives
    the value for the last axis, NaN where it is not known. It is shown with so many
    `decimals`.

    >>> lessons = Measure(
    ...     "lessons",
    ...     "how often it was taught",
    ...     lambda dialogue: np.array([dialogue.lessons, 1.0]),
    ...     better=-1,
    ... )
    >>> lessons.name, lessons.better
    ('lessons', -1)
    """

    name: str
    meaning: str
    tally: Callable[[ScoredDialogue], Vector]
    of: Callable[[Vector], Vector] = ratio
    better: int = 1
    decimals: int = 3


def tallies(measure: Measure, dialogues: Iterable[ScoredDialogue]) -> Vector:
    """The tallies of the dialogues, one in each row."""
    return np.array([measure.tally(it) for it in dialogues], np.float64)


def value(measure: Measure, dialogues: Sequence[ScoredDialogue]) -> float:
    """The measure over the dialogues together; NaN of none.

    >>> from kille.lab.dialogues import Played
    >>> from kille.lab.measures import score_dialogue
    >>> from kille.lab.study import Run
    >>> lessons = Measure(
    ...     "lessons", "how often it was taught", lambda it: np.array([it.lessons, 1.0])
    ... )
    >>> run = Run("a", "Ann", "table", 1)
    >>> played = [Played((), (), lessons=n) for n in (2, 4)]
    >>> float(value(lessons, [score_dialogue(run, it, 0.1) for it in played]))
    3.0
    """
    if not dialogues:
        return float("nan")
    return float(measure.of(tallies(measure, dialogues).sum(axis=0)))


def resample_counts(
    count: int, chance: np.random.Generator, rounds: int = ROUNDS
) -> Vector:
    """How often each of `count` dialogues is drawn in each round of a bootstrap.

    Shape (rounds, count). Times the tallies, it is their sums round by round.
    Source: Efron 1979, Bootstrap methods: another look at the jackknife; Davison and
    Hinkley 1997, section 3.8, who draw whole clusters.
    """
    equal = np.full(count, 1 / count)
    return chance.multinomial(count, equal, size=rounds).astype(np.float64)


def estimate_tallies(measure: Measure, rows: Vector, draws: Vector) -> Estimate:
    """The measure of tallies, with the 95 % confidence interval of those drawn."""
    whole, known = measure.of(rows.sum(axis=0)), np.isfinite(measure.of(rows)).sum()
    others = measure.of(draws @ rows)
    return percentile_estimate(float(whole), others, int(known), measure.decimals)


def estimate(
    measure: Measure,
    dialogues: Sequence[ScoredDialogue],
    chance: np.random.Generator,
    rounds: int = ROUNDS,
) -> Estimate:
    """The measure over the dialogues, with the 95 % interval of resampled dialogues.

    >>> from kille.lab.dialogues import Played
    >>> from kille.lab.measures import score_dialogue
    >>> from kille.lab.study import Run
    >>> lessons = Measure(
    ...     "lessons", "how often it was taught", lambda it: np.array([it.lessons, 1.0])
    ... )
    >>> run = Run("a", "Ann", "table", 1)
    >>> dialogues = [score_dialogue(run, Played((), (), lessons=3), 0.1)] * 5
    >>> float(estimate(lessons, dialogues, np.random.default_rng(1)).value)
    3.0
    """
    if not dialogues:
        return UNKNOWN
    draws = resample_counts(len(dialogues), chance, rounds)
    return estimate_tallies(measure, tallies(measure, dialogues), draws)


def percentile_estimate(
    value: float, others: Vector, count: int, decimals: int = 3
) -> Estimate:
    """The value of `count` dialogues, with the 95 % interval of resampled values."""
    known = others[np.isfinite(others)]
    if not len(known) or count < FEWEST:
        return Estimate(value, float("nan"), float("nan"), decimals)
    low, high = np.percentile(known, [2.5, 97.5])
    return Estimate(value, float(low), float(high), decimals)


# --- shares and means ----------------------------------------------------------------


def _mean_over_answers(
    name: str,
    meaning: str,
    of: Callable[[ScoredAnswer], float | None],
    better: int = 1,
) -> Measure:
    """The measure that is the mean over those answers that have such a number."""

    def tally(dialogue: ScoredDialogue) -> Vector:
        found = [it for it in map(of, dialogue.answers) if it is not None]
        return np.array([sum(found), len(found)], np.float64)

    return Measure(name, meaning, tally, better=better)


def _mean_over_words(
    name: str,
    meaning: str,
    of: Callable[[ScoredAnswer], float | None],
    better: int = 1,
) -> Measure:
    """The same, of answers to questions for words only."""
    return _mean_over_answers(
        name, meaning, lambda answer: of(answer) if answer.is_word else None, better
    )


def _mean_over_dialogues(
    name: str,
    meaning: str,
    of: Callable[[ScoredDialogue], float],
    better: int = 0,
    decimals: int = 1,
) -> Measure:
    """The measure that is the mean of a number of each dialogue."""
    return Measure(
        name, meaning, lambda it: np.array([of(it), 1.0]), ratio, better, decimals
    )


ACCURACY = _mean_over_words(
    "accuracy",
    "the share of answers with the word that the tutor holds to be right",
    lambda it: it.is_right,
)
ACCEPTED = _mean_over_words(
    "accepted",
    "the share of answers that the tutor might well have given, too",
    lambda it: it.accepted,
)
BRIER = _mean_over_words(
    "Brier score",
    "the squared distance of the degrees from 1 for the right word and 0 for all "
    "others, what they lack to 1 being one more, for none of these; 0 is best and 2 is "
    "worst (Brier 1950)",
    lambda it: it.brier,
    better=-1,
)
MARGIN = _mean_over_words(
    "margin",
    "the degree of the right word less that of the best other",
    lambda it: it.margin,
)
DEGREE = _mean_over_words(
    "degree",
    "the degree of the word that was said",
    lambda it: it.degree if it.said and it.degree == it.degree else None,
    better=0,
)
REFERENCES = _mean_over_answers(
    "reference",
    "the share of things that were found when they were described",
    lambda it: it.is_right if it.kind == REFERENCE else None,
)
TURNS = _mean_over_dialogues(
    "turns",
    "turns of a dialogue in which the tutor said something",
    lambda it: sum(one.turns for one in it.efforts),
    better=-1,
)
WORDS = _mean_over_dialogues(
    "words",
    "words that the tutor said in a dialogue",
    lambda it: sum(one.words for one in it.efforts),
    better=-1,
)
CORRECTIONS = _mean_over_dialogues(
    "corrections",
    "how often the tutor said in a dialogue that the robot was wrong, or what is right "
    "instead",
    lambda it: sum(one.corrections for one in it.efforts),
    better=-1,
)
QUESTIONS = _mean_over_dialogues(
    "questions",
    "questions that the robot asked in a dialogue",
    lambda it: sum(one.questions for one in it.efforts),
)
LESSONS = _mean_over_dialogues(
    "lessons", "lessons that the robot kept of a dialogue", lambda it: it.lessons
)
IN_A_ROW = 5
"""How many answers in a row are right where something has been learned."""


def _answers_to_criterion(dialogue: ScoredDialogue) -> float:
    """How many answers there were until so many in a row were right, with these.

    All of them, and one more, where that never was.
    """
    row = 0
    for count, answer in enumerate(dialogue.answers, start=1):
        row = row + 1 if answer.is_right else 0
        if row == IN_A_ROW:
            return count
    return len(dialogue.answers) + 1


TO_CRITERION = _mean_over_dialogues(
    "to criterion",
    f"answers of a dialogue until {IN_A_ROW} in a row were right; all of them and one "
    "more where that never was",
    _answers_to_criterion,
    better=-1,
)
SECONDS = _mean_over_dialogues(
    "seconds",
    "how long a dialogue took to play, which differs from machine to machine",
    lambda it: it.seconds,
    decimals=3,
)
