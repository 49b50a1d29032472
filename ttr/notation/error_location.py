"""Find the part of a text that makes its type ill-formed, to underline it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

from ttr.building.constructors import Pi
from ttr.errors import IllFormedError
from ttr.notation.syntax_trees import Field, Fields, Part, Term
from ttr.signature.signature import Signature
from ttr.types.objects import Object, Path
from ttr.types.paths import replace_paths
from ttr.types.syntax import RecordType, TypeNode

_IsWrong: TypeAlias = Callable[[Object], bool]
"""Is what surrounds a place ill-formed with this value in that place?"""


def locate_misfit(
    term: Fields, types: Mapping[str, TypeNode], theory: Signature
) -> Part:
    """The first field with a path that leads nowhere, or to a value of a wrong type.

    `types` are the types of the fields.
    """
    around = RecordType(tuple(types.items()))

    def is_wrong(field: Object) -> bool:
        return _is_misfit(field, around, theory)

    for part in term.fields:
        wrong = _locate_in_field(part, types[part.label.text], is_wrong)
        if wrong:
            return wrong
    return term


def locate_error(term: Term, value: Object, is_wrong: _IsWrong) -> Part:
    """The smallest part that is wrong of a term that stands for this value."""
    if not isinstance(term, Fields) or not isinstance(value, RecordType):
        return term
    for part in term.fields:
        label = part.label.text
        wrong = _locate_in_field(part, value[label], _wrong_alone(label, is_wrong))
        if wrong:
            return wrong
    return term


def _locate_in_field(part: Field, field: TypeNode, is_wrong: _IsWrong) -> Part | None:
    """The part that is wrong in a field; None if nothing is."""
    if not is_wrong(field):
        return None
    return part if part.value else locate_error(part.type, field, is_wrong)


def _wrong_alone(label: str, is_wrong: _IsWrong) -> _IsWrong:
    """Is a field wrong if it is the only one of a record type?"""
    return lambda field: is_wrong(RecordType(((label, field),)))


def _is_misfit(field: Object, around: RecordType, theory: Signature) -> bool:
    """Does a path in a field lead nowhere in the record type, or to a wrong type?

    To find out, the field is made the result of a function type from the record type,
    which is a scope of the same kind.
    """

    def at(path: Path) -> Path:
        return path if path.up else Path(0, ("r", *path.labels))

    return is_ill_formed(lambda: Pi({"r": around}, theory)(replace_paths(field, at)))


def is_ill_formed(build: Callable[[], Object]) -> bool:
    """Does `build` raise `IllFormedError`?"""
    try:
        build()
    except IllFormedError:
        return True
    return False
