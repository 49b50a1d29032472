"""Which part of a text makes the type that it stands for ill-formed."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

from ttr.building.constructors import fun
from ttr.errors import IllFormed
from ttr.notation.syntax_trees import Field, Fields, Part, Term
from ttr.signature.signature import Signature
from ttr.types.paths import replace_paths
from ttr.types.syntax import Object, Path, RecordType, TypeNode

__all__ = ["locate_error", "locate_misfit", "is_ill_formed"]

IsWrong: TypeAlias = Callable[[Object], bool]
"""Whether what stands around a place is ill-formed with this value there."""


def locate_misfit(
    term: Fields, types: Mapping[str, TypeNode], theory: Signature
) -> Part:
    """The first part of a record type whose paths lead nowhere, or to a misfit.

    `types` are the types of its fields.
    """
    around = RecordType(tuple(types.items()))

    def is_wrong(field: Object) -> bool:
        return _is_misfit(field, around, theory)

    for part in term.fields:
        wrong = _locate_in_field(part, types[part.label.text], is_wrong)
        if wrong:
            return wrong
    return term


def locate_error(term: Term, value: Object, is_wrong: IsWrong) -> Part:
    """The smallest part of a term, for this value, that is wrong in its place."""
    if not isinstance(term, Fields) or not isinstance(value, RecordType):
        return term
    for part in term.fields:
        label = part.label.text
        wrong = _locate_in_field(part, value[label], _wrong_alone(label, is_wrong))
        if wrong:
            return wrong
    return term


def _locate_in_field(part: Field, field: TypeNode, is_wrong: IsWrong) -> Part | None:
    """What is wrong in a field, if anything is."""
    if not is_wrong(field):
        return None
    return part if part.value else locate_error(part.type, field, is_wrong)


def _wrong_alone(label: str, is_wrong: IsWrong) -> IsWrong:
    """Whether it is wrong where it is the only field of a record type."""
    return lambda field: is_wrong(RecordType(((label, field),)))


def _is_misfit(field: Object, around: RecordType, theory: Signature) -> bool:
    """Whether a path in a field leads nowhere in the record type, or to a misfit.

    A record type is a scope like that of a function from its records.
    """

    def at(path: Path) -> Path:
        return path if path.up else Path(0, ("r", *path.labels))

    return is_ill_formed(lambda: fun({"r": around}, theory)(replace_paths(field, at)))


def is_ill_formed(build: Callable[[], Object]) -> bool:
    """Whether what would be built is ill-formed."""
    try:
        build()
    except IllFormed:
        return True
    return False
