"""Quantified propositions in a model: are so many of P also Q, and who are they?

By definition s : q(P, Q) iff s = {X, f} and X is a witness set of q over P: some of P,
as many as q asks for. Where q rises, f takes each of X to a situation in which it is Q;
where q falls, everything that is P and Q lies in X. So q(P, Q) is true iff the set of
all that are P and Q is such an X, and this X is the witness that is given.
"""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, field
from functools import cached_property

from ttr.errors import TTRError, UndecidedError
from ttr.judging.judgements import Why
from ttr.judging.models import Model
from ttr.probability import CERTAIN, REFUTED, UNKNOWN, Degree
from ttr.safety.budgets import within_budget
from ttr.semantics.quantifiers.counting import chance_of
from ttr.semantics.quantifiers.degrees_of_truth import SHOWN, Atoms, Truth
from ttr.semantics.quantifiers.determiners import (
    Determiner,
    Property,
    as_quantified,
    properties,
    threshold_of,
)
from ttr.semantics.quantifiers.extension_pairs import Case, Split, split_by
from ttr.semantics.quantifiers.extensions import (
    Extension,
    extension,
    in_domain,
    member,
)
from ttr.semantics.quantifiers.thresholds import Threshold, Thresholds, thresholds_of
from ttr.semantics.quantifiers.truth import truth_of_quantified
from ttr.types.objects import FiniteSet, Missing, Record
from ttr.types.printing import notation
from ttr.types.syntax import Function, PType, TypeNode, kind_of


class UndefinedError(TTRError):
    r"""A proposition that is neither true nor false: what it presupposes is not so.

    >>> from ttr import Ind, Model, Pred
    >>> from ttr.semantics.quantifiers import most, settle
    >>> settle(Model(), most(Pred("dog", Ind), Pred("bark", Ind))).holds
    Traceback (most recent call last):
        ...
    ttr.semantics.quantifiers.quantified_propositions.UndefinedError: most(\x:Ind.
    dog(x), \x:Ind. bark(x)) is neither true nor false: it asks for a share, and nothing
    is of \x:Ind. dog(x)
    """


@dataclass(frozen=True, eq=False)
class Quantification:
    """How so many of P are Q: who they are, who not, how certain it is, and why.

    `maxset` are those that certainly are P, `refset` those that are Q too, `compset`
    those that are not, `open_` those of which it is not certain.

    >>> from ttr.semantics.quantifiers import Extension, most, quantify
    >>> dogs = Extension.of(["fido", "rex", "sam"], "dog")
    >>> found = quantify(most, dogs, Extension.of(["fido", "sam"], "bark"))
    >>> found.holds, [it.sit for it in found.refset], [it.sit for it in found.compset]
    (True, ['fido', 'sam'], ['rex'])
    """

    type: PType
    asked: tuple[Threshold, ...]
    p: Degree
    atoms: Atoms
    _split: Split = field(repr=False)

    @cached_property
    def refset(self) -> tuple[Case, ...]:
        """Those that certainly are P and Q."""
        return self._split.cases(self._split.inside)

    @cached_property
    def compset(self) -> tuple[Case, ...]:
        """Those that certainly are P and not Q."""
        return self._split.cases(self._split.outside)

    @cached_property
    def open_(self) -> tuple[Case, ...]:
        """Those that may be P, or P and Q."""
        return self._split.cases(self._split.open_)

    @property
    def holds(self) -> bool:
        """True at [1, 1], False at [0, 0]; else it raises `UndecidedError`."""
        if self.p in (CERTAIN, REFUTED):
            return self.p == CERTAIN
        raise UndecidedError(
            f"{self.type} is neither certain nor refuted: p = {self.p}",
            hint="look at .p, or at .open_ for who is uncertain",
        )

    def __str__(self) -> str:
        return str(self.why)

    @property
    def maxset(self) -> tuple[Case, ...]:
        """Those that certainly are P."""
        return (*self.refset, *self.compset)

    @cached_property
    def witness(self) -> Record:
        """{X, f}: those that are P and Q, and what makes each of them Q.

        The function f is written as the list of its pairs {x, e}.
        """
        pairs = tuple([Record({"x": it.sit, "e": it.situation}) for it in self.refset])
        return Record({"X": FiniteSet(*[it.sit for it in self.refset]), "f": pairs})

    @property
    def truth(self) -> Truth:
        """How certain it is, why, and on what it rests."""
        return Truth(self.p, self.why, self.atoms)

    @property
    def why(self) -> Why:
        """The derivation: the count, and then those that decide it."""
        exceptions = self._exceptions()
        rising = self.asked[0].is_lower_bound
        speaking = self.refset if rising else self.compset
        shown = exceptions or self.open_ or speaking or self.refset
        grounds = tuple([it.why for it in shown[:SHOWN] if it.why is not None])
        sit = Missing() if self.p == REFUTED else self.witness
        return Why(sit, self.type, self.p, self._reason(exceptions), grounds)

    def _reason(self, exceptions: tuple[Case, ...]) -> str:
        """How many are, how many it takes, and who are the exceptions."""
        said = f"{len(self.refset)} of {len(self.maxset)}"
        if self.open_:
            said += f" and perhaps {list_names(self.open_)}"
        said += f"; it takes {' and '.join(map(str, self.asked))}"
        if exceptions:
            said += f", but for {list_names(exceptions)}"
        return said

    def _exceptions(self) -> tuple[Case, ...]:
        """The things that refute it: those not Q if too few are Q, else those Q."""
        if self.p != REFUTED:
            return ()
        k, n = len(self.refset), len(self.maxset)
        failing = [one for one in self.asked if not one.is_met_by(k, n)]
        return self.compset if failing and failing[0].is_lower_bound else self.refset


def list_names(cases: tuple[Case, ...]) -> str:
    """The first of some things, by their names."""
    names = ", ".join(notation(it.sit) for it in cases[:SHOWN])
    return names + ", …" * (len(cases) > SHOWN)


@within_budget
def quantify(
    q: Determiner, P: Extension, Q: Extension, thresholds: Thresholds | None = None, /
) -> Quantification:
    """Are so many of one extension in the other? Only what is in P is looked at.

    What is uncertain of different things is taken as independent. Raises
    `UndefinedError` where q asks for a share, as `most` does, and nothing is P.

    >>> from ttr.semantics.quantifiers import every, most
    >>> dogs = Extension.of(["fido", "rex", "sam"], "dog")
    >>> barkers = Extension.of(["fido", "sam", "kim"], "bark")
    >>> print(quantify(most, dogs, barkers).witness["X"])
    {fido, sam}
    >>> print(quantify(every, dogs, barkers).why)
    ✗ nothing : every(dog, bark)   (2 of 3; it takes all, but for rex)
    >>> print(quantify(most, dogs, Extension.of(["fido", ("rex", 0.5)])).p)
    0.5
    """
    if not isinstance(q, Determiner):
        raise TTRError(f"this is no quantifier, found {kind_of(q)}")
    for one in (P, Q):
        if not isinstance(one, Extension):
            raise TTRError(f"a quantifier counts two extensions, found {kind_of(one)}")
    found = split_by(P.members, Q.members)
    return _quantification(q(P.property, Q.property), found, thresholds_of(thresholds))


@within_budget
def settle(
    M: Model, T: TypeNode, thresholds: Thresholds | None = None, /
) -> Quantification:
    """Is q(P, Q) true in a model? The extension of P is listed, and Q asked of each.

    Raises `UndefinedError` where q asks for a share, as `most` does, and nothing is P;
    `IllFormedError` for a type that is not quantified.

    >>> from ttr import Ind, Pred
    >>> from ttr.semantics.quantifiers import every
    >>> dog, bark = Pred("dog", Ind), Pred("bark", Ind)
    >>> M = Model().given("fido", Ind).given("s1", dog("fido"))
    >>> M = M.given("s2", bark("fido"))
    >>> print(settle(M, every(dog, bark)).witness)
    {X = {fido}, f = [{e = s2, x = fido}]}
    """
    quantified = as_quantified(T)
    P, Q = properties(quantified)
    chosen = thresholds_of(thresholds)
    members = extension(M, P, chosen).members
    if members and _domain(P) is not _domain(Q):
        in_domain(M, Q, next(iter(members.values())).sit)
    others = members
    if P is not Q:
        each = members.items()
        others = {key: member(M, Q, one.sit, chosen) for key, one in each}
    return _quantification(quantified, split_by(members, others), chosen)


@truth_of_quantified.provided_by
def _truth(M: Model, T: PType, thresholds: Thresholds) -> Truth:
    return settle(M, T, thresholds).truth


def _domain(P: Property) -> object:
    return P.domain if isinstance(P, Function) else P


def _quantification(T: PType, found: Split, thresholds: Thresholds) -> Quantification:
    asked = threshold_of(T, thresholds)
    if not found.P and any(one.presupposes for one in asked):
        P, _ = properties(T)
        raise UndefinedError(
            f"{T} is neither true nor false: it asks for a share, and nothing is of {P}"
        )
    sure = len(found.inside), len(found.outside)
    chances = [it.chances for it in found.cases(found.open_)]
    p = chance_of(asked, sure, chances)
    each = found.atoms
    atoms = frozenset[Hashable]().union(*each)
    if len(atoms) < sum(map(len, each)) and p not in (CERTAIN, REFUTED):
        p = UNKNOWN
    return Quantification(T, asked, p, atoms, found)
