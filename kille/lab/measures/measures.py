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


@dataclass(frozen=True)
class Measure:
    """A measure: its name and meaning, its tally, and its value of summed tallies.

    `better` is 1 where more is better, -1 where less is, 0 where it depends. `of` gives
    the value for the last axis, NaN where it is not known. It is shown with so many
    `decimals`.
    """

    name: str
    meaning: str
    tally: Callable[[ScoredDialogue], Vector]
    of: Callable[[Vector], Vector]
    better: int = 1
    decimals: int = 3


def tallies(measure: Measure, dialogues: Iterable[ScoredDialogue]) -> Vector:
    """The tallies of the dialogues, one in each row."""
    return np.array([measure.tally(it) for it in dialogues], np.float64)


def value(measure: Measure, dialogues: Sequence[ScoredDialogue]) -> float:
    """The measure over the dialogues together; NaN of none."""
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
    """The measure over the dialogues, with the 95 % interval of resampled dialogues."""
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


def ratio(sums: Vector) -> Vector:
    """The first number divided by the second; NaN where that is 0."""
    over = np.where(sums[..., 1] > 0, sums[..., 1], np.nan)
    found: Vector = sums[..., 0] / over
    return found


def _mean_of(
    of: Callable[[ScoredAnswer], float | None],
) -> Callable[[ScoredDialogue], Vector]:
    """The tally of a mean over those answers that have such a number."""

    def tally(dialogue: ScoredDialogue) -> Vector:
        found = [it for it in map(of, dialogue.answers) if it is not None]
        return np.array([sum(found), len(found)], np.float64)

    return tally


def _per_dialogue(
    of: Callable[[ScoredDialogue], float],
) -> Callable[[ScoredDialogue], Vector]:
    return lambda dialogue: np.array([of(dialogue), 1.0])


def _word(
    of: Callable[[ScoredAnswer], float | None],
) -> Callable[[ScoredDialogue], Vector]:
    return _mean_of(lambda answer: of(answer) if answer.is_word else None)


ACCURACY = Measure(
    "accuracy",
    "the share of answers with the word that the tutor holds to be right",
    _word(lambda it: it.is_right),
    ratio,
)
ACCEPTED = Measure(
    "accepted",
    "the share of answers that the tutor might well have given, too",
    _word(lambda it: it.accepted),
    ratio,
)
BRIER = Measure(
    "Brier score",
    "the squared distance of the degrees from 1 for the right word and 0 for all "
    "others, what they lack to 1 being one more, for none of these; 0 is best and 2 is "
    "worst (Brier 1950)",
    _word(lambda it: it.brier),
    ratio,
    better=-1,
)
MARGIN = Measure(
    "margin",
    "the degree of the right word less that of the best other",
    _word(lambda it: it.margin),
    ratio,
)
DEGREE = Measure(
    "degree",
    "the degree of the word that was said",
    _word(lambda it: it.degree if it.said and it.degree == it.degree else None),
    ratio,
    better=0,
)
REFERENCES = Measure(
    "reference",
    "the share of things that were found when they were described",
    _mean_of(lambda it: it.is_right if it.kind == REFERENCE else None),
    ratio,
)
TURNS = Measure(
    "turns",
    "turns of a dialogue in which the tutor said something",
    _per_dialogue(lambda it: sum(one.turns for one in it.efforts)),
    ratio,
    better=-1,
    decimals=1,
)
WORDS = Measure(
    "words",
    "words that the tutor said in a dialogue",
    _per_dialogue(lambda it: sum(one.words for one in it.efforts)),
    ratio,
    better=-1,
    decimals=1,
)
CORRECTIONS = Measure(
    "corrections",
    "how often the tutor said in a dialogue that the robot was wrong, or what is right "
    "instead",
    _per_dialogue(lambda it: sum(one.corrections for one in it.efforts)),
    ratio,
    better=-1,
    decimals=1,
)
QUESTIONS = Measure(
    "questions",
    "questions that the robot asked in a dialogue",
    _per_dialogue(lambda it: sum(one.questions for one in it.efforts)),
    ratio,
    better=0,
    decimals=1,
)
LESSONS = Measure(
    "lessons",
    "lessons that the robot kept of a dialogue",
    _per_dialogue(lambda it: it.lessons),
    ratio,
    better=0,
    decimals=1,
)
SECONDS = Measure(
    "seconds",
    "how long a dialogue took to play, which differs from machine to machine",
    _per_dialogue(lambda it: it.seconds),
    ratio,
    better=0,
)
