"""Frequencies of judgements, and the probabilities of types that they give.

J is a multiset of probabilistic Austinian propositions. ‖T‖ is the sum of the
probabilities of those whose type is below T; p(T) = ‖T‖ / total and
p(S|T) = ‖S ∧ T‖ / ‖T‖ (Cooper, Dobnik, Lappin and Larsson 2015). Sums are kept as exact
fractions, so that taking evidence back leaves no trace.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import Any, NamedTuple, TypeVar

from ttr.computing.subtyping import VERDICTS, consistent, subtype
from ttr.errors import IllFormedError, RefusedError, TTRError
from ttr.judging.judgements import Judgement
from ttr.judging.propositions import probabilistic, probabilistic_claim, proposition_of
from ttr.persistent_maps import Map
from ttr.probability import CERTAIN, REFUTED, UNKNOWN, Degree
from ttr.probability.degrees import share
from ttr.safety.budgets import within_budget
from ttr.semantics.learning.smoothing import NO_SMOOTHING, Smoothing, as_smoothing
from ttr.signature.signature import Signature, signature_of
from ttr.types.interning import identity
from ttr.types.objects import Object, Record
from ttr.types.paths import free_paths
from ttr.types.printing import notation
from ttr.types.syntax import Negation, TypeNode, as_type

NO_THEORY = Signature(definitions=Map())
"""The theory without axioms: types are below one another by their form alone."""


class Weight(NamedTuple):
    """‖T‖, the amount of evidence, as exact fractions; an interval if uncertain."""

    lo: Fraction
    hi: Fraction


class _Sum(NamedTuple):
    """The evidence for one type: the number of propositions and their weight."""

    times: int
    lo: Fraction
    hi: Fraction

    def plus(self, times: int, p: Degree) -> _Sum:
        lo, hi = Fraction(p.lo) * times, Fraction(p.hi) * times
        return _Sum(self.times + times, self.lo + lo, self.hi + hi)


_EMPTY: Map[Any, Any] = Map()
_ZERO = Fraction(0)
_NO_SUM = _Sum(0, _ZERO, _ZERO)

_CertainTypes = Map[object, Map[TypeNode, int]]
"""The types that each situation is certain to be of, and how often that was learned."""


@dataclass(frozen=True, repr=False)
class Counts:
    """A multiset J of propositions, which can grow and shrink.

    Equal where the same was learned, in whatever order.

    >>> from ttr import Basic
    >>> from ttr.judging import proposition
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
    certain: _CertainTypes = _EMPTY

    def __post_init__(self) -> None:
        object.__setattr__(self, "theory", signature_of(self.theory))

    @within_budget
    def learned(self, *evidence: Record | Judgement) -> Counts:
        """J with these propositions or judgements, each once more.

        A proposition without prob is certain. Raises `RefusedError`, and learns
        nothing, for a type that nothing can be of, and where one situation would
        certainly be of types that exclude one another.

        >>> from ttr import Basic
        >>> from ttr.judging import proposition
        >>> A = Basic("A")
        >>> Counts().learned(proposition("s", A), proposition("s", ~A))
        Traceback (most recent call last):
        ttr...RefusedError: {prob = 1.0, sit = s, sit_type = ~A} contradicts what is ...
        """
        counts = self
        for one in evidence:
            counts = counts._with(_as_evidence(one))
        return counts

    def retracted(self, *evidence: Record | Judgement) -> Counts:
        """J without these, each once less; raises `TTRError` for one that is not in J.

        Law: J.learned(e).retracted(e) == J, with the same answers to the last digit.
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
        """How often this proposition was learned."""
        _, times = self.held.get(identity(_as_evidence(evidence)), (None, 0))
        return times

    @property
    def total(self) -> Weight:
        """The sum of all probabilities."""
        return _weight(self.sums.values())

    def weight(self, T: TypeNode) -> Weight:
        """‖T‖; an interval where it is unknown whether some evidence is below T."""
        shares = self._evidence_by_verdict(as_type(T), None)
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

        Intervals give an interval: the least and the greatest value of the fraction.
        [0, 1] where there is no evidence.

        >>> from ttr import Basic
        >>> from ttr.judging.propositions import probabilistic
        >>> from ttr.semantics.learning.smoothing import LAPLACE
        >>> A, B = Basic("A"), Basic("B")
        >>> J = Counts().learned(probabilistic("s", A, (0.5, 1)))
        >>> J = J.learned(probabilistic("t", B, 1))
        >>> print(J.p(A), J.p(A, smoothing=LAPLACE), J.p(A, given=Basic("C")))
        [0.3333, 0.5] [0.4286, 0.5] [0, 1]
        """
        shares = self._evidence_by_verdict(
            as_type(T), None if given is None else as_type(given)
        )
        weights = {verdict: _weight(sums) for verdict, sums in shares.items()}
        return _fraction(**weights, extra=as_smoothing(smoothing).pseudocount)

    def _evidence_by_verdict(
        self, T: TypeNode, given: TypeNode | None
    ) -> dict[str, list[_Sum]]:
        """The evidence among what is given: for T, against T, and unknown which."""
        shares: dict[str, list[_Sum]] = {"yes": [], "no": [], "unknown": []}
        for kind, known in self.sums.items():
            inside = "yes" if given is None else self._verdict(kind, given)
            if inside == "no":
                continue
            verdict = min(inside, self._verdict(kind, T), key=VERDICTS.index)
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
        """A cache of verdicts S ⊑ T for the types of this evidence."""
        return {}

    # --- learning and taking back ----------------------------------------------------

    def _with(self, evidence: Record) -> Counts:
        sit, T, p = probabilistic_claim(evidence)
        if free_paths(T):
            raise IllFormedError(
                f"{T} has paths that lead nowhere, so it is no evidence"
            )
        if p.lo > 0.0 and T not in self.sums and consistent(T, theory=self.theory).no:
            raise RefusedError(f"{evidence} cannot be: nothing can be of {T}")
        kind = _certain_type(T, p)
        if kind is not None:
            self._check_consistent(sit, kind, evidence)
        return self._adjust(evidence, 1)

    def _without(self, evidence: Record) -> Counts:
        if identity(evidence) not in self.held:
            raise TTRError(
                f"{evidence} was not learned, so it cannot be taken back",
                hint="take back what was learned, with the same probability",
            )
        return self._adjust(evidence, -1)

    def _adjust(self, evidence: Record, by: int) -> Counts:
        """J with the evidence once more or once less; entries of none are dropped."""
        sit, T, p = probabilistic_claim(evidence)
        times = self.times(evidence) + by
        held = _with_entry(self.held, identity(evidence), (evidence, times), times)
        summed = self.sums.get(T, _NO_SUM).plus(by, p)
        sums = _with_entry(self.sums, T, summed, summed.times)
        return replace(
            self, held=held, sums=sums, certain=self._certain_after(sit, T, p, by)
        )

    def _check_consistent(self, sit: Object, kind: TypeNode, evidence: Record) -> None:
        """Raise `RefusedError` for what contradicts the certain types of the
        situation.
        """
        known = self._certain_types(sit)
        if not known or kind in known:
            return
        if consistent(*known, kind, theory=self.theory).no:
            said = ", ".join(sorted(map(str, known)))
            raise RefusedError(
                f"{evidence} contradicts what is certain of {notation(sit)}: "
                f"that it is of {said}",
                hint="take back what was learned of it, or say it with a prob",
            )

    def _certain_types(self, sit: Object) -> Map[TypeNode, int]:
        return self.certain.get(identity(sit), _EMPTY)

    def _certain_after(
        self, sit: Object, T: TypeNode, p: Degree, by: int
    ) -> _CertainTypes:
        kind = _certain_type(T, p)
        if kind is None:
            return self.certain
        known = self._certain_types(sit)
        times = known.get(kind, 0) + by
        left = _with_entry(known, kind, times, times)
        return _with_entry(self.certain, identity(sit), left, len(left))


def _as_evidence(one: Record | Judgement) -> Record:
    """The evidence as a probabilistic Austinian proposition."""
    if isinstance(one, Judgement):
        return proposition_of(one)
    return probabilistic(*probabilistic_claim(one))


def _certain_type(T: TypeNode, p: Degree) -> TypeNode | None:
    """The type that a situation is certainly of by p(s : T): T, ~T or none."""
    if p == CERTAIN:
        return T
    return Negation(T) if p == REFUTED else None


K = TypeVar("K")
V = TypeVar("V")


def _with_entry(entries: Map[K, V], key: K, value: V, times: int) -> Map[K, V]:
    """The map with an entry, or without it where it counts 0 times."""
    if times:
        return entries.set(key, value)
    return entries.delete(key)


def _weight(sums: Iterable[_Sum]) -> Weight:
    sums = list(sums)
    return Weight(sum((s.lo for s in sums), _ZERO), sum((s.hi for s in sums), _ZERO))


def _fraction(yes: Weight, no: Weight, unknown: Weight, extra: Fraction) -> Degree:
    """(yes + extra) / (yes + no + 2 · extra), at its least and its greatest.

    The unknown counts as no for the least value, and as yes for the greatest.
    """
    mine = Weight(yes.lo + extra, yes.hi + unknown.hi + extra)
    rest = Weight(no.lo + extra, no.hi + unknown.hi + extra)
    return share(mine, rest) or UNKNOWN
