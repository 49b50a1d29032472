"""Is a judgement certain? The clauses of `Evaluator`, without deriving why.

Updates ask this of every rule and state, and mostly the answer is plain from the form
of the type. Law: `is_certain(facts, a, T)` iff the derivation of a : T ends in [1, 1].
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import lru_cache
from operator import is_
from typing import Any, TypeAlias
from weakref import ref

from ttr.errors import RefusedError
from ttr.judging.assignments import Assignment
from ttr.judging.evaluator import Evaluator, derivation
from ttr.judging.judgements import How
from ttr.judging.rule_index import RuleIndex, demands_of
from ttr.judging.stated_dependence import Atom
from ttr.probability import CERTAIN, REFUTED, Degree
from ttr.safety.budgets import spend
from ttr.types.interning import identity
from ttr.types.objects import EventString, Object, Record, UnresolvedError, is_immutable
from ttr.types.paths import subterms
from ttr.types.substitution import Around
from ttr.types.syntax import (
    Basic,
    Function,
    FunType,
    Join,
    ListOf,
    NonEmpty,
    Plus,
    PType,
    RecordType,
    SetOf,
    Singleton,
    Str,
    TypeNode,
    Universe,
)


def is_certain(facts: Assignment, sit: Object, T: TypeNode) -> bool:
    """Is sit : T certain by the facts?

    >>> from ttr import Ind, Model, record, rectype
    >>> M = Model().given("a", Ind)
    >>> is_certain(M.facts, record(x="a"), rectype(x=Ind))
    True
    """
    return _Certainty(facts).of(sit, T, ())


def is_certain_given(
    facts: Assignment, sit: Object, T: TypeNode, known: TypeNode
) -> bool:
    """Is sit : T certain by the facts, given that sit : known certainly holds?

    What the known type says is not judged again. Law: where sit : known is certain,
    the answer is that of `is_certain`.

    >>> from ttr import Ind, Model
    >>> M = Model().given("a", Ind)
    >>> is_certain_given(M.facts, ("a", "a"), NonEmpty(Ind), ListOf(Ind))
    True
    """
    if T is known:
        return True
    certainty = _Certainty(facts)
    for labels, holds, claim in _remainder(T, known):
        value, around = sit, _NOWHERE
        for label in labels:
            fields = value._fields
            if label not in fields:
                return False
            value, around = fields[label], (fields, *around)
        if not holds(certainty, value, claim, around):
            return False
    return True


_NOWHERE: Around = ()
"""The scopes around what is judged as a whole."""


class _Certainty(Evaluator[bool]):
    """Gives whether a claim is certain, without a derivation where it can.

    Records found certain are remembered, and parts of joins that are plainly refuted
    are skipped. What rests on several uncertain judgements is derived.
    """

    def conclude(
        self, sit: Object, T: TypeNode, p: Degree, rule: str, where: str
    ) -> bool:
        return p == CERTAIN

    def combine(
        self,
        sit: Object,
        T: TypeNode,
        around: Around,
        where: str,
        how: How,
        rule: str,
        grounds: Iterable[bool],
    ) -> bool:
        if how == "all":
            return all(grounds)
        return (how == "any" and any(grounds)) or self._derive(sit, T, around)

    def judge_atom(self, sit: Object, T: Atom, where: str) -> bool:
        p, _ = self.facts.degree_of(sit, T)
        if p in (CERTAIN, REFUTED):
            return p == CERTAIN
        return self._derive(sit, T, ())

    def judge_missing(self, label: str, T: TypeNode, around: Around) -> bool:
        return False

    def judge_pieces(
        self, sit: EventString, T: Str | Plus, around: Around, where: str
    ) -> bool:
        return self._derive(sit, T, around)

    def judge_function(self, sit: Function, T: FunType, where: str) -> bool:
        return self._derive(sit, T, ())

    def _derive(self, sit: Object, T: TypeNode, around: Around) -> bool:
        return derivation(self.facts, sit, T, around).p == CERTAIN

    # --- shortcuts ---
    # The forms that most types are made of are judged without passing grounds on.

    def _judge_record(
        self, sit: Object, T: RecordType, around: Around, where: str
    ) -> bool:
        if not isinstance(sit, Record):
            return False
        if sit._noted is not None and _is_remembered(self.facts, sit, T):
            return True
        spend(1 + len(T.fields))
        found, clauses = sit._fields, self._clauses
        inside = (found, *around)
        for label, field in _most_telling_first(T):
            if label not in found:
                return False
            value, form = found[label], type(field)
            if form is ListOf and type(value) is tuple and not value:
                continue  # most lists of a move are empty
            if not clauses[form](self, value, field, inside, label):
                return False
        remember_certain(self.facts, sit, T)
        return True

    def _judge_singleton(
        self, sit: Object, T: Singleton, around: Around, where: str
    ) -> bool:
        spend()
        return self.has_value(sit, T, around) and self.of(sit, T.base, around)

    def _judge_each(
        self,
        sit: Object,
        T: ListOf | NonEmpty | SetOf,
        inside: Sequence[Object],
        around: Around,
        where: str,
    ) -> bool:
        spend(1 + len(inside))
        if not inside:
            return True
        item = T.item
        clause = self._clauses[type(item)]
        return all(clause(self, element, item, around, "") for element in inside)

    def _judge_ptype(self, sit: Object, T: PType, around: Around, where: str) -> bool:
        if not self.facts.can_be(sit, T.pred):
            return False
        return Evaluator._judge_ptype(self, sit, T, around, where)

    def _judge_join(self, sit: Object, T: Join, around: Around, where: str) -> bool:
        left = _index_of_parts(T).possible_demands(sit, self.facts)
        possible = [T.parts[n] for n in left if not self._excludes(sit, T.parts[n])]
        if len(possible) < 2:
            return any(self.of(sit, part, around) for part in possible)
        return self.judge_one_of(sit, T, possible, around, where)

    def _excludes(self, sit: Object, T: TypeNode) -> bool:
        """Is it plain that sit cannot be of T? Where this says no, it may be either."""
        if isinstance(T, PType):
            return not self.facts.can_be(sit, T.pred)
        if not isinstance(T, RecordType):
            return False
        if not isinstance(sit, Record):
            return True
        found = sit._fields
        return any(
            label not in found or self._excludes(found[label], field)
            for label, field in _most_telling_first(T)
        )

    # --- what is left to judge where something is known ---

    def has_value(self, sit: Object, T: Singleton, around: Around) -> bool:
        """Is sit the object that a singleton type is of?"""
        try:
            value = self._value_in(T, around)
        except (UnresolvedError, RefusedError):
            return False
        return value is sit or identity(value) == identity(sit)

    def is_not_empty(self, sit: Object, T: NonEmpty, around: Around) -> bool:
        """Does a list have elements?"""
        return bool(sit)


@lru_cache(4096)
def _most_telling_first(T: RecordType) -> tuple[tuple[str, TypeNode], ...]:
    """The fields of a record type, ptypes first, as those are refuted most often."""
    return tuple(sorted(T.fields, key=lambda field: not isinstance(field[1], PType)))


@lru_cache(4096)
def _index_of_parts(T: Join) -> RuleIndex:
    """An index that finds the parts of a join that an object may be of."""
    return RuleIndex(map(demands_of, T.parts))


Claims: TypeAlias = tuple[
    tuple[tuple[str, ...], Callable[[_Certainty, Object, Any, Around], bool], TypeNode],
    ...,
]
"""For each claim its path, the check to make there, and the type to check for."""


@lru_cache(4096)
def _remainder(T: TypeNode, known: TypeNode) -> Claims:
    """The claims of T that the known type does not make."""
    if T is known:
        return ()
    if isinstance(T, Singleton):
        return ((), _Certainty.has_value, T), *_remainder(T.base, known)
    if isinstance(T, RecordType) and isinstance(known, RecordType):
        return tuple(
            [
                ((label, *labels), holds, claim)
                for label, field in _most_telling_first(T)
                for labels, holds, claim in (
                    _remainder(field, known[label])
                    if label in known
                    else (((), _Certainty.of, field),)
                )
            ]
        )
    lists = ListOf, NonEmpty
    if isinstance(T, lists) and isinstance(known, lists) and T.item is known.item:
        return (((), _Certainty.is_not_empty, T),) if isinstance(T, NonEmpty) else ()
    return (((), _Certainty.of, T),)


# --- what was certain before ---------------------------------------------------------


Grounds: TypeAlias = tuple[object, ...]
"""The witness functions and the facts about some basic types. As long as these are the
same objects, the same records are of types made of those basic types."""


def remember_certain(facts: Assignment, sit: Record, T: RecordType) -> None:
    """Remember that a record is certainly of T, so that it is not judged again."""
    basics = _basics(T)
    if basics is None or not is_immutable(sit) or not _need_no_axioms(facts, basics):
        return
    noted = sit._noted
    if noted is None:
        noted = {}
        object.__setattr__(sit, "_noted", noted)
    noted[T] = _grounds(facts, basics)


def _is_remembered(facts: Assignment, sit: Record, T: RecordType) -> bool:
    grounds = (sit._noted or {}).get(T)
    if grounds is None:
        return False
    functions, *told = grounds
    if functions() is not facts.functions:
        return False
    basics = _basics(T) or ()
    now = map(facts.told.get, basics)
    return all(map(is_, told, now)) and _need_no_axioms(facts, basics)


def _grounds(facts: Assignment, basics: tuple[Basic, ...]) -> Grounds:
    return (ref(facts.functions), *map(facts.told.get, basics))


def _need_no_axioms(facts: Assignment, basics: tuple[Basic, ...]) -> bool:
    """Do facts and witness functions alone, and no axioms, tell what is of these?"""
    return facts.theory.axiom_heads.isdisjoint(basics)


@lru_cache(4096)
def _basics(T: RecordType) -> tuple[Basic, ...] | None:
    """The basic types in a type made of lists, records and universes; else None.

    Its fields may be set to names and to lists of names.
    """
    within = (Basic, Universe, ListOf, RecordType, Singleton, str, tuple)
    found = list(subterms([T]))
    if not all(isinstance(part, within) for part in found):
        return None
    return tuple(part for part in found if isinstance(part, Basic))
