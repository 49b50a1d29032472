"""Figures of theories: how they learn, and whether degrees hold."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from kille.experiments.metrics import confusion
from kille.experiments.results import Estimate, Figure
from kille.studies.measuring.measures import ACCURACY, DEGREE
from kille.studies.measuring.scored import Dialogue, Scored, parted
from kille.studies.reporting.findings import Theories, as_drawn, estimated

__all__ = ["confusions", "learning", "near", "reliable", "step", "words"]

_PLACES = 12
"""At most so many places on a learning curve."""
_LEAST = 5
"""Places of fewer answers are left out."""
_BINS = 10
_MOST = 16
"""Of at most so many words it is drawn which are taken for which."""
_DRAWN = 40
"""At most so many words are drawn one by one."""
_NOTHING = "(nothing)"
_MANY = {"reply": "replies"}


def learning(theories: Theories) -> Iterator[Figure]:
    """The accuracy by how many lessons there were; nothing where it was asked once."""
    answers = [it for them in theories.values() for one in them for it in one.answers]
    most = max((it.lessons for it in answers if it.is_word), default=0)
    wide = step(most)

    def place(answer: Scored) -> int:
        return near(answer.lessons, wide) if answer.is_word else -1

    series: dict[str, Any] = {}
    for name, them in theories.items():
        parts = parted(them, place)
        at = sorted(it for it in parts if it >= 0 and _count(parts[it]) >= _LEAST)
        estimates = [estimated(ACCURACY, parts[it]) for it in at]
        series[name] = {"x": at, **as_drawn(estimates, "mean")}
    if any(len(it["x"]) > 1 for it in series.values()):
        data = {
            "x": sorted({x for it in series.values() for x in it["x"]}),
            "series": series,
            "xlabel": "lessons",
            "ylabel": "accuracy",
        }
        yield Figure("curves", "Learning curve", data, _note(wide))


def near(lessons: int, wide: int) -> int:
    """The place nearest to so many lessons; what is between two goes to the later.

    >>> [near(it, 2) for it in range(7)]
    [0, 2, 2, 4, 4, 6, 6]
    """
    return (lessons + wide // 2) // wide * wide


def _count(dialogues: Sequence[Dialogue]) -> int:
    return sum(len(it.answers) for it in dialogues)


def _note(wide: int) -> str:
    near = f"Answers are put to the nearest {wide} lessons. " if wide > 1 else ""
    return f"{near}Not every dialogue comes to all of these. Bands of 95 %."


def step(most: int) -> int:
    """How far apart places on an axis up to so much are: 1, 2, 5, 10, 20, 50, …

    >>> step(9), step(48), step(2000)
    (1, 5, 200)
    """
    scale = 1
    while True:
        for by in (1, 2, 5):
            if most <= _PLACES * by * scale:
                return by * scale
        scale *= 10


def reliable(theories: Theories) -> Iterator[Figure]:
    """Whether what is said with a degree is right as often as that."""
    series = {}
    for name, them in theories.items():
        bins = parted(them, _bin)
        at = sorted(it for it in bins if it >= 0)
        said = [estimated(DEGREE, bins[it]).value for it in at]
        right = [estimated(ACCURACY, bins[it]) for it in at]
        series[name] = {
            "x": said,
            **as_drawn(right, "y"),
            "counts": [_count(bins[it]) for it in at],
        }
    if not any(it["x"] for it in series.values()):
        return
    data = {
        "series": series,
        "xlabel": "degree of the word that was said",
        "ylabel": "share that is right",
    }
    note = "On the dashed line degrees are what they say. Bands of 95 %."
    yield Figure("reliability", "Reliability", data, note)


def _bin(answer: Scored) -> int:
    if not (answer.is_word and answer.said and np.isfinite(answer.degree)):
        return -1
    return min(int(answer.degree * _BINS), _BINS - 1)


def words(theories: Theories) -> Iterator[Figure]:
    """The accuracy word by word, for not too many words."""
    parts = {
        name: parted(them, lambda it: (it.kind, it.right) if it.is_word else None)
        for name, them in theories.items()
    }
    ordered = sorted({key for them in parts.values() for key in them if key})
    if not 1 < len(ordered) <= _DRAWN:
        return
    nothing = Estimate(float("nan"), float("nan"), float("nan"))
    series = {}
    for name, of in parts.items():
        estimates = [
            estimated(ACCURACY, of[key]) if key in of else nothing for key in ordered
        ]
        series[name] = as_drawn(estimates)
    data = {
        "labels": [word for _, word in ordered],
        "series": series,
        "xlabel": "accuracy",
    }
    yield Figure("intervals", "Word by word", data, "Bands of 95 %.")


def confusions(theories: Theories) -> Iterator[Figure]:
    """Which words are taken for which, for each theory and kind of word."""
    for name, them in theories.items():
        for kind, of in parted(them, lambda it: it.kind if it.is_word else "").items():
            labels = sorted({it.right for one in of for it in one.answers})
            if kind and 1 < len(labels) <= _MOST:
                yield _confusion(f"{name}: {_MANY.get(kind, f'{kind}s')}", labels, of)


def _confusion(title: str, labels: list[str], of: Sequence[Dialogue]) -> Figure:
    answers = [it for one in of for it in one.answers]
    right = [it.right for it in answers]
    said = [it.said or _NOTHING for it in answers]
    columns = [*labels, *sorted({*said} - {*labels})]
    counts = confusion(right, said, columns)[: len(labels)]
    data = {"labels": labels, "columns": columns, "counts": counts.tolist()}
    return Figure("confusion", title, data)
