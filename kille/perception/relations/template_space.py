"""All templates together, and their prior over possible configurations."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import numpy as np
from numpy.typing import NDArray

from kille.perception.relations.measures import Array, measure_configurations
from kille.perception.relations.templates import families
from kille.scene import Configuration, Direction

_PLACES = 600
_SEED = 0
_UNSEEN = 0.5


class Space:
    """The templates that a word may mean: their prior, and their degrees."""

    def __init__(self) -> None:
        self._families = tuple(families())
        prior = np.concatenate([it.prior for it in self._families])
        self.names = tuple(it.name for it in self._families)
        self.ends = np.cumsum([len(it.prior) for it in self._families])
        self.log_prior: NDArray[np.float64] = np.log(prior / prior.sum())
        anywhere = self._degrees(_anywhere(_PLACES, np.random.default_rng(_SEED)))
        self.breadth: Array = anywhere.mean(axis=0)
        """The share of all possible configurations that each template covers, (h,)."""

    def degrees(self, configurations: Sequence[Configuration]) -> Array:
        """The degree of each template at each configuration, (n, h).

        Where what it depends on is unknown this is half of what is usual: words are
        mostly said where one can see what they are about.
        """
        found = self._degrees(configurations)
        return np.where(np.isnan(found), _UNSEEN * self.breadth, found)

    def _degrees(self, configurations: Sequence[Configuration]) -> Array:
        of = measure_configurations(configurations)
        return np.concatenate([it.degrees(of) for it in self._families], axis=1)


@cache
def space() -> Space:
    """The space of templates, built once."""
    return Space()


def _anywhere(count: int, chance: np.random.Generator) -> list[Configuration]:
    """Random configurations of two things on and above a table."""
    return [_somewhere(chance) for _ in range(count)]


def _somewhere(chance: np.random.Generator) -> Configuration:
    bearing = chance.uniform(-np.pi, np.pi)
    distance = float(np.exp(chance.uniform(np.log(0.7), np.log(12))))
    tilt = chance.choice([0.0, 0.0, 1.0, -1.0]) * abs(chance.normal(np.pi / 3, 0.4))
    offset = _towards(bearing, tilt, distance)
    others = tuple(
        _towards(chance.uniform(-np.pi, np.pi), 0.0, float(np.exp(chance.normal(1, 1))))
        for _ in range(chance.integers(0, 6))
    )
    touches = distance < 1.2
    contained = float(touches and chance.random() < 0.3)
    return Configuration(
        offset=offset,
        viewed=_towards(chance.normal(np.pi / 2, 0.2), 0.0, 10.0),
        target_size=1.0,
        landmark_size=1.0,
        others=others,
        heading=chance.uniform(-np.pi, np.pi),
        contact=float(touches) * chance.random(),
        support=float(touches and (tilt > 0.5 or contained)) * chance.random() ** 0.5,
        containment=contained * chance.random() ** 0.5,
    )


def _towards(bearing: float, tilt: float, distance: float) -> Direction:
    level = distance * np.cos(tilt)
    return (
        float(level * np.cos(bearing)),
        float(level * np.sin(bearing)),
        float(distance * np.sin(tilt)),
    )
