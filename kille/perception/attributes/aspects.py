"""Aspects: the respects in which a word may describe a thing, such as size or texture.

An aspect measures a thing by some of its traits, and has a kernel that says how far
what is said of one thing holds of another:

- in an aspect of *kind*, such as texture, it holds of what is like that: the kernel is
  exp(-d), with d the squared distance in units of its mean between different things;
- in an aspect of *degree*, such as size, it holds of what is more so on the same side
  of what is usual: the kernel is (c + z z') / (c + 1), with z how many deviations a
  thing is off the mean. What is big is big beyond any thing that was shown.

So a word for a colour, for a middling size or for a pattern is a matter of kind, one
like "big" or "long" of degree. The means and deviations are those of things that stand
on a table, ten rendered ones in eight poses each.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from kille.perception.cues import CUES
from kille.perception.cues.colour import HUES, LIGHTS, VIVID
from kille.perception.evidence import weighing
from kille.scene import Traits, Vector

Numbers = NDArray[np.float64]

_HUGE = 1e6
_LEVEL = 0.5  # c: how much of what is said in a degree holds of what is usual
_FARTHEST = 2.5  # deviations: what is farther off counts as so far


@dataclass(frozen=True)
class Aspect:
    """One respect in which things are described.

    `measure` gives numbers (k,) or None for what cannot be told, `kernel` how far two
    rows of such numbers, (m, k) and (n, k), have it in common, (m, n). `prior` is how
    likely a word is to speak of it.

    >>> length = Aspect("length", lambda it: it.get("size"), np.minimum, prior=0.1)
    >>> length.name
    'length'
    """

    name: str
    measure: Callable[[Traits], Numbers | None]
    kernel: Callable[[Numbers, Numbers], Numbers]
    prior: float


def _vector(traits: Traits, cue: str) -> Vector | None:
    """A trait; None if it is unknown or no valid measurement."""
    vector = traits.get(cue)
    if vector is None or len(vector) != CUES[cue].length:
        return None
    return vector if np.abs(vector).max() < _HUGE else None


def _of_kind(cue: str, prior: float) -> Aspect:
    width = weighing().kernels[cue].width

    def measure(traits: Traits) -> Numbers | None:
        vector = _vector(traits, cue)
        return None if vector is None else vector.astype(np.float64)

    def kernel(some: Numbers, others: Numbers) -> Numbers:
        squares = (some**2).sum(axis=1)[:, None] + (others**2).sum(axis=1)
        apart = np.maximum(squares - 2 * some @ others.T, 0)
        return np.asarray(np.exp(-apart / width))

    return Aspect(cue, measure, kernel, prior)


@dataclass(frozen=True)
class _Usual:
    """What is usual among things: the mean of a number, and its deviation."""

    mean: float
    deviation: float


def _of_degree(
    name: str,
    cue: str,
    number: Callable[[Vector], float],
    usual: _Usual,
    prior: float,
) -> Aspect:
    def measure(traits: Traits) -> Numbers | None:
        vector = _vector(traits, cue)
        if vector is None:
            return None
        off = (number(vector) - usual.mean) / usual.deviation
        return np.array([np.clip(off, -_FARTHEST, _FARTHEST)])

    def kernel(some: Numbers, others: Numbers) -> Numbers:
        return np.asarray((_LEVEL + some @ others.T) / (_LEVEL + 1))

    return Aspect(name, measure, kernel, prior)


def _shares(colour: Vector) -> Numbers:
    """The share of each colour (L, a, b) in a thing, from the cue `colour`."""
    shares = colour.astype(np.float64).reshape(LIGHTS, HUES, HUES) ** 2
    return np.asarray(shares / max(shares.sum(), 1e-12))


def _lightness(colour: Vector) -> float:
    return float(_shares(colour).sum(axis=(1, 2)) @ np.arange(LIGHTS))


def _vividness(colour: Vector) -> float:
    """The mean distance of the colours from grey, in units of a and b."""
    axis = ((np.arange(HUES) + 0.5) / HUES - 0.5) * 2 * VIVID
    return float((_shares(colour).sum(axis=0) * np.hypot(axis[:, None], axis)).sum())


def _aspects() -> Sequence[Aspect]:
    return (
        _of_kind("colour", 1.0),
        _of_kind("hue", 1.0),
        _of_kind("texture", 0.5),
        _of_kind("pattern", 0.5),
        _of_kind("shape", 0.5),
        _of_kind("outline", 0.5),
        _of_kind("size", 0.5),
        _of_degree("bigness", "size", np.mean, _Usual(-2.28, 0.35), 1.0),
        _of_degree(
            "length", "size", lambda it: float(it[0] - it[1]), _Usual(0.52, 0.33), 0.5
        ),
        _of_degree(
            "flatness", "size", lambda it: float(it[1] - it[2]), _Usual(0.62, 0.45), 0.5
        ),
        _of_degree(
            "roundness", "shape", lambda it: float(it[5]), _Usual(1.4, 0.19), 0.5
        ),
        _of_degree("lightness", "colour", _lightness, _Usual(3.57, 0.6), 0.5),
        _of_degree("vividness", "colour", _vividness, _Usual(31.5, 8.9), 0.5),
    )


ASPECTS: Mapping[str, Aspect] = MappingProxyType({it.name: it for it in _aspects()})
"""The aspects that words may describe, by name.

>>> from kille.perception.attributes import ASPECTS
>>> print(*ASPECTS)
colour hue texture pattern shape outline size bigness length flatness roundness
lightness vividness
"""
