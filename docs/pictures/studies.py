"""Draws what the studies of `examples/studies` show, with the numbers of their reports.

kille experiment run examples/studies/NAME.toml --out FOLDER/NAME     # each of them
python docs/pictures/studies.py FOLDER
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain, combinations
from pathlib import Path

import numpy as np
from grounds import remove_ground_of

from kille.lab import log
from kille.lab.measures import ScoredDialogue, kappas, score_dialogue, vocabulary
from kille.lab.measures.comparison import differences
from kille.lab.measures.measures import (
    ACCURACY,
    CORRECTIONS,
    TO_CRITERION,
    TURNS,
    WORDS,
)
from kille.lab.reports.drawing import drawing
from kille.lab.reports.findings import Theories, estimate_measure, group_by_theory
from kille.lab.reports.repeated_tests import restrict_to_phase
from kille.lab.results import Figure, interval_series

HERE = Path(__file__).parent

CAUSES = {
    "nothing": ("viewer", "exact"),
    "2 cm off": ("viewer", "2 cm off"),
    "5 cm off": ("viewer", "5 cm off"),
    "12 cm off": ("viewer", "12 cm off"),
    "a quarter astray": ("viewer", "a quarter astray"),
    "half astray": ("viewer", "half astray"),
    "moved 25 cm": ("viewer", "moved 25 cm"),
    "1/4 in the car's frame": ("quarter", "exact"),
    "1/2 in the car's frame": ("half", "exact"),
    "all in the car's frame": ("landmark", "exact"),
    "people differ": ("habits", "exact"),
    "1/2 in its frame, half astray": ("half", "half astray"),
    "1/2 in its frame, moved": ("half", "moved 25 cm"),
}
"""What may have gone wrong: the tutor and the scene."""

LESSONS = {"one lesson": 1, "three lessons": 3, "six lessons": 6}
"""How many there are of each kind, by scene."""


def main() -> None:
    """Draws a figure of each study."""
    folder = Path(sys.argv[1])
    drawn = {
        "why_was_kappa_low": why_was_kappa_low,
        "does_correction_pay": does_correction_pay,
        "what_is_a_cup": what_is_a_cup,
        "do_explanations_pay": do_explanations_pay,
    }
    for name, figure in drawn.items():
        if not (folder / name).exists():
            continue
        dialogues = [score_dialogue(*it) for it in log.read(folder / name)]
        names = list(log.study(folder / name).theories)
        picture = drawing(figure(group_by_theory(names, dialogues)))
        picture.savefig(HERE / f"{name}.png", dpi=110, facecolor="white")
        remove_ground_of(HERE / f"{name}.png")
        if name == "do_explanations_pay":
            sys.stdout.writelines(explained_differences(dialogues))


def why_was_kappa_low(theories: Theories) -> Figure:
    """Kappa of robot and tutor under each cause."""
    kappa, *_ = kappas(vocabulary(chain.from_iterable(theories.values())))
    series = {
        name: interval_series(
            [estimate_measure(kappa, of_cause(them, it)) for it in CAUSES.values()]
        )
        for name, them in theories.items()
    }
    data = {"labels": list(CAUSES), "series": series, "zero": 0.0}
    return Figure("intervals", "", {**data, "xlabel": "κ of robot and tutor"})


def of_cause(
    dialogues: Iterable[ScoredDialogue], cause: tuple[str, str]
) -> list[ScoredDialogue]:
    """The dialogues with a tutor in front of a scene."""
    return [it for it in dialogues if (it.run.tutor, it.run.scene) == cause]


def does_correction_pay(theories: Theories) -> Figure:
    """What is right in the last test, by tutor."""
    asked = restrict_to_phase(theories, ACCURACY, "test 3")
    tutors = list(dict.fromkeys(it.run.tutor for them in asked.values() for it in them))
    series = {
        name: interval_series(
            [
                estimate_measure(ACCURACY, [it for it in them if it.run.tutor == tutor])
                for tutor in tutors
            ]
        )
        for name, them in asked.items()
    }
    data = {"labels": tutors, "series": series}
    return Figure("intervals", "", {**data, "xlabel": "right in the last test"})


def what_is_a_cup(theories: Theories) -> Figure:
    """How many other pictures are named rightly, by the number of lessons."""
    asked = restrict_to_phase(theories, ACCURACY, "others")
    series = {
        name: interval_series(
            [
                estimate_measure(ACCURACY, [it for it in them if it.run.scene == scene])
                for scene in LESSONS
            ],
            "mean",
        )
        for name, them in asked.items()
    }
    told = {"xlabel": "lessons of each kind", "ylabel": "other pictures named right"}
    return Figure("curves", "", {"x": list(LESSONS.values()), "series": series, **told})


def do_explanations_pay(theories: Theories) -> Figure:
    """How many answers it takes until five in a row are right, by tutor and scene."""
    [them] = theories.values()
    tutors = list(dict.fromkeys(it.run.tutor for it in them))
    series = {
        scene: interval_series(
            [
                estimate_measure(TO_CRITERION, of_cause(them, (it, scene)))
                for it in tutors
            ]
        )
        for scene in dict.fromkeys(it.run.scene for it in them)
    }
    told = {"xlabel": "answers until five in a row are right"}
    return Figure("intervals", "", {"labels": tutors, "series": series, **told})


SPENT = (TO_CRITERION, ACCURACY, TURNS, WORDS, CORRECTIONS)
"""What the teachers who explain are compared by."""


def explained_differences(dialogues: Sequence[ScoredDialogue]) -> Iterator[str]:
    """Each measure for each tutor and scene, and its differences, seed by seed."""
    tutors = list(dict.fromkeys(it.run.tutor for it in dialogues))
    for scene in dict.fromkeys(it.run.scene for it in dialogues):
        of = {it: of_cause(dialogues, (it, scene)) for it in tutors}
        for tutor, them in of.items():
            for measure in SPENT:
                told = estimate_measure(measure, them)
                yield f"{scene}: {tutor}: {measure.name} {told}\n"
        for one, other in combinations(tutors, 2):
            pairs = list(zip(of[one], of[other], strict=True))
            found = differences(SPENT, pairs, np.random.default_rng(1))
            for name, it in found.items():
                told = f"{it.estimate}, p = {it.p:.4f}"
                yield f"{scene}: {other} − {one}: {name} {told}\n"


if __name__ == "__main__":
    main()
