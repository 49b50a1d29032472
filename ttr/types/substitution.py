"""Putting objects in the place of paths."""

from __future__ import annotations

from collections.abc import Mapping

from ttr.types.objects import BOUND, Object, Path, Record, Unresolved
from ttr.types.paths import replace_paths

__all__ = ["Around", "along", "grounded"]

Around = tuple[Mapping[str, Object], ...]
"""What the scopes around say: labels of records, the variable of a binder; innermost
first."""


def along(value: Object, labels: tuple[str, ...]) -> Object:
    """r.ℓ₁.….ℓₙ; raises `Unresolved` where a step is missing.

    >>> from ttr.types.syntax import record
    >>> along(record(bg=record(x="fido")), ("bg", "x"))
    'fido'
    """
    for label in labels:
        if not isinstance(value, Record) or label not in value:
            lacks = "there is no" if isinstance(value, Record) else "no record has"
            path = ".".join(labels)
            raise Unresolved(f"the path {path} leads nowhere: {lacks} {label}")
        value = value._fields[label]
    return value


def grounded(value: Object, around: Around) -> Object:
    """A field's type or object with its paths replaced by what they lead to.

    Raises `Unresolved` for a path that leads nowhere.

    >>> from ttr.types.syntax import Ind, Pred, this
    >>> print(grounded(Pred("dog", Ind)(this.x), ({"x": "fido"},)))
    dog(fido)
    """

    def at(path: Path) -> Object:
        name = ".".join(label for label in path.labels if label != BOUND)
        if path.up >= len(around):
            raise Unresolved(f"the path {name} leads out of every record")
        first, *rest = path.labels
        if first not in around[path.up]:
            raise Unresolved(f"the path {name} leads nowhere: there is no {first}")
        return along(around[path.up][first], tuple(rest))

    return replace_paths(value, at)
