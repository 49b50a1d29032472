"""Power: how many dialogues are needed to see a difference between theories."""

from __future__ import annotations

import math
from statistics import NormalDist

import numpy as np
from numpy.typing import ArrayLike

ALPHA = 0.05
"""How often a difference may be reported where there is none."""

POWER = 0.8
"""How often an existing difference should be seen."""

_FLIPS = 999
_TINY = 1e-12


def runs_needed(
    spread: float, d: float, power: float = POWER, alpha: float = ALPHA
) -> int | None:
    """How many pairs of dialogues are needed to see a difference of d with this power.

    n = (z_{1-α/2} + z_power)² σ² / d² + z²_{1-α/2} / 2, σ the standard deviation of the
    differences within pairs. None where that is not known or d is 0.
    Source: Guenther 1981, Sample size formulas for normal theory t tests.

    >>> runs_needed(spread=0.2, d=0.1)
    34
    """
    if not (math.isfinite(spread) and math.isfinite(d)) or d == 0:
        return None
    z, beyond = _z(1 - alpha / 2), _z(power)
    return max(2, math.ceil(((z + beyond) * spread / d) ** 2 + z**2 / 2))


def least_difference(
    spread: float, runs: int, power: float = POWER, alpha: float = ALPHA
) -> float:
    """The smallest difference that this many pairs of dialogues show with this power.

    The inverse of `runs_needed`; NaN for too few.

    >>> round(least_difference(spread=0.2, runs=34), 2)
    0.1
    """
    z, beyond = _z(1 - alpha / 2), _z(power)
    left = runs - z**2 / 2
    return (z + beyond) * spread / math.sqrt(left) if left > 0 else float("nan")


def power_of(
    apart: ArrayLike,
    d: float,
    runs: int,
    chance: np.random.Generator,
    *,
    rounds: int = 400,
    alpha: float = ALPHA,
) -> float:
    """How often this many pairs show a difference of d, by simulation.

    Differences are drawn from those observed, shifted to the mean d, and tested by
    flipping their signs, as theories are compared. NaN for fewer than two differences.

    >>> apart = [0.0, 0.1, 0.2, 0.1, 0.3]
    >>> chance = np.random.default_rng(1)
    >>> power_of(apart, 0.5, 30, chance) > power_of(apart, 0.01, 30, chance)
    True
    """
    observed = np.asarray(apart, np.float64)
    if len(observed) < 2:
        return float("nan")
    samples = chance.choice(observed - observed.mean() + d, size=(rounds, runs))
    signs = chance.choice([-1.0, 1.0], size=(runs, _FLIPS))
    flipped = np.abs(samples @ signs)
    large = (flipped >= np.abs(samples.sum(axis=1))[:, None] - _TINY).sum(axis=1)
    return float(((large + 1) / (_FLIPS + 1) <= alpha).mean())


def _z(share: float) -> float:
    return NormalDist().inv_cdf(share)
