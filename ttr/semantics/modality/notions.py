"""Two notions of what is necessary and possible in a modal system (Cooper 2023).

The restrictive notion looks at types that exist in every possibility. The inclusive
notion looks at every type, but only in the possibilities where it exists.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

from ttr.building.merging import merge_meet
from ttr.computing.subtyping import subtype
from ttr.errors import IllFormedError, RefusedError, UnsupportedError
from ttr.judging.assignments import Assignment
from ttr.judging.propositions import borne_out, claim, probabilistic_claim
from ttr.probability import CERTAIN, REFUTED, UNKNOWN, Degree
from ttr.probability.degrees import frechet_conjunction, frechet_disjunction
from ttr.safety.budgets import spend, within_budget
from ttr.semantics.modality.necessity import (
    ModalAnswer,
    is_modal,
    mentions_modal,
    nec,
    poss,
)
from ttr.signature.axioms import subtypes
from ttr.types.objects import Object, Record, freeze
from ttr.types.paths import subterms
from ttr.types.printing import notation
from ttr.types.syntax import Basic, Join, Meet, PType, RecordType, TypeNode, as_type

if TYPE_CHECKING:
    from ttr.semantics.modality.modal_systems import ModalSystem

_Scope: TypeAlias = (
    "Callable[[ModalSystem, tuple[Object, ...]], tuple[str, ...] | ModalAnswer]"
)
"""Gives the possibilities that a question about values looks at, or its answer."""


def everywhere(
    system: ModalSystem, values: tuple[Object, ...]
) -> tuple[str, ...] | ModalAnswer:
    """Every possibility; the answer no where a value does not exist in one of them."""
    for name in system.names:
        for value in values:
            if not system.has(name, value):
                why = f"{notation(value)} does not exist in {name}"
                return ModalAnswer(REFUTED, why, name)
    return system.names


def where_they_exist(
    system: ModalSystem, values: tuple[Object, ...]
) -> tuple[str, ...]:
    """The possibilities in which all values exist; raises `IllFormedError` for none."""
    found = tuple(
        name
        for name in system.names
        if all(system.has(name, value) for value in values)
    )
    if found:
        return found
    shown = " and ".join(map(notation, values))
    raise IllFormedError(f"no possibility has {shown}, so nothing can be asked of it")


@dataclass(frozen=True, eq=False)
class Notion:
    """Necessity, possibility, subtyping and equivalence over possibilities in scope.

    A proposition is Austinian, or a type, which is true in a possibility where
    something is of it. Where propositions are uncertain, the bounds hold whatever the
    dependence between possibilities.
    """

    system: ModalSystem
    scope: _Scope

    @within_budget
    def necessary(self, proposition: object, /) -> ModalAnswer:
        """□P: is it true in every possibility?

        Bounds: max(0, Σ pᵢ − (n − 1)) to min pᵢ.
        """
        P = freeze(proposition)
        found = self._degrees(P)
        if isinstance(found, ModalAnswer):
            return found
        worst = min(found, key=lambda name: found[name])
        p = frechet_conjunction(*found.values())
        if p == CERTAIN:
            return ModalAnswer(p, _describe_success(P, tuple(found)))
        return ModalAnswer(p, _describe_failure(P, worst, found[worst]), worst)

    @within_budget
    def possible(self, proposition: object, /) -> ModalAnswer:
        """◇P: is it true in some possibility?

        Bounds: max pᵢ to min(1, Σ pᵢ).
        """
        P = freeze(proposition)
        found = self._degrees(P)
        if isinstance(found, ModalAnswer):
            return found
        best = max(found, key=lambda name: found[name])
        p = frechet_disjunction(*found.values())
        if p == REFUTED:
            return ModalAnswer(p, _describe_failure(P, " or ".join(found), p))
        if p == CERTAIN:
            return ModalAnswer(p, _describe_success(P, (best,)), best)
        return ModalAnswer(p, _describe_failure(P, best, found[best]), best)

    @within_budget
    def subtype(self, S: TypeNode, T: TypeNode, /) -> ModalAnswer:
        """Is every witness of S one of T, in every possibility?

        Law: yes where S ⊑ T. Unknown where there may be more witnesses of S than are
        known, and where they cannot be listed.

        >>> from ttr import Basic, Model
        >>> from ttr.semantics.modality import modal_system
        >>> A, B = Basic("A"), Basic("B")
        >>> w = modal_system(w1=Model().given("a", A).given("a", B), w2=Model())
        >>> print(w.restrictive.subtype(A, B))
        yes: all that is of A is of B in w1 and w2
        >>> answer = w.given("w2", "b", A).restrictive.subtype(A, B)
        >>> print(answer)
        no: b is of A, but not of B in w2
        >>> answer.possibility, answer.counter.holds
        ('w2', False)
        """
        S, T = as_type(S), as_type(T)
        names = self.scope(self.system, (S, T))
        if isinstance(names, ModalAnswer):
            return names
        theory = self.system.models[0][1].theory
        if subtype(S, T, theory).yes:
            return ModalAnswer(CERTAIN, f"{S} is below {T} under every assignment")
        found = [self._below(name, S, T) for name in names]
        decided = [answer for answer in found if not answer.yes]
        refuting = [answer for answer in decided if answer.no]
        all_of = f"all that is of {S} is of {T} in {_names_in_words(names)}"
        return next(iter([*refuting, *decided]), ModalAnswer(CERTAIN, all_of))

    def equivalent(self, S: TypeNode, T: TypeNode, /) -> ModalAnswer:
        """Have S and T the same witnesses, in every possibility?"""
        both = [self.subtype(S, T), self.subtype(T, S)]
        failing = [answer for answer in both if not answer.yes]
        refuting = [answer for answer in failing if answer.no]
        same = f"the same is of {S} and of {T}"
        return next(iter([*refuting, *failing]), ModalAnswer(CERTAIN, same))

    def _degrees(self, P: Object) -> dict[str, Degree] | ModalAnswer:
        """How certain P is in each possibility in scope, or why none is in scope."""
        names = self.scope(self.system, (P,))
        if isinstance(names, ModalAnswer):
            return names
        return {name: self._degree_or_unknown(name, P) for name in names}

    def _degree_or_unknown(self, name: str, P: Object) -> Degree:
        """The degree of a proposition in a possibility; [0, 1] if it is undefined."""
        spend()
        try:
            return self._degree(name, P)
        except RefusedError:
            return UNKNOWN

    def _degree(self, name: str, P: Object) -> Degree:
        """The same, but raises `RefusedError` where a function in P is undefined
        there.
        """
        match P:
            case PType(pred, (TypeNode() as inner,)) if pred in (nec, poss):
                asks = self.necessary if pred is nec else self.possible
                return asks(inner).p
            case TypeNode() if is_modal(P):
                return self.system.judge(name, (), P).p
            case TypeNode():
                _refuse_modal(P)
                return self.system[name].true(merge_meet(P))
        sit, T, claimed = probabilistic_claim(P)
        found = self.system.judge(name, sit, T).p
        return borne_out(claimed, found) if "prob" in P else found

    def _below(self, name: str, S: TypeNode, T: TypeNode) -> ModalAnswer:
        """Is every witness of S one of T in this possibility?"""
        model = self.system[name]
        try:
            _refuse_modal(S)
            known = model.witnesses(merge_meet(S))
        except (RefusedError, UnsupportedError) as error:
            return ModalAnswer(UNKNOWN, f"in {name}, {error.message}", name)
        judged = [self.system.judge(name, sit, T) for sit in known]
        for j in judged:
            if j.p == REFUTED:
                why = f"{notation(j.sit)} is of {S}, but not of {T} in {name}"
                return ModalAnswer(REFUTED, why, name, j)
        for j in judged:
            if j.p != CERTAIN:
                why = f"{notation(j.sit)} is of {S}, but may not be of {T} in {name}"
                return ModalAnswer(UNKNOWN, why, name, j)
        if _leaves_open(model.facts, S) or not _lists_all(S, T):
            why = f"more may be of {S} than is known in {name}"
            return ModalAnswer(UNKNOWN, why, name)
        return ModalAnswer(CERTAIN, f"all that is of {S} is of {T} in {name}")


def _refuse_modal(T: TypeNode) -> None:
    """Raise `UnsupportedError` for a type with nec or poss; it has no list of
    witnesses.
    """
    if mentions_modal(T):
        raise UnsupportedError(
            f"what is of {T} cannot be listed, as nec and poss are asked of the system",
            hint="judge a situation",
        )


def _leaves_open(facts: Assignment, T: TypeNode) -> bool:
    """May there be more witnesses of T than are known, also by an axiom?"""
    atoms = [part for part in subterms([T]) if isinstance(part, Basic | PType)]
    lower = [kind for atom in atoms for _, kind in subtypes(atom, facts.theory.axioms)]
    return any(map(facts.leaves_open, (T, *lower)))


def _lists_all(S: TypeNode, T: TypeNode) -> bool:
    """Are the listed records of S all there are, as far as T is concerned?

    Records may have further fields, so there are infinitely many of S; but a flat
    record type says something of each field by itself.
    """
    return not _mentions_records(S) or (_is_flat(merge_meet(S)) and _is_flat(T))


def _is_flat(T: TypeNode) -> bool:
    spend()
    match T:
        case RecordType(fields):
            return not any(_mentions_records(field) for _, field in fields)
        case Meet(parts) | Join(parts):
            return all(map(_is_flat, parts))
    return False


def _mentions_records(T: TypeNode) -> bool:
    return any(isinstance(part, RecordType) for part in subterms([T]))


def _describe_success(P: Object, names: tuple[str, ...]) -> str:
    if isinstance(P, Record):
        sit, T = claim(P)
        return f"{notation(sit)} is of {T} in {_names_in_words(names)}"
    return f"something is of {P} in {_names_in_words(names)}"


def _describe_failure(P: Object, name: str, p: Degree) -> str:
    if isinstance(P, Record):
        sit, T = claim(P)
        fails = f"{notation(sit)} is not of {T}"
        doubt = f"{notation(sit)} may or may not be of {T}"
    else:
        fails, doubt = f"nothing is of {P}", f"something may or may not be of {P}"
    return f"{fails} in {name}" if p == REFUTED else f"{doubt} in {name} (p = {p})"


def _names_in_words(names: tuple[str, ...]) -> str:
    *most, last = names
    return f"{', '.join(most)} and {last}" if most else last
