"""What perceptual meanings are shown as: where they hold, among one or two numbers."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import Any

from ttr.degree_pictures import POINTS, Interval, degree_curve, degree_map
from ttr.errors import TTRError
from ttr.probability import Degree
from ttr.semantics.perceptual.vectors import is_vector
from ttr.showing import Part
from ttr.types.objects import Object, Record

Judge = Callable[[Object], Degree]

_FURTHEST = 1e6
"""How far from zero it is looked for where a word begins to hold."""

_VISIBLE = 0.002
"""How much a degree has to change from one piece of a curve to the next."""

_CLOSER = 8
"""How often a curve is drawn closer to where its degrees change."""


def picture_of(params: Record, degree: Judge) -> Part | None:
    """A learner's own picture, a curve or a map of degrees; None if there is none.

    How many numbers a percept has is told by the parameters: as many as the first
    vector in them, or a number if they are numbers themselves.
    """
    learner: Any = getattr(params._fields.get("learner"), "learner", None)
    if hasattr(type(learner), "_shown_as_"):
        shown: Part = learner._shown_as_()
        return shown
    values = [*params._fields.values()]
    size = next((len(it) for it in _vectors(values)), 0)
    try:
        if size == 2:
            return degree_map(
                lambda xs: [_bounds(degree(x)) for x in xs], _reach(params)
            )
        if size == 1:
            return _curve(lambda x: _bounds(degree((x,))))
        if values and all(_is_number(it) for it in values):
            return _curve(lambda x: _bounds(degree(x)))
    except TTRError:
        pass
    return None


def _bounds(p: Degree) -> Interval:
    return p.lo, p.hi


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _vectors(values: list[Object]) -> Iterator[tuple[Object, ...]]:
    """The vectors among values, also those in lists of them."""
    for it in values:
        if isinstance(it, tuple):
            if it and is_vector(it):
                yield it
            else:
                yield from _vectors([*it])


def _curve(degree: Callable[[float], Interval]) -> Part | None:
    """The curve around where degrees change; None if they nowhere do."""
    reach = 1.0
    while not (pieces := _changes(degree, low := -reach, high := reach)):
        reach *= 10.0
        if reach > _FURTHEST:
            return None
    for _ in range(_CLOSER):
        low, high, width = *_around(pieces, low, high), high - low
        pieces = _changes(degree, low, high)
        if len(pieces) < 2 or high - low > 0.8 * width:  # a jump, or near enough
            break
    return degree_curve(degree, low, high)


def _changes(degree: Callable[[float], Interval], low: float, high: float) -> list[int]:
    """The numbers of the pieces of an interval in which degrees change visibly."""
    step = (high - low) / POINTS
    found = [degree(low + step * k) for k in range(POINTS + 1)]
    steps = enumerate(pairwise(found))
    return [k for k, (one, other) in steps if _distance(one, other) > _VISIBLE]


def _around(pieces: Sequence[int], low: float, high: float) -> Interval:
    """Some pieces of an interval with as much around them, between round numbers."""
    step = (high - low) / POINTS
    first, last = low + step * pieces[0], low + step * (pieces[-1] + 1)
    margin = max(last - first, 4 * step) / 2
    digits = 1 - math.floor(math.log10(margin))
    return round(first - margin, digits), round(last + margin, digits)


def _distance(one: Interval, other: Interval) -> float:
    return max(abs(a - b) for a, b in zip(one, other, strict=True))


def _reach(params: Record) -> float:
    """How far from zero a map has to reach to show where w · x is the threshold.

    That is 1, or ten times as much until it does.
    """
    weights, t = params._fields.get("w", ()), params._fields.get("t", 0.0)
    if not (isinstance(weights, tuple) and is_vector(weights) and _is_number(t)):
        return 1.0
    reach, furthest = 1.0, sum(map(abs, weights))
    while furthest > 0.0 and abs(t) >= reach * furthest and reach < _FURTHEST:
        reach *= 10.0
    return reach
