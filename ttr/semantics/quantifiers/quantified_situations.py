"""Situations of quantified types: is {X, f} one that makes q(P, Q) true?"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TypeGuard

from ttr.judging.judgements import Judgement, Why
from ttr.judging.models import Model
from ttr.probability import CERTAIN, REFUTED, UNKNOWN, Degree
from ttr.safety.budgets import within_budget
from ttr.semantics.quantifiers.determiners import determiner_of, properties
from ttr.semantics.quantifiers.quantified_propositions import (
    Quantification,
    list_names,
    settle,
)
from ttr.semantics.quantifiers.thresholds import Thresholds
from ttr.types.interning import identity
from ttr.types.objects import FiniteSet, Object, Record, freeze
from ttr.types.printing import notation
from ttr.types.syntax import Function, TypeNode, as_type


@within_budget
def judge_situation(
    M: Model, s: object, T: TypeNode, thresholds: Thresholds | None = None, /
) -> Judgement:
    """Is s of q(P, Q)? It is a record {X, f}, where X is a witness set and f fits.

    X is a set of some of P, as many as q asks for. Where q rises, f is a list of pairs
    {x, e}, one for each of X, whose e is of Q(x). Where q falls, X has everything that
    is P and Q. Where something uncertain decides, the answer is unknown.

    >>> from ttr import Ind, Pred, record
    >>> from ttr.semantics.quantifiers import few
    >>> dog, bark = Pred("dog", Ind), Pred("bark", Ind)
    >>> M = Model().given("fido", Ind).given("s1", dog("fido"))
    >>> M = M.given("s2", bark("fido"))
    >>> judge_situation(M, record(X=frozenset()), few(dog, bark)).why.rule
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
        objection = next(self._objections(s), None)
        if objection is not None:
            return REFUTED, objection
        if self._found.open_:
            return UNKNOWN, f"{list_names(self._found.open_)} may decide"
        return CERTAIN, "X is a witness set"

    def _objections(self, s: Object) -> Iterator[str]:
        """The objections to s = {X, f}."""
        if not isinstance(s, Record) or not isinstance(s._fields.get("X"), FiniteSet):
            yield "it is no record {X, f} with a set X"
            return
        X = {identity(x): x for x in s._fields["X"]}
        yield from self._wrong_set(X)
        if any(one.is_lower_bound for one in self._found.asked):
            yield from self._wrong_function(X, s._fields.get("f", ()))

    def _wrong_set(self, X: Mapping[object, Object]) -> Iterator[str]:
        """Why X is no witness set."""
        for key, x in X.items():
            if key not in self._cases:
                yield f"{notation(x)} in X is not of the first property"
        size = len(self._found.maxset)
        unmet = [one for one in self._found.asked if not one.is_met_by(len(X), size)]
        if unmet and not self._found.open_:
            yield f"X has {len(X)} of {size}; it takes {unmet[0]}"
        if all(one.is_lower_bound for one in self._found.asked):
            return
        for it in self._found.refset:
            if identity(it.sit) not in X:
                yield f"{notation(it.sit)} is both, but not in X"

    def _wrong_function(self, X: Mapping[object, Object], f: Object) -> Iterator[str]:
        """Why f does not take each of X to what makes it Q."""
        if not isinstance(f, tuple) or not all(map(_is_pair, f)):
            yield "f is no list of pairs {x, e}"
            return
        given: dict[object, Object] = {}
        for pair in f:
            x = pair._fields["x"]
            if identity(x) in given:
                yield f"f has two pairs for {notation(x)}"
            if identity(x) not in X:
                yield f"f says something of {notation(x)}, which is not in X"
            given[identity(x)] = pair._fields["e"]
        for key, x in X.items():
            if key not in given:
                yield f"f gives nothing for {notation(x)}"
            elif not self._makes(x, given[key]):
                yield f"{notation(given[key])} does not make {notation(x)} so"

    def _makes(self, x: Object, e: Object) -> bool:
        """May a situation be one in which x is Q?"""
        if not isinstance(self._Q, Function):
            return identity(e) == identity(x) and self._M.judge(x, self._Q).p.hi > 0.0
        T = self._M.apply(self._Q, x)
        if determiner_of(T) is not None:
            return judge_situation(self._M, e, as_type(T)).p.hi > 0.0
        case = self._cases[identity(x)]
        found = identity(case.situation) == identity(e) and case in self._found.refset
        return found or self._M.judge(e, as_type(T)).p.hi > 0.0


def _is_pair(value: object) -> TypeGuard[Record]:
    return isinstance(value, Record) and set(value._fields) == {"x", "e"}
