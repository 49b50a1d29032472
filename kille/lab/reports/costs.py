"""Figures of what it costs the tutor to make the robot know so much."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, TypeAlias

import numpy as np

from kille.lab.measures.measures import ACCURACY, Measure, Vector, ratio
from kille.lab.measures.scored_dialogues import ScoredDialogue, split_dialogues
from kille.lab.reports.findings import Theories, estimate_measure
from kille.lab.reports.repeated_tests import Tests, phases_of, title_of_test
from kille.lab.reports.row_figures import interval_note
from kille.lab.reports.short_names import shorten_names
from kille.lab.results import Figure, interval_series


def cost_figures(theories: Theories, tests: Tests) -> Iterator[Figure]:
    """The accuracy in each test against the words said before it; then by tutor.

    A test that is not repeated, and tutors who all say as much, have no figure.
    """
    phases = phases_of(theories, ACCURACY)
    for test in tests:
        asked = [phase for phase in test if phase in phases]
        if len(asked) > 1:
            yield _phase_figure(theories, asked)
    for phase in phases[-1:]:
        series = {name: _tutor_points(them, phase) for name, them in theories.items()}
        if _points_differ(series):
            yield _tutor_figure(series, phase)


_Series: TypeAlias = Mapping[str, Mapping[str, Sequence[Any]]]

_LABELS = {"xlabel": "words of the tutor until then", "ylabel": "accuracy"}
_LABELLED = 16
"""Up to this many points are labelled with their tutor."""
_NOTE = "Words are those of one dialogue."


def words_before(phase: str) -> Measure:
    """The measure of how many words the tutor has said when a phase begins."""

    def tally(dialogue: ScoredDialogue) -> Vector:
        words = 0
        for effort in dialogue.efforts:
            if effort.phase == phase:
                break
            words += effort.words
        return np.array([words, 1], np.float64)

    return Measure("words", f"words of the tutor before {phase}", tally, ratio, -1, 1)


def _points_differ(series: _Series) -> bool:
    """Do any two points differ in x, and not by chance alone?"""
    points = [
        (x, low if low == low else x, high if high == high else x)
        for it in series.values()
        for x, low, high in zip(it["x"], it["x_low"], it["x_high"], strict=True)
    ]
    least = min((high for _, _, high in points), default=0)
    return any(low > least for _, low, _ in points)


def _tutor_figure(series: _Series, phase: str) -> Figure:
    """The points by tutor, with labels where there are several tutors, but not many."""
    tutors = {label for it in series.values() for label in it["labels"]}
    title = f"Accuracy in {phase} against what it cost"
    title += ", by tutor" if len(tutors) > 1 else ""
    if len(tutors) < 2 or sum(len(it["x"]) for it in series.values()) > _LABELLED:
        series = {name: {**it, "labels": []} for name, it in series.items()}
    intervals = interval_note(series.values())
    return Figure(
        "points", title, {"series": series, **_LABELS}, f"{_NOTE} {intervals}"
    )


def _phase_figure(theories: Theories, phases: Sequence[str]) -> Figure:
    series: dict[str, Any] = {}
    for name, them in theories.items():
        parts = split_dialogues(them, lambda it: it.phase if it.is_word else "")
        known = [phase for phase in phases if phase in parts]
        right = [estimate_measure(ACCURACY, parts[phase]) for phase in known]
        series[name] = {
            "x": [estimate_measure(words_before(phase), them).value for phase in known],
            **interval_series(right, "mean"),
        }
    title = f"Accuracy against what it cost: {title_of_test(phases)}"
    intervals = interval_note(series.values())
    return Figure(
        "curves", title, {"series": series, **_LABELS}, f"{_NOTE} {intervals}"
    )


def _tutor_points(
    dialogues: Sequence[ScoredDialogue], phase: str
) -> dict[str, list[Any]]:
    found: dict[str, list[Any]] = {
        name: [] for name in ("x", "y", "x_low", "x_high", "y_low", "y_high", "labels")
    }
    asked = split_dialogues(dialogues, lambda it: it.phase if it.is_word else "").get(
        phase, []
    )
    tutors = shorten_names(it.run.tutor for it in asked)
    for tutor, label in tutors.items():
        them = [it for it in asked if it.run.tutor == tutor]
        spent, right = (
            estimate_measure(words_before(phase), them),
            estimate_measure(ACCURACY, them),
        )
        for axis, it in (("x", spent), ("y", right)):
            found[axis].append(it.value)
            found[f"{axis}_low"].append(it.low)
            found[f"{axis}_high"].append(it.high)
        found["labels"].append(label)
    return found
