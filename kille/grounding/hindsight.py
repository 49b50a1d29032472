"""How well a word was known while it was learned: what the robot would have said of
the thing of each lesson by the lessons before it.

It is the accuracy of predicting each example before it is learned: "prequential", Dawid
1984, "Statistical theory: the prequential approach".
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from kille.perception.descriptor_index import View
from kille.perception.features import NONE
from kille.perception.objects import ObjectMemory
from kille.scene import Box, Features, Percept, Region

_UNPLACED = Region(np.zeros((0, 0), np.bool_), Box(0, 0, 0, 0), None)


class PastLesson(NamedTuple):
    """A lesson in a noun: what was seen, and whether its word held of it."""

    view: View
    holds: bool


def was_right(
    lessons: Sequence[PastLesson],
    name: str,
    latest: int,
    make: Callable[[Iterable[View]], ObjectMemory] = ObjectMemory,
) -> Iterator[bool]:
    """Whether the robot would have been right before each of the latest lessons in a
    noun: its best guess is the noun, or for a denial is not.

    `lessons` are all that were given, in order. Its criteria, which say what counts for
    a word, are left out. Each answer is worked out when it is asked for.
    """
    asked = [n for n, it in enumerate(lessons) if it.view.label == name][-latest:]
    if not asked:
        return
    known = lessons[: asked[0]]
    learner = make(it.view for it in known if it.holds)
    for it in known:
        if not it.holds:
            learner.deny(it.view)
    for n, (view, holds) in enumerate(lessons[asked[0] : asked[-1] + 1], asked[0]):
        if n in asked:
            degrees = learner.predict_proba_one(_percept_of(view))
            best = max(degrees, key=lambda it: degrees[it], default="")
            yield (best == name) == holds
        (learner.learn if holds else learner.deny)(view)


def _percept_of(view: View) -> Percept:
    """What was seen in a lesson, as far as it was kept."""
    kept = Features(view.descriptors, NONE.pixels, NONE.points)
    return Percept(_UNPLACED, (kept,), lambda: view.traits)
