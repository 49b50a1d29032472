"""Where the notation needs brackets: one rule for printing and display.

From the loosest to the tightest: the dot of a function, arrow, join, meet, sum,
negation, `@`, application. An arrow always stands in brackets of its own.
"""

from __future__ import annotations

from ttr.types.objects import Object, Operation, Path
from ttr.types.paths import free_paths
from ttr.types.syntax import (
    Application,
    Basic,
    Function,
    FunType,
    Join,
    Meet,
    Merge,
    Negation,
    Singleton,
)


def is_loose(value: Object) -> bool:
    r"""Does it need brackets as a part of a meet, join or negation, or as a result?

    >>> from ttr import Ind
    >>> A = Basic("A")
    >>> is_loose(Ind & A), is_loose(~Ind)
    (True, False)
    >>> print(A & (Ind | A), ~Ind & A)
    A /\ (A \/ Ind) A /\ ~Ind
    """
    loose = isinstance(value, Meet | Join | Singleton | Function)
    return loose and not isinstance(value, Merge)


def is_loose_beside(value: Object) -> bool:
    """Does it need brackets beside `@` or `+`, before an arrow, or as an event?

    >>> from ttr import Ind, ListOf
    >>> is_loose_beside(~Ind), is_loose_beside(ListOf(Ind))
    (True, False)
    >>> print(~Ind @ "a", ListOf(Ind) @ "l")
    (~Ind)@a list(Ind)@l
    """
    match value:
        case Negation() | Operation("+", _):
            return True
    return is_loose(value)


def holds_as_head(function: Object) -> bool:
    """Can it be applied without brackets? A path, a name or an application can.

    A basic type here is the name of a function, as in an abbreviated display.

    >>> from ttr import Ind, fun
    >>> [holds_as_head(f) for f in (Path(0, ("f",)), "f", fun(x=Ind)("a"))]
    [True, True, False]
    """
    return isinstance(function, Path | str | Basic | Application)


def begins_with_bracket(event: Object) -> bool:
    """Does an event begin with `(`? It would read as an argument of the one before.

    >>> from ttr import Ind, Type, fun, this
    >>> begins_with_bracket(Ind >> Type), begins_with_bracket(fun(x=Ind)(this.x))
    (True, True)
    >>> begins_with_bracket(Application(fun(x=Ind)(this.x), "a"))
    True
    >>> begins_with_bracket(Application("f", "a"))
    False
    """
    match event:
        case FunType():
            return True
        case Application(function, _):
            return not holds_as_head(function) or begins_with_bracket(function)
    return is_loose_beside(event)


def binds(inside: Object) -> bool:
    """Does the inside of a binder mention its variable, which then needs a name?

    >>> from ttr import Ind, Pred, this
    >>> dog = Pred("dog", Ind)
    >>> binds(dog(this.x)), binds(dog("fido"))
    (True, False)
    """
    return any(path.up == 0 for path in free_paths(inside))
