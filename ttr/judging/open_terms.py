r"""Terms of types that speak of variables: the bodies of functions that are made up.

A term of T is put together from what is at hand, as in a proof: a variable of T, a part
of one, what a variable function gives for such a term, or what the form of T asks for.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from ttr.errors import RefusedError
from ttr.judging.assignments import Assignment
from ttr.safety.budgets import spend
from ttr.types.objects import BOUND, FiniteSet, Object, Path, Record
from ttr.types.paths import free_paths, shift_paths
from ttr.types.substitution import field_type, substitute_variable
from ttr.types.syntax import (
    Application,
    Function,
    FunType,
    Join,
    ListOf,
    Meet,
    NonEmpty,
    RecordType,
    SetOf,
    Singleton,
    TypeNode,
)

_DEPTH = 4
"""How many functions may be applied one inside another."""

Made = tuple[Object, Assignment]
"""A term, and the assignment in which the closed parts of it are what they should be.
"""

Variables = tuple[tuple[Object, TypeNode], ...]
"""The variables around and their parts, each with its type."""


@dataclass(frozen=True)
class TermFinder:
    """Finds terms; `make` gives new objects of types that speak of no variable."""

    make: Callable[[Assignment, TypeNode], Made]

    def function(self, facts: Assignment, T: FunType) -> Made:
        """A function of T: its body is a term of T's result."""
        return self._function(facts, T, (), _DEPTH)

    def _term(
        self, facts: Assignment, T: TypeNode, variables: Variables, depth: int
    ) -> Made:
        """A term of T; raises `RefusedError` where none is found."""
        spend()
        for term, kind in variables:
            if kind is T:
                return term, facts
        match T:
            case Singleton(_, value):
                return value, facts
            case FunType():
                return self._function(facts, T, variables, depth)
            case RecordType() if free_paths(T):
                return self._record(facts, T, variables, depth)
            case ListOf():
                return (), facts
            case SetOf():
                return FiniteSet(), facts
            case NonEmpty(item):
                element, facts = self._term(facts, item, variables, depth)
                return (element,), facts
            case Meet(parts) | Join(parts) if free_paths(T):
                return self._first_term(facts, parts, variables, depth)
        if not free_paths(T):
            return self.make(facts, T)
        return self._value(facts, T, variables, depth)

    def _first_term(
        self,
        facts: Assignment,
        parts: tuple[TypeNode, ...],
        variables: Variables,
        depth: int,
    ) -> Made:
        """A term of one of the parts; whether it is of all is not asked here."""
        refused = RefusedError("there is no part")
        for part in sorted(parts, key=lambda T: not isinstance(T, Singleton)):
            try:
                return self._term(facts, part, variables, depth)
            except RefusedError as error:
                refused = error
        raise refused

    def _function(
        self, facts: Assignment, T: FunType, variables: Variables, depth: int
    ) -> Made:
        x = Path(0, (BOUND,))
        outer = [(shift_paths(term, 1), shift_paths(K, 1)) for term, K in variables]
        inner = _with_parts(x, shift_paths(T.domain, 1))
        body, facts = self._term(facts, T.result, (*inner, *outer), depth)
        return Function(T.domain, body), facts

    def _record(
        self, facts: Assignment, T: RecordType, variables: Variables, depth: int
    ) -> Made:
        fields: dict[str, Object] = {}
        for label, field in T.fields:
            ground = field_type(field, Record(fields))
            fields[label], facts = self._term(facts, ground, variables, depth)
        return Record(fields), facts

    def _value(
        self, facts: Assignment, T: TypeNode, variables: Variables, depth: int
    ) -> Made:
        """What a variable function gives for some term, if that is of T."""
        for f, kind in variables if depth > 0 else ():
            if not isinstance(kind, FunType):
                continue
            try:
                return self._apply(facts, f, kind, T, variables, depth - 1)
            except RefusedError:
                continue
        raise RefusedError(f"no term of {T} can be made up")

    def _apply(
        self,
        facts: Assignment,
        f: Object,
        kind: FunType,
        T: TypeNode,
        variables: Variables,
        depth: int,
    ) -> Made:
        argument, facts = self._term(facts, kind.domain, variables, depth)
        result = substitute_variable(kind.result, argument)
        found = Application(f, argument)
        if result is T:
            return found, facts
        if isinstance(result, FunType):
            return self._apply(facts, found, result, T, variables, depth)
        raise RefusedError(f"{found} is of another type")


def _with_parts(term: Object, T: TypeNode) -> Iterator[tuple[Object, TypeNode]]:
    """A variable, and what it has at its labels, each with its type."""
    while isinstance(T, Singleton):
        T = T.base
    yield term, T
    if isinstance(T, RecordType) and isinstance(term, Path):
        for label, field in T.fields:
            inner = Path(term.up, (*term.labels, label))
            yield from _with_parts(inner, field_type(field, term))
