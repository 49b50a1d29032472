"""How well a thing's size and colours fit those of the things each word was learned of.

Size rejects: what has another size is another thing. Colour only supports: things of
the same colour are many, and a thing may look different in another light.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kille.perception.appearance import COLOURS
from kille.perception.index import View
from kille.scene import Traits

Vector = NDArray[np.float64]

_BLUR = 0.01  # metres: thin things are known no better than that
_SPREAD = 0.24  # of log sizes: parts of a thing are hidden, and it is turned
_ALIKE, _STEP = 0.81, 0.023  # overlap of the colours of like things, and its range


class Fit(NamedTuple):
    """How each word fits, from 0 to 1: by size, 1 if unknown; by colour, 0 if unknown.

    `size_known` is 1 for the words whose size could be compared, else 0.
    """

    size: Vector
    colour: Vector
    size_known: Vector


class Resemblance:
    """The traits of all views, to be compared at once; never changed.

    Colours of another length than `COLOURS` count as unknown: they were learned when
    colours were binned in another way.
    """

    def __init__(self, views: Sequence[View], labels: Sequence[str]) -> None:
        """The traits of these views; labels are their words, in the order of a fit."""
        columns = {label: i for i, label in enumerate(labels)}
        self._count = len(labels)
        sized = [view for view in views if view.traits.size is not None]
        self._sizes = np.array([_logs(view.traits.size) for view in sized])
        self._sized = np.array([columns[view.label] for view in sized], np.intp)
        tinted = [view for view in views if _has_colour(view.traits)]
        self._colours = np.array([view.traits.colour for view in tinted])
        self._tinted = np.array([columns[view.label] for view in tinted], np.intp)

    def fit(self, traits: Traits) -> Fit:
        """How the words fit: a word as well as the view of it that fits best.

        With d the root mean square of the differences of log sizes, the fit by size is
        exp(-(d/s)²). With q the overlap of the histograms, Σ√(p p'), that by colour is
        1 / (1 + exp(-(q - c) / t)).
        """
        size = np.zeros(self._count)
        known = np.zeros(self._count)
        if traits.size is not None and len(self._sized):
            apart = self._sizes - _logs(traits.size)
            each = np.exp(-(apart**2).mean(axis=1) / _SPREAD**2)
            np.maximum.at(size, self._sized, each)
            known[self._sized] = 1
        colour = np.zeros(self._count)
        if traits.colour is not None and len(self._tinted):
            overlap = self._colours @ traits.colour
            each = 1 / (1 + np.exp((_ALIKE - overlap) / _STEP))
            np.maximum.at(colour, self._tinted, each)
        return Fit(np.where(known > 0, size, 1.0), colour, known)


def _has_colour(traits: Traits) -> bool:
    return traits.colour is not None and len(traits.colour) == COLOURS


def _logs(size: NDArray[np.float32] | None) -> Vector:
    return np.log(np.asarray(size, np.float64) + _BLUR)
