r"""Interpretations λr:bg. [c : p(r.x)]: the type that a word gives a situation."""

from __future__ import annotations

from ttr.building.constructors import fun
from ttr.building.well_formedness import check_record_type
from ttr.errors import IllFormedError
from ttr.semantics.argument_checks import in_notation
from ttr.types.derived_types import order_fields
from ttr.types.objects import BOUND, Path
from ttr.types.paths import replace_paths
from ttr.types.syntax import Function, PType, RecordType, kind_of


def claim_of(interp: object) -> tuple[str, PType]:
    """The label and the ptype in an interpretation; `IllFormedError` for what is
    none.
    """
    match interp:
        case Function(RecordType(), RecordType(((label, PType() as claim),))):
            return label, claim
    raise IllFormedError(
        "an interpretation takes situations to a record type with one ptype, as in "
        f"\\r:[x : Ind]. [c : cup(r.x)], found {interp}"
    )


def interpretation(T: RecordType, label: str) -> Function:
    r"""The λr:bg. [ℓ : p(…)] whose fixed-point type is T, which has ℓ : p(…).

    Law: fix(interpretation(T, ℓ)) is T. Raises `IllFormedError` where T has no ptype
    there.

    >>> from ttr import Ind, Pred, rectype, this
    >>> print(interpretation(rectype(x=Ind, c=Pred("cup", Ind)(this.x)), "c"))
    \r:[x : Ind]. [c : cup(r.x)]
    """
    is_there = isinstance(T, RecordType) and isinstance(label, str)
    claim = T.get(label) if is_there else None
    if not isinstance(claim, PType):
        found = T if isinstance(T, RecordType) else kind_of(T)
        raise IllFormedError(
            "an interpretation is of a record type with a ptype at "
            f"{in_notation(label)}, found {found}"
        )
    bg = check_record_type(
        RecordType(order_fields({k: S for k, S in T.fields if k != label})), None
    )
    return fun(r=bg)(RecordType(((label, replace_paths(claim, _path_into_situation)),)))


def _path_into_situation(path: Path) -> Path:
    """A path into the record as a path into the variable, one scope further out."""
    if path.up == 0:
        return Path(1, (BOUND, *path.labels))
    return Path(path.up + 1, path.labels)
