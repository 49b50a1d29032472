"""What follows from propositions."""

from __future__ import annotations

from ttr.errors import following_nesting
from ttr.printing import notation
from ttr.probability import CERTAIN, Degree
from ttr.propositions import borne_out, claim, probabilistic_claim
from ttr.subtyping import Answer, subtype
from ttr.syntax import Basic, Object, PType, TypeNode, freeze, identity
from ttr.theories import Signature

__all__ = ["entails", "equivalent"]


@following_nesting
def entails(
    first: object, second: object, theory: Signature | None = None, /
) -> Answer:
    """Is the second proposition true wherever the first is?

    Of types, and of Austinian propositions of one situation: is the first type below
    the second? A type is true as well where something is certainly of it. From p(s : S)
    in [lo, hi] and S ⊑ T follows that p(s : T) is in [lo, 1], and in [lo, hi] where
    T ⊑ S as well. Raises `IllFormed` for what is no proposition.

    >>> from ttr.propositions import probabilistic, proposition
    >>> from ttr.syntax import Basic
    >>> A, B = Basic("A"), Basic("B")
    >>> print(entails(proposition("s", A & B), proposition("s", A)).verdict)
    yes
    >>> print(entails(probabilistic("s", A, 0.7), probabilistic("s", A | B, (0.5, 1))))
    yes: p(s : A \\/ B) is in [0.7, 1]
    """
    P, Q = freeze(first), freeze(second)
    if isinstance(Q, TypeNode):
        return _some(P, Q, theory)
    sit, _ = claim(Q)
    if isinstance(P, TypeNode):
        return Answer("unknown", f"what is of {P} may be other than {notation(sit)}")
    return _austinian(P, Q, theory)


def equivalent(
    first: object, second: object, theory: Signature | None = None, /
) -> Answer:
    """Does each of two propositions entail the other?"""
    answers = [entails(first, second, theory), entails(second, first, theory)]
    return min(answers, key=lambda answer: _WORST_FIRST.index(answer.verdict))


_WORST_FIRST = ("no", "unknown", "yes")


def _some(P: Object, T: TypeNode, theory: Signature | None) -> Answer:
    """Does it follow that something is of T?"""
    if isinstance(P, TypeNode):
        return subtype(P, T, theory)
    sit, S, claimed = probabilistic_claim(P)
    if claimed == CERTAIN:
        return subtype(S, T, theory)
    return Answer("unknown", f"{notation(sit)} is not said to be certainly of {S}")


def _austinian(P: Object, Q: Object, theory: Signature | None) -> Answer:
    sit, S, claimed = probabilistic_claim(P)
    other, T, wanted = probabilistic_claim(Q)
    if identity(sit) != identity(other):
        apart = f"{notation(sit)} and {notation(other)} may be different situations"
        return Answer("unknown", apart)
    below, above = subtype(S, T, theory), subtype(T, S, theory)
    if claimed == wanted == CERTAIN:
        return below
    follows = Degree(claimed.lo if below.yes else 0.0, claimed.hi if above.yes else 1.0)
    why = f"p({notation(sit)} : {T}) is in {follows}"
    if borne_out(wanted, follows) == CERTAIN:
        return Answer("yes", why)
    refuted = S is T and isinstance(S, Basic | PType)
    return Answer("no" if refuted else "unknown", why)
