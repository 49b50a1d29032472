"""Building record types, functions and function types, in one form, well-formed."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

from ttr.building.well_formedness import check_binder, check_record_type
from ttr.errors import IllFormedError
from ttr.types.derived_types import order_fields
from ttr.types.objects import BOUND, Object, Path, check_label, combine_labels, freeze
from ttr.types.paths import replace_paths
from ttr.types.syntax import Function, FunType, RecordType, TypeNode, as_type, kind_of

if TYPE_CHECKING:
    from ttr.signature.signature import Signature


def rectype(
    fields: Mapping[str, TypeNode] | None = None,
    theory: Signature | None = None,
    /,
    **labels: TypeNode,
) -> RecordType:
    """The record type with these fields, as keywords or as one mapping.

    Fields are put in the order (depth of dependency, label), so that the order of
    writing never matters; fields on a cycle come last. Raises `IllFormedError` for a
    path that leads nowhere in this record type, or to an object of a wrong type; what
    fits by an axiom fits where the theory is given.

    >>> from ttr import Ind, Pred, this
    >>> dog = Pred("dog", Ind)
    >>> print(rectype(c=dog(this.x), x=Ind))
    [x : Ind, c : dog(x)]
    >>> rectype(c=dog(this.y), x=Ind)
    Traceback (most recent call last):
    ttr.errors.IllFormedError: the path y leads nowhere: [c : dog(.y), x : Ind] has no y
    help: outer.y, written ^.y, is the y one record further out
    """
    given = combine_labels("rectype", fields, labels)
    for label, T in given.items():
        check_label(label)
        if not isinstance(T, TypeNode):
            raise IllFormedError(f"the field {label} needs a type, found {kind_of(T)}")
    return check_record_type(RecordType(order_fields(given)), theory)


# --- functions -----------------------------------------------------------------------


def fun(
    variable: Mapping[str, TypeNode] | None = None,
    theory: Signature | None = None,
    /,
    **named: TypeNode,
) -> Callable[[object], Function]:
    """`fun(x=S)(body)` is the function λx:S. body.

    In the body `this.x` is the variable, and inside a record type there `outer.x`, as
    the function is a scope like a record type. Raises `IllFormedError` for a path that
    leads nowhere, or to an object of a wrong type.

    >>> from ttr import Ind, Pred, outer, this
    >>> run, hug = Pred("run", Ind), Pred("hug", Ind, Ind)
    >>> print(fun(x=Ind)(run(this.x)))
    \\x:Ind. run(x)
    >>> print(fun(x=Ind)(rectype(y=Ind, e=hug(outer.x, this.y))))
    \\x:Ind. [y : Ind, e : hug(x, y)]
    >>> fun(x=Ind)(run(this.x)) is fun(y=Ind)(run(this.y))
    True
    """
    name, domain = _variable("fun", variable, named)

    def of(body: object) -> Function:
        found = Function(domain, _bind_variable(name, freeze(body)), name)
        return check_binder(found, theory)

    return of


def Pi(
    variable: Mapping[str, TypeNode] | None = None,
    theory: Signature | None = None,
    /,
    **named: TypeNode,
) -> Callable[[TypeNode], FunType]:
    """`Pi(x=S)(T)` is the type of functions from each x of S to T, which may mention x.

    >>> from ttr import Ind, Pred, this
    >>> print(Pi(x=Ind)(Pred("run", Ind)(this.x)))
    ((x : Ind) -> run(x))
    """
    name, domain = _variable("Pi", variable, named)

    def of(result: TypeNode) -> FunType:
        found = FunType(domain, _bind_variable(name, as_type(result)), name)
        return check_binder(found, theory)

    return of


def _variable(
    what: str, given: Mapping[str, TypeNode] | None, named: Mapping[str, TypeNode]
) -> tuple[str, TypeNode]:
    """The one variable of a binder, and its type."""
    variables = combine_labels(what, given, named)
    if len(variables) != 1:
        raise IllFormedError(f"{what} takes one variable, as in {what}(x=Ind)(…)")
    ((name, domain),) = variables.items()
    check_label(name)
    return name, as_type(domain)


def _bind_variable(name: str, body: Object) -> Object:
    """The body with its variable as the path `BOUND`, whatever its name."""

    def at(path: Path) -> Object:
        first, *rest = path.labels
        if path.up > 0 or first == BOUND:
            return path
        if first != name:
            raise IllFormedError(
                f"the path {'.'.join(path.labels)} leads nowhere: "
                f"the variable is {name}"
            )
        return Path(0, (BOUND, *rest))

    return replace_paths(body, at)
