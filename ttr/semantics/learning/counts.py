"""Frequencies over judgements: how probable a type is, by what was judged.

J is a multiset of probabilistic Austinian propositions. ‖T‖ is the sum of the
probabilities of those whose type is below T; p(T) = ‖T‖ / total and
p(S|T) = ‖S ∧ T‖ / ‖T‖ (Cooper, Dobnik, Lappin and Larsson 2015). Sums are kept as exact
fractions, so that evidence can be taken back as if it had never been there.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import Any, NamedTuple, TypeVar

from immutables import Map

from ttr.computing.subtyping import consistent, subtype
from ttr.errors import IllFormed, Refused, TTRError
from ttr.judging.judgements import Judgement
from ttr.judging.propositions import judged, probabilistic, probabilistic_claim
from ttr.probability import CERTAIN, REFUTED, UNKNOWN, Degree
from ttr.safety.budgets import within_budget
from ttr.semantics.learning.smoothing import NO_SMOOTHING, Smoothing, as_smoothing
from ttr.signature.signature import Signature, signature_of
from ttr.types.paths import escaping
from ttr.types.printing import notation
from ttr.types.syntax import (
    Negation,
    Object,
    Record,
    TypeNode,
    as_type,
    identity,
)

__all__ = ["NO_THEORY", "Counts", "Weight"]

NO_THEORY = Signature(definitions=Map())
"""The theory without axioms, in which every type is below what its form says."""


class Weight(NamedTuple):
    """‖T‖, how much evidence there is: exact, and an interval where it is uncertain."""

    lo: Fraction
    hi: Fraction


class _Sum(NamedTuple):
    """The evidence of one type: how many propositions, and how much they weigh."""

    times: int
    lo: Fraction
    hi: Fraction

    def plus(self, times: int, p: Degree) -> _Sum:
        lo, hi = Fraction(p.lo) * times, Fraction(p.hi) * times
        return _Sum(self.times + times, self.lo + lo, self.hi + hi)


_WORST_FIRST = ("no", "unknown", "yes")
_EMPTY: Map[Any, Any] = Map()
_ZERO = Fraction(0)
_NONE = _Sum(0, _ZERO, _ZERO)

Certain = Map[object, Map[TypeNode, int]]
"""What each situation was certainly said to be of, and how often."""


@dataclass(frozen=True, repr=False)
class Counts:
    """What was judged, as a multiset of propositions that can grow and shrink.

    Equal where the same was learned, in whatever order.

    >>> from ttr.judging.propositions import proposition
    >>> from ttr.types.syntax import Basic
    >>> Dog, Bark = Basic("Dog"), Basic("Bark")
    >>> J = Counts().learned(proposition("f", Dog & Bark), proposition("s", Dog & Bark))
    >>> J = J.learned(proposition("r", Dog))
    >>> print(J.p(Bark, given=Dog))
    0.6667
    >>> print(J.retracted(proposition("r", Dog)).p(Bark, given=Dog))
    1
    """

    theory: Signature = NO_THEORY
    held: Map[object, tuple[Record, int]] = _EMPTY
    sums: Map[TypeNode, _Sum] = _EMPTY
    certain: Certain = _EMPTY

    def __post_init__(self) -> None:
        object.__setattr__(self, "theory", signature_of(self.theory))

    @within_budget
    def learned(self, *evidence: Record | Judgement) -> Counts:
        """J with these propositions or judgements, each once more.

        One without prob is certain. Raises `Refused`, and learns none of them, where
        nothing can be of a type that something is said to be of, and where what is
        certain of one situation cannot be together.

        >>> from ttr.judging.propositions import proposition
        >>> from ttr.types.syntax import Basic
        >>> A = Basic("A")
        >>> Counts().learned(proposition("s", A), proposition("s", ~A))
        Traceback (most recent call last):
        ttr.errors.Refused: {prob = 1.0, sit = s, sit_type = ~A} contradicts what is ...
        """
        counts = self
        for one in evidence:
            counts = counts._with(_as_evidence(one))
        return counts

    def retracted(self, *evidence: Record | Judgement) -> Counts:
        """J without these, each once less; raises `TTRError` where one is not in it.

        Law: J.learned(e).retracted(e) == J, and answers the same to the last digit.
        """
        counts = self
        for one in evidence:
            counts = counts._without(_as_evidence(one))
        return counts

    def __repr__(self) -> str:
        return f"<Counts: {len(self)} judgements of {len(self.sums)} types>"

    def __len__(self) -> int:
        return sum(times for _, times in self.held.values())

    def times(self, evidence: Record | Judgement) -> int:
        """How often this was learned."""
        _, times = self.held.get(identity(_as_evidence(evidence)), (None, 0))
        return times

    @property
    def total(self) -> Weight:
        """The sum of all probabilities."""
        return _weight(self.sums.values())

    def weight(self, T: TypeNode) -> Weight:
        """‖T‖; between bounds where the subtyping of some evidence is not derivable."""
        shares = self._shares(as_type(T), None)
        sure, perhaps = _weight(shares["yes"]), _weight(shares["unknown"])
        return Weight(sure.lo, sure.hi + perhaps.hi)

    @within_budget
    def p(
        self,
        T: TypeNode,
        *,
        given: TypeNode | None = None,
        smoothing: Smoothing = NO_SMOOTHING,
    ) -> Degree:
        """p(T) = ‖T‖ / total, or p(T|S) = ‖S ∧ T‖ / ‖S‖ where S is given.

        Intervals give an interval: the least and the most that the fraction can be.
        [0, 1] where there is no evidence to divide by.

        >>> from ttr.semantics.learning.smoothing import LAPLACE
        >>> from ttr.judging.propositions import probabilistic
        >>> from ttr.types.syntax import Basic
        >>> A, B = Basic("A"), Basic("B")
        >>> J = Counts().learned(probabilistic("s", A, (0.5, 1)))
        >>> J = J.learned(probabilistic("t", B, 1))
        >>> print(J.p(A), J.p(A, smoothing=LAPLACE), J.p(A, given=Basic("C")))
        [0.3333, 0.5] [0.4286, 0.5] [0, 1]
        """
        shares = self._shares(as_type(T), None if given is None else as_type(given))
        weights = {verdict: _weight(sums) for verdict, sums in shares.items()}
        return _fraction(**weights, extra=as_smoothing(smoothing).pseudocount)

    def _shares(self, T: TypeNode, given: TypeNode | None) -> dict[str, list[_Sum]]:
        """The evidence for T, against it, and not known which, of what is given."""
        shares: dict[str, list[_Sum]] = {"yes": [], "no": [], "unknown": []}
        for kind, known in self.sums.items():
            inside = "yes" if given is None else self._verdict(kind, given)
            if inside == "no":
                continue
            verdict = min(inside, self._verdict(kind, T), key=_WORST_FIRST.index)
            if inside == "unknown" and verdict == "no":
                known = known._replace(lo=_ZERO)
            shares[verdict].append(known)
        return shares

    def _verdict(self, S: TypeNode, T: TypeNode) -> str:
        known = self._verdicts.get((S, T))
        if known is None:
            known = subtype(S, T, self.theory).verdict
            self._verdicts[S, T] = known
        return known

    @cached_property
    def _verdicts(self) -> dict[tuple[TypeNode, TypeNode], str]:
        """What was asked of the types of this evidence already."""
        return {}

    # --- learning and taking back ----------------------------------------------------

    def _with(self, evidence: Record) -> Counts:
        sit, T, p = probabilistic_claim(evidence)
        if escaping(T):
            raise IllFormed(f"{T} has paths that lead nowhere, so it is no evidence")
        if p.lo > 0.0 and T not in self.sums and consistent(T, theory=self.theory).no:
            raise Refused(f"{evidence} cannot be: nothing can be of {T}")
        kind = _certainly(T, p)
        if kind is not None:
            self._check(sit, kind, evidence)
        return self._changed(evidence, 1)

    def _without(self, evidence: Record) -> Counts:
        if identity(evidence) not in self.held:
            raise TTRError(
                f"{evidence} was not learned, so it cannot be taken back",
                hint="take back what was learned, with the same probability",
            )
        return self._changed(evidence, -1)

    def _changed(self, evidence: Record, by: int) -> Counts:
        """J with the evidence once more or once less; what is empty is not kept."""
        sit, T, p = probabilistic_claim(evidence)
        times = self.times(evidence) + by
        held = _kept(self.held, identity(evidence), (evidence, times), times)
        summed = self.sums.get(T, _NONE).plus(by, p)
        sums = _kept(self.sums, T, summed, summed.times)
        return replace(self, held=held, sums=sums, certain=self._after(sit, T, p, by))

    def _check(self, sit: Object, kind: TypeNode, evidence: Record) -> None:
        """Refuses what cannot be together with what is certain of the situation."""
        known = self._certain(sit)
        if not known or kind in known:
            return
        if consistent(*known, kind, theory=self.theory).no:
            said = ", ".join(sorted(map(str, known)))
            raise Refused(
                f"{evidence} contradicts what is certain of {notation(sit)}: "
                f"that it is of {said}",
                hint="take back what was learned of it, or say it with a prob",
            )

    def _certain(self, sit: Object) -> Map[TypeNode, int]:
        return self.certain.get(identity(sit), _EMPTY)

    def _after(self, sit: Object, T: TypeNode, p: Degree, by: int) -> Certain:
        kind = _certainly(T, p)
        if kind is None:
            return self.certain
        known = self._certain(sit)
        times = known.get(kind, 0) + by
        left = _kept(known, kind, times, times)
        return _kept(self.certain, identity(sit), left, len(left))


def _as_evidence(one: Record | Judgement) -> Record:
    """The evidence as a probabilistic Austinian proposition, in one form."""
    if isinstance(one, Judgement):
        return judged(one)
    return probabilistic(*probabilistic_claim(one))


def _certainly(T: TypeNode, p: Degree) -> TypeNode | None:
    """What the situation is certainly of, if it is certain at all."""
    if p == CERTAIN:
        return T
    return Negation(T) if p == REFUTED else None


K = TypeVar("K")
V = TypeVar("V")


def _kept(entries: Map[K, V], key: K, value: V, times: int) -> Map[K, V]:
    """The map with an entry, or without it where it stands for nothing any more."""
    if times:
        return entries.set(key, value)
    return entries.delete(key)


def _weight(sums: Iterable[_Sum]) -> Weight:
    sums = list(sums)
    return Weight(sum((s.lo for s in sums), _ZERO), sum((s.hi for s in sums), _ZERO))


def _fraction(yes: Weight, no: Weight, unknown: Weight, extra: Fraction) -> Degree:
    """yes / (yes + no) at its least and its most, with so much extra for each of them.

    What is not known counts against at the least, and for at the most.
    """
    most = yes.hi + unknown.hi
    if not most + no.hi + extra:
        return UNKNOWN
    low = _share(yes.lo + extra, no.hi + unknown.hi + extra, Fraction(1))
    high = _share(most + extra, no.lo + extra, _ZERO)
    return Degree(float(low), float(high))


def _share(one: Fraction, other: Fraction, where_empty: Fraction) -> Fraction:
    whole = one + other
    return one / whole if whole else where_empty
