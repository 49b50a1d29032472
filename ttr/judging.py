"""Deriving a judgement: a : T from the facts, with the derivation as its reason."""

from __future__ import annotations

from collections.abc import Iterator
from typing import assert_never

from ttr.assignments import Assignment, Atom
from ttr.axioms import above
from ttr.judgements import Claim, Why
from ttr.levels import why_outside
from ttr.probability import CERTAIN, REFUTED, Degree, conjunction
from ttr.substitution import Around, Unresolved, grounded
from ttr.syntax import (
    Basic,
    ListOf,
    Meet,
    Object,
    PType,
    Record,
    RecordType,
    Singleton,
    TypeNode,
    Universe,
    identity,
)

__all__ = ["derivation"]


def derivation(facts: Assignment, sit: Object, T: TypeNode) -> Why:
    """How probable sit : T is by the facts, and why.

    An atom has the degree the facts give it. What is made of parts is as probable as
    its distinct atoms together: an atom that another one entails adds nothing, and
    the others are independent.
    """
    return _Derivation(facts).of(sit, T, (), "")


class _Derivation:
    """Derives claims; `around` are the records around a field, innermost first."""

    def __init__(self, facts: Assignment) -> None:
        self._facts = facts

    def of(self, sit: Object, T: TypeNode, around: Around, where: str) -> Why:
        match T:
            case Basic() | PType():
                return self._atom(sit, T, around, where)
            case Singleton():
                return self._singleton(sit, T, around, where)
            case Meet(parts):
                grounds = [self.of(sit, part, around, "") for part in parts]
                return self._all(sit, T, "each part", grounds, where)
            case ListOf(item):
                return self._list(sit, T, item, around, where)
            case RecordType():
                return self._record(sit, T, around, where)
            case Universe():
                outside = why_outside(sit, T)
                p = REFUTED if outside else CERTAIN
                return Why(sit, T, p, outside or "by its form", where=where)
        raise assert_never(T)  # type: ignore[arg-type]

    def _atom(self, sit: Object, T: Atom, around: Around, where: str) -> Why:
        try:
            ground: Atom = grounded(T, around)
        except Unresolved as unresolved:
            return Why(sit, T, REFUTED, unresolved.message, where=where)
        p, rule = self._facts.degree_of(sit, ground)
        return Why(sit, ground, p, rule, where=where, atom=(identity(sit), ground))

    def _singleton(self, sit: Object, T: Singleton, around: Around, where: str) -> Why:
        try:
            wanted = grounded(T.value, around)
        except Unresolved as unresolved:
            return Why(sit, T, REFUTED, unresolved.message, where=where)
        ground = Singleton(T.base, wanted)
        if identity(sit) != identity(wanted):
            return Why(sit, ground, REFUTED, "it is another object", where=where)
        base = self.of(sit, T.base, around, "")
        return self._all(sit, ground, "it is that object", [base], where)

    def _list(
        self, sit: Object, T: ListOf, item: TypeNode, around: Around, where: str
    ) -> Why:
        if not isinstance(sit, tuple):
            return Why(sit, T, REFUTED, "it is no list", where=where)
        grounds = [self.of(element, item, around, "") for element in sit]
        return self._all(sit, T, "each element", grounds, where)

    def _record(self, sit: Object, T: RecordType, around: Around, where: str) -> Why:
        if not isinstance(sit, Record):
            return Why(sit, T, REFUTED, "it is no record", where=where)
        inside = (sit._fields, *around)
        grounds = [
            self.of(sit._fields[label], field, inside, label)
            if label in sit
            else Why(sit, field, REFUTED, f"there is no {label}", where=label)
            for label, field in T.fields
        ]
        return self._all(sit, T, "field by field", grounds, where)

    def _all(
        self, sit: Object, T: TypeNode, rule: str, grounds: list[Why], where: str
    ) -> Why:
        """A claim that holds where all its grounds do."""
        return Why(sit, T, self._joint(grounds), rule, tuple(grounds), where)

    def _joint(self, grounds: list[Why]) -> Degree:
        if all(ground.p == CERTAIN for ground in grounds):
            return CERTAIN
        if any(ground.p == REFUTED for ground in grounds):
            return REFUTED
        atoms = {atom: p for ground in grounds for atom, p in ground.atoms()}
        uncertain = {atom: p for atom, p in atoms.items() if p != CERTAIN}
        return conjunction(uncertain[atom] for atom in self._strongest(uncertain))

    def _strongest(self, atoms: dict[Claim, Degree]) -> Iterator[Claim]:
        """The atoms that no other one entails, and one of those that say the same."""
        axioms = self._facts.theory.axioms
        entails = {
            (sit, T): {(sit, upper) for _, upper in above(T, axioms)}
            for sit, T in atoms
        }
        stronger: dict[Claim, set[Claim]] = {}
        for atom in atoms:
            for weaker in entails[atom]:
                stronger.setdefault(weaker, set()).add(atom)
        kept: set[Claim] = set()
        for atom in atoms:
            same = entails[atom] & stronger.get(atom, set())
            if stronger.get(atom, set()) <= same and not same & kept:
                kept.add(atom)
                yield atom
