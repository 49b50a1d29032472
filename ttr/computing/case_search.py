"""Looking for a case of a type that is not ruled out, without going through them all.

A case of S takes one part of every join in S. There are exponentially many, and most
are ruled out for the same few reasons. So S becomes clauses whose literals say of what
is at a place that it is of a type; a search that learns from its dead ends finds what
makes them true; and what else rules out a case, such as the fields of record types, is
learned as one more clause.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence, Set
from dataclasses import dataclass, field
from itertools import combinations_with_replacement
from typing import TypeAlias

from ttr.computing.case_analysis import has_cases
from ttr.computing.normal_forms import push_negations_inwards
from ttr.computing.satisfiability import Search
from ttr.computing.strings.pieces import events_of
from ttr.safety.budgets import spend
from ttr.signature.axioms import find_exclusion, supertype_set
from ttr.signature.signature import Signature
from ttr.types.derived_types import order_fields
from ttr.types.syntax import (
    Basic,
    Join,
    Meet,
    Negation,
    PType,
    RecordType,
    Singleton,
    Str,
    TypeNode,
    meet,
)

_Place: TypeAlias = tuple[object, ...]
"""The labels that lead from the whole to a part; also numbers of pieces of strings."""

_Choice: TypeAlias = tuple[_Place, TypeNode]
"""A join at a place, of which one part is chosen."""

_FEW = 3
"""How many choices are learned from as they are; of more, those that matter."""

_ANYTHING = Basic("·")
"""Stands where it does not matter what something is of; no type is written so."""


def open_cases(
    S: TypeNode,
    T: TypeNode | None,
    theory: Signature,
    is_ruled_out: Callable[[TypeNode], bool],
) -> Iterator[TypeNode]:
    """The cases of S that are not ruled out, as far as something of them may not be T.

    A case that says more than one that is ruled out must be ruled out, too. Where T is
    given, nothing that is ruled out may be of S without being of T.

    >>> A, B, C = map(Basic, "ABC")
    >>> print(*open_cases((A | B) & C, None, Signature(), lambda case: False), sep="; ")
    A /\\ C; B /\\ C
    >>> print(*open_cases((A | B) & C, A, Signature(), lambda case: False), sep="; ")
    B /\\ C
    """
    if not has_cases(S):
        if not is_ruled_out(S):
            yield S
        return
    search = _CaseSearch(S, T, theory)
    while True:
        model = search.next_model()
        if model is None:
            return
        case = search.narrow(S, model)
        if is_ruled_out(case.type):
            case = search.narrow(
                S, model, _unneeded_choices(search, S, model, is_ruled_out)
            )
        else:
            yield case.type
        search.block(case)


def is_every_case_ruled_out(
    S: TypeNode,
    T: TypeNode | None,
    theory: Signature,
    is_ruled_out: Callable[[TypeNode], bool],
) -> bool:
    """Are there no open cases?"""
    return next(open_cases(S, T, theory, is_ruled_out), None) is None


@dataclass
class _Case:
    """A case, with the choices that lead to it and what they claim."""

    choices: list[_Choice] = field(default_factory=list)
    claims: dict[int, None] = field(default_factory=dict)
    type: TypeNode = _ANYTHING


def _unneeded_choices(
    search: _CaseSearch,
    S: TypeNode,
    model: Set[int],
    is_ruled_out: Callable[[TypeNode], bool],
) -> Set[_Choice]:
    """Choices of a case without which it is ruled out as well."""
    choices = dict.fromkeys(search.narrow(S, model).choices)
    gone: set[_Choice] = set()
    if len(choices) <= _FEW:
        return gone
    for one in choices:
        if is_ruled_out(search.narrow(S, model, gone | {one}).type):
            gone.add(one)
    return gone


_Formula: TypeAlias = "int | _All | _Some"
"""What clauses are made of: literals, and several formulas together."""


@dataclass(frozen=True)
class _All:
    parts: tuple[_Formula, ...]


@dataclass(frozen=True)
class _Some:
    parts: tuple[_Formula, ...]


class _CaseSearch:
    """The clauses for: something of S, which is not of T where that is given."""

    def __init__(self, S: TypeNode, T: TypeNode | None, theory: Signature) -> None:
        self._variables: dict[tuple[_Place, TypeNode], int] = {}
        self._used = 0
        self._formulas: dict[tuple[_Place, TypeNode, bool], _Formula] = {}
        self._labels: dict[_Place, set[str]] = {}
        self._search = Search()
        self._add(self._formula(S, (), is_sure=True), ())
        if T is not None:
            self._add(self._denial(T, ()), ())
        if theory.axioms or theory.exclusions:
            for clause in _consequences(self._variables, theory):
                self._search.add(clause)

    def next_model(self) -> Set[int] | None:
        """The literals of a case that no clause rules out, or None."""
        return self._search.solve()

    def block(self, case: _Case) -> None:
        """Rule out whatever makes the same claims as a case."""
        self._search.add([-claim for claim in case.claims])

    def narrow(
        self, T: TypeNode, model: Set[int], without: Set[_Choice] = frozenset()
    ) -> _Case:
        """The case of T that a model has, where some choices are left out."""
        case = _Case()
        found = self._narrow(T, (), model, without, case)
        case.type = _ANYTHING if found is None else found
        return case

    # --- from types to clauses ---

    def _literal(self, place: _Place, T: TypeNode) -> int:
        known = self._variables.get((place, T))
        if known is None:
            known = self._variables[place, T] = self._new()
        return known

    def _new(self) -> int:
        self._used += 1
        return self._used

    def _formula(self, T: TypeNode, place: _Place, is_sure: bool = False) -> _Formula:
        """What is at a place is of T. If that is sure, its labels are noted."""
        spend(1 + len(place) // 4)
        if is_sure and isinstance(T, RecordType):
            self._labels.setdefault(place, set()).update(T.labels)
            inner = [self._formula(U, (*place, k), True) for k, U in T.fields]
            return _All(tuple(inner))
        if is_sure and isinstance(T, Meet):
            return _All(tuple([self._formula(U, place, True) for U in T.parts]))
        known = self._formulas.get((place, T, True))
        if known is None:
            known = self._formulas[place, T, True] = self._claim(T, place)
        return known

    def _claim(self, T: TypeNode, place: _Place) -> _Formula:
        match T:
            case Negation(Negation() | Meet() | Join()):
                return self._formula(push_negations_inwards(T), place)
            case Negation(body):
                return self._denial(body, place)
            case Meet(parts):
                return _All(tuple([self._formula(U, place) for U in parts]))
            case Join(parts):
                return _Some(tuple([self._formula(U, place) for U in parts]))
        if not has_cases(T):
            return self._literal(place, T)
        inner: list[_Formula] = []
        match T:
            case RecordType(fields):
                inner = [self._formula(U, (*place, k)) for k, U in fields]
            case Singleton(base, _):
                inner = [self._formula(base, place)]
            case Str(items):
                inner = [self._formula(U, at) for U, at in _pieces(T, items, place)]
        # That it has this form is claimed, too, whatever of its parts turns out to
        # matter.
        return _All((self._literal(place, T), *inner))

    def _denial(self, T: TypeNode, place: _Place) -> _Formula:
        """What is at a place is not of T."""
        spend(1 + len(place) // 4)
        known = self._formulas.get((place, T, False))
        if known is None:
            known = self._formulas[place, T, False] = self._deny(T, place)
        return known

    def _deny(self, T: TypeNode, place: _Place) -> _Formula:
        match T:
            case Negation(body):
                return self._formula(body, place)
            case Meet(parts):
                return _Some(tuple([self._denial(U, place) for U in parts]))
            case Join(parts):
                return _All(tuple([self._denial(U, place) for U in parts]))
            case RecordType(fields) if self._surely_has(place, T.labels):
                # What surely has these fields is of T iff they are of their types.
                return _Some(tuple([self._denial(U, (*place, k)) for k, U in fields]))
        return -self._literal(place, T)

    def _surely_has(self, place: _Place, labels: Iterable[str]) -> bool:
        """Is what is at a place surely a record with these labels?"""
        return place in self._labels and self._labels[place].issuperset(labels)

    def _add(self, formula: _Formula, otherwise: Sequence[int]) -> None:
        """Add the clauses for: the formula holds, or else one of these literals."""
        match formula:
            case _All(parts):
                for part in parts:
                    self._add(part, otherwise)
            case _Some():
                literals, implied = [], []
                for part in _alternatives(formula):
                    if isinstance(part, int):
                        literals.append(part)
                    else:
                        chosen = self._new()
                        literals.append(chosen)
                        implied.append((chosen, part))
                self._search.add([*otherwise, *literals])
                for chosen, part in implied:
                    self._add(part, [-chosen])
            case int():
                self._search.add([*otherwise, formula])

    # --- from models to cases ---

    def _narrow(
        self,
        T: TypeNode,
        place: _Place,
        model: Set[int],
        without: Set[_Choice],
        case: _Case,
    ) -> TypeNode | None:
        """T with the part of each join that holds; None if nothing is left of it."""
        spend()

        def inside(U: TypeNode, where: _Place) -> TypeNode:
            found = self._narrow(U, where, model, without, case)
            return _ANYTHING if found is None else found

        if not has_cases(T):
            return T
        match T:
            case Negation():
                pushed = push_negations_inwards(T)
                if pushed is T:
                    return T
                return self._narrow(pushed, place, model, without, case)
            case Join(parts):
                if (place, T) in without:
                    return None
                case.choices.append((place, T))
                part, formula = self._first_that_holds(parts, place, model)
                case.claims.update(dict.fromkeys(_literals(formula)))
                return self._narrow(part, place, model, without, case)
            case Meet(parts):
                left = [self._narrow(U, place, model, without, case) for U in parts]
                kept = [one for one in left if one is not None]
                return meet(*kept) if kept else None
            case Singleton(base, value):
                return Singleton(inside(base, place), value)
            case RecordType(fields):
                types = {k: inside(U, (*place, k)) for k, U in fields}
                return RecordType(order_fields(types))
            case Str(items):
                return Str(*[inside(U, at) for U, at in _pieces(T, items, place)])
        return T

    def _first_that_holds(
        self, parts: Iterable[TypeNode], place: _Place, model: Set[int]
    ) -> tuple[TypeNode, _Formula]:
        for part in parts:
            formula = self._formula(part, place)
            if _holds(formula, model):
                return part, formula
        raise AssertionError("a model makes one part of every join hold")


def _pieces(
    T: Str, items: Sequence[TypeNode], place: _Place
) -> Iterator[tuple[TypeNode, _Place]]:
    """The pieces of a string of T, each with a place of its own.

    Types have such a place in common if their strings have as many events.
    """
    whole: object = T if events_of(T) is None else len(items)
    for number, item in enumerate(items):
        yield item, (*place, (whole, number))


def _alternatives(formula: _Some) -> Iterator[_Formula]:
    for part in formula.parts:
        if isinstance(part, _Some):
            yield from _alternatives(part)
        else:
            yield part


def _holds(formula: _Formula, model: Set[int]) -> bool:
    spend()
    match formula:
        case _All(parts):
            return all(_holds(part, model) for part in parts)
        case _Some(parts):
            return any(_holds(part, model) for part in parts)
    return formula in model


def _literals(formula: _Formula) -> Iterator[int]:
    """The literals that are all claimed; those of joins are claimed with their part."""
    match formula:
        case _All(parts):
            for part in parts:
                yield from _literals(part)
        case int():
            yield formula


def _consequences(
    variables: dict[tuple[_Place, TypeNode], int], theory: Signature
) -> Iterator[list[int]]:
    """What the axioms say of the atoms, as clauses."""
    by_place: dict[_Place, list[Basic | PType]] = {}
    for place, T in variables:
        if isinstance(T, Basic | PType):
            by_place.setdefault(place, []).append(T)
    for place, here in by_place.items():
        spend(len(here))
        for S in here:
            above = supertype_set(S, theory)
            for T in here if above else ():
                if T in above:
                    yield [-variables[place, S], variables[place, T]]
        for S, T in combinations_with_replacement(here, 2):
            spend()
            if find_exclusion(S, T, theory):
                yield [-variables[place, S], -variables[place, T]]
