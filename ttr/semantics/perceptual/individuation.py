r"""From points to individuals: point maps, regions in them, and the things there.

A detector finds regions in a point map. They are records {reg, pfun, p}: the points,
the property of the thing there, and its probability. Then an individual is assumed for
each. Source: Dobnik, Cooper and Larsson 2013.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import product
from typing import NamedTuple

from ttr.building.constructors import fun, rectype
from ttr.errors import TTRError
from ttr.judging.models import Model, as_model
from ttr.semantics.argument_checks import as_tuple
from ttr.semantics.perceptual.meanings import Meaning, as_meaning
from ttr.semantics.perceptual.vectors import Vector, finite_number, vector
from ttr.types.objects import BOUND, Path, Record, record
from ttr.types.path_notation import outer, this
from ttr.types.substitution import resolve_paths
from ttr.types.syntax import Basic, Function, Ind, PType, RecordType, Type

Points = Basic("PointMap")
"""The type of point maps.

>>> from ttr import Model
>>> from ttr.semantics.perceptual import PointMap, Points
>>> cloud = PointMap([[0, 1], [1, 0]])
>>> print(Model().given(cloud, Points).judge(cloud, Points))
<PointMap 2> : PointMap   p = 1
"""

Region = rectype(reg=Points, pfun=Ind >> Type)
"""The type of what a detector finds: points, and a property of the thing there.

>>> from ttr.semantics.perceptual import Region
>>> print(Region)
[pfun : (Ind -> Type), reg : PointMap]
"""

INDIVIDUATE = fun(r=Region)(
    rectype(a=Ind, loc=Points @ outer.r.reg, c=outer.r.pfun(this.a))
)
r"""λr:Region. [a : Ind, loc = r.reg : PointMap, c : r.pfun(a)]

>>> from ttr import Model, Pred, fun, Ind, record, this
>>> from ttr.semantics.perceptual import INDIVIDUATE, PointMap, Points
>>> dog, cloud = fun(x=Ind)(Pred("dog", Ind)(this.x)), PointMap([[0, 1]])
>>> M = Model().given(cloud, Points)
>>> print(M.apply(INDIVIDUATE, record(reg=cloud, pfun=dog)))
[a : Ind, loc = <PointMap 1> : PointMap, c : (\x:Ind. dog(x))(a)]
"""


@dataclass(frozen=True)
class PointMap:
    """Points with equally many numbers each. It prints as the number of points.

    >>> cloud = PointMap([[0, 1], [2, 3]])
    >>> cloud.centre, cloud.size
    ((1.0, 2.0), (2.0, 2.0))
    """

    points: tuple[Vector, ...]

    def __init__(self, points: Iterable[object]) -> None:
        try:
            listed = tuple(points)
        except TypeError:
            listed = (points,)
        found = tuple([vector(point, "a point") for point in listed])
        if not found or len({len(point) for point in found}) > 1:
            raise TTRError(
                "a point map has one point or more, all with as many numbers, found "
                + (", ".join(sorted({str(len(p)) for p in found})) or "no points")
            )
        object.__setattr__(self, "points", found)

    def __len__(self) -> int:
        return len(self.points)

    @property
    def centre(self) -> Vector:
        """The mean of the points."""
        return tuple(
            [math.fsum(axis) / len(axis) for axis in zip(*self.points, strict=True)]
        )

    @property
    def size(self) -> Vector:
        """The extent of the points along each axis."""
        return tuple([max(axis) - min(axis) for axis in zip(*self.points, strict=True)])


def clusters(points: PointMap | Iterable[object], reach: float) -> tuple[PointMap, ...]:
    """Single-linkage clusters: points joined by steps shorter than `reach`.

    They are in the order of their first points. Neighbours are sought in a grid.

    >>> [len(it) for it in clusters([[0, 0], [5, 5], [0, 1]], 2)]
    [2, 1]
    """
    if not finite_number(reach, "the reach") > 0.0:
        raise TTRError(f"the reach of a step is above 0, found {reach!r}")
    points = points if isinstance(points, PointMap) else PointMap(points)
    cells: dict[_Cell, list[int]] = {}
    for i, point in enumerate(points.points):
        cells.setdefault(_cell(point, reach), []).append(i)
    found: list[PointMap] = []
    taken: set[int] = set()
    for i in range(len(points)):
        if i in taken:
            continue
        region = _reachable_points(points.points, i, cells, reach)
        taken.update(region)
        found.append(PointMap([points.points[j] for j in sorted(region)]))
    return tuple(found)


_FEW_DIMENSIONS = 3
"""Up to how many dimensions all 3ⁿ cells around one are visited."""

_Cell = tuple[int, ...]
"""A cube of the grid, by its number along each axis."""


def _cell(point: Vector, reach: float) -> _Cell:
    try:
        return tuple([math.floor(x / reach) for x in point])
    except OverflowError:
        raise TTRError(
            f"the reach {reach:g} is too small for a point like {list(point)}"
        ) from None


def _reachable_points(
    points: tuple[Vector, ...], start: int, cells: dict[_Cell, list[int]], reach: float
) -> list[int]:
    """The points that steps lead to from one; they are taken out of their cells."""
    region = [start]
    cells[_cell(points[start], reach)].remove(start)
    for i in region:
        for cell in _neighbours(_cell(points[i], reach), cells):
            inside = cells.get(cell)
            if inside:
                apart = [math.dist(points[i], points[j]) for j in inside]
                pairs = list(zip(inside, apart, strict=True))
                region += [j for j, step in pairs if step < reach]
                cells[cell] = [j for j, step in pairs if not step < reach]
    return region


def _neighbours(cell: _Cell, cells: Iterable[_Cell]) -> Iterator[_Cell]:
    """The cells next to one, and itself.

    In many dimensions only cells with points are tried, as 3ⁿ soon is more than these.
    """
    if len(cell) > _FEW_DIMENSIONS:
        yield from [
            one
            for one in cells
            if all(abs(x - y) <= 1 for x, y in zip(one, cell, strict=True))
        ]
        return
    for step in product((-1, 0, 1), repeat=len(cell)):
        yield tuple([c + s for c, s in zip(cell, step, strict=True)])


# --- what is in the regions ----------------------------------------------------------


def detections(regions: Iterable[PointMap], *words: Meaning) -> tuple[Record, ...]:
    r"""The regions in which something is detected, as records {reg, pfun, p}.

    The words are meanings that classify `reg`. A region gets the predicate of the word
    with the highest degree, the first of equals, if that degree is at least a half.

    >>> from ttr import Pred, record
    >>> from ttr.semantics.perceptual import GradedPerceptron, meaning
    >>> bg = rectype(a=Ind, reg=Points)
    >>> tall = meaning(
    ...     fun(r=bg)(rectype(c=Pred("tall", Ind)(outer.r.a))),
    ...     GradedPerceptron(),
    ...     record(w=[0, 1], t=1),
    ...     of="reg",
    ...     through=lambda region: region.size,
    ... )
    >>> tower, plate = PointMap([[0, 0], [0, 2]]), PointMap([[0, 0], [2, 0]])
    >>> [len(it.reg) for it in detections([tower, plate], tall)]
    [2]
    """
    found: list[Record] = []
    meanings = [as_meaning(word) for word in words]
    for reg in as_tuple(regions, "regions"):
        best, p = None, 0.5
        for word in meanings:
            degree = word.degree(record(reg=reg)).lo
            if degree > p or (best is None and degree == p):
                best, p = word, degree
        if best is not None:
            found.append(record(reg=reg, pfun=fun(x=Ind)(best.predicate(this.x)), p=p))
    return tuple(found)


class Individual(NamedTuple):
    """An individual assumed in a region: a record of a type, and the model with it.

    >>> from ttr import Pred
    >>> dog = fun(x=Ind)(Pred("dog", Ind)(this.x))
    >>> sit, T, M = individuate(Model(), record(reg=PointMap([[0, 1]]), pfun=dog, p=1))
    >>> M.judge(sit, T).holds
    True
    """

    sit: Record
    type: RecordType
    model: Model


def individuate(M: Model, region: Record) -> Individual:
    r"""A new individual for a region {reg, pfun, p}, by `INDIVIDUATE`.

    It certainly exists; that it has the property is as probable as p of the region, or
    certain where there is no p. Raises `RefusedError` for what is no region.

    >>> from ttr import Pred
    >>> seen = record(reg=PointMap([[0, 1], [1, 0]]), pfun=fun(x=Ind)(
    ...     Pred("dog", Ind)(this.x)), p=0.8)
    >>> found = individuate(Model(), seen)
    >>> print(found.sit)
    {a = a1, c = s2, loc = <PointMap 2>}
    >>> print(found.type)
    [a : Ind, loc = <PointMap 2> : PointMap, c : dog(a)]
    >>> print(found.model.judge(found.sit, found.type).p)
    0.8
    """
    seeing = as_model(M).witnessed(Points, by=lambda value: isinstance(value, PointMap))
    T = seeing.apply(INDIVIDUATE, region)
    sit, after = seeing.create(T)
    claim = after.reduce(region.pfun(sit.a))
    if "p" in region and isinstance(claim, PType):
        after = after.given(sit.c, claim, region.p)
    return Individual(sit, _with_claim_applied(T, region.pfun), after)


def _with_claim_applied(T: RecordType, pfun: Function) -> RecordType:
    """The type of the individual, with p(a) for (λx:Ind. p(x))(a)."""
    if not isinstance(pfun.body, PType):
        return T
    claim = resolve_paths(pfun.body, ({BOUND: Path(0, ("a",))},))
    return rectype({**dict(T.fields), "c": claim})
