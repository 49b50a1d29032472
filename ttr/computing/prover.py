"""Is a term of a type for sure, whatever is judged to be of what?

The term is a place in an arbitrary witness, or an object. The rules follow the form of
the type that is asked for; what is not derivable by them is not sure, and then it is
said what speaks against it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import combinations_with_replacement
from typing import assert_never

from ttr.computing.case_analysis import Clause, cases, clauses
from ttr.computing.generic_witness import Assumption, Hypothetical
from ttr.computing.strings.automata import automaton, automaton_above
from ttr.computing.strings.inclusion import Inclusion, included
from ttr.computing.strings.pieces import events_of, is_of_strings, is_regular
from ttr.computing.strings.runs import covers
from ttr.computing.universe_levels import why_outside
from ttr.computing.witness_places import (
    ITSELF,
    element,
    elements,
    event,
    instantiated,
    step,
    unpacked,
)
from ttr.errors import Unsupported
from ttr.safety.budgets import spend
from ttr.signature.axioms import above, excluding
from ttr.signature.signature import Signature
from ttr.types.paths import escaping, replace_paths
from ttr.types.printing import notation
from ttr.types.syntax import (
    Application,
    Basic,
    EventString,
    FiniteSet,
    Function,
    FunType,
    Join,
    ListOf,
    Meet,
    Negation,
    NonEmpty,
    Object,
    Operation,
    Path,
    Plus,
    PType,
    Record,
    RecordType,
    SetOf,
    Singleton,
    Str,
    TypeNode,
    Universe,
    identity,
    join,
    meet,
)

__all__ = ["Finding", "Question"]

ASSUMPTIONS = 24
"""How many things may be assumed, one inside another, before a question is left."""


@dataclass(frozen=True)
class Finding:
    """Whether something is derivable, why or why not, and what was assumed for that."""

    yes: bool
    why: str = ""
    assumed: tuple[Assumption, ...] = ()


_YES = Finding(True)

Where = tuple[str, ...]
"""The labels from the witness to the field that a question is about."""


@dataclass(frozen=True)
class Question:
    """What is sure of an arbitrary witness of S, under axioms and assumptions?

    `given` are the elements of lists and sets that the question is about. `judged` says
    of which types an object certainly is, where there is a model to ask. `divided` are
    the strings about whose events the question is.
    """

    S: TypeNode
    theory: Signature
    witness: Hypothetical
    assumed: tuple[Assumption, ...] = ()
    given: frozenset[Path] = frozenset()
    judged: Callable[[Object, TypeNode], bool] | None = None
    divided: frozenset[object] = frozenset()

    @classmethod
    def about(cls, S: TypeNode, theory: Signature) -> Question:
        """The question about an arbitrary witness of S."""
        return cls(S, theory, Hypothetical(S))

    def assuming(self, *more: Assumption) -> Question:
        """The same question where also these terms are of these types."""
        assumed = (*self.assumed, *more)
        return replace(self, witness=Hypothetical(self.S, assumed), assumed=assumed)

    @property
    def impossible(self) -> bool:
        """Whether there can be no such witness, as far as that is derivable."""
        return self._misfit or self._denies or self._lacks_string

    @property
    def _denies(self) -> bool:
        """Whether something is surely of a type that is denied of it."""
        negated = self.witness.negated(self.given)
        return any(self.ask(term, T).yes for term, T in negated)

    @property
    def _lacks_string(self) -> bool:
        """Whether no string is of all that is claimed of what this is last about."""
        terms = [term for term, _ in self.assumed[-1:]] or self.witness.strings
        return any(map(self._is_no_string, map(self.witness.normal, terms)))

    def _is_no_string(self, term: Object) -> bool:
        """Whether no string is of all the types known of a term, event by event."""
        known = self._known_strings(term)
        if known is None or identity(term) in self.divided:
            return False
        if isinstance(known, Str) and events_of(known) is not None:
            return False
        inside = self._dividing(term)
        with suppress(Unsupported):
            return included(automaton_above(known), None, inside._is_below).yes
        return False

    @property
    def _misfit(self) -> bool:
        """Whether by their form there can be no such things as it is about."""
        absent = map(self.witness.is_absent, self.given)
        return self.witness.impossible or any(absent) or self._excluded()

    def _excluded(self) -> bool:
        """Whether something would have to be of two types that exclude each other."""
        if not self.theory.exclusions:
            return False
        return any(
            excluding(one, other, self.theory)
            for atoms in self.witness.atoms(self.given)
            for one, other in combinations_with_replacement(atoms, 2)
        )

    def ask(self, term: Object, T: TypeNode, where: Where = ()) -> Finding:
        """Is a term of T for sure? T's paths start where the whole witness stands."""
        spend()
        term = self.witness.normal(term)
        known = self._known(term)
        if any(one is T for one in known):
            return _YES
        if self.judged and _is_closed(term, T) and self.judged(term, T):
            return _YES
        found = self._by_form(term, T, where)
        if found.yes or self._in_each_case(term, T, known):
            return _YES if not found.yes else found
        if isinstance(term, Application) and self._by_function(term, T):
            return _YES
        return found

    def _by_form(self, term: Object, T: TypeNode, where: Where) -> Finding:
        match T:
            case Basic() | PType():
                return self._atom(term, T, where)
            case Singleton(base, value):
                return self._singleton(term, base, value, where)
            case Meet(parts):
                return _every(self.ask(term, part, where) for part in parts)
            case Join() | Negation():
                return self._clauses(term, T, where)
            case ListOf(item) | NonEmpty(item) | SetOf(item):
                return self._collection(term, T, item, where)
            case Str() | Plus():
                return self._string(term, T, where)
            case FunType():
                return self._function(term, T, where)
            case RecordType():
                return self._record(term, T, where)
            case Universe():
                return self._universe(term, T, where)
            case Application():
                return self._application(term, T, where)
        raise assert_never(T)  # type: ignore[arg-type]

    # --- atoms, singletons, types of types ---

    def _atom(self, term: Object, T: Basic | PType, where: Where) -> Finding:
        wanted = self.witness.normal(T)
        for known in self._known(term):
            if known is wanted:
                return _YES
            if not isinstance(known, Basic | PType):
                continue
            for axiom, upper in above(known, self.theory.axioms):
                if upper is wanted:
                    return Finding(True, f"by the axiom {axiom}")
        if isinstance(term, Operation) and term.name == "fst":
            return self._first(term, T, where)
        return self._not_below(term, wanted, where)

    def _first(self, term: Operation, T: TypeNode, where: Where) -> Finding:
        """The first element of a list is of what all its elements are of."""
        (source,) = term.args
        if not isinstance(source, Path) or not self._has_first(source):
            return self._not_below(term, T, where)
        place = element(source)
        return replace(self, given=self.given | {place}).ask(place, T, where)

    def _has_first(self, source: Object) -> bool:
        return any(isinstance(known, NonEmpty) for known in self._known(source))

    def _singleton(
        self, term: Object, base: TypeNode, value: Object, where: Where
    ) -> Finding:
        wanted = self._worked_out(self.witness.normal(value))
        if self.witness.same(term, wanted):
            return self.ask(term, base, where)
        one = ".".join(where) or f"a witness of {self.S}"
        return _no(where, f"{one} need not be {self._shown(wanted)}")

    def _universe(self, term: Object, T: Universe, where: Where) -> Finding:
        if isinstance(term, TypeNode) and not isinstance(term, Application):
            outside = why_outside(term, T)
            return _no(where, f"{self._shown(term)}: {outside}") if outside else _YES
        for known in self._known(term):
            if isinstance(known, Universe) and _is_among(known, T):
                return _YES
        return self._not_below(term, T, where)

    # --- joins and negations ---

    def _clauses(self, term: Object, T: TypeNode, where: Where) -> Finding:
        found = clauses(T)
        if found is None:
            return _no(where, f"{self._shown(T)} has too many cases")
        return _every(self._clause(term, clause, T, where) for clause in found)

    def _clause(
        self, term: Object, clause: Clause, T: TypeNode, where: Where
    ) -> Finding:
        """Is the term of one of the types? What is denied of it may be assumed."""
        plain = [part for part in clause if not isinstance(part, Negation)]
        denied = [part for part in clause if isinstance(part, Negation)]
        known = self._known(term)
        if any(self.witness.normal(part) in known for part in denied):
            return _YES
        found = self._one_of(term, plain, where)
        if found.yes:
            return _YES
        further = self._further([(term, part.body) for part in denied])
        if further is not self:
            if further.impossible:
                return _YES
            found = further._one_of(term, plain, ())
        if found.yes:
            return _YES
        why_not = self._not_below(term, T, where)
        return replace(why_not, assumed=found.assumed or further.assumed)

    def _one_of(self, term: Object, parts: list[TypeNode], where: Where) -> Finding:
        """Is the term of one of the types, or a string of one or another of them?"""
        if any(self.ask(term, part, where).yes for part in parts):
            return _YES
        strings = [part for part in parts if is_of_strings(part)]
        return self._strings(term, join(*strings)) if strings else Finding(False)

    def _further(self, assumptions: Iterable[Assumption]) -> Question:
        """The question under what is not assumed yet; the same one if that is nothing.

        It is the same one, too, where too much is assumed already.
        """
        so_far = {(identity(term), T) for term, T in self.assumed}
        new = [
            (term, T) for term, T in assumptions if (identity(term), T) not in so_far
        ]
        if not new or len(self.assumed) >= ASSUMPTIONS:
            return self
        return self.assuming(*new)

    def _in_each_case(self, term: Object, T: TypeNode, known: list[TypeNode]) -> bool:
        """Whether the term is of a join, and of T whichever part it is of."""
        for one in known:
            if not isinstance(one, Join):
                continue
            further = [self._further([(term, case)]) for case in _cases(one)]
            if self in further:
                continue
            if all(case.impossible or case.ask(term, T).yes for case in further):
                return True
        return False

    # --- lists, sets and strings ---

    def _collection(
        self,
        term: Object,
        T: ListOf | NonEmpty | SetOf,
        item: TypeNode,
        where: Where,
    ) -> Finding:
        if isinstance(term, Operation):
            return self._computed_list(term, T, where)
        written = _written(term, T)
        if written is not None:
            return _every(self.ask(one, item, where) for one in written)
        if not any(isinstance(known, _BELOW[type(T)]) for known in self._known(term)):
            return self._not_below(term, T, where)
        if not isinstance(term, Path):
            return self._elementwise(term, T, where)
        place = element(term)
        inside = replace(self, given=self.given | {place})
        if inside._misfit or (place not in self.given and inside.impossible):
            return _YES
        return inside.ask(place, item, where)

    def _elementwise(
        self, term: Object, T: ListOf | NonEmpty | SetOf, where: Where
    ) -> Finding:
        """Of what a function gives: is what its elements are of below T's?"""
        one = self._fresh()
        for known in self._known(term):
            if not isinstance(known, ListOf | NonEmpty | SetOf):
                continue
            fits = isinstance(known, _BELOW[type(T)])
            if fits and self._where(one, known.item, _asks(one, T.item)).yes:
                return _YES
        return self._not_below(term, T, where)

    def _computed_list(
        self, term: Operation, T: ListOf | NonEmpty | SetOf, where: Where
    ) -> Finding:
        if isinstance(T, SetOf) or term.name == "fst":
            return self._not_below(term, T, where)
        there = self._known(term) or self._has_first(term.args[0])
        if term.name == "rst" and not there:
            return self._not_below(term, T, where)
        whole = ListOf(T.item)
        found = _every(self.ask(part, whole, where) for part in term.args)
        if not found.yes or isinstance(T, ListOf):
            return found
        if term.name == "+" and any(self.ask(part, T).yes for part in term.args):
            return _YES
        return self._not_below(term, T, where)

    def _string(self, term: Object, T: Str | Plus, where: Where) -> Finding:
        events = self._events(term)
        if events is not None:
            found = automaton(T)
            if covers(len(events), found, lambda i, U: self.ask(events[i], U).yes):
                return _YES
        included = self._strings(term, T)
        if included.yes:
            return included
        return replace(self._not_below(term, T, where), assumed=included.assumed)

    def _events(self, term: Object) -> Sequence[Object] | None:
        """The events of a string, or None where it is not known how many they are."""
        if isinstance(term, EventString):
            return term.items
        strings = [T for T in self._known(term) if isinstance(T, Str)]
        lengths = [len(items) for T in strings if (items := events_of(T)) is not None]
        if not lengths or not isinstance(term, Path):
            return None
        return [event(term, number) for number in range(lengths[0])]

    def _strings(self, term: Object, T: TypeNode) -> Finding:
        """Is every string of what is known of a term one of T, event by event?

        What is asked of part of a string as a whole is taken as that first, and then as
        what it is made of. If not, a string that may speak against it is assumed.
        """
        known = self._known_strings(term)
        if known is None or identity(term) in self.divided:
            return Finding(False)
        inside = self._dividing(term)
        found = Inclusion(False)
        with suppress(Unsupported):
            above = automaton(T)
            for one in (automaton, automaton_above):
                found = included(one(known), above, inside._is_below)
                if found.yes:
                    return _YES
        if found.against is None:
            return Finding(False)
        return Finding(False, "", (*self.assumed, (term, Str(*found.against))))

    def _dividing(self, term: Object) -> Question:
        """The question about the events of a string; not about the string once more."""
        return replace(self, divided=self.divided | {identity(term)})

    def _known_strings(self, term: Object) -> TypeNode | None:
        """What strings a term may be, as one type; None where it need not be one."""
        known = self._known(term)
        strings = [T for T in known if is_of_strings(T)]
        if not strings:
            return None
        denied = [T for T in known if isinstance(T, Negation) and is_regular(T.body)]
        return meet(*strings, *denied)

    def _is_below(self, S: TypeNode, types: tuple[TypeNode, ...]) -> bool:
        """Whether an event of a type surely is of one of some others.

        Of none only if there can be no such event.
        """
        if len(self.assumed) >= ASSUMPTIONS:
            return False
        one = self._fresh()
        further = [self.assuming((one, case)) for case in _cases(S)]
        return all(
            q._misfit or q._denies or (bool(types) and q.ask(one, join(*types)).yes)
            for q in further
        )

    # --- functions ---

    def _function(self, term: Object, T: FunType, where: Where) -> Finding:
        if isinstance(term, Function):
            return self._maps(term.domain, term.body, T, where)
        for known in self._known(term):
            if isinstance(known, FunType) and self._covers(known, T).yes:
                return _YES
        return self._not_below(term, T, where)

    def _maps(
        self, domain: TypeNode, body: Object, T: FunType, where: Where
    ) -> Finding:
        """Is the function defined for all of T's domain, its values of T's result?"""
        x = self._fresh()

        def mapped(q: Question) -> Finding:
            inside = q.ask(x, domain, where)
            value = instantiated(body, x)
            return (
                q.ask(value, instantiated(T.result, x), where) if inside.yes else inside
            )

        return self._where(x, T.domain, mapped)

    def _covers(self, known: FunType, T: FunType) -> Finding:
        """Is every function of the known type one of T?"""
        x = self._fresh()

        def covered(q: Question) -> Finding:
            inside = q.ask(x, known.domain)
            if not inside.yes:
                return inside
            y = q._fresh()
            result = instantiated(T.result, x)
            return q._where(
                y, instantiated(known.result, x), lambda r: r.ask(y, result)
            )

        return self._where(x, T.domain, covered)

    def _fresh(self) -> Path:
        """A place that nothing is known of yet."""
        return Path(0, (f"{ITSELF.labels[0]}{len(self.assumed)}",))

    def _where(
        self, place: Path, S: TypeNode, asked: Callable[[Question], Finding]
    ) -> Finding:
        """What is found in every case where something of S is at a place."""
        if len(self.assumed) >= ASSUMPTIONS:
            return Finding(False, "this nests too deep to be followed")
        further = [self.assuming((place, case)) for case in _cases(S)]
        return _every(asked(q) for q in further if not q._misfit)

    def _by_function(self, term: Application, T: TypeNode) -> bool:
        """Whether what a function of a known type gives for an argument is of T."""
        for known in self._known(term.function):
            if not isinstance(known, FunType):
                continue
            result = instantiated(known.result, term.argument)
            further = self._further([(term, result)])
            inside = further is not self and self.ask(term.argument, known.domain).yes
            if inside and further.ask(term, T).yes:
                return True
        return False

    def _application(self, term: Object, T: Application, where: Where) -> Finding:
        wanted = self.witness.normal(T)
        if any(known is wanted for known in self._known(term)):
            return _YES
        value = self._worked_out(wanted)
        if isinstance(value, TypeNode) and value is not wanted:
            return self.ask(term, value, where)
        return self._not_below(term, wanted, where)

    def _worked_out(self, value: Object) -> Object:
        """What an application gives, if the argument surely is in the domain."""
        while isinstance(value, Application) and isinstance(value.function, Function):
            function, argument = value.function, value.argument
            if not self.ask(argument, function.domain).yes:
                return value
            value = self.witness.normal(instantiated(function.body, argument))
        return value

    # --- records ---

    def _record(self, term: Object, T: RecordType, where: Where) -> Finding:
        known = [R for R in self._known(term) if isinstance(R, RecordType)]
        if not known and not isinstance(term, Record):
            return self._not_below(term, T, where)
        for label, field in T.fields:
            if isinstance(term, Record) and label in term:
                inner = term[label]
            elif isinstance(term, Path) and any(label in R for R in known):
                inner = step(term, label)
            else:
                return _no(where, f"{self._types(term)} has no field {label}")
            found = self.ask(inner, unpacked(field, term), (*where, label))
            if not found.yes:
                return found
        return _YES

    # --- what is known, in words ---

    def _known(self, term: Object) -> list[TypeNode]:
        return self.witness.types_of(term, self.given)

    def _not_below(self, term: Object, T: TypeNode, where: Where) -> Finding:
        return _no(where, f"{self._types(term)} is not below {self._shown(T)}")

    def _types(self, term: Object) -> str:
        """What is known of a term, as one type, for a reason."""
        known = self._known(term)
        return " /\\ ".join(map(self._shown, known)) or self._shown(term)

    def _shown(self, value: Object) -> str:
        """The notation of a value, its places written as paths from the witness."""
        labels = frozenset(self.S.labels if isinstance(self.S, RecordType) else ())
        return notation(replace_paths(value, _from_witness), (labels,))


_BELOW: dict[type[TypeNode], tuple[type[TypeNode], ...]] = {
    ListOf: (ListOf, NonEmpty),
    NonEmpty: (NonEmpty,),
    SetOf: (SetOf,),
}
"""Which types of collections a type of collections is above."""


def _written(term: Object, T: ListOf | NonEmpty | SetOf) -> tuple[Object, ...] | None:
    """The elements of an object that is such a collection; None if it is none."""
    kind = FiniteSet if isinstance(T, SetOf) else tuple
    inside = elements(term) if isinstance(term, kind) else None
    return None if isinstance(T, NonEmpty) and not inside else inside


def _asks(term: Object, T: TypeNode) -> Callable[[Question], Finding]:
    return lambda question: question.ask(term, T)


def _is_closed(term: Object, T: TypeNode) -> bool:
    """Whether a model can be asked of the term; functions are asked of it here."""
    return not (isinstance(T, FunType) or escaping(term) or escaping(T))


def _cases(T: TypeNode) -> tuple[TypeNode, ...]:
    """The cases of a type; where they are too many, the type itself."""
    return cases(T) or (T,)


def _from_witness(place: Path) -> Path:
    inside = place.labels[: len(ITSELF.labels)] == ITSELF.labels
    return Path(place.up, place.labels[inside:] or place.labels)


def _no(where: Where, why: str) -> Finding:
    return Finding(False, f"in the field {'.'.join(where)}, {why}" if where else why)


def _every(findings: Iterable[Finding]) -> Finding:
    """The finding where all must be yes: the first that is not."""
    return next((found for found in findings if not found.yes), _YES)


def _is_among(U: Universe, T: Universe) -> bool:
    """Whether the types of the one are among those of the other."""
    return U.level <= T.level and T.name in ("Type", U.name)
