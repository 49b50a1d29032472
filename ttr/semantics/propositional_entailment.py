"""Entailment between propositions: types, and Austinian propositions."""

from __future__ import annotations

from ttr.computing.subtyping import VERDICTS, Answer, subtype
from ttr.judging.propositions import borne_out, claim, probabilistic_claim
from ttr.probability import CERTAIN, Degree, complement
from ttr.probability.degrees import order_ends
from ttr.safety.budgets import within_budget
from ttr.signature.signature import Signature
from ttr.types.interning import identity
from ttr.types.objects import Object, freeze
from ttr.types.printing import notation
from ttr.types.syntax import Basic, PType, TypeNode

__all__ = ["entails", "equivalent"]


@within_budget
def entails(
    first: object, second: object, /, theory: Signature | None = None
) -> Answer:
    """Is the second proposition true wherever the first is?

    For types, and for Austinian propositions of one situation: is the first type below
    the second? An Austinian proposition that is certain entails its type. If p(s : S)
    is in [lo, hi], then p(s : T) is at least lo where S ⊑ T, at most hi where T ⊑ S, at
    least 1 − hi where ¬S ⊑ T, and at most 1 − lo where S ⊑ ¬T. Raises `IllFormedError`
    for what is no proposition.

    >>> from ttr import Basic
    >>> from ttr.judging import proposition
    >>> from ttr.judging.propositions import probabilistic
    >>> A, B = Basic("A"), Basic("B")
    >>> print(entails(proposition("s", A & B), proposition("s", A)).verdict)
    yes
    >>> print(entails(probabilistic("s", A, 0.7), probabilistic("s", A | B, (0.5, 1))))
    yes: p(s : A \\/ B) is in [0.7, 1]
    """
    P, Q = freeze(first), freeze(second)
    if isinstance(Q, TypeNode):
        return _entails_type(P, Q, theory)
    sit, _ = claim(Q)
    if isinstance(P, TypeNode):
        return Answer("unknown", f"what is of {P} may be other than {notation(sit)}")
    return _entails_austinian(P, Q, theory)


def equivalent(
    first: object, second: object, /, theory: Signature | None = None
) -> Answer:
    """Does each of two propositions entail the other?

    >>> from ttr import Basic
    >>> from ttr.judging import proposition
    >>> A, B = Basic("A"), Basic("B")
    >>> equivalent(proposition("s", ~(A & B)), proposition("s", ~A | ~B)).yes
    True
    """
    answers = [entails(first, second, theory), entails(second, first, theory)]
    return min(answers, key=lambda answer: VERDICTS.index(answer.verdict))


def _entails_type(P: Object, T: TypeNode, theory: Signature | None) -> Answer:
    """Does P entail that something is of T?"""
    if isinstance(P, TypeNode):
        return subtype(P, T, theory)
    sit, S, claimed = probabilistic_claim(P)
    if claimed == CERTAIN:
        return subtype(S, T, theory)
    return Answer("unknown", f"{notation(sit)} is not said to be certainly of {S}")


def _entails_austinian(P: Object, Q: Object, theory: Signature | None) -> Answer:
    sit, S, claimed = probabilistic_claim(P)
    other, T, wanted = probabilistic_claim(Q)
    if identity(sit) != identity(other):
        apart = f"{notation(sit)} and {notation(other)} may be different situations"
        return Answer("unknown", apart)
    if claimed == wanted == CERTAIN:
        return subtype(S, T, theory)
    follows = _bounds(claimed, S, T, theory)
    why = f"p({notation(sit)} : {T}) is in {follows}"
    if borne_out(wanted, follows) == CERTAIN:
        return Answer("yes", why)
    refuted = (S is T or ~S is T) and isinstance(S, Basic | PType)
    return Answer("no" if refuted else "unknown", why)


def _bounds(p: Degree, S: TypeNode, T: TypeNode, theory: Signature | None) -> Degree:
    """The bounds of p(s : T) that follow from p = p(s : S)."""
    least, most = [0.0], [1.0]
    if subtype(S, T, theory).yes:
        least.append(p.lo)
    if subtype(T, S, theory).yes:
        most.append(p.hi)
    if subtype(~S, T, theory).yes:
        least.append(complement(p.hi))
    if subtype(S, ~T, theory).yes:
        most.append(complement(p.lo))
    return order_ends(max(least), min(most))
