"""Functions with a narrower domain, and the type at which a function is fixed."""

from __future__ import annotations

from typing import cast

from ttr.building.merging import merge
from ttr.building.well_formedness import check_binder, check_record_type
from ttr.errors import IllFormedError
from ttr.safety.budgets import within_budget
from ttr.signature.signature import Signature
from ttr.types.derived_types import order_fields
from ttr.types.objects import BOUND, Path
from ttr.types.paths import replace_paths
from ttr.types.printing import variable
from ttr.types.syntax import Function, RecordType, TypeNode, as_type, kind_of


@within_budget
def restrict(f: Function, S: TypeNode, /, theory: Signature | None = None) -> Function:
    r"""λv:merge(T, S). body: the function f = λv:T. body, only for what is also of S.

    Raises `IllFormedError` for what is no function, and where the domain is ill-formed
    then.

    >>> from ttr import Ind, Pred, fun, rectype, this
    >>> man, run = Pred("man", Ind), Pred("run", Ind)
    >>> f = fun(r=rectype(x=Ind))(run(this["r.x"]))
    >>> print(restrict(f, rectype(x=Ind, c=man(this.x))))
    \r:[x : Ind, c : man(x)]. run(r.x)
    """
    if not isinstance(f, Function):
        raise IllFormedError(f"restrict takes a function, found {kind_of(f)}")
    domain = merge(f.domain, as_type(S), theory)
    return check_binder(Function(domain, f.body), theory)


@within_budget
def fix(f: Function, /, theory: Signature | None = None) -> RecordType:
    r"""The fixed-point type of f = λr:S. T, for record types S and T.

    It is S merged with T, in which the paths from r are paths from the record itself:
    a record s is of it iff s : S and s : f(s). Raises `IllFormedError` where f is no
    such function, and where it says something of r as a whole. Source: Cooper 2023.

    >>> from ttr import Ind, Pred, fun, outer, rectype
    >>> run = Pred("run", Ind)
    >>> f = fun(r=rectype(x=Ind))(rectype(c=run(outer.r.x)))
    >>> print(f)
    \r:[x : Ind]. [c : run(r.x)]
    >>> print(fix(f))
    [x : Ind, c : run(x)]
    """
    match f:
        case Function(RecordType() as domain, RecordType() as body):
            inside = _replace_variable(body, variable(f, ()))
        case _:
            raise IllFormedError(
                "fix takes a function from a record type to a record type, as in "
                f"\\r:[x : Ind]. [c : run(r.x)], found {kind_of(f)}"
            )
    merged = cast(RecordType, merge(domain, inside, theory))
    return check_record_type(merged, theory)


def _replace_variable(body: RecordType, name: str) -> RecordType:
    """The body with paths from the variable as paths from the record itself.

    So it has one scope instead of two.
    """

    def at(path: Path) -> Path:
        if path.up == 0:
            return path
        if path.up > 1 or path.labels[0] != BOUND:
            return Path(path.up - 1, path.labels)
        if len(path.labels) == 1:
            raise IllFormedError(
                f"there is no fixed-point type: something is said of {name} as a whole"
            )
        return Path(0, path.labels[1:])

    return RecordType(order_fields({k: replace_paths(T, at) for k, T in body.fields}))
