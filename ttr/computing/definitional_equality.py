"""Definitional equality: two types are equal if they compute to the same.

Identity (`is`, and what a type prints as) is that of what is written; equality is a
relation of a theory. Source: Martin-Löf 1984.
"""

from __future__ import annotations

from functools import partial

from ttr.computing.kept_redexes import kept_redexes, open_presupposition
from ttr.computing.normalisation import normal_form
from ttr.computing.subtyping import Answer
from ttr.errors import TooLargeError
from ttr.safety.budgets import within_budget
from ttr.signature.signature import Signature, signature_of
from ttr.types.interning import identity
from ttr.types.objects import Object, freeze
from ttr.types.printing import notation


def _left_open(error: TooLargeError, *_: object, **__: object) -> Answer:
    return Answer("unknown", error.message)


@within_budget(otherwise=_left_open)
def equal(left: Object, right: Object, /, theory: Signature | None = None) -> Answer:
    r"""Are two types or objects equal in the theory, by what they compute to?

    The answer is unknown where they differ and an application is kept, whose argument
    is not known to be in the domain. Raises `IllFormedError` as `normal_form`.

    >>> from ttr import Ind, Pred, fun, outer, rectype, this
    >>> man = Pred("man", Ind)
    >>> Man = fun(v=Ind)(rectype(e=man(outer.v)))
    >>> equal(Man("j"), rectype(e=man("j"))).verdict
    'unknown'
    >>> equal(rectype(x=Ind, r=Man(this.x)), rectype(x=Ind, r=Man(this.x))).yes
    True
    """
    left, right = freeze(left), freeze(right)
    one, other = normal_form(left, theory), normal_form(right, theory)
    if identity(one) == identity(other):
        return Answer("yes", lambda: f"both compute to {notation(one)}")
    if any(next(kept_redexes(value), None) for value in (one, other)):
        text = signature_of(theory).spelling
        return Answer("unknown", partial(open_presupposition, one, other, text=text))
    return Answer("no", lambda: f"{notation(one)} is not {notation(other)}")
