"""Addresses: where a field stands in a record type, as the labels that lead to it.

A path says how many scopes out it starts; an address starts at the outermost record
type. What moves fields about rewrites a path as an address and back.
"""

from __future__ import annotations

from typing import TypeAlias

from ttr.errors import IllFormedError
from ttr.types.objects import Path, check_label

Address: TypeAlias = tuple[str, ...]
"""The labels from the outermost record type to a field, or to a record type in it."""


def parse_address(path: object, what: str) -> Address:
    """The labels of a path written with dots; `what` is the function that was given it.

    >>> parse_address("bg.x", "subtract")
    ('bg', 'x')
    """
    if not isinstance(path, str):
        raise IllFormedError(
            f"{what} takes a path as a text, as in 'bg.x', found {type(path).__name__}"
        )
    labels = tuple(path.split("."))
    for label in labels:
        check_label(label)
    return labels


def format_address(labels: Address) -> str:
    """The address as a path with dots."""
    return ".".join(labels)


def to_absolute(path: Path, scope: Address) -> Path:
    """A path that starts in the record type at an address, as one from the outermost.

    >>> to_absolute(Path(0, ("x",)), ("bg",)), to_absolute(Path(1, ("y",)), ("bg",))
    (this.bg.x, this.y)
    """
    if path.up > len(scope):
        return Path(path.up - len(scope), path.labels)
    return Path(0, scope[: len(scope) - path.up] + path.labels)


def to_relative(path: Path, scope: Address) -> Path:
    """A path that starts in the outermost record type, as the shortest from an address.

    >>> to_relative(Path(0, ("bg", "x")), ("bg",))
    this.x
    >>> to_relative(Path(0, ("y",)), ("bg",))
    outer.y
    """
    if path.up > 0:
        return Path(path.up + len(scope), path.labels)
    shared = 0
    for mine, wanted in zip(scope, path.labels[:-1], strict=False):
        if mine != wanted:
            break
        shared += 1
    return Path(len(scope) - shared, path.labels[shared:])
