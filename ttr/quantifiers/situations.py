"""Situations of quantified types: is {X, f} one that makes q(P, Q) true?"""

from __future__ import annotations

from collections.abc import Mapping

from ttr.errors import following_nesting
from ttr.judgements import Judgement, Why
from ttr.models import Model
from ttr.printing import notation
from ttr.probability import CERTAIN, REFUTED, UNKNOWN, Degree
from ttr.quantifiers.determiners import determiner_of, properties
from ttr.quantifiers.quantifications import Quantification, named, settle
from ttr.quantifiers.thresholds import Thresholds
from ttr.syntax import (
    FiniteSet,
    Function,
    Object,
    Record,
    TypeNode,
    as_type,
    freeze,
    identity,
)

__all__ = ["judged"]


@following_nesting
def judged(
    M: Model, s: object, T: TypeNode, thresholds: Thresholds | None = None, /
) -> Judgement:
    """Is s of q(P, Q)? It is a record {X, f}, where X is a witness set and f fits.

    X is a set of some of P, as many as q asks for. Where q rises, f is a list of pairs
    {x, e}, one for each of X, whose e is of Q(x). Where q falls, X has everything that
    is P and Q. Where something uncertain decides, the answer is unknown.

    >>> from ttr.quantifiers import few
    >>> from ttr.syntax import Ind, Pred, record
    >>> dog, bark = Pred("dog", Ind), Pred("bark", Ind)
    >>> M = Model().given("fido", Ind).given("s1", dog("fido"))
    >>> M = M.given("s2", bark("fido"))
    >>> judged(M, record(X=frozenset()), few(dog, bark)).why.rule
    'fido is both, but not in X'
    """
    s = freeze(s)
    found = settle(M, T, thresholds)
    p, rule = _Fitting(M, found).of(s)
    why = Why(s, T, p, rule, (found.why,) if p != CERTAIN else ())
    return Judgement(s, T, p, why, M)


class _Fitting:
    """Checks a situation against all that are P, those that are Q, and those not."""

    def __init__(self, M: Model, found: Quantification) -> None:
        self._M, self._found = M, found
        _, self._Q = properties(found.type)
        cases = (*found.refset, *found.compset, *found.open_)
        self._cases = {identity(it.sit): it for it in cases}

    def of(self, s: Object) -> tuple[Degree, str]:
        """How certainly s = {X, f} fits, and what says so."""
        if not isinstance(s, Record) or not isinstance(s._fields.get("X"), FiniteSet):
            return REFUTED, "it is no record {X, f} with a set X"
        chosen = s._fields["X"]
        X = {identity(x): x for x in chosen}
        outside = [x for key, x in X.items() if key not in self._cases]
        if outside:
            return REFUTED, f"{notation(outside[0])} in X is not of the first property"
        falls = [one for one in self._found.asked if not one.rising]
        rises = [one for one in self._found.asked if one.rising]
        size = len(self._found.maxset)
        unmet = [one for one in self._found.asked if not one.met(len(X), size)]
        if unmet and not self._found.open_:
            return REFUTED, f"X has {len(X)} of {size}; it takes {unmet[0]}"
        left = [it for it in self._found.refset if identity(it.sit) not in X]
        if falls and left:
            return REFUTED, f"{notation(left[0].sit)} is both, but not in X"
        if rises:
            lacking = self._lacking(X, s._fields.get("f", ()))
            if lacking:
                return REFUTED, lacking
        if self._found.open_:
            return UNKNOWN, f"{named(self._found.open_)} may decide"
        return CERTAIN, "X is a witness set"

    def _lacking(self, X: Mapping[object, Object], f: Object) -> str:
        """What f gives no situation for, or none that makes it Q."""
        if not isinstance(f, tuple) or not all(map(_is_pair, f)):
            return "f is no list of pairs {x, e}"
        pairs = {identity(pair._fields["x"]): pair._fields["e"] for pair in f}
        for key, x in X.items():
            if key not in pairs:
                return f"f gives nothing for {notation(x)}"
            if not self._makes(x, pairs[key]):
                return f"{notation(pairs[key])} does not make {notation(x)} so"
        return ""

    def _makes(self, x: Object, e: Object) -> bool:
        """Whether a situation may make x one of Q."""
        if not isinstance(self._Q, Function):
            return identity(e) == identity(x) and self._M.judge(x, self._Q).p.hi > 0.0
        T = self._M.apply(self._Q, x)
        if determiner_of(T) is not None:
            return judged(self._M, e, as_type(T)).p.hi > 0.0
        case = self._cases[identity(x)]
        found = identity(case.situation) == identity(e) and case in self._found.refset
        return found or self._M.judge(e, as_type(T)).p.hi > 0.0


def _is_pair(value: object) -> bool:
    return isinstance(value, Record) and set(value._fields) == {"x", "e"}
