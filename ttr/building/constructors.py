"""Building record types, functions and function types, in one form, well-formed."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, TypeAlias

from ttr.building.scope_variables import apply_to_scope, is_abstraction
from ttr.building.well_formedness import check_binder, check_record_type
from ttr.errors import IllFormedError
from ttr.types.derived_types import order_fields
from ttr.types.objects import BOUND, Object, Path, check_label, combine_labels, freeze
from ttr.types.paths import replace_paths
from ttr.types.syntax import Function, FunType, RecordType, TypeNode, as_type, kind_of

if TYPE_CHECKING:
    from ttr.signature.signature import Signature

Field: TypeAlias = TypeNode | Callable[[Any], object]
"""The type of a field, or a Python function of the record that gives it."""


def rectype(
    fields: Mapping[str, Field] | None = None,
    theory: Signature | None = None,
    /,
    **labels: Field,
) -> RecordType:
    """The record type with these fields, as keywords or as one mapping.

    A field may also be a Python function of the record, `c=lambda r: dog(r.x)`. What it
    builds may nest record types at will: `r.x` is always the x of this one, while
    `this.x` is that of the innermost. So it is the way to compose meanings in Python.

    Fields are put in the order (depth of dependency, label), so that the order of
    writing never matters; fields on a cycle come last. Raises `IllFormedError` for a
    path that leads nowhere in this record type, or to an object of a wrong type; what
    fits by an axiom fits where the theory is given.

    >>> from ttr import Ind, Pred, this
    >>> dog = Pred("dog", Ind)
    >>> print(rectype(c=dog(this.x), x=Ind))
    [x : Ind, c : dog(x)]
    >>> chase = Pred("chase", Ind, Ind)
    >>> some = lambda P, Q: rectype(x=Ind, r=lambda r: P(r.x), s=lambda r: Q(r.x))
    >>> cat = Pred("cat", Ind)
    >>> print(some(dog, lambda x: some(cat, lambda y: chase(x, y))))
    [x : Ind, r : dog(x), s : [x : Ind, r : cat(x), s : chase(^.x, x)]]
    >>> rectype(c=dog(this.y), x=Ind)
    Traceback (most recent call last):
    ttr.errors.IllFormedError: the path y leads nowhere: [c : dog(.y), x : Ind] has no y
    help: outer.y, written ^.y, is the y one record further out
    """
    given = combine_labels("rectype", fields, labels)
    found: dict[str, TypeNode] = {}
    for label, field in given.items():
        check_label(label)
        T = apply_to_scope(field) if is_abstraction(field) else field
        try:
            found[label] = as_type(T)
        except IllFormedError:
            found_kind = kind_of(T)
            raise IllFormedError(
                f"the field {label} needs a type, found {found_kind}"
            ) from None
    return check_record_type(RecordType(order_fields(found)), theory)


# --- functions -----------------------------------------------------------------------


def fun(
    variable: Mapping[str, TypeNode] | None = None,
    theory: Signature | None = None,
    /,
    **named: TypeNode,
) -> Callable[[object], Function]:
    """`fun(x=S)(body)` is the function λx:S. body.

    The body may be a Python function of the variable, `fun(x=S)(lambda x: run(x))`,
    which is the way to compose meanings in Python. In a body that is written with
    paths `this.x` is the variable, and inside a record type there `outer.x`, as
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
    >>> fun(x=Ind)(lambda x: run(x)) is fun(x=Ind)(run(this.x))
    True
    """
    name, domain = _variable("fun", variable, named)

    def of(body: object) -> Function:
        return check_binder(Function(domain, _inside(name, body)), theory, name)

    return of


def Pi(
    variable: Mapping[str, TypeNode] | None = None,
    theory: Signature | None = None,
    /,
    **named: TypeNode,
) -> Callable[[Field], FunType]:
    """`Pi(x=S)(T)` is the type of functions from each x of S to T, which may mention x.

    >>> from ttr import Ind, Pred, this
    >>> print(Pi(x=Ind)(Pred("run", Ind)(this.x)))
    ((x : Ind) -> run(x))
    """
    name, domain = _variable("Pi", variable, named)

    def of(result: Field) -> FunType:
        inside = as_type(_inside(name, result))
        return check_binder(FunType(domain, inside), theory, name)

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


def _inside(name: str, body: object) -> Object:
    """What stands inside a binder, written with paths or as a Python function."""
    if is_abstraction(body):
        return apply_to_scope(body, (BOUND,))
    return _bind_variable(name, freeze(body))


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
