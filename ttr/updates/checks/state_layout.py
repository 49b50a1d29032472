"""The layout of states: which labels there are at a path, by all that is known of it.

What is known of the value at a path are its *views*: types that it is of, and objects
that it may be. A label is missing if no view has it and none allows any label.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import TypeAlias

from ttr.types.objects import Object, Record
from ttr.types.syntax import Join, Meet, RecordType, Singleton, TypeNode


@dataclass(frozen=True, eq=False)
class Term:
    """An object as it is written: a value, or a path that begins with a variable."""

    value: Object


View: TypeAlias = TypeNode | Term
"""A type that a value is of, or an object that it may be."""

Views: TypeAlias = tuple[View, ...]
"""All that is known of the value at a path."""

Labels: TypeAlias = tuple[str, ...]
"""A path, label by label."""

_NOWHERE: Mapping[Labels, Views] = {}


@dataclass(frozen=True)
class Missing:
    """That a path leads nowhere: its part up to the label that is missing, and the
    labels that there are instead."""

    path: Labels
    known: Labels

    @property
    def label(self) -> str:
        """The label that is missing."""
        return self.path[-1]

    @property
    def place(self) -> str:
        """The path that lacks the label; empty for the state itself."""
        return ".".join(self.path[:-1])


def _views_below(view: View, label: str) -> Views:
    """The views of a label, by one view of the record that has it."""
    match view:
        case RecordType():
            found = view.get(label)
            return () if found is None else (found,)
        case Singleton(base, value):
            return (*_views_below(base, label), *_views_below(Term(value), label))
        case Meet(parts) | Join(parts):
            return tuple(one for part in parts for one in _views_below(part, label))
        case Term(Record() as r):
            return (Term(r[label]),) if label in r else ()
    return ()


def _declared_labels(view: View) -> Labels | None:
    """The labels that a value is declared to have; None if it may have any.

    A record type is taken to name all labels that there are, if it names any.
    """
    match view:
        case RecordType(fields):
            return view.labels if fields else None
        case Singleton(base, _):
            return _declared_labels(base)
        case Meet(parts) | Join(parts):
            return _union_of_labels(map(_declared_labels, parts))
    return None


def _union_of_labels(several: Iterable[Labels | None]) -> Labels | None:
    """The labels in any of several; None if one of them may have any label."""
    joined: dict[str, None] = {}
    for labels in several:
        if labels is None:
            return None
        joined |= dict.fromkeys(labels)
    return tuple(joined)


def descend(
    views: Views, path: Labels, placed: Mapping[Labels, Views] = _NOWHERE
) -> Views | Missing:
    """The views at a path, or what is missing; no views if the path cannot be followed.

    `placed` are more views, by their paths. A label is only missing if a type of the
    record is known and all its types are closed.
    """
    for i, label in enumerate(path, 1):
        further = tuple(one for view in views for one in _views_below(view, label))
        if not further:
            return _missing_label(views, path[:i])
        views = further + placed.get(path[:i], ())
    return views


def _missing_label(views: Views, path: Labels) -> Views | Missing:
    types = [view for view in views if isinstance(view, TypeNode)]
    closed = _union_of_labels(map(_declared_labels, types))
    return Missing(path, closed) if types and closed is not None else ()


def views_along(view: View, path: Labels) -> Views:
    """What one view says of the value at a path."""
    views: Views = (view,)
    for label in path:
        views = tuple(one for view in views for one in _views_below(view, label))
    return views


def overlap(path: Labels, other: Labels) -> bool:
    """Does one of two paths lead to where the other does, or into that?

    >>> overlap(("bg",), ("bg", "x")), overlap(("bg", "y"), ("bg", "x"))
    (True, False)
    """
    return path[: len(other)] == other[: len(path)]


def leaf_fields(T: TypeNode, at: Labels = ()) -> Iterator[tuple[Labels, TypeNode]]:
    """The paths and types of the innermost fields of a record type."""
    match T:
        case RecordType(fields) if fields:
            for label, field in fields:
                yield from leaf_fields(field, (*at, label))
        case _:
            yield at, T
