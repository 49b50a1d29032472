"""Vague borders: which colours a word applies to, and to what degree.

Each word has three axes in Oklab (`kille.perception.colours.space.even`): lightness;
vividness, which runs from grey towards the word's own hue; and lean, which runs across
it, counter-clockwise. On each axis it has a lower and an upper border, and how vague
each of them is. With x the colour's place on an axis, l and h the borders, s and t how
vague they are, its degree there is

    σ((x - l) / s) · σ((h - x) / t),

which is the chance that x is between two borders of which one knows no more than that.
The degree of the word is the product over its axes. Source: McMahan and Stone 2015, who
have borders in hue, saturation and value, and the tails of a gamma distribution.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kille.perception.colours.space import Lab, even

Numbers = NDArray[np.float64]

AXES = ("lightness", "vividness", "lean")


@dataclass(frozen=True, eq=False)
class Borders:
    """The borders of several words.

    hues (w,) are the words' angles in Oklab's plane of a and b, in degrees; edges
    (w, 3, 4) are, for each word and axis: low, how vague it is, high, how vague it is.
    """

    hues: Numbers
    edges: Numbers

    def log_degrees(self, lab: Lab) -> Numbers:
        """The logarithms (n, w) of the degrees of each word for colours (n, 3)."""
        low, low_vague, high, high_vague = np.moveaxis(self.edges, -1, 0)
        places = along(lab, self.hues)
        below = np.logaddexp(0, (low - places) / low_vague)
        above = np.logaddexp(0, (places - high) / high_vague)
        return np.asarray(-(below + above).sum(axis=2))

    def some(self, which: list[int]) -> Borders:
        """The borders of some of the words, by their numbers."""
        return Borders(self.hues[which], self.edges[which])


def along(lab: Lab, hues: Numbers) -> Numbers:
    """The places (n, w, 3) of Lab colours (n, 3) on the axes of words with these hues.

    >>> blue = np.array([[32.0, 79, -108]])
    >>> along(blue, np.array([264.0, 84.0])).round().tolist()
    [[[45.0, 94.0, -1.0], [45.0, -94.0, 1.0]]]
    """
    angles = np.radians(hues)
    cos, sin = np.cos(angles), np.sin(angles)
    light, a, b = np.split(even(lab), 3, axis=1)
    vivid, lean = a * cos + b * sin, b * cos - a * sin
    return np.stack([light + np.zeros_like(vivid), vivid, lean], axis=2)
