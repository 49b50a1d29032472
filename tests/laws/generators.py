"""What the laws are tried on: types that have to do with one another, and their like.

`types`, `objects` and `models` are the public strategies. `record_types` draws from a
part of the theory about which more can be said: there subtyping is decided.
"""

from __future__ import annotations

from contextlib import suppress
from typing import Any

from hypothesis import strategies as st

from ttr import (
    Basic,
    ListOf,
    Model,
    Plus,
    Pred,
    Record,
    RecordType,
    SetOf,
    Str,
    join,
    meet,
    merge,
    record,
    rectype,
)
from ttr.errors import IllFormedError, RefusedError, UnsupportedError
from ttr.testing.strategies import models, objects, types
from ttr.types import FunType, Negation, NonEmpty, Path, PType, TypeNode
from ttr.types.objects import Object
from ttr.types.paths import subterms

__all__ = [
    "NAMES",
    "A",
    "B",
    "chains",
    "has_negations_or_function_types",
    "made_up",
    "models",
    "names",
    "objects",
    "p",
    "ptypes",
    "record_types",
    "records",
    "related",
    "relatives",
    "samples",
    "types",
]

Draw = Any
"""What hypothesis gives a composite strategy to draw with."""

A, B, C = Basic("A"), Basic("B"), Basic("C")
p = Pred("p", (A,), (B,))
q = Pred("q", (A, A), (A, B), (B, A), (B, B))

NAMES = ("a", "b", "s", "t", "x")
"""Objects; x is also a label."""

names = st.sampled_from(NAMES)
basics = st.sampled_from([A, B, meet(A, B)])


@st.composite
def ptypes(draw: Draw, paths: tuple[Path, ...] = ()) -> PType:
    """p or q of names and of these paths."""
    args = st.one_of(names, st.sampled_from(paths)) if paths else names
    if draw(st.booleans()):
        return p(draw(args))
    return q(draw(args), draw(args))


@st.composite
def individuals(
    draw: Draw, labels: list[str], paths: tuple[Path, ...]
) -> dict[str, TypeNode]:
    """Fields for these labels, some of them set to a name or to another field."""
    fields: dict[str, TypeNode] = {}
    for label in labels:
        base = draw(basics)
        kind = draw(st.sampled_from(["plain", "plain", "name", "path"]))
        others = [path for path in paths if path != Path(0, (label,))]
        if kind == "name":
            base = base @ draw(names)
        elif kind == "path" and others:
            base = base @ draw(st.sampled_from(others))
        fields[label] = base
    return fields


@st.composite
def inner_types(draw: Draw, labels: list[str], around: list[str]) -> RecordType:
    """A record type whose paths may lead one record further out."""
    near = [Path(0, (label,)) for label in labels]
    paths = (*near, *(Path(1, (label,)) for label in around))
    fields = draw(individuals(labels, paths))
    if draw(st.booleans()):
        fields["c"] = draw(ptypes(paths))
    return rectype(fields)


@st.composite
def record_types(draw: Draw) -> RecordType:
    """Record types with dependent, manifest and nested fields, some in a circle."""
    labels = draw(st.lists(st.sampled_from("xyz"), unique=True))
    inner = draw(st.lists(st.sampled_from("xy"), unique=True))
    mine = [Path(0, (label,)) for label in labels]
    paths = (*mine, *(Path(0, ("n", label)) for label in inner))
    fields = draw(individuals(labels, paths))
    for label in draw(st.lists(st.sampled_from("cd"), unique=True)):
        fields[label] = meet(*draw(st.lists(ptypes(paths), min_size=1, max_size=2)))
    if inner:
        fields["n"] = draw(inner_types(inner, labels))
    return rectype(fields)


def well_formed(fields: dict[str, TypeNode]) -> RecordType:
    """The fields as a record type, without the last ones if paths lead nowhere."""
    try:
        return rectype(fields)
    except IllFormedError:
        return well_formed(dict(list(fields.items())[:-1]))


@st.composite
def relatives(draw: Draw, T: RecordType) -> RecordType:
    """A type that has much in common with T: some of its fields, some of another."""
    kept = {label: field for label, field in T.fields if draw(st.integers(0, 3))}
    other = draw(record_types()).fields
    mixed = {label: field for label, field in other if not draw(st.integers(0, 3))}
    return well_formed({**kept, **mixed})


@st.composite
def related(draw: Draw) -> tuple[RecordType, RecordType]:
    """Two record types that have much in common."""
    S = draw(record_types())
    return S, draw(relatives(S))


WITHIN = (
    lambda T: T,
    ListOf,
    NonEmpty,
    SetOf,
    Plus,
    lambda T: Str(T, C),
    lambda T: Str(Plus(T), C),
    lambda T: Str() | Plus(Str(C, T)),
    lambda T: rectype(x=T),
    lambda T: rectype(n=rectype(x=T), y=A),
    lambda T: T | C,
    lambda T: T & C,
    lambda T: A >> T,
)
"""Types with another one in them; one is below another if what is in it is."""


@st.composite
def chains(draw: Draw) -> list[TypeNode]:
    """Three types, mostly each below the one before, or much like it."""
    found = [draw(types())]
    for other in draw(st.lists(types(), min_size=2, max_size=2)):
        last = found[-1]
        below = [meet(last, other), merge(last, other), last & other @ "a"]
        above = [join(last, other), other]
        found.append(draw(st.sampled_from([*below, *above])))
    within = draw(st.sampled_from(WITHIN))
    return [within(T) for T in found]


@st.composite
def records(draw: Draw) -> Record:
    """Records with the labels that the types above use."""
    inner = st.fixed_dictionaries({"x": names, "y": names}, optional={"c": names})
    fields = st.fixed_dictionaries(
        {"x": names, "y": names, "z": names, "n": inner},
        optional={"c": names, "d": names, "l": st.lists(names, max_size=2)},
    )
    return record(draw(fields))


@st.composite
def samples(draw: Draw) -> Object:
    """Objects of many forms."""
    return draw(st.one_of(records(), objects(depth=2), st.just(()), names))


def made_up(T: TypeNode, M: Model) -> tuple[Object, Model] | None:
    """A witness made up for T, and the model in which it is; None where there is none.

    Where none is found beside the facts of the model, it is made up without them.
    """
    for model in (M, Model()):
        with suppress(RefusedError, UnsupportedError):
            return model.create(T)
    return None


def has_negations_or_function_types(*types: TypeNode) -> bool:
    """Whether what the contract says of transitivity does not go so far."""
    return any(isinstance(part, Negation | FunType) for part in subterms(types))
