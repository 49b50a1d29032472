"""Python's own variables for the records and arguments that a type speaks of.

A path such as `this.x` says how many scopes out it starts, so that it means something
else in a record type that a function has put around it. The argument of a Python
function means the same record wherever it stands.
"""

from __future__ import annotations

from collections.abc import Callable
from inspect import isfunction, ismethod
from itertools import count
from typing import TypeGuard

from ttr.errors import IllFormedError
from ttr.types.objects import Object, Path, freeze
from ttr.types.path_notation import PathTo
from ttr.types.paths import replace_paths

_FAR = 1 << 30
"""Further out than any scope: what starts there is not bound on the way."""

_numbers = count()


def is_abstraction(value: object) -> TypeGuard[Callable[[PathTo], object]]:
    """Is it a Python function, which is to be given the scope that it stands in?"""
    return isfunction(value) or ismethod(value)


def apply_to_scope(
    build: Callable[[PathTo], object], start: tuple[str, ...] = ()
) -> Object:
    """What a Python function gives for the scope in which its result will stand.

    Its argument leads to where the labels `start` lead from there.

    >>> from ttr import Ind, Pred, outer, rectype, this
    >>> see = Pred("see", Ind, Ind)
    >>> found = apply_to_scope(lambda r: rectype(y=Ind, e=see(r.x, this.y)))
    >>> found is rectype(y=Ind, e=see(outer.x, this.y))
    True
    """
    mark = f"·{next(_numbers)}"

    def at(path: Path) -> Path:
        first, *rest = path.labels
        if first != mark:
            return path
        if not (start or rest):
            raise IllFormedError(
                "a record type says nothing of its record as a whole: name a label, "
                "as in lambda r: dog(r.x)"
            )
        return Path(0, (*start, *rest))

    return replace_paths(freeze(build(PathTo(_FAR, (mark,)))), at)
