"""Judgements of a word, as a regression on each template that it may mean.

How often people tick a word that fits, and how sharply, differs by word and by people:
`in` may be ticked by a fifth of them at best, and `above` by all. So a judged degree d
is not the template's degree h itself but depends on it through a line in log odds,

    logit d = shift + slope logit h + noise,    slope >= 0,

weighted by d (1 - d), the information in a share of votes (the empirical logit of
Cox 1970). Shift and slope have Gaussian priors around 0 and 1, the noise a grid of
values: clean ratings make few templates likely, noisy ones leave many. All follows from
six sums a template, so judgements have no order and are forgotten exactly.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Vector = NDArray[np.float64]

_DOUBTED = 0.03  # nobody is surer than this
_SHIFT = 1.0  # deviations of the priors: a factor of e in the odds,
_SLOPE = 0.1  # and a little sharper or vaguer than one of the templates of the grid
_NOISE = np.array([[0.15], [0.3], [0.6], [1.0], [1.6]])
_ENOUGH = 15  # judgements: more tell where templates err rather than which is meant
_PROBIT = 1.702  # the logistic nearest to the normal distribution


def log_odds(degrees: ArrayLike) -> Vector:
    """The log odds of degrees in [0, 1], which never count as quite certain."""
    sure = _DOUBTED + (1 - 2 * _DOUBTED) * np.asarray(degrees, np.float64)
    odds: Vector = np.log(sure / (1 - sure))
    return odds


def degrees_at(odds: ArrayLike) -> Vector:
    """The degrees in [0, 1] of log odds; the inverse of `log_odds`."""
    sure = 1 / (1 + np.exp(-np.asarray(odds, np.float64)))
    degrees: Vector = np.clip((sure - _DOUBTED) / (1 - 2 * _DOUBTED), 0, 1)
    return degrees


class TemplateFit(NamedTuple):
    """How well each template fits the judgements (log evidence), and its line."""

    score: Vector
    shift: Vector
    slope: Vector


@dataclass(frozen=True, eq=False)
class Judgements:
    """Weighted sums over the judgements of one word: of their log odds y, and, for
    each template (h,), of its log odds z."""

    count: int
    weight: float
    y: float
    yy: float
    z: Vector
    zz: Vector
    zy: Vector

    @staticmethod
    @cache  # the same for every word: computed once
    def none(templates: int) -> Judgements:
        """The sums for so many templates before any judgement."""
        zeros = np.zeros(templates)
        return Judgements(0, 0.0, 0.0, 0.0, zeros, zeros, zeros)

    def plus(self, degrees: Vector, degree: float, times: int) -> Judgements:
        """Add `times` judgements of this degree, where the templates have `degrees`."""
        y, z = float(log_odds(degree)), log_odds(degrees)
        weight = times / np.cosh(y / 2) ** 2  # 4 d (1 - d)
        return Judgements(
            self.count + times,
            self.weight + weight,
            self.y + weight * y,
            self.yy + weight * y * y,
            self.z + weight * z,
            self.zz + weight * z * z,
            self.zy + weight * z * y,
        )

    @cached_property
    def fit(self) -> TemplateFit:
        """The evidence and the line of each template, averaged over the noise
        levels."""
        noise = _NOISE**2
        # Of the posterior: its precision (a b; b c), and that times its mean (u, v).
        a = 1 / _SHIFT**2 + self.weight / noise
        b = self.z / noise
        c = 1 / _SLOPE**2 + self.zz / noise
        u, v = self.y / noise, 1 / _SLOPE**2 + self.zy / noise
        spread = a * c - b * b
        shift, slope = (c * u - b * v) / spread, (a * v - b * u) / spread
        misfit = self.yy / noise + 1 / _SLOPE**2 - shift * u - slope * v
        rising = -np.logaddexp(0, -_PROBIT * slope * np.sqrt(spread / a))
        scores = rising - 0.5 * (
            self.count * np.log(noise)
            + misfit
            + np.log(spread * (_SHIFT * _SLOPE) ** 2)
        )
        scores /= np.sqrt(1 + (self.count / _ENOUGH) ** 2)
        top = scores.max(axis=0)
        shares = np.exp(scores - top)
        total = shares.sum(axis=0)
        return TemplateFit(
            top + np.log(total),
            (shares * shift).sum(axis=0) / total,
            np.maximum((shares * slope).sum(axis=0) / total, 0),
        )
