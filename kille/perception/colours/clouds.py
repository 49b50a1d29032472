"""A tutor's colour word as a cloud in Lab, learned from the things they showed.

The colours of a word are taken to be normally distributed. Before anything was shown
it is as wide as a usual colour word is, and of no colour in particular; each colour
that is shown moves it there, and gradually determines its width. This is the
normal-inverse-Wishart prior, for which the order of lessons does not matter (Gelman et
al. 2013, section 3.6); the prediction for another colour is a Student t.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kille.perception.colours.space import Lab

Numbers = NDArray[np.float64]

WIDTH = 14.8
"""Lab units: the usual deviation of a word of xkcd's survey on each axis."""

_FIRM = 8.0
"""How many colours the usual width counts for.

Of 6, 8, 12, 20 and 40 the one by which words of xkcd are learned best from 3 examples,
when each is taken to be unknown in turn.
"""


@dataclass(frozen=True, eq=False)
class Cloud:
    """The distribution of a colour word: lessons, mean (3,), inverse scale (3, 3)."""

    lessons: float
    freedom: float
    middle: Numbers
    inverse: Numbers

    def nearness(self, lab: Lab) -> Numbers:
        """The density (n,) of colours (n, 3), scaled to 1 at the mean."""
        apart = lab - self.middle
        squares = np.einsum("ni,ij,nj->n", apart, self.inverse, apart)
        power = -(self.freedom + 3) / 2
        return np.asarray((1 + squares / self.freedom) ** power)

    def degrees(self, lab: Lab) -> Numbers:
        """How well the word applies to colours (n, 3): the square root of their
        nearness.

        A root, for a word holds of more than it is mostly used for: so the degrees
        agree best with those of words that many people use.
        """
        return np.sqrt(self.nearness(lab))


def cloud(lab: Lab, weights: Numbers) -> Cloud:
    """The cloud after these colours (n, 3), n > 0; weight 1 is one lesson."""
    lessons = float(weights.sum())
    middle = weights @ lab / lessons
    apart = lab - middle
    spread = (_FIRM - 4) * WIDTH**2 * np.eye(3) + (apart * weights[:, None]).T @ apart
    freedom = _FIRM + lessons - 2
    scale = spread * (lessons + 1) / lessons / freedom
    inverse = np.asarray(np.linalg.inv(scale), np.float64)
    return Cloud(lessons, freedom, middle, inverse)
