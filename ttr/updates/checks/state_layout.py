"""Layouts: which labels there are below a place, by all that is known of it.

What is known of a place are its *views*: types that it is of, and objects that it may
be. A label is missing if none of them has it, and nothing speaks for more labels.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import TypeAlias

from ttr.types.syntax import (
    Join,
    Meet,
    Object,
    Record,
    RecordType,
    Singleton,
    TypeNode,
)

__all__ = [
    "Labels",
    "Missing",
    "Term",
    "View",
    "Views",
    "along",
    "below",
    "closed_labels",
    "descend",
    "leaves",
]


@dataclass(frozen=True, eq=False)
class Term:
    """An object as it is written: a value, or a path that begins with a variable."""

    value: Object


View: TypeAlias = TypeNode | Term
"""A type that a place is of, or an object that it may be."""

Views: TypeAlias = tuple[View, ...]
"""All that is known of a place."""

Labels: TypeAlias = tuple[str, ...]
"""A path, label by label."""

_NOWHERE: Mapping[Labels, Views] = {}


@dataclass(frozen=True)
class Missing:
    """That a path leads nowhere: how far it goes, and what could be written there."""

    path: Labels
    known: Labels

    @property
    def label(self) -> str:
        """The first label that is not there."""
        return self.path[-1]

    @property
    def place(self) -> str:
        """The place that lacks the label, or the empty string at the top."""
        return ".".join(self.path[:-1])


def below(view: View, label: str) -> Views:
    """What is known of a label of something of which this is known."""
    match view:
        case RecordType():
            found = view.get(label)
            return () if found is None else (found,)
        case Singleton(base, value):
            return (*below(base, label), *below(Term(value), label))
        case Meet(parts) | Join(parts):
            return tuple(one for part in parts for one in below(part, label))
        case Term(Record() as r):
            return (Term(r[label]),) if label in r else ()
    return ()


def closed_labels(view: View) -> Labels | None:
    """The labels that something is declared to have; None where it may have any.

    A record type is taken to say which labels there are, if it names any at all.
    """
    match view:
        case RecordType(fields):
            return view.labels if fields else None
        case Singleton(base, _):
            return closed_labels(base)
        case Meet(parts) | Join(parts):
            return _joined(map(closed_labels, parts))
    return None


def _joined(several: Iterable[Labels | None]) -> Labels | None:
    """The labels in any of several; None where one of these may have any label."""
    joined: dict[str, None] = {}
    for labels in several:
        if labels is None:
            return None
        joined |= dict.fromkeys(labels)
    return tuple(joined)


def descend(
    views: Views, path: Labels, placed: Mapping[Labels, Views] = _NOWHERE
) -> Views | Missing:
    """What is known of where a path leads; nothing where that cannot be followed.

    `placed` are more views of places that there are. Only a place of which a type is
    known, and closed types only, lacks a label.
    """
    for i, label in enumerate(path, 1):
        further = tuple(one for view in views for one in below(view, label))
        if not further:
            return _missing(views, path[:i])
        views = further + placed.get(path[:i], ())
    return views


def _missing(views: Views, path: Labels) -> Views | Missing:
    types = [view for view in views if isinstance(view, TypeNode)]
    closed = _joined(map(closed_labels, types))
    return Missing(path, closed) if types and closed is not None else ()


def along(view: View, path: Labels) -> Views:
    """What one view says of where a path leads."""
    views: Views = (view,)
    for label in path:
        views = tuple(one for view in views for one in below(view, label))
    return views


def leaves(T: TypeNode, at: Labels = ()) -> Iterator[tuple[Labels, TypeNode]]:
    """The fields of a record type that are of no record type with fields, by path."""
    match T:
        case RecordType(fields) if fields:
            for label, field in fields:
                yield from leaves(field, (*at, label))
        case _:
            yield at, T
