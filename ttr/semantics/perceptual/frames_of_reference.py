"""Where things are relative to one another: coordinates in a frame of reference.

A frame is a record {origin, axes = {right, front}} of points and directions on a plane.
What is to the right of a tree depends on whose right it is: the tree's own, that of the
map, or that of somebody who looks at it.

Sources: Levinson 2003 on the three frames; Dobnik, Cooper and Larsson 2013 on
predicates over two regions in a frame; Logan and Sadler 1996 on spatial templates.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from ttr.building.constructors import rectype
from ttr.errors import TTRError, UnsupportedError
from ttr.semantics.argument_checks import in_notation
from ttr.semantics.perceptual.individuation import PointMap
from ttr.semantics.perceptual.vectors import (
    RealVector,
    Vector,
    dot,
    finite_number,
    vector,
)
from ttr.types.objects import Object, Record, record
from ttr.types.syntax import RecordType

Frame: RecordType = rectype(
    origin=RealVector, axes=rectype(right=RealVector, front=RealVector)
)
"""The type of frames of reference.

>>> from ttr.semantics.perceptual import Frame, absolute
>>> print(Frame)
[axes : [front : RealVector, right : RealVector], origin : RealVector]
>>> sorted(absolute([2, 3])) == sorted(Frame)
True
"""


def absolute(ground: Object) -> Record:
    """The frame of the map with its origin at the ground: right is x, front is y.

    >>> print(absolute([2, 3]))  # doctest: +NORMALIZE_WHITESPACE
    {axes = {front = [0.0, 1.0], right = [1.0, 0.0]}, origin = [2.0, 3.0]}
    """
    return _frame(_place(ground, "the ground"), (0.0, 1.0))


def intrinsic(ground: Object, facing: Object) -> Record:
    """The frame of the ground itself, by where it faces: its own front and right.

    >>> print(intrinsic([0, 0], facing=[0, -1]).axes)
    {front = [0.0, -1.0], right = [-1.0, 0.0]}
    """
    return _frame(_place(ground, "the ground"), _direction(facing, "facing"))


def relative(ground: Object, viewer: Object) -> Record:
    """The frame of a viewer: the front of the ground is towards them, right is theirs.

    So front and back are those of someone who faces the viewer, while left and right
    are the viewer's own, as in English.

    >>> print(relative([0, 0], viewer=[0, -5]).axes)
    {front = [0.0, -1.0], right = [1.0, 0.0]}
    """
    place, eye = _place(ground, "the ground"), _place(viewer, "the viewer")
    x, y = _direction([eye[0] - place[0], eye[1] - place[1]], "the way to the viewer")
    axes = record(right=(0.0 - y, x), front=(x, y))
    return record(origin=place, axes=axes)


def coordinates(thing: Object, frame: Record) -> Vector:
    """The coordinates of a thing: how far to the right, and how far to the front.

    The thing is a point, or a point map, which counts as its centre. Law: what is right
    of a ground for a viewer is left of it for a viewer opposite.

    >>> coordinates([1, 0], relative([0, 0], viewer=[0, -5]))
    (1.0, 0.0)
    >>> coordinates([1, 0], relative([0, 0], viewer=[0, 5]))
    (-1.0, 0.0)
    """
    try:
        origin, axes = frame.origin, (frame.axes.right, frame.axes.front)
    except AttributeError:
        raise TTRError(
            f"a frame is a record {{origin, axes = {{right, front}}}}, "
            f"found {in_notation(frame)}"
        ) from None
    x, y = _place(thing, "the thing")
    ox, oy = _place(origin, "the origin")
    right, front = (_place(axis, "an axis") for axis in axes)
    apart = (x - ox, y - oy)
    return dot(apart, right), dot(apart, front)


@dataclass(frozen=True)
class Projective:
    """A spatial template of an axis: max(0, cos θ) to the power of `sharpness`.

    θ is the angle between `params.axis` and the percept, coordinates in a frame. So the
    degree is 1 along the axis, and 0 from 90° on. A template does not learn; a
    perceptron over the same coordinates does.

    >>> template = Projective()
    >>> template.degree(record(axis=[1, 0]), (2.0, 0.0))
    1.0
    >>> round(template.degree(record(axis=[1, 0]), (1.0, 1.0)), 3)
    0.707
    """

    sharpness: float = 1.0

    def __post_init__(self) -> None:
        if not finite_number(self.sharpness, "the sharpness of a template") > 0.0:
            raise TTRError(
                f"the sharpness of a template is above 0, found {self.sharpness!r}"
            )

    def __str__(self) -> str:
        return "a spatial template"

    def degree(self, params: Record, x: Object, /) -> float:
        """The power of the cosine; 0 at the origin, which is in no direction."""
        if not isinstance(params, Record) or "axis" not in params:
            raise TTRError(
                f"a spatial template has {{axis = […]}}, found {in_notation(params)}"
            )
        axis, place = vector(params.axis, "axis"), vector(x)
        if len(axis) != len(place):
            raise TTRError(
                f"the axis has {len(axis)} numbers, but the percept {len(place)}"
            )
        lengths = math.hypot(*axis) * math.hypot(*place)
        if lengths == 0.0:
            return 0.0
        cosine = min(1.0, max(0.0, dot(axis, place) / lengths))
        return math.pow(cosine, self.sharpness)

    def confirmed(self, _: Record, x: Object, /) -> Record:
        """Raise `UnsupportedError`: a template does not learn."""
        raise UnsupportedError(
            f"a spatial template does not learn, as from {in_notation(x)}"
        )

    rejected = confirmed


def _frame(origin: Vector, front: Vector) -> Record:
    """The frame with this front; its right is a quarter turn clockwise from there."""
    x, y = front
    return record(origin=origin, axes=record(right=(y, 0.0 - x), front=front))


def _place(value: Object, what: str) -> Vector:
    """A point of the plane, or the centre of a point map."""
    if isinstance(value, PointMap):
        value = value.centre
    found = vector(value, what)
    if len(found) != 2:
        raise TTRError(f"{what} is a point of a plane, found {list(found)}")
    return found


def _direction(value: Object, what: str) -> Vector:
    x, y = _place(value, what)
    length = math.hypot(x, y)
    if length == 0.0:
        raise TTRError(f"{what} leads nowhere: its length is 0")
    return x / length, y / length
