"""Places in an arbitrary witness: paths from the witness itself, further in.

A place leads through records, to the events of a string, and to an arbitrary element of
a list or set. Seen from outside a record or a binder, its paths are places.
"""

from __future__ import annotations

from ttr.types.paths import replace_paths
from ttr.types.syntax import EventString, FiniteSet, Object, Path, Record, TypeNode

__all__ = [
    "EACH",
    "ITSELF",
    "element",
    "elements",
    "event",
    "within",
    "instantiated",
    "step",
    "unpacked",
]

ITSELF = Path(0, ("·",))
"""The place of the witness itself; its name is no label."""

EACH = "*"
"""The step from a list or set to an arbitrary element of it; it is no label."""


def step(place: Path, label: str) -> Path:
    """The place one label further in."""
    return Path(place.up, (*place.labels, label))


def element(place: Path) -> Path:
    """The place of an arbitrary element of the list or set at a place."""
    return step(place, EACH)


def event(place: Path, number: int) -> Path:
    """The place of an event of the string at a place; they are counted from 0."""
    return step(place, str(number))


def elements(term: Object) -> tuple[Object, ...] | None:
    """What is in a list, a set or a string that is written out; else None."""
    if isinstance(term, FiniteSet | EventString):
        return term.items
    return term if isinstance(term, tuple) else None


def unpacked(field: TypeNode, whole: Path | Record) -> TypeNode:
    """The type of a field of a record as seen from outside the record.

    `whole` is the record, or the place where it stands.

    >>> from ttr.types.syntax import Ind, Pred, this
    >>> print(unpacked(Pred("dog", Ind)(this.x), Record({"x": "fido"})))
    dog(fido)
    """

    def outside(path: Path) -> Object:
        if path.up > 0:
            return Path(path.up - 1, path.labels)
        return within(whole, path.labels)

    found: TypeNode = replace_paths(field, outside)
    return found


def instantiated(body: Object, term: Object) -> Object:
    """The body of a binder, as seen from outside, with a term for its variable.

    >>> from ttr.building.constructors import fun
    >>> from ttr.types.syntax import Ind, Pred, this
    >>> print(instantiated(fun(x=Ind)(Pred("run", Ind)(this.x)).body, "fido"))
    run(fido)
    """

    def outside(path: Path) -> Object:
        if path.up > 0:
            return Path(path.up - 1, path.labels)
        return within(term, path.labels[1:])

    return replace_paths(body, outside)


def within(value: Object, labels: tuple[str, ...]) -> Object:
    """Where the labels lead in an object or from a place.

    A path that leads nowhere becomes one that starts nowhere: it equals nothing else.
    """
    for done, label in enumerate(labels):
        if isinstance(value, Path):
            return Path(value.up, value.labels + labels[done:])
        if isinstance(value, EventString) and _is_event(value, label):
            value = value.items[int(label)]
            continue
        if not isinstance(value, Record) or label not in value:
            return Path(0, ("", *labels))
        value = value[label]
    return value


def _is_event(string: EventString, label: str) -> bool:
    """Whether a label, which may be a number, is that of an event of the string."""
    return label.isdigit() and int(label) < len(string)
