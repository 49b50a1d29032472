"""Small types, records and models over few names, so that clashes happen."""

from __future__ import annotations

from typing import Any

from hypothesis import strategies as st

from ttr import (
    Basic,
    IllFormed,
    ListOf,
    Model,
    Path,
    Pred,
    PType,
    Record,
    RecordType,
    RecType,
    Type,
    TypeNode,
    meet,
    merge,
    record,
    rectype,
)
from ttr.syntax import Object

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


@st.composite
def listing_types(draw: Draw) -> RecordType:
    """Record types that also have fields for lists and for types."""
    fields = dict(draw(record_types()).fields)
    fields["l"] = ListOf(draw(st.one_of(basics, record_types())))
    if draw(st.booleans()):
        fields["m"] = RecType @ draw(record_types())
    if draw(st.booleans()):
        fields["k"] = ListOf(Type) @ draw(st.lists(ptypes(), max_size=2))
    return rectype(fields)


@st.composite
def types(draw: Draw) -> TypeNode:
    """Types of every constructor of this version."""
    plain = st.one_of(basics, ptypes(), st.just(C), st.just(Type), st.just(RecType))
    records = st.one_of(record_types(), listing_types())
    match draw(st.sampled_from(["record", "plain", "singleton", "list", "meet"])):
        case "plain":
            return draw(plain)
        case "singleton":
            return draw(plain) @ draw(names)
        case "list":
            return ListOf(draw(st.one_of(plain, records)))
        case "meet":
            return meet(draw(st.one_of(plain, records)), draw(records))
    return draw(records)


def well_formed(fields: dict[str, TypeNode]) -> RecordType:
    """The fields as a record type, without the last ones if paths lead nowhere."""
    try:
        return rectype(fields)
    except IllFormed:
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


@st.composite
def chains(draw: Draw) -> list[TypeNode]:
    """Three types, mostly each a meet or a merge of the one before with another."""
    found = [draw(types())]
    for other in draw(st.lists(types(), min_size=2, max_size=2)):
        last = found[-1]
        ways = [other, meet(last, other), merge(last, other), last & other @ "a"]
        found.append(draw(st.sampled_from(ways)))
    return found


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
def models(draw: Draw) -> Model:
    """Closed models of the names, with random facts."""
    M = Model()
    for name in NAMES:
        for T in (A, B):
            M = M.given(name, T, draw(st.sampled_from([1.0, 1.0, 1.0, 0.0])))
    for sit, T in draw(st.lists(st.tuples(names, ptypes()), max_size=8)):
        M = M.given(sit, T)
    return M


@st.composite
def inhabited(draw: Draw, T: TypeNode) -> tuple[Model, Object]:
    """A model with random facts and a witness of T made up in it."""
    witness, M = draw(models()).create(T)
    return M, witness
