"""The meanings that a spatial word may have: families of graded spatial templates.

A template gives each configuration a degree, the applicability of the word. Those of
directions follow the attention vector sum of Regier and Carlson 2001,

    sigmoid(2 k (c - c0) + s tanh((c - c0) / w) - a gap), made 1 in the middle,

c the cosine of how far the target is off the direction, the mean of that on the table
and that against the viewer's ray. With s = 0 the degree is a slope in the angle alone.
With s > 0 there is a step at the border too: people hold places to be good, acceptable
or bad for a word, and what parts acceptable from bad is a line (Logan and Sadler 1996).
Those of distance are sigmoid(k (b - log d)), less where other things are nearer or
between. Those of function are sigmoid(k (f - b)) of contact, support and containment.

Each family is a grid of such templates with a prior over them. Which of them a word
means is told by its examples alone (see `kille.perception.relations.memory`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from kille.perception.relations.measures import Array, ConfigurationMeasures

_FUZZ = 0.1  # sizes: nearer to the vertical than this no direction is told on the table
_TOUCHING = -0.3  # the logarithm of the distance, in sizes, of things that touch
_STEEPEST = 30.0  # beyond this a sigmoid is 0 or 1


@dataclass(frozen=True, eq=False)
class Family:
    """Templates of one kind: their prior (h,), and their degrees at n configurations.

    `degrees` is (n, h) in [0, 1], NaN where what it depends on is unknown.
    """

    name: str
    prior: NDArray[np.float64]
    degrees: Callable[[ConfigurationMeasures], Array]


@dataclass(frozen=True)
class Axis:
    """The values of one parameter, with a prior."""

    values: Array
    prior: NDArray[np.float64]


def _axis(values: ArrayLike, mean: float, deviation: float) -> Axis:
    """Values with a Gaussian prior."""
    them = np.asarray(values, np.float32)
    density = np.exp(-0.5 * ((them - mean) / deviation) ** 2).astype(np.float64)
    return Axis(them, density / density.sum())


def _grid(*axes: Axis) -> tuple[list[Array], NDArray[np.float64]]:
    """Every combination of the axes' values, each (h,), and their prior (h,)."""
    values = np.meshgrid(*[axis.values for axis in axes], indexing="ij")
    priors = np.meshgrid(*[axis.prior for axis in axes], indexing="ij")
    return [it.ravel() for it in values], np.prod(priors, axis=0).ravel()


def _sigmoid(x: NDArray[np.floating]) -> Array:
    degrees = 1 / (1 + np.exp(-np.clip(x, -_STEEPEST, _STEEPEST)))
    return np.asarray(degrees, np.float32)


# The means (k 4, c0 .55, a .1; near: k 1.5, b 1) were found by prototypes, on people's
# judgements of blocks: on these no figure is held out. The widths let a word be twice
# as sharp or four times as vague, and its border be 30 degrees elsewhere.
SHARPNESS = _axis([1, 2, 4, 8], 4, 3)
BORDER = _axis([-0.05, 0.1, 0.25, 0.4, 0.55, 0.7, 0.85, 0.95], 0.55, 0.3)
FADING = _axis([0, 0.1, 0.4], 0.1, 0.15)
STEEPNESS = _axis([0.8, 1.5, 3, 6], 1.5, 1.5)
REACH = _axis([-0.5, 0, 0.5, 1, 1.5, 2, 2.5], 1, 0.7)
CROWDED = _axis([0, 0.75, 1.5], 0, 1)
PARTED = _axis([0, 0.7, 1.5], 0, 1)

# The edges of cones: k and s. A sharp edge is a step already: only the vague have one.
EDGES = np.array([[1, 0], [2, 0], [4, 0], [8, 0], [1, 1.5], [2, 1.5]], np.float32)
_EDGE = Axis(np.arange(len(EDGES), dtype=np.float32), _axis(EDGES[:, 0], 4, 3).prior)
_STEP = 0.1  # w: within 6 degrees of the border


def _cone_grid() -> tuple[list[Array], NDArray[np.float64]]:
    """k, s, c0 and a of every cone around a direction, each (h,), and their prior."""
    (edge, c0, a), prior = _grid(_EDGE, BORDER, FADING)
    k, s = EDGES[edge.astype(int)].T
    return [k, s, c0, a], prior


def _cones(
    cosines: Callable[[ConfigurationMeasures], Array],
) -> Callable[[ConfigurationMeasures], Array]:
    """Templates around each of m directions, from their cosines (n, m).

    Each is made so high that it is 1 in the middle of its cone.
    """
    (k, s, c0, a), _ = _cone_grid()

    def inside(c: ArrayLike) -> Array:
        beyond = np.asarray(c, np.float32) - c0
        return np.asarray(2 * k * beyond + s * np.tanh(beyond / _STEP), np.float32)

    highest = _sigmoid(inside(1.0))

    def degrees(of: ConfigurationMeasures) -> Array:
        c = cosines(of)
        off = inside(c[:, :, None]) - a * of.gap[:, None, None]
        return (_sigmoid(off) / highest).reshape(len(c), -1)

    return degrees


def _cone_prior(of_directions: ArrayLike, share: float) -> NDArray[np.float64]:
    weights = np.asarray(of_directions, np.float64)
    _, prior = _cone_grid()
    return share * np.outer(weights / weights.sum(), prior).ravel()


def _levels(of: ConfigurationMeasures) -> tuple[Array, Array]:
    """How much of a direction is seen on the table, (n,), without and with regard to
    height.
    """
    told = of.across / np.sqrt(of.across**2 + _FUZZ**2)
    steep = of.across / np.sqrt(of.across**2 + of.rise**2 + _FUZZ**2)
    return told, steep


def _both_levels(cosines: Array, of: ConfigurationMeasures) -> Array:
    """The cosines (n, m) with and without regard to height, (n, 2 m)."""
    told, steep = _levels(of)
    return np.concatenate([cosines * told[:, None], cosines * steep[:, None]], axis=1)


def _viewers(of: ConfigurationMeasures, directions: Array) -> Array:
    """The mean cosine on the table and against the viewer's ray, (n, m)."""
    on_table = np.cos(of.bearing[:, None] - directions)
    against_ray = np.cos((of.bearing - of.turn)[:, None] - directions)
    cosines: Array = 0.5 * (on_table + against_ray)
    return cosines


def _viewer_family(share: float) -> Family:
    """Directions as the viewer sees them: left, behind, and 22 others."""
    directions = np.radians(np.arange(0, 360, 15)).astype(np.float32)
    weights = [20 if i % 6 == 0 else 2 if i % 3 == 0 else 1 for i in range(24)]

    def cosines(of: ConfigurationMeasures) -> Array:
        return _both_levels(_viewers(of, directions), of)

    return Family("viewed", _cone_prior(weights * 2, share), _cones(cosines))


def _heading_family(share: float) -> Family:
    """Directions from a landmark that has a front of its own."""
    directions = np.radians(np.arange(0, 360, 45)).astype(np.float32)
    weights = [4, 1] * 4

    def cosines(of: ConfigurationMeasures) -> Array:
        return _both_levels(np.cos((of.bearing - of.heading)[:, None] - directions), of)

    return Family("headed", _cone_prior(weights * 2, share), _cones(cosines))


def _flanking_family(share: float) -> Family:
    """Either of two opposite sides."""
    directions = np.radians([0.0, 90.0]).astype(np.float32)

    def cosines(of: ConfigurationMeasures) -> Array:
        return _both_levels(np.abs(_viewers(of, directions)), of)

    return Family("flanking", _cone_prior([1] * 4, share), _cones(cosines))


def _vertical_family(share: float) -> Family:
    """Above or below, within a wide or a narrow cone."""

    def cosines(of: ConfigurationMeasures) -> Array:
        wide = of.rise / np.sqrt(of.across**2 + of.rise**2 + _FUZZ**2)
        narrow = of.rise / np.sqrt(4 * of.across**2 + of.rise**2 + _FUZZ**2)
        return np.stack([wide, narrow, -wide, -narrow], axis=1)

    return Family("vertical", _cone_prior([1] * 4, share), _cones(cosines))


def _near_family(share: float) -> Family:
    """Near, relative to the sizes of the two and to the other things.

    Each is made so high that it is 1 where the two touch.
    """
    (k, b, e, f), prior = _grid(STEEPNESS, REACH, CROWDED, PARTED)
    highest = _sigmoid(k * (b - _TOUCHING))

    def degrees(of: ConfigurationMeasures) -> Array:
        off = (
            k * (b - of.apart[:, None])
            - e * of.crowding[:, None]
            - f * of.between[:, None]
        )
        near: Array = np.minimum(_sigmoid(off) / highest, 1)
        return near

    return Family("near", share * prior, degrees)


def _beside_family(share: float) -> Family:
    """Near and on the same level."""
    (k, b), prior = _grid(STEEPNESS, REACH)
    highest = _sigmoid(k * (b - _TOUCHING))

    def degrees(of: ConfigurationMeasures) -> Array:
        _, steep = _levels(of)
        level = _sigmoid(8 * (steep - 0.7))
        near = np.minimum(_sigmoid(k * (b - of.apart[:, None])) / highest, 1)
        both: Array = level[:, None] * near
        return both

    return Family("beside", share * prior, degrees)


def _far_family(share: float) -> Family:
    """Far away."""
    (k, b), prior = _grid(STEEPNESS, REACH)

    def degrees(of: ConfigurationMeasures) -> Array:
        return _sigmoid(k * (of.apart[:, None] - b))

    return Family("far", share * prior, degrees)


def _between_family(share: float) -> Family:
    """On the line from the landmark to another thing."""
    (k, c0), prior = _grid(SHARPNESS, BORDER)

    def degrees(of: ConfigurationMeasures) -> Array:
        return _sigmoid(2 * k * (of.flanked[:, None] - c0))

    return Family("between", share * prior, degrees)


def _functional_family(share: float) -> Family:
    """Held in some way: touched, supported, or contained."""
    (k, b), prior = _grid(
        _axis([6, 12], 8, 6), _axis([0.05, 0.2, 0.4, 0.6, 0.8], 0.4, 0.3)
    )

    def degrees(of: ConfigurationMeasures) -> Array:
        contact, support, containment = of.contact, of.support, of.containment
        held = np.stack(
            [
                contact,
                support,
                containment,
                np.maximum(support, containment),
                np.maximum(contact, support),
                contact * (1 - support),
                contact * (1 - np.maximum(support, containment)),
                support * (1 - containment),
            ],
            axis=1,
        )
        off = k * (held[:, :, None] - b)
        return _sigmoid(off).reshape(len(held), -1)

    return Family("functional", share * np.tile(prior / 8, 8), degrees)


def families() -> Iterator[Family]:
    """All families; the priors of all their templates sum to 1."""
    yield _viewer_family(0.4)
    yield _heading_family(0.06)
    yield _flanking_family(0.03)
    yield _vertical_family(0.14)
    yield _near_family(0.1)
    yield _beside_family(0.03)
    yield _far_family(0.07)
    yield _between_family(0.02)
    yield _functional_family(0.15)
