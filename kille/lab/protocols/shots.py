"""How quickly words for pictures are learned: from one, three, five and ten of each.

A run draws ten categories and shuffles the pictures of each; the last six are asked
for (or a third, where a category has few), and the first of the others are taught.
Source: the k-shot protocol of Vinyals et al. 2016, Matching networks for one shot
learning, with a fixed number of tutored examples.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

import numpy as np

from kille.lab.measures.statistics import auroc, bootstrap, brier
from kille.lab.progress import Steps
from kille.lab.protocols.teaching import ObjectAnswer, ask, share_right, teach
from kille.lab.results import (
    Cell,
    Estimate,
    ExperimentError,
    Figure,
    Progress,
    Result,
    Table,
    interval_series,
    silent,
)
from kille.lab.scenes.galleries import LOOKING, Categories, Gallery
from kille.lab.scenes.stills import Lesson
from kille.lab.theories.candidates import Methods

RUNS = 8
SHOTS = (1, 3, 5, 10)
_CATEGORIES = 10
_ASKED = 6

Answers = Mapping[str, Mapping[int, Sequence[Sequence[ObjectAnswer]]]]
"""What each method answered in each run, by the number of pictures taught."""

_Run = tuple[int, int, list[Lesson], list[Lesson]]
"""The number of a run, that of pictures taught of each, lessons and questions."""

Curve = Mapping[int, Estimate]
"""The mean share right, by the number of pictures taught."""


def shots(
    gallery: Gallery, methods: Methods, *, seed: int, progress: Progress = silent
) -> Result:
    """The learning curve: the share right by the number of lessons of each category."""
    count = asked_of_each(gallery)
    numbers = [shot for shot in SHOTS if shot <= gallery.least - count]
    if not numbers:
        raise ExperimentError(
            f"{gallery.name}: a category has one picture only; "
            "to teach one and ask another it takes two"
        )
    gallery.look(progress, LOOKING)
    found = _answers(_runs(gallery, numbers, count, seed), numbers, methods, progress)
    chance = np.random.default_rng([seed, RUNS])
    curves = {
        name: {number: _over_runs(runs, chance) for number, runs in by_number.items()}
        for name, by_number in found.items()
    }
    return Result(
        "Words from few pictures",
        (_shares(gallery, curves, numbers, count), _calibration(found, numbers[-1])),
        (_learning_curve(curves, numbers),),
        {
            "runs": RUNS,
            "shots": numbers,
            "asked_of_each": count,
            "categories": _categories(gallery),
            "left_out": list(gallery.unread),
            "methods": {name: _by_run(them) for name, them in found.items()},
        },
    )


def _by_run(
    answers: Mapping[int, Sequence[Sequence[ObjectAnswer]]],
) -> dict[str, object]:
    """The share right in each run, by the number of pictures taught."""
    return {
        str(number): [share_right(run) for run in runs]
        for number, runs in answers.items()
    }


def _answers(
    runs: Iterable[_Run], numbers: Sequence[int], methods: Methods, progress: Progress
) -> Answers:
    steps = Steps(progress, RUNS * len(numbers) * len(methods), LOOKING, 1)
    found: dict[str, dict[int, list[list[ObjectAnswer]]]] = {
        name: {number: [] for number in numbers} for name in methods
    }
    for run, number, lessons, questions in runs:
        for name, make in methods.items():
            found[name][number].append(ask(teach(make, lessons), questions))
            steps(f"{name}, {number} of each, run {run + 1} of {RUNS}")
    return found


def _runs(
    gallery: Gallery, numbers: Sequence[int], count: int, seed: int
) -> Iterator[_Run]:
    """The lessons and questions of each run, for each number of pictures taught."""
    for run in range(RUNS):
        # Runs of different seeds have no draw in common.
        drawn = _draw_categories(gallery, np.random.default_rng(RUNS * seed + run))
        questions = gallery.lessons({w: them[-count:] for w, them in drawn.items()})
        for number in numbers:
            lessons = gallery.lessons({w: them[:number] for w, them in drawn.items()})
            yield run, number, lessons, questions


def asked_of_each(gallery: Gallery) -> int:
    """The number of pictures of each category that are asked for."""
    return min(_ASKED, max(1, gallery.least // 3))


def _categories(gallery: Gallery) -> int:
    """The number of categories in a run."""
    return min(_CATEGORIES, len(gallery.categories))


def _shares(
    gallery: Gallery, curves: Mapping[str, Curve], numbers: Sequence[int], count: int
) -> Table:
    others = "other" if count == 1 else "others"
    return Table(
        f"Share right of {_categories(gallery)} categories, by pictures taught of each",
        ("method", *(_count_pictures(number) for number in numbers)),
        tuple(_curve_row(name, curve) for name, curve in curves.items()),
        f"Mean of {RUNS} runs and its 95 % confidence interval (bootstrap); {count} "
        f"{others} of each category asked. {gallery.note}".strip(),
    )


def _learning_curve(curves: Mapping[str, Curve], numbers: Sequence[int]) -> Figure:
    return Figure(
        "curves",
        "Learning curve",
        {
            "x": numbers,
            "series": {
                name: interval_series([*curve.values()], "mean")
                for name, curve in curves.items()
            },
            "xlabel": "pictures taught of each category",
            "ylabel": "share right",
        },
    )


def _draw_categories(gallery: Gallery, chance: np.random.Generator) -> Categories:
    words = sorted(gallery.categories)
    if len(words) > _CATEGORIES:
        words = sorted(chance.choice(words, _CATEGORIES, replace=False).tolist())
    return draw_pictures(gallery, words, chance)


def draw_pictures(
    gallery: Gallery, words: Sequence[str], chance: np.random.Generator
) -> Categories:
    """The pictures of these categories, those of each in an order of chance."""
    shuffled = {}
    for word in words:
        paths = gallery.categories[word]
        shuffled[word] = [paths[i] for i in chance.permutation(len(paths))]
    return shuffled


def _over_runs(
    runs: Sequence[Sequence[ObjectAnswer]], chance: np.random.Generator
) -> Estimate:
    shares = [share_right(run) for run in runs]
    return Estimate(float(np.mean(shares)), *bootstrap(shares, chance))


def _count_pictures(number: int) -> str:
    return f"{number} picture{'s' * (number > 1)}"


def _curve_row(name: str, curve: Curve) -> tuple[Cell, ...]:
    return (
        name,
        *(f"{it.value:.3f} ({it.low:.2f}–{it.high:.2f})" for it in curve.values()),
    )


def _calibration(found: Answers, number: int) -> Table:
    """Are the degrees reliable, after the most lessons?"""
    rows = []
    for name, by_number in found.items():
        every = [answer for run in by_number[number] for answer in run]
        sure = [answer for answer in every if answer.best >= 0.5]
        rows.append(
            (
                name,
                len(sure) / len(every),
                share_right(sure),
                auroc(
                    [it.best for it in every if it.right],
                    [it.best for it in every if not it.right],
                ),
                brier([it.word for it in every], [it.degrees for it in every]),
            )
        )
    return Table(
        f"Can degrees be relied on, after {_count_pictures(number)} of each?",
        ("method", "degree of .5 or more", "right of these", "AUROC", "Brier"),
        tuple(rows),
        "AUROC: how likely a right answer has a higher degree than a wrong one.",
    )
