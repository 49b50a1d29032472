"""How well learners of spatial words agree with people who judged them.

Some judgements of each word are taught and the others asked: a growing number drawn at
random, then four fifths of the scenes at a time. Learners that take judgements get
them, also that a word does not fit; to those with two methods only, words are said of
what people took them to fit.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np

from kille.lab.measures.statistics import mean_and_range
from kille.lab.protocols.scoring import (
    Agreement,
    agreement_after,
    cross_validate,
    score_choices,
    teach_judgements,
)
from kille.lab.protocols.spatial import Methods
from kille.lab.protocols.word_maps import map_figure
from kille.lab.results import Cell, Figure, Progress, Result, Table, interval_series
from kille.lab.scenes.published_judgements import JudgementStudy
from kille.perception.relations.one_number_rule import AngleRule
from kille.scene import Configuration

SIZES = (1, 2, 4, 8, 16, 24, 48)
FEW = 8
"""After so many lessons each word is told of by itself."""
_DRAWS = 5
_SPAN = 0.4  # metres: half the width of a map
TOLD = "angle, told"
"""The angle rule that knows beforehand which number each word is about."""


def judgements(
    study: JudgementStudy, methods: Methods, *, seed: int, progress: Progress
) -> Result:
    """Compare learners with people, by the number of lessons, word and method."""
    methods = {**methods, TOLD: partial(AngleRule, study.about)}
    lengths = [len(them) for them in study.words.values()]
    sizes = [it for it in SIZES if it <= np.median(lengths) / 2]
    curves: dict[str, list[list[dict[str, Agreement]]]] = {}
    for step, (name, make) in enumerate(methods.items()):
        progress(0.8 * step / len(methods), name)
        curves[name] = [_draw_scores(study, make, size, seed) for size in sizes]
    progress(0.8, "all lessons")
    rights = {name: cross_validate(study, make, seed) for name, make in methods.items()}
    return Result(
        title=f"Spatial words as people judged them: {study.name}",
        tables=(
            _by_size(curves, sizes),
            *([_by_word_after(curves, sizes)] if FEW in sizes else []),
            _by_word(study, rights),
            *_choice_tables(study, methods, seed),
        ),
        figures=(
            _curve(curves, sizes, "spearman", "rank correlation with people"),
            _curve(curves, sizes, "accuracy", "yes or no as people said"),
            *(_map(study, name, make) for name, make in methods.items()),
        ),
        facts={
            "study": study.name,
            "seed": seed,
            "spearman": _ranks(rights, "spearman"),
            "spearman within folds": _ranks(rights, "within"),
        },
    )


def _ranks(
    rights: Mapping[str, Mapping[str, Agreement]], which: str
) -> dict[str, dict[str, float]]:
    return {
        name: {word: round(getattr(it, which), 4) for word, it in scores.items()}
        for name, scores in rights.items()
    }


def _draw_scores(
    study: JudgementStudy, make: Callable[[], Any], size: int, seed: int
) -> list[dict[str, Agreement]]:
    """The agreement on each word after `size` lessons of each, draw by draw."""
    return [
        agreement_after(study, make, size, np.random.default_rng([seed, size, draw]))
        for draw in range(_DRAWS)
    ]


# --- tables and figures --------------------------------------------------------------


def _means(draws: Sequence[Mapping[str, Agreement]], which: str) -> list[float]:
    """The mean over the words in each draw."""
    return [
        float(np.nanmean([getattr(it, which) for it in draw.values()]))
        for draw in draws
    ]


def _by_size(
    curves: Mapping[str, Sequence[Sequence[Mapping[str, Agreement]]]],
    sizes: Sequence[int],
) -> Table:
    rows: list[tuple[Cell, ...]] = []
    for name, by_size in curves.items():
        for size, draws in zip(sizes, by_size, strict=True):
            rank, *others = (
                mean_and_range(_means(draws, it))
                for it in ("spearman", "accuracy", "kappa")
            )
            shown = (*rank[:3], *(it.value for it in others))
            rows.append((name, size, *shown))
    return Table(
        title="By the number of lessons of each word",
        columns=("method", "lessons", "Spearman", "low", "high", "accuracy", "kappa"),
        rows=tuple(rows),
        note=f"Means over words and {_DRAWS} draws; low and high: 80 % of the draws. "
        f"{TOLD!r} knows beforehand which number each word is about.",
    )


def _by_word_after(
    curves: Mapping[str, Sequence[Sequence[Mapping[str, Agreement]]]],
    sizes: Sequence[int],
) -> Table:
    """The agreement on each word after a few lessons."""
    rows: list[tuple[Cell, ...]] = []
    for name, by_size in curves.items():
        draws = by_size[sizes.index(FEW)]
        for word in draws[0]:
            rank = mean_and_range([it[word].spearman for it in draws])
            right = mean_and_range([it[word].accuracy for it in draws])
            rows.append((name, word, *rank[:3], right.value))
    return Table(
        title=f"By word, {FEW} lessons of each",
        columns=("method", "word", "Spearman", "low", "high", "accuracy"),
        rows=tuple(rows),
        note=f"Means over {_DRAWS} draws; low and high: 80 % of the draws.",
    )


def _by_word(
    study: JudgementStudy, rights: Mapping[str, Mapping[str, Agreement]]
) -> Table:
    columns = ["word", "judged"]
    for name in rights:
        columns += [f"{name}: Spearman", f"{name}: accuracy", f"{name}: kappa"]
    rows = []
    for word, them in study.words.items():
        row: list[Cell] = [word, len(them)]
        for scores in rights.values():
            it = scores[word]
            row += [it.spearman, it.accuracy, it.kappa]
        rows.append(tuple(row))
    mean: list[Cell] = ["mean", None]
    for scores in rights.values():
        mean += [
            float(np.nanmean([getattr(it, which) for it in scores.values()]))
            for which in ("spearman", "accuracy", "kappa")
        ]
    return Table(
        title="By word, all but a fifth of the scenes taught",
        columns=tuple(columns),
        rows=(*rows, tuple(mean)),
        note="Spearman of degrees; accuracy and kappa of yes or no.",
    )


def _choice_tables(study: JudgementStudy, methods: Methods, seed: int) -> list[Table]:
    """How often learners choose the target that people chose as the best for a word."""
    if not study.choices:
        return []
    right = {name: score_choices(study, make, seed) for name, make in methods.items()}
    words = sorted({it.word for it in study.choices})
    rows = [_choice_row(word, study, right) for word in [*words, "all"]]
    return [
        Table(
            title="The target that fits a word best, of those possible",
            columns=("word", "asked", "by chance", *methods),
            rows=tuple(rows),
            note="The share of the choices that are those of people.",
        )
    ]


def _choice_row(
    word: str, study: JudgementStudy, right: Mapping[str, Mapping[int, float]]
) -> tuple[Cell, ...]:
    which = [i for i, it in enumerate(study.choices) if word in (it.word, "all")]
    even = np.mean([1 / len(study.choices[i].targets) for i in which])
    shares = [
        float(np.mean([of[i] for i in which if i in of])) for of in right.values()
    ]
    return (word, len(which), float(even), *shares)


def _curve(
    curves: Mapping[str, Sequence[Sequence[Mapping[str, Agreement]]]],
    sizes: Sequence[int],
    which: str,
    label: str,
) -> Figure:
    series = {}
    for name, by_size in curves.items():
        estimates = [mean_and_range(_means(draws, which)) for draws in by_size]
        series[name] = interval_series(estimates, "mean")
    return Figure(
        kind="curves",
        title=f"By the number of lessons: {label}",
        data={
            "x": list(sizes),
            "series": series,
            "xlabel": "lessons of each word",
            "ylabel": label,
        },
    )


def _map(study: JudgementStudy, name: str, make: Callable[[], Any]) -> Figure:
    """The words around a landmark after all lessons, on the plane that was judged."""
    learner = teach_judgements(make, study.words)
    upright = not any(it.x.offset[1] for it in study.every())

    def at(right: float, other: float) -> Configuration:
        offset = (right, 0.0, other) if upright else (right, other, 0.0)
        return Configuration(offset, target_size=0.1, landmark_size=0.1)

    return map_figure(
        f"What each word means after all lessons: {name}",
        list(study.words),
        learner,
        np.linspace(-_SPAN, _SPAN, 21).tolist(),
        at,
        "up" if upright else "away",
    )
