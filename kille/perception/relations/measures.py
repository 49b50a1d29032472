"""The measurements that spatial words depend on, for many configurations at once.

Lengths are in units of the things' own size, so that a word means the same of cups and
of cupboards. The size of a pair is the geometric mean of the two sizes, 10 cm where
neither is known.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kille.scene import Configuration, Direction

Array = NDArray[np.float32]

USUAL_SIZE = 0.1  # metres: a thing one takes in the hand
_SMALLEST, _LARGEST = 1e-6, 1e6  # metres: beyond it numbers would overflow
_NEAREST = 0.05  # sizes: what is nearer is at the same place
_FARTHEST = 1e4  # sizes: what is farther is that far
_BETWEEN = 0.35  # of their distance: how far off the line a thing is between two others


class ConfigurationMeasures(NamedTuple):
    """Measurements of n configurations, each (n,), NaN where unknown."""

    bearing: Array
    """Where the target is on the table: radians counter-clockwise from right."""
    turn: Array
    """How far the viewer's ray to the landmark is turned, counter-clockwise, from
    straight away; 0 where it is unknown."""
    heading: Array
    """The landmark's own front: radians counter-clockwise from right."""
    across: Array
    """The distance on the table."""
    rise: Array
    """The target's height over the landmark's."""
    apart: Array
    """The logarithm of the distance."""
    gap: Array
    """The distance less half of both sizes, at least 0."""
    crowding: Array
    """The logarithm of the distance over the median distance of the other things; 0
    where there are none."""
    between: Array
    """How many other things are between the two."""
    flanked: Array
    """How far the target is between the landmark and another thing: the cosine of the
    angle it is seen under, from -1 (not at all) to 1 (on the line)."""
    contact: Array
    """The share of the target that touches the landmark."""
    support: Array
    """How far the landmark bears the target."""
    containment: Array
    """The share of the target within the landmark."""


def measure_configurations(
    configurations: Sequence[Configuration],
) -> ConfigurationMeasures:
    """Measure several configurations at once."""
    rows = np.array([_row(it) for it in configurations], np.float32)
    return ConfigurationMeasures(
        *rows.reshape(-1, len(ConfigurationMeasures._fields)).T
    )


def size_of(configuration: Configuration) -> float:
    """The unit of length in metres: the geometric mean of the two sizes."""
    target, landmark = _sizes(configuration)
    return math.sqrt(target * landmark)


def clip_lengths(metres: NDArray[np.float64]) -> NDArray[np.float64]:
    """Clip lengths in metres to the largest length allowed."""
    return np.clip(metres, -_LARGEST, _LARGEST)


def _sizes(it: Configuration) -> tuple[float, float]:
    """The sizes in metres; an unknown size is taken to equal the known one."""
    known = [
        min(max(size, _SMALLEST), _LARGEST)
        for size in (it.target_size, it.landmark_size)
        if size is not None and 0 < size < math.inf
    ]
    if len(known) == 2:
        return known[0], known[1]
    return (known[0], known[0]) if known else (USUAL_SIZE, USUAL_SIZE)


def _row(it: Configuration) -> tuple[float, ...]:
    target, landmark = _sizes(it)
    unit = math.sqrt(target * landmark)
    right, away, up = (_length(number / unit) for number in it.offset)
    distance = math.hypot(right, away, up)
    known = distance == distance
    return (
        math.atan2(away, right),
        _turn(it.viewed),
        math.nan if it.heading is None else _length(it.heading),
        math.hypot(right, away),
        up,
        math.log(max(distance, _NEAREST)) if known else math.nan,
        max(0.0, distance - (target + landmark) / 2 / unit) if known else math.nan,
        *_company(it.offset, it.others),
        _share(it.contact),
        _share(it.support),
        _share(it.containment),
    )


def _length(number: float) -> float:
    return (
        max(-_FARTHEST, min(_FARTHEST, number)) if math.isfinite(number) else math.nan
    )


def _share(number: float | None) -> float:
    if number is None or not math.isfinite(number):
        return math.nan
    return max(0.0, min(1.0, number))


def _turn(viewed: Direction | None) -> float:
    if viewed is None or not math.hypot(viewed[0], viewed[1]) > 0:
        return 0.0
    turn = math.atan2(viewed[1], viewed[0]) - math.pi / 2
    return turn if math.isfinite(turn) else 0.0


def _company(
    offset: Direction, others: Sequence[Direction]
) -> tuple[float, float, float]:
    """How the other things are placed: crowding, between and flanked."""
    around = np.array(others, np.float64).reshape(-1, 3)
    target = np.array(offset, np.float64)
    around = clip_lengths(around[np.isfinite(around).all(axis=1)])
    if not len(around) or not np.isfinite(target).all():
        return 0.0, 0.0, -1.0
    target = clip_lengths(target)
    distance = float(np.linalg.norm(target))
    if distance < _SMALLEST:
        return 0.0, 0.0, -1.0
    lengths = np.linalg.norm(around, axis=1)
    median = max(float(np.median(lengths)), 1e-6)
    along = around @ target / distance**2
    aside = np.linalg.norm(around - along[:, None] * target, axis=1) / distance
    between = int(((along > 0.1) & (along < 0.9) & (aside < _BETWEEN)).sum())
    away = around - target
    cosines = -(away @ target) / (np.linalg.norm(away, axis=1) * distance + 1e-9)
    return math.log(distance / median), float(between), float(-cosines.min())
