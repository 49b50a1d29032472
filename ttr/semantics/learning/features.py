"""Features of a situation's type: which of some feature types it is below."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ttr.building.merging import merge_meet
from ttr.computing.subtyping import consistent, subtype
from ttr.errors import IllFormedError, RefusedError
from ttr.safety.budgets import within_budget
from ttr.signature.signature import Signature
from ttr.types.paths import free_paths, labels_mentioned
from ttr.types.syntax import Meet, RecordType, TypeNode, as_type, kind_of

Features = tuple[bool, ...]
"""For each feature type: is the type of the situation below it?"""


@within_budget
def feature_types(T: TypeNode, /) -> tuple[TypeNode, ...]:
    """The feature types of a record type: each field with those that it depends on.

    A field with a meet gives a feature for each part. A type that is no record type is
    itself a feature.

    >>> from ttr import Ind, Pred, rectype, this
    >>> red, big = Pred("red", Ind), Pred("big", Ind)
    >>> print(*feature_types(rectype(x=Ind, c=red(this.x), s=big(this.x))), sep="; ")
    [x : Ind]; [x : Ind, c : red(x)]; [x : Ind, s : big(x)]
    """
    whole = merge_meet(as_type(T))
    if not isinstance(whole, RecordType):
        return (whole,)
    return tuple(dict.fromkeys(_types_by_field(whole)))


def _types_by_field(T: RecordType) -> Iterator[TypeNode]:
    for label, field in T.fields:
        needed = _labels_needed(T, label)
        others = {one: f for one, f in T.fields if one in needed and one != label}
        for part in field.parts if isinstance(field, Meet) else (field,):
            fields = {**others, label: part}
            yield RecordType(tuple((one, fields[one]) for one in T if one in fields))


def _labels_needed(T: RecordType, label: str) -> set[str]:
    """The labels of the fields that a field depends on, and its own."""
    needed, waiting = {label}, [label]
    while waiting:
        field = T[waiting.pop()]
        found = labels_mentioned(field) - needed
        needed |= found
        waiting += found
    return needed


def types_of(values: Iterable[TypeNode], what: str) -> tuple[TypeNode, ...]:
    """The types of a list; `IllFormedError` for what is no list of types."""
    if isinstance(values, tuple | list):
        return tuple(map(as_type, values))
    raise IllFormedError(f"expected a list of types as {what}, found {kind_of(values)}")


def features_of(types: Iterable[TypeNode]) -> tuple[TypeNode, ...]:
    """Types as the features of a classifier; `IllFormedError` for a type given
    twice.
    """
    found = types_of(types, "features")
    twice = next((T for T in found if found.count(T) > 1), None)
    if twice is not None:
        raise IllFormedError(f"the feature {twice} is given twice")
    return found


@within_budget
def features_below(
    x: TypeNode, features: tuple[TypeNode, ...], theory: Signature | None = None
) -> Features:
    """For each feature: is x below it?

    Raises `RefusedError` where nothing can be of x, as x would then be below all
    features.

    >>> from ttr import Basic
    >>> A, B = Basic("A"), Basic("B")
    >>> features_below(A, (A | B, B))
    (True, False)
    """
    x = as_type(x)
    if free_paths(x):
        raise IllFormedError(f"{x} has paths that lead nowhere, so it is no evidence")
    if consistent(x, theory=theory).no:
        raise RefusedError(f"nothing can be of {x}, so it is no evidence")
    return tuple(subtype(x, feature, theory).yes for feature in features)
