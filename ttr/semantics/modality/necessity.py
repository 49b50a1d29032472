"""Box and diamond types, and the answers that a modal system gives.

Box and diamond types are ptypes, nec(T) and poss(T). So they can stand in record types,
meets and negations, and the notation writes them as it writes any predicate of types.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass

from ttr.judging.judgements import Judgement
from ttr.probability import CERTAIN, REFUTED, Degree
from ttr.safety.budgets import spend
from ttr.types.objects import Object, Record, UnresolvedError
from ttr.types.paths import subterms
from ttr.types.substitution import Around, resolve_paths
from ttr.types.syntax import (
    Join,
    Meet,
    Negation,
    Pred,
    PType,
    RecordType,
    Singleton,
    Type,
    TypeNode,
    as_type,
)

nec, poss = Pred("nec", Type), Pred("poss", Type)
"""Predicates of types: that something is of a type in every possibility, or in some.

>>> from ttr import Basic
>>> from ttr.semantics.modality import nec, poss
>>> Rain = Basic("Rain")
>>> print(nec(Rain), poss(Rain))
nec(Rain) poss(Rain)
"""


def necessarily(T: TypeNode, /) -> PType:
    """The box type □T = nec(T), of the situations in a system in which T is necessary.

    `ModalSystem.judge` judges what is of it.

    >>> from ttr import Basic
    >>> print(necessarily(Basic("Rain")))
    nec(Rain)
    """
    return nec(as_type(T))


def possibly(T: TypeNode, /) -> PType:
    """The diamond type ◇T = poss(T), of the situations in which T is possible.

    >>> from ttr import Basic
    >>> print(~possibly(Basic("Rain")))
    ~poss(Rain)
    """
    return poss(as_type(T))


def is_modal(T: TypeNode) -> bool:
    """Is a type made of box and diamond types by meets, joins and negations alone?

    Then what is of it does not depend on the situation.
    """
    spend()
    match T:
        case Meet(parts) | Join(parts):
            return all(map(is_modal, parts))
        case Negation(body):
            return is_modal(body)
    return isinstance(T, PType) and T.pred in (nec, poss)


def mentions_modal(T: Object) -> bool:
    """Does nec or poss occur in a type?"""
    return any(one is nec or one is poss for one in subterms([T]))


def modal_claims(
    sit: Object, T: TypeNode, around: Around = ()
) -> Iterator[tuple[Object, PType]]:
    """The box and diamond types that sit : T depends on, each with its object.

    >>> from ttr import Basic, record, rectype, this
    >>> dog = Pred("dog", Basic("Ind"))
    >>> T = rectype(x=Basic("Ind"), c=possibly(dog(this.x)))
    >>> [(sit, str(kind)) for sit, kind in modal_claims(record(x="fido", c="s1"), T)]
    [('s1', 'poss(dog(fido))')]
    """
    spend()
    match T:
        case PType(pred, _) if pred in (nec, poss):
            with suppress(UnresolvedError):
                yield sit, resolve_paths(T, around)
        case Meet(parts) | Join(parts):
            for part in parts:
                yield from modal_claims(sit, part, around)
        case Negation(part) | Singleton(part, _):
            yield from modal_claims(sit, part, around)
        case RecordType(fields) if isinstance(sit, Record):
            inside = (sit._fields, *around)
            for label, field in fields:
                if label in sit:
                    yield from modal_claims(sit[label], field, inside)


@dataclass(frozen=True)
class ModalAnswer:
    """How certain something is of a modal system, and why.

    `possibility` is the name of the possibility that decides: in which what is possible
    is so, or what is not necessary is not so. For subtyping and equivalence, `counter`
    is the judgement there of a witness of S that is not of T.

    >>> from ttr import Basic, Model
    >>> from ttr.semantics.modality import modal_system
    >>> Rain = Basic("Rain")
    >>> days = modal_system(mon=Model().given("s", Rain), tue=Model())
    >>> answer = days.restrictive.necessary(Rain)
    >>> print(answer, answer.possibility, sep="; ")
    no: nothing is of Rain in tue; tue
    """

    p: Degree
    why: str
    possibility: str | None = None
    counter: Judgement | None = None

    @property
    def yes(self) -> bool:
        """Certainly so."""
        return self.p == CERTAIN

    @property
    def no(self) -> bool:
        """Certainly not so."""
        return self.p == REFUTED

    @property
    def unknown(self) -> bool:
        """Neither; `p` has the bounds."""
        return not self.yes and not self.no

    def __bool__(self) -> bool:
        raise TypeError("an answer is yes, no or unknown: ask for .yes or .no")

    def __str__(self) -> str:
        verdict = "yes" if self.yes else "no" if self.no else f"unknown, p = {self.p}"
        return f"{verdict}: {self.why}"
