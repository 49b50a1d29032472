"""Lists of numbers: percepts and weights."""

from __future__ import annotations

import math
from collections.abc import Sequence
from operator import mul

from ttr.errors import TTRError
from ttr.semantics.argument_checks import in_notation
from ttr.types.objects import Object
from ttr.types.syntax import Basic

RealVector = Basic("RealVector")
"""The type of lists of numbers, and of arrays with one axis.

>>> from ttr import Ind, rectype
>>> from ttr.semantics.perceptual import RealVector
>>> print(rectype(x=Ind, pos=RealVector))
[pos : RealVector, x : Ind]
"""

Vector = tuple[float, ...]


def vector(value: Object, what: str = "a percept") -> Vector:
    """The numbers of a list or an array; `TTRError` where one is no finite number.

    >>> vector([1, 0.5])
    (1.0, 0.5)
    >>> vector([1, float("nan")], "w")
    Traceback (most recent call last):
    ttr.errors.TTRError: w is a list of finite numbers, found [1, <float nan>]
    """
    numbers = _numbers(value)
    if numbers is None:
        raise TTRError(
            f"{what} is a list of finite numbers, found {in_notation(value)}"
        )
    return numbers


def is_vector(value: Object) -> bool:
    """Is it a list of finite numbers? The witness condition of `RealVector`.

    >>> is_vector((0.9, 0.1)), is_vector("o1")
    (True, False)
    """
    return _numbers(value) is not None


def _numbers(value: Object) -> Vector | None:
    if isinstance(value, str | bytes):
        return None
    try:
        numbers = tuple(map(float, value))
    except (TypeError, ValueError, OverflowError, RuntimeError):
        return None
    return numbers if all(map(math.isfinite, numbers)) else None


def finite_number(value: Object, what: str) -> float:
    """A finite number; `TTRError` where it is none.

    >>> finite_number(1, "t")
    1.0
    """
    found = None if isinstance(value, str) else _numbers((value,))
    if found is None:
        raise TTRError(f"{what} is a finite number, found {in_notation(value)}")
    return found[0]


def dot(v: Sequence[float], w: Sequence[float]) -> float:
    """The inner product v · w of two vectors of one length.

    >>> round(dot((0.8, 0.01), (0.9, 0.1)), 3)
    0.721
    """
    return math.fsum(map(mul, v, w))
