"""Kept redexes: applications that are left in a normal form, and why.

The argument is not known to be in the domain of the function, and not known to be
outside it.
"""

from __future__ import annotations

from collections.abc import Iterator

from ttr.safety.budgets import spend
from ttr.types.objects import Object
from ttr.types.paths import map_parts, mentions, subterms
from ttr.types.printing import Scope, labels_of, notation, variable
from ttr.types.syntax import Application, Function, FunType, RecordType


def kept_redexes(value: Object) -> Iterator[Application]:
    """The applications of written functions that are left in a normal form."""
    for part in subterms([value]):
        match part:
            case Application(Function(), _):
                yield part


def open_presupposition(*values: Object, text: Scope = ()) -> str:
    """What is not known, so that a redex is kept in one of the normal forms; or "".

    It is written as in the text, if there is one.

    >>> from ttr import Ind, Pred, Rec, fun, outer, rectype, this
    >>> Man = fun(y=Ind)(rectype(e=Pred("man", Ind)(outer.y)))
    >>> open_presupposition(rectype(x=Rec, r=Application(Man, this.x))).split(",")[0]
    'it is not known that x is of Ind'
    """
    for value in values:
        if next(kept_redexes(value), None) is not None:
            for kept, scope in _with_scopes(value, text):
                return _format_presupposition(kept, scope)
    return ""


def _format_presupposition(kept: Application, scope: Scope) -> str:
    assert isinstance(kept.function, Function)
    argument, domain = kept.argument, kept.function.domain
    return (
        f"it is not known that {notation(argument, scope)} is of "
        f"{notation(domain, scope)}, in {notation(kept, scope)}"
    )


def _with_scopes(value: Object, scope: Scope) -> Iterator[tuple[Application, Scope]]:
    """The kept redexes, the outermost first, with the names that stand around them."""
    spend()
    if not mentions(value, Application):
        return
    parts: list[tuple[Object, Scope]] = []

    def collect(part: Object, _: int) -> Object:
        parts.append((part, scope))
        return part

    match value:
        case Application(Function(), _):
            yield value, scope
        case RecordType(fields):
            inner = (labels_of(value), *scope)
            parts = [(field, inner) for _, field in fields]
        case Function(domain, inside) | FunType(domain, inside):
            parts = [(domain, scope), (inside, (variable(value, scope), *scope))]
        case _:
            map_parts(value, collect)
    for part, within in parts:
        yield from _with_scopes(part, within)
