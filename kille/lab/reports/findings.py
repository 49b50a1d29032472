"""What a study found: tables of its dialogues, theory by theory.

Numbers lead to the dialogues behind them, whose places are `places`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from itertools import chain
from typing import TypeAlias

import numpy as np

from kille.lab.measures.agreement import kappas, vocabulary
from kille.lab.measures.measures import (
    ACCEPTED,
    ACCURACY,
    BRIER,
    CORRECTIONS,
    FEWEST,
    LESSONS,
    MARGIN,
    QUESTIONS,
    REFERENCES,
    SECONDS,
    TURNS,
    WORDS,
    Measure,
    Vector,
    estimate_tallies,
    resample_counts,
    tallies,
)
from kille.lab.measures.scored_dialogues import (
    ScoredDialogue,
    dialogues_of,
    split_dialogues,
)
from kille.lab.reports.links import Places
from kille.lab.reports.short_names import shorten_names
from kille.lab.results import UNKNOWN, Cell, Estimate, Result, Table

Theories: TypeAlias = Mapping[str, Sequence[ScoredDialogue]]
"""The dialogues of each theory, in the order of the study."""

_SEED = 1  # of the chance by which dialogues are resampled
_INTERVALS = (
    f"In brackets: the 95 % confidence interval, of dialogues drawn anew with these "
    f"tutors and scenes (bootstrap over whole dialogues, not over single answers); "
    f"none where fewer than {FEWEST} dialogues have the measure. A measure that is the "
    f"same as one above in every dialogue is left out."
)


def group_by_theory(
    names: Sequence[str], dialogues: Sequence[ScoredDialogue]
) -> Theories:
    """Group dialogues by these theories; theories without any are left out."""
    found = {name: dialogues_of(dialogues, name) for name in names}
    return {name: them for name, them in found.items() if them}


def shorten_theory_names(theories: Theories) -> Theories:
    """The theories by names that fit beside a figure."""
    called = shorten_names(theories)
    return {called[name]: them for name, them in theories.items()}


def known_measures(theories: Theories) -> list[Measure]:
    """All measures that are known for these dialogues, the main one first.

    A measure that has the same tallies as one before it is left out, and so is the
    agreement with a judge who was never asked, or always agrees with the tutor.
    """
    everything = list(chain.from_iterable(theories.values()))
    robot, *judged = kappas(vocabulary(everything))
    known = [
        ACCURACY,
        robot,
        *(judged if _is_judged(everything) else ()),
        ACCEPTED,
        REFERENCES,
        BRIER,
        MARGIN,
        TURNS,
        WORDS,
        CORRECTIONS,
        QUESTIONS,
        LESSONS,
        SECONDS,
    ]
    found: list[tuple[Measure, Vector]] = []
    for measure in known:
        rows = tallies(measure, everything)
        is_known = np.isfinite(measure.of(rows.sum(axis=0)))
        if is_known and not any(np.array_equal(rows, its) for _, its in found):
            found.append((measure, rows))
    return [measure for measure, _ in found]


def _is_judged(dialogues: Sequence[ScoredDialogue]) -> bool:
    """Does another judge ever say something else than the tutor?"""
    answers = (it for one in dialogues for it in one.answers if it.is_word)
    return any(it.judge not in ("", it.right) for it in answers)


def estimate_measure(measure: Measure, dialogues: Sequence[ScoredDialogue]) -> Estimate:
    """The measure over the dialogues, with an interval by the same draws every time."""
    if not dialogues:
        return UNKNOWN
    draws = _draws(len(dialogues))
    return estimate_tallies(measure, tallies(measure, dialogues), draws)


@lru_cache(maxsize=4)
def _draws(count: int) -> Vector:
    return resample_counts(count, np.random.default_rng(_SEED))


# --- tables --------------------------------------------------------------------------


def overall_table(
    theories: Theories, measures: Sequence[Measure], places: Places
) -> Table:
    """Every measure of every theory, below the numbers of dialogues and answers."""
    rows: list[tuple[Cell, ...]] = [("dialogues", *map(len, theories.values()))]
    rows += _answer_counts(theories)
    answers = range(1, len(rows))
    for measure in measures:
        estimates = (estimate_measure(measure, them) for them in theories.values())
        rows.append((measure.name, *estimates))
    links = {
        (row, column): places.answers(name) if row in answers else places.theory(name)
        for row in range(len(rows))
        for column, name in enumerate(theories, start=1)
    }
    return Table("All measures", ("", *theories), tuple(rows), _INTERVALS, links)


def _answer_counts(theories: Theories) -> Iterator[tuple[Cell, ...]]:
    """How many words were asked for; and how many things, if any."""
    words = [_count(of) for of in theories.values()]
    things = [sum(len(it.answers) for it in of) for of in theories.values()]
    yield ("answers", *words)
    if things != words:
        yield ("things asked for", *(a - b for a, b in zip(things, words, strict=True)))


def measure_meanings(measures: Sequence[Measure]) -> Result:
    """What the measures mean."""
    rows = tuple((it.name, it.meaning) for it in measures)
    table = Table("Measures", ("measure", "what it is"), rows)
    return Result("What the numbers mean", (table,))


def detail_tables(theories: Theories, places: Places) -> Iterator[Table]:
    """How many answers are right: by kind of word, phase, way of saying and word."""
    words = _words_only(theories)
    for title, what, key in (
        ("By kind of word", "kind", lambda it: (it.kind,)),
        ("By phase", "phase", lambda it: (it.phase,)),
        ("By how it was put", "way", lambda it: (it.way,)),
        ("By word", "word", lambda it: (it.kind, it.right)),
    ):
        parts = {name: split_dialogues(them, key) for name, them in words.items()}
        yield from _accuracy_tables(title, what, parts, places)


_Key: TypeAlias = tuple[str, ...]


def _words_only(theories: Theories) -> Theories:
    """The dialogues without the answers that say which thing is meant."""
    return {
        name: split_dialogues(them, lambda it: it.is_word).get(True, [])
        for name, them in theories.items()
    }


def _accuracy_tables(
    title: str,
    what: str,
    parts: Mapping[str, Mapping[_Key, Sequence[ScoredDialogue]]],
    places: Places,
) -> Iterator[Table]:
    """The accuracy of each theory in each part, and the numbers of answers.

    These have a table of their own where they differ between theories.
    """
    heads = ("kind", "word") if what == "word" else (what,)
    keys = dict.fromkeys(key for them in parts.values() for key in them)
    ordered = sorted(keys) if what == "word" else list(keys)
    counts = [[_count(of.get(key, ())) for of in parts.values()] for key in ordered]
    alike = all(len({*row}) == 1 for row in counts)
    rows: list[tuple[Cell, ...]] = []
    links = {}
    for row, (key, count) in enumerate(zip(ordered, counts, strict=True)):
        cells: list[Cell] = [*key]
        for name, of in parts.items():
            one = key if what == "word" else key[0]
            links[row, len(cells)] = places.answers(name, what, one)
            cells.append(estimate_measure(ACCURACY, of[key]) if key in of else None)
        rows.append((*cells, *count[:1]) if alike else tuple(cells))
    columns = (*heads, *parts, "answers") if alike else (*heads, *parts)
    yield Table(title, columns, tuple(rows), "", links)
    if not alike:
        many: list[tuple[Cell, ...]] = []
        many += [(*key, *it) for key, it in zip(ordered, counts, strict=True)]
        yield Table(f"{title}: answers", columns, tuple(many), "", links)


def _count(dialogues: Sequence[ScoredDialogue]) -> int:
    return sum(it.is_word for one in dialogues for it in one.answers)
