"""The paper's spatial protocol with simulated people, and why its kappa was so low.

Agreement beyond chance is Cohen's kappa, between the judges and between judges and
robot; an answer is accepted if the judge might well have said it (with a probability of
at least .15). The lessons, the questions and the causes are in
`kille.lab.protocols.causes`.
Source: Dobnik and de Graaf 2017, section 4.2.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np

from kille.lab.measures.statistics import kappa_of_margins, mean_and_range
from kille.lab.protocols.causes import (
    CAUSES,
    ROUNDS,
    TABLE,
    Cause,
    RunScores,
    configuration_at,
    placements,
    play_protocol,
)
from kille.lab.protocols.rendered_scenes import play_rendered_scenes
from kille.lab.protocols.word_maps import map_figure
from kille.lab.results import Cell, Figure, Progress, Result, Table, interval_series
from kille.lab.tutors.spatial_judges import WORDS, Person
from kille.perception.learners import Learner
from kille.scene import Configuration

Methods = Mapping[str, Callable[[], Learner[Configuration]]]

RUNS = 60


def paper(
    methods: Methods,
    *,
    seed: int,
    progress: Progress,
    runs: int = RUNS,
    causes: Sequence[Cause] = CAUSES,
) -> Result:
    """The paper's spatial protocol under each of the causes, for each method."""
    found: dict[tuple[str, str], list[RunScores]] = {}
    for step, cause in enumerate(causes):
        progress(0.9 * step / len(causes), cause.name)
        for name, make in methods.items():
            found[cause.name, name] = [
                play_protocol(make, cause, np.random.default_rng([seed, run]))
                for run in range(runs)
            ]
    names = list(methods)
    first = causes[0].name
    return Result(
        title="Where things are: the paper's protocol with simulated people",
        tables=(
            _agreement(found, first, names),
            _why(found, [it.name for it in causes], names),
            published_agreement(),
            play_rendered_scenes(
                methods, seed=seed, progress=partial(_report_within, progress, 0.9)
            ),
        ),
        figures=(
            *(_bars(found, [it.name for it in causes], name) for name in names),
            *(_map(name, make, seed) for name, make in methods.items()),
        ),
        facts={
            "runs": runs,
            "seed": seed,
            "kappa": {
                name: {
                    it.name: round(_mean(found[it.name, name], "robot"), 4)
                    for it in causes
                }
                for name in names
            },
        },
    )


def _report_within(progress: Progress, start: float, share: float, doing: str) -> None:
    progress(start + (1 - start) * share, doing)


def published_agreement() -> Table:
    """The paper's own numbers: kappa rebuilt from agreement seen and by chance."""
    return Table(
        title="What the paper published",
        columns=("agreement of", "seen", "by chance", "kappa"),
        rows=(
            (
                "judge and judge",
                0.5313,
                0.176,
                round(kappa_of_margins(17 / 32, 180 / 32**2), 4),
            ),
            (
                "judges and robot",
                0.2344,
                0.191,
                round(kappa_of_margins(15 / 64, 782 / 64**2), 4),
            ),
        ),
        note="The judges accepted 60.94 % of the robot's answers (39 of 64).",
    )


def _agreement(
    found: Mapping[tuple[str, str], Sequence[RunScores]],
    cause: str,
    names: Sequence[str],
) -> Table:
    rows: list[tuple[Cell, ...]] = [("the paper's robot", 0.4313, 0.0537, None, 0.6094)]
    for name in names:
        runs = found[cause, name]
        rows.append(
            (
                name,
                _mean(runs, "people"),
                _mean(runs, "robot"),
                float(np.std([it.robot for it in runs])),
                _mean(runs, "accepted"),
            )
        )
    return Table(
        title="Agreement when nothing goes wrong",
        columns=(
            "method",
            "judges' kappa",
            "robot's kappa",
            "its deviation",
            "accepted",
        ),
        rows=tuple(rows),
        note="48 lessons, 32 questions a run; the judges of the first row are real.",
    )


def _why(
    found: Mapping[tuple[str, str], Sequence[RunScores]],
    causes: Sequence[str],
    names: Sequence[str],
) -> Table:
    columns = ["cause", "judges' kappa"]
    for name in names:
        columns += [f"{name}: kappa", f"{name}: accepted"]
    rows = []
    for cause in causes:
        row: list[Cell] = [cause, _mean(found[cause, names[0]], "people")]
        for name in names:
            runs = found[cause, name]
            row += [_mean(runs, "robot"), _mean(runs, "accepted")]
        rows.append(tuple(row))
    return Table(
        title="Why was kappa .05?",
        columns=tuple(columns),
        rows=tuple(rows),
        note="Means over the runs; each cause by itself, the rest as in the first row.",
    )


def _mean(runs: Sequence[RunScores], which: str) -> float:
    return float(np.mean([getattr(it, which) for it in runs]))


def _bars(
    found: Mapping[tuple[str, str], Sequence[RunScores]],
    causes: Sequence[str],
    name: str,
) -> Figure:
    kappas = [
        mean_and_range([it.robot for it in found[cause, name]]) for cause in causes
    ]
    return Figure(
        kind="bars",
        title=f"Kappa of judges and robot by cause: {name}",
        data={
            "labels": list(causes),
            **interval_series(kappas),
            "ylabel": "kappa (bars: 80 % of the runs)",
        },
    )


def _map(name: str, make: Callable[[], Learner[Any]], seed: int) -> Figure:
    """The degree of each word around the landmark after 48 lessons."""
    chance = np.random.default_rng([seed, 0])
    learner, tutor = make(), Person()
    for key, scene in enumerate(placements(CAUSES[0], ROUNDS, chance, 0.0)):
        learner.learn_one(scene.seen, tutor.says(scene.true, chance), key=key)
    spots = np.linspace(-TABLE, TABLE, 25).tolist()
    title = f"What each word means after 48 lessons: {name}"
    return map_figure(title, WORDS, learner, spots, configuration_at)
