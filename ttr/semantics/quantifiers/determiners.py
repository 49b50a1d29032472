"""The quantifiers: predicates of two properties, and what each demands of a count.

`every(P, Q)` is a ptype. P and Q are properties: functions from individuals to types,
functions from records with an x, as in `\\r:[x : Ind]. [e : dog(r.x)]`, types, or
predicates of one individual.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from typing import TypeGuard

from ttr.building.constructors import fun, rectype
from ttr.errors import IllFormedError
from ttr.semantics.quantifiers.thresholds import Threshold, Thresholds, number, share
from ttr.types.objects import Object
from ttr.types.path_notation import this
from ttr.types.syntax import Basic, Function, Ind, Pred, PType, Type, TypeNode, kind_of

Property = Function | TypeNode
"""What can be true of things: a function to types, or a type that they are of."""

Number = Basic("Number")
"""The type of the number in `at_least(3, P, Q)`."""

KINDS: tuple[TypeNode, ...] = (Ind >> Type, rectype(x=Ind) >> Type, Type)
_PLAIN = tuple(product(KINDS, KINDS))
_COUNTED = tuple((Number, *arity) for arity in _PLAIN)


@dataclass(frozen=True)
class Determiner:
    """A quantifier: applied to two properties it is the type of what makes it true.

    >>> dog, bark = Pred("dog", Ind), Pred("bark", Ind)
    >>> print(every(dog, bark))
    every(\\x:Ind. dog(x), \\x:Ind. bark(x))
    >>> print(at_least(2)(dog, bark))
    at_least(2, \\x:Ind. dog(x), \\x:Ind. bark(x))
    """

    name: str
    amount: int | None = None

    @property
    def pred(self) -> Pred:
        """The predicate of its ptypes."""
        return Pred(self.name, *(_PLAIN if self.amount is None else _COUNTED))

    def __call__(self, P: object, Q: object, /) -> PType:
        """q(P, Q): the type of the situations in which so many of P are Q."""
        properties = (as_property(P), as_property(Q))
        if self.amount is None:
            return self.pred(*properties)
        return self.pred(self.amount, *properties)

    def __str__(self) -> str:
        words = {"exist": "some", "exist_pl": "two or more"}
        name = words.get(self.name, self.name.replace("_", " "))
        return name if self.amount is None else f"{name} {self.amount}"


exist = Determiner("exist")
""""a", "some": at least one.

>>> from ttr.semantics.quantifiers import Extension, exist, quantify
>>> dogs, barkers = Extension.of(["fido", "rex"]), Extension.of(["rex"])
>>> quantify(exist, dogs, barkers).holds
True
"""
exist_pl = Determiner("exist_pl")
"""Plural "some": at least two.

>>> from ttr.semantics.quantifiers import Extension, exist_pl, quantify
>>> dogs, barkers = Extension.of(["fido", "rex"]), Extension.of(["rex"])
>>> quantify(exist_pl, dogs, barkers).holds
False
"""
every = Determiner("every")
""""every", "all": none of them is missing.

>>> from ttr.semantics.quantifiers import Extension, every, quantify
>>> dogs, barkers = Extension.of(["fido", "rex"]), Extension.of(["rex"])
>>> quantify(every, dogs, barkers).holds
False
"""
no = Determiner("no")
""""no": none.

>>> from ttr.semantics.quantifiers import Extension, no, quantify
>>> dogs, barkers = Extension.of(["fido", "rex"]), Extension.of(["kim"])
>>> quantify(no, dogs, barkers).holds
True
"""
not_every = Determiner("not_every")
""""not every": one at least is missing.

>>> from ttr.semantics.quantifiers import Extension, not_every, quantify
>>> dogs, barkers = Extension.of(["fido", "rex"]), Extension.of(["rex"])
>>> quantify(not_every, dogs, barkers).holds
True
"""
most = Determiner("most")
""""most": more than the share that `Thresholds.most` says, by default a half.

>>> from ttr.semantics.quantifiers import Extension, most, quantify
>>> dogs = Extension.of(["fido", "rex", "sam"])
>>> quantify(most, dogs, Extension.of(["fido", "rex"])).holds
True
"""
many = Determiner("many")
""""many": so many as `Thresholds.many` says, by default a third.

>>> from ttr.semantics.quantifiers import Extension, Thresholds, many, quantify, share
>>> dogs, barkers = Extension.of(["fido", "rex", "sam"]), Extension.of(["fido"])
>>> half = Thresholds(many=share("at least", 0.5))
>>> quantify(many, dogs, barkers).holds, quantify(many, dogs, barkers, half).holds
(True, False)
"""
few = Determiner("few")
""""few": fewer than the share that `Thresholds.few` says, by default a third.

>>> from ttr.semantics.quantifiers import Extension, few, quantify
>>> dogs = Extension.of(["fido", "rex", "sam", "kim"])
>>> quantify(few, dogs, Extension.of(["fido"])).holds
True
"""
several = Determiner("several")
""""several": so many as `Thresholds.several` says, by default two.

>>> from ttr.semantics.quantifiers import Extension, quantify, several
>>> dogs, barkers = Extension.of(["fido", "rex", "sam"]), Extension.of(["fido", "sam"])
>>> quantify(several, dogs, barkers).holds
True
"""


def at_least(n: int) -> Determiner:
    """The quantifier "at least n".

    >>> from ttr.semantics.quantifiers import Extension, quantify
    >>> dogs = Extension.of(["fido", "rex", "sam"])
    >>> quantify(at_least(2), dogs, Extension.of(["fido", "sam"])).holds
    True
    """
    return _determiner_with_number("at_least", n)


def at_most(n: int) -> Determiner:
    """The quantifier "at most n".

    >>> from ttr.semantics.quantifiers import Extension, quantify
    >>> dogs = Extension.of(["fido", "rex", "sam"])
    >>> quantify(at_most(1), dogs, Extension.of(["fido", "sam"])).holds
    False
    """
    return _determiner_with_number("at_most", n)


def exactly(n: int) -> Determiner:
    """The quantifier "exactly n", which neither rises nor falls.

    >>> from ttr.semantics.quantifiers import Extension, quantify
    >>> dogs = Extension.of(["fido", "rex", "sam"])
    >>> quantify(exactly(2), dogs, Extension.of(["fido", "sam"])).holds
    True
    """
    return _determiner_with_number("exactly", n)


def _determiner_with_number(name: str, n: int) -> Determiner:
    number("at least", n)
    return Determiner(name, n)


_DEMANDS: dict[str, tuple[Threshold, ...]] = {
    "exist": (number("at least", 1),),
    "exist_pl": (number("at least", 2),),
    "every": (share("at least", 1),),
    "no": (number("at most", 0),),
    "not_every": (share("fewer than", 1),),
}

DETERMINERS = (exist, exist_pl, every, no, not_every, most, many, few, several)
"""The quantifiers without a number.

>>> from ttr.semantics.quantifiers import DETERMINERS
>>> print(*DETERMINERS)
some two or more every no not every most many few several
"""

_BY_PRED = {one.pred: one for one in DETERMINERS}
_BY_NUMBER = {one(0).pred: one(0).name for one in (at_least, at_most, exactly)}


def threshold_of(T: PType, thresholds: Thresholds) -> tuple[Threshold, ...]:
    """What a quantified type asks of the number of those of P that are Q.

    One threshold where it rises or falls, two for `exactly`, which does neither.

    >>> two = exactly(2)(Basic("P"), Basic("Q"))
    >>> print(*threshold_of(two, Thresholds()), sep=", ")
    at least 2, at most 2
    """
    match determiner_of(T):
        case None:
            raise _not_quantified(T)
        case Determiner("at_least", int(n)):
            return (number("at least", n),)
        case Determiner("at_most", int(n)):
            return (number("at most", n),)
        case Determiner("exactly", int(n)):
            return number("at least", n), number("at most", n)
        case Determiner("most" | "many" | "few" | "several" as name):
            own: Threshold = getattr(thresholds, name)
            return (own,)
        case Determiner(name):
            return _DEMANDS[name]


def determiner_of(T: object) -> Determiner | None:
    """The quantifier of a ptype q(P, Q), or None for any other type.

    >>> determiner_of(most(Basic("A"), Basic("B"))) == most
    True
    """
    if not isinstance(T, PType):
        return None
    if T.pred in _BY_NUMBER:
        amount = T.args[0]
        known = type(amount) is int and amount >= 0
        return Determiner(_BY_NUMBER[T.pred], amount) if known else None
    return _BY_PRED.get(T.pred)


def as_property(value: object) -> Property:
    """The property that a predicate of one object stands for; any other as it is.

    >>> print(as_property(Pred("dog", Ind)))
    \\x:Ind. dog(x)
    """
    if isinstance(value, Function | TypeNode):
        return value
    if not isinstance(value, Pred):
        raise IllFormedError(
            f"a property is a function to types, a type or a predicate, found "
            f"{kind_of(value)}"
        )
    for arity in value.arities:
        if len(arity) == 1:
            return fun(x=arity[0])(value(this.x))
    raise IllFormedError(
        f"a property is of one thing, but {value.name} takes {len(value.arities[0])}"
    )


def as_quantified(T: TypeNode) -> PType:
    """The type, if it is quantified; else `IllFormedError`."""
    if isinstance(T, PType) and determiner_of(T) is not None:
        return T
    raise _not_quantified(T)


def _not_quantified(T: object) -> IllFormedError:
    return IllFormedError(
        f"{T} is no quantified type",
        hint="write every(P, Q) or the like, of ttr.semantics.quantifiers",
    )


def properties(T: PType) -> tuple[Property, Property]:
    """The two properties of a quantified type."""
    P, Q = T.args[-2:]
    if not (_is_property(P) and _is_property(Q)):
        raise IllFormedError(
            f"{T} is not of two properties, functions to types or types"
        )
    return P, Q


def _is_property(value: Object) -> TypeGuard[Property]:
    return isinstance(value, Function | TypeNode)
