"""How well spatial words fit at places around a landmark, as learners have them."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from kille.lab.results import Figure
from kille.lab.theories.candidates import degrees_of
from kille.perception.learners import Learner
from kille.scene import Configuration


def map_figure(
    title: str,
    words: Sequence[str],
    learner: Learner[Configuration],
    spots: Sequence[float],
    at: Callable[[float, float], Configuration],
    ylabel: str = "away",
) -> Figure:
    """The degree of each word wherever the target is on a square around the landmark.

    `spots` are the places along each side, in metres; `at` is the configuration at two
    of them.
    """
    grid = [
        [degrees_of(learner, at(right, other)) for right in spots] for other in spots
    ]
    return Figure(
        "map",
        title,
        {
            "words": list(words),
            "right": spots,
            "away": spots,
            "ylabel": ylabel,
            "degrees": {
                word: [[degrees.get(word, 0.0) for degrees in row] for row in grid]
                for word in words
            },
        },
    )
