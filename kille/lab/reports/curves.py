"""Figures of how theories learn, how reliable their degrees are, and of each word."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from kille.lab.measures.confusion_figures import confusion_figure
from kille.lab.measures.measures import ACCURACY, DEGREE
from kille.lab.measures.scored_dialogues import (
    ScoredAnswer,
    ScoredDialogue,
    split_dialogues,
)
from kille.lab.measures.statistics import reliability_bin
from kille.lab.reports.findings import Theories, estimate_measure
from kille.lab.reports.repeated_tests import Tests, phases_of, title_of_test
from kille.lab.reports.row_figures import interval_note, row_figures
from kille.lab.results import Figure, interval_series

_PLACES = 12
"""The most places on a learning curve."""
_LEAST = 5
"""Places with fewer answers are left out."""
_MOST = 16
"""The most words in a figure of confusions."""
_DRAWN = 40
"""The most words that are drawn one by one."""
_NOTHING = "(nothing)"
_MANY = {"reply": "replies"}
_ACCURACY = {"xlabel": "accuracy"}


def learning_curves(theories: Theories, tests: Tests) -> Iterator[Figure]:
    """The accuracy in each test by the number of lessons before the question."""
    phases = phases_of(theories, ACCURACY)
    asked = [[phase for phase in test if phase in phases] for test in tests]
    several = sum(map(bool, asked)) > 1
    for test in filter(None, asked):
        which = f": {title_of_test(test)}" if several else ""
        yield from _learning_curve(f"Learning curve{which}", theories, test)


def _learning_curve(
    title: str, theories: Theories, test: Sequence[str]
) -> Iterator[Figure]:
    """The curve of one test, unless all its questions came after as many lessons."""

    def counts(answer: ScoredAnswer) -> bool:
        return answer.is_word and answer.phase in test

    answers = (it for them in theories.values() for one in them for it in one.answers)
    lessons = {it.lessons for it in answers if counts(it)}
    wide = axis_step(max(lessons)) if len(lessons) > _PLACES else 1

    def place(answer: ScoredAnswer) -> int:
        return nearest_place(answer.lessons, wide) if counts(answer) else -1

    series: dict[str, Any] = {}
    for name, them in theories.items():
        parts = split_dialogues(them, place)
        at = sorted(it for it in parts if it >= 0 and _count(parts[it]) >= _LEAST)
        estimates = [estimate_measure(ACCURACY, parts[it]) for it in at]
        series[name] = {"x": at, **interval_series(estimates, "mean")}
    if any(len(it["x"]) > 1 for it in series.values()):
        data = {
            "x": sorted({x for it in series.values() for x in it["x"]}),
            "series": series,
            "xlabel": "lessons",
            "ylabel": "accuracy",
        }
        intervals = interval_note(series.values())
        yield Figure("curves", title, data, f"{_note(wide)} {intervals}")


def nearest_place(lessons: int, wide: int) -> int:
    """The place nearest to a number of lessons; halfway, it is the later one.

    >>> [nearest_place(it, 2) for it in range(7)]
    [0, 2, 2, 4, 4, 6, 6]
    """
    return (lessons + wide // 2) // wide * wide


def _count(dialogues: Sequence[ScoredDialogue]) -> int:
    return sum(len(it.answers) for it in dialogues)


def _note(wide: int) -> str:
    places = f"Answers are put to the nearest {wide} lessons. " if wide > 1 else ""
    return f"{places}Not every dialogue comes to all of these."


def axis_step(most: int) -> int:
    """The distance between places on an axis up to `most`: 1, 2, 5, 10, 20, 50, …

    >>> axis_step(9), axis_step(48), axis_step(2000)
    (1, 5, 200)
    """
    scale = 1
    while True:
        for by in (1, 2, 5):
            if most <= _PLACES * by * scale:
                return by * scale
        scale *= 10


def reliability_figures(theories: Theories) -> Iterator[Figure]:
    """Is what is said with some degree right as often as that?"""
    series: dict[str, dict[str, Any]] = {}
    for name, them in theories.items():
        bins = split_dialogues(them, _bin_of)
        at = sorted(it for it in bins if it >= 0)
        said = [estimate_measure(DEGREE, bins[it]).value for it in at]
        right = [estimate_measure(ACCURACY, bins[it]) for it in at]
        series[name] = {
            "x": said,
            **interval_series(right, "y"),
            "counts": [_count(bins[it]) for it in at],
        }
    if not any(it["x"] for it in series.values()):
        return
    data = {
        "series": series,
        "xlabel": "degree of the word that was said",
        "ylabel": "share that is right",
    }
    intervals = interval_note(series.values())
    note = f"On the dashed line degrees are what they say. {intervals}"
    yield Figure("reliability", "Reliability", data, note)


def _bin_of(answer: ScoredAnswer) -> int:
    if not (answer.is_word and answer.said and np.isfinite(answer.degree)):
        return -1
    return int(reliability_bin(answer.degree))


def word_figures(theories: Theories) -> Iterator[Figure]:
    """The accuracy word by word, for each kind of word that has not too many."""
    parts = {
        name: split_dialogues(
            them, lambda it: (it.kind, it.right) if it.is_word else None
        )
        for name, them in theories.items()
    }
    keys = sorted({key for them in parts.values() for key in them if key})
    kinds = dict.fromkeys(kind for kind, _ in keys)
    for kind in kinds:
        ordered = [key for key in keys if key[0] == kind]
        if not 1 < len(ordered) <= _DRAWN:
            continue
        series = {
            name: [estimate_measure(ACCURACY, of.get(key, ())) for key in ordered]
            for name, of in parts.items()
        }
        which = f": {_plural(kind)}" if len(kinds) > 1 else ""
        labels = [word for _, word in ordered]
        yield from row_figures(f"Word by word{which}", labels, series, _ACCURACY)


def confusion_figures(theories: Theories) -> Iterator[Figure]:
    """Which words are taken for which, by theory and kind of word."""
    for name, them in theories.items():
        for kind, of in split_dialogues(
            them, lambda it: it.kind if it.is_word else ""
        ).items():
            labels = sorted({it.right for one in of for it in one.answers})
            if kind and 1 < len(labels) <= _MOST:
                given = [it for one in of for it in one.answers]
                right = [it.right for it in given]
                said = [it.said or _NOTHING for it in given]
                title = f"{name}: {_plural(kind)}"
                yield confusion_figure(title, labels, right, said)


def _plural(kind: str) -> str:
    return _MANY.get(kind, f"{kind}s")
