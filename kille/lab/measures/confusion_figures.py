"""Figures of which answers were given for which right words."""

from __future__ import annotations

from collections.abc import Sequence

from kille.lab.measures.statistics import confusion
from kille.lab.results import Figure


def confusion_figure(
    title: str,
    labels: Sequence[str],
    right: Sequence[str],
    answers: Sequence[str],
    last: str = "",
) -> Figure:
    """Count how often each answer was given for each right word, which are `labels`.

    Answers that are no labels have columns after these; the `last` answer comes last.

    >>> found = confusion_figure("two", ["cup", "car"], ["cup", "car"], ["cup", "cap"])
    >>> found.data["columns"], found.data["counts"]
    (['cup', 'car', 'cap'], [[1, 0, 0], [0, 0, 1]])
    """
    others = sorted({*answers} - {*labels}, key=lambda it: (it == last, it))
    columns = [*labels, *others]
    counts = confusion(right, answers, columns)[: len(labels)].tolist()
    data = {"labels": list(labels), "columns": columns, "counts": counts}
    return Figure("confusion", title, data)
