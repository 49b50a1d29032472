"""What it costs the tutor to make the robot know so much: figures."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from kille.experiments.results import Figure
from kille.studies.measuring.measures import ACCURACY, Measure, Vector, ratio
from kille.studies.measuring.scored import Dialogue, parted
from kille.studies.reporting.findings import Theories, as_drawn, estimated

__all__ = ["costs", "said_before"]


def costs(theories: Theories) -> Iterator[Figure]:
    """The accuracy of each phase against what was said before it; then by tutor.

    Nothing of what is drawn as single points in one place.
    """
    phases = _asked(theories)
    if len(phases) > 1:
        yield _by_phase(theories, phases)
    for phase in phases[-1:]:
        series = {name: _by_tutor(them, phase) for name, them in theories.items()}
        if len({x for it in series.values() for x in it["x"]}) > 1:
            if sum(len(it["x"]) for it in series.values()) > _LABELLED:
                series = {name: it | {"labels": []} for name, it in series.items()}
            title = f"Accuracy in {phase} against what it cost, by tutor"
            yield Figure("points", title, {"series": series, **_LABELS}, _NOTE)


_LABELS = {"xlabel": "words of the tutor until then", "ylabel": "accuracy"}
_LABELLED = 16
"""At most so many points are called by the tutor."""
_NOTE = "In a dialogue. Bands of 95 %."


def said_before(phase: str) -> Measure:
    """How many words the tutor has said in a dialogue when a phase begins."""

    def tally(dialogue: Dialogue) -> Vector:
        words = 0
        for effort in dialogue.efforts:
            if effort.phase == phase:
                break
            words += effort.words
        return np.array([words, 1], np.float64)

    return Measure("words", f"words of the tutor before {phase}", tally, ratio, -1, 1)


def _asked(theories: Theories) -> list[str]:
    """The phases in which words were asked for, in their order."""
    found: dict[str, None] = {}
    for them in theories.values():
        for dialogue in them:
            asked = {it.phase for it in dialogue.answers if it.is_word}
            found |= {it.phase: None for it in dialogue.efforts if it.phase in asked}
    return list(found)


def _by_phase(theories: Theories, phases: Sequence[str]) -> Figure:
    series: dict[str, Any] = {}
    for name, them in theories.items():
        parts = parted(them, lambda it: it.phase if it.is_word else "")
        known = [phase for phase in phases if phase in parts]
        right = [estimated(ACCURACY, parts[phase]) for phase in known]
        series[name] = {
            "x": [estimated(said_before(phase), them).value for phase in known],
            **as_drawn(right, "mean"),
        }
    title = "Accuracy against what it cost, phase by phase"
    note = f"In {', '.join(phases)}. {_NOTE}"
    return Figure("curves", title, {"series": series, **_LABELS}, note)


def _by_tutor(dialogues: Sequence[Dialogue], phase: str) -> dict[str, list[Any]]:
    found: dict[str, list[Any]] = {
        name: [] for name in ("x", "y", "x_low", "x_high", "y_low", "y_high", "labels")
    }
    asked = parted(dialogues, lambda it: it.phase if it.is_word else "").get(phase, [])
    for tutor in dict.fromkeys(it.run.tutor for it in asked):
        them = [it for it in asked if it.run.tutor == tutor]
        spent, right = estimated(said_before(phase), them), estimated(ACCURACY, them)
        for axis, it in (("x", spent), ("y", right)):
            found[axis].append(it.value)
            found[f"{axis}_low"].append(it.low)
            found[f"{axis}_high"].append(it.high)
        found["labels"].append(tutor)
    return found
