"""Draws what the studies of `examples/studies` show, from their results.

kille experiment run examples/studies/NAME.toml --out FOLDER/NAME     # each of them
python docs/pictures/studies.py FOLDER
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path

import numpy as np

from kille.experiments.figures import drawing
from kille.experiments.metrics import bootstrap, kappa
from kille.experiments.results import Figure
from kille.studies import log
from kille.studies.played import Answer, Played

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

Band = tuple[float, float, float]


def main() -> None:
    """Draws a figure of each study."""
    folder = Path(sys.argv[1])
    drawn = {
        "why_was_kappa_low": why_was_kappa_low,
        "does_correction_pay": does_correction_pay,
        "what_is_a_cup": what_is_a_cup,
    }
    for name, figure in drawn.items():
        dialogues = list(log.read(folder / name))
        picture = drawing(figure(dialogues))
        picture.savefig(HERE / f"{name}.png", dpi=110, facecolor="white")


def why_was_kappa_low(dialogues: Sequence[log.Finished]) -> Figure:
    """Kappa of robot and tutor under each cause."""

    def of(theory: str, cause: tuple[str, str]) -> Band:
        return band(
            kappa([it.right for it in asked], [it.said for it in asked])
            for run, played, _ in dialogues
            if run.theory == theory and (run.tutor, run.scene) == cause
            for asked in [answers(played, "questions")]
        )

    series = {
        theory: columns([of(theory, cause) for cause in CAUSES.values()])
        for theory in theories(dialogues)
    }
    data = {"labels": list(CAUSES), "series": series, "zero": 0.0}
    return Figure("intervals", "", {**data, "xlabel": "κ of robot and tutor"})


def does_correction_pay(dialogues: Sequence[log.Finished]) -> Figure:
    """What is right in the last test, by tutor."""
    tutors = list(dict.fromkeys(run.tutor for run, _, _ in dialogues))
    right = right_in("test 3")

    def of(theory: str, tutor: str) -> Band:
        return band(
            right(played)
            for run, played, _ in dialogues
            if (run.theory, run.tutor) == (theory, tutor)
        )

    series = {
        theory: columns([of(theory, tutor) for tutor in tutors])
        for theory in theories(dialogues)
    }
    data = {"labels": tutors, "series": series}
    return Figure("intervals", "", {**data, "xlabel": "right in the last test"})


def what_is_a_cup(dialogues: Sequence[log.Finished]) -> Figure:
    """How many other pictures are named rightly, by the number of lessons."""
    lessons = {"one lesson": 1, "three lessons": 3, "six lessons": 6}

    def of(theory: str) -> Mapping[str, list[float]]:
        right = right_in("others")
        found = columns(
            [
                band(
                    right(played)
                    for run, played, _ in dialogues
                    if (run.theory, run.scene) == (theory, scene)
                )
                for scene in lessons
            ]
        )
        return {"mean": found["values"], "low": found["low"], "high": found["high"]}

    series = {theory: of(theory) for theory in theories(dialogues)}
    told = {"xlabel": "lessons of each kind", "ylabel": "other pictures named right"}
    return Figure("curves", "", {"x": list(lessons.values()), "series": series, **told})


# --- reckoning -----------------------------------------------------------------------


def theories(dialogues: Sequence[log.Finished]) -> list[str]:
    """The theories, in the study's order."""
    return list(dict.fromkeys(run.theory for run, _, _ in dialogues))


def answers(played: Played, phase: str) -> list[Answer]:
    """The answers in a phase of a dialogue."""
    return [it for it in played.answers if it.phase == phase]


def right_in(phase: str) -> Callable[[Played], float]:
    """The share of right answers in a phase of a dialogue."""
    return lambda it: float(np.mean([a.is_right for a in answers(it, phase)]))


def band(values: Iterable[float]) -> Band:
    """The mean over dialogues, and its band of 95 %."""
    found = list(values)
    return float(np.mean(found)), *bootstrap(found, np.random.default_rng(0))


def columns(bands: Sequence[Band]) -> dict[str, list[float]]:
    """Means and bands as a figure has them."""
    return {
        name: [it[place] for it in bands]
        for place, name in enumerate(("values", "low", "high"))
    }


if __name__ == "__main__":
    main()
