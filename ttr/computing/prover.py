"""Is a term surely of a type, whatever is judged to be of what?

A `Prover` knows an arbitrary witness of a type, and derives what it is surely of. A
term is a place in the witness, or an object. The rules follow the form of the type that
is asked for. What they do not derive is not sure; the `Finding` then says why not.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from itertools import combinations_with_replacement
from math import prod
from typing import assert_never

from ttr.computing.case_analysis import Clause, cases_or_whole, clauses
from ttr.computing.case_search import is_every_case_ruled_out
from ttr.computing.findings import YES, Finding, Where, every, no
from ttr.computing.generic_witness import (
    ITSELF,
    Assumption,
    GenericWitness,
    element,
    elements,
    event,
    name_place,
    new_place,
    step,
)
from ttr.computing.normal_forms import push_negations_inwards
from ttr.computing.strings.automata import automaton, automaton_above
from ttr.computing.strings.automaton_runs import accepts
from ttr.computing.strings.inclusion import Inclusion, check_inclusion
from ttr.computing.strings.pieces import events_of, is_of_strings, is_regular
from ttr.computing.universe_levels import why_outside
from ttr.errors import UnsupportedError
from ttr.safety.budgets import spend
from ttr.signature.axioms import find_exclusion, supertypes
from ttr.signature.conditional_axioms import Way, ways_to_follow
from ttr.signature.signature import Signature
from ttr.types.interning import identity
from ttr.types.objects import (
    EventString,
    FiniteSet,
    Object,
    Operation,
    Path,
    Record,
    freeze,
)
from ttr.types.paths import (
    free_paths,
    paths_to_types,
    paths_with_arguments,
    replace_paths,
)
from ttr.types.printing import notation
from ttr.types.substitution import field_type, substitute_variable
from ttr.types.syntax import (
    Application,
    Basic,
    Function,
    FunType,
    Join,
    ListOf,
    Meet,
    Merge,
    Negation,
    NonEmpty,
    Plus,
    PType,
    RecordType,
    SetOf,
    Singleton,
    Str,
    TypeAt,
    TypeNode,
    Universe,
    join,
    meet,
)

ASSUMPTIONS = 24
"""How many assumptions may be nested before a question is left open."""

DENIALS = 3
"""How many assumptions there may be where denied record types are taken apart."""

RECORDS = 64
"""In how many ways something may fail to be of any of the record types of a join."""


@dataclass(frozen=True)
class Prover:
    """What is sure of an arbitrary witness of S, under axioms and assumptions.

    `given` are the elements of lists and sets that are taken to be there. `is_judged`
    asks a model, where there is one, whether an object is certainly of a type.
    `inside_strings` are the strings that are being compared event by event, and
    `examined` the function types of which it is being asked whether they are denied.
    """

    S: TypeNode
    theory: Signature
    witness: GenericWitness
    assumed: tuple[Assumption, ...] = ()
    given: frozenset[Path] = frozenset()
    is_judged: Callable[[Object, TypeNode], bool] | None = None
    inside_strings: frozenset[object] = frozenset()
    examined: frozenset[TypeNode] = frozenset()

    @classmethod
    def for_type(cls, S: TypeNode, theory: Signature) -> Prover:
        """The prover for an arbitrary witness of S.

        >>> from ttr import Ind
        >>> Prover.for_type(Ind @ "a", Signature()).prove(ITSELF, Ind).yes
        True
        """
        return cls(S, theory, GenericWitness(S))

    def assume(self, *more: Assumption) -> Prover:
        """The prover that also assumes these terms to be of these types."""
        assumed = (*self.assumed, *more)
        return replace(self, witness=GenericWitness(self.S, assumed), assumed=assumed)

    @property
    def is_impossible(self) -> bool:
        """Is it derivable that there is no such witness?"""
        return self._has_misfit or self._is_contradictory or self._has_no_string

    @property
    def _is_contradictory(self) -> bool:
        """Is something surely of a type that is denied of it?"""
        if not self.witness.has_negations:
            return False
        given = self.given | self.witness.first_elements(self.given)
        inside = self if given == self.given else replace(self, given=given)
        negations = [
            (term, T)
            for term, T in self.witness.negations(given)
            if T not in self.examined
        ]
        functions = {T for _, T in negations if isinstance(T, FunType)}
        apart = replace(inside, examined=self.examined | functions)
        return any(
            (apart if isinstance(T, FunType) else inside).prove(term, T).yes
            for term, T in negations
        )

    def _is_denied(self, place: Path) -> bool:
        """Is something at a place surely of a type that is denied of it?"""
        return any(
            isinstance(term, Path)
            and term.labels[0] == place.labels[0]
            and self.prove(term, T).yes
            for term, T in self.witness.negations(self.given)
        )

    @property
    def _has_no_string(self) -> bool:
        """Is no string of all the types that are claimed of a term?

        Only the term that was assumed last is looked at, where anything is assumed.
        """
        terms = [term for term, _ in self.assumed[-1:]] or self.witness.strings
        return any(map(self._is_no_string, map(self.witness.normalise, terms)))

    def _is_no_string(self, term: Object) -> bool:
        """Is no string of all the types known of a term, event by event?"""
        known = self._string_type_of(term)
        if known is None or identity(term) in self.inside_strings:
            return False
        if isinstance(known, Str) and events_of(known) is not None:
            return False
        inside = self._inside_string(term)
        with suppress(UnsupportedError):
            return check_inclusion(
                automaton_above(known), None, inside._is_event_below
            ).yes
        return False

    @property
    def _has_misfit(self) -> bool:
        """Can there be no such witness or elements, by the form of their types?"""
        absent = map(self.witness.is_absent, self.given)
        return self.witness.is_impossible or any(absent) or self._is_excluded()

    def _is_excluded(self) -> bool:
        """Must something be of two types that exclude each other?"""
        if not self.theory.exclusions:
            return False
        return any(
            find_exclusion(one, other, self.theory)
            for atoms in self.witness.atoms(self.given)
            for one, other in combinations_with_replacement(atoms, 2)
        )

    def prove(self, term: Object, T: TypeNode, where: Where = ()) -> Finding:
        """Is a term surely of T? Paths in T start where the whole witness stands.

        `where` is the field to name in the reason.
        """
        spend()
        term = self._apply_functions(self.witness.normalise(term))
        known = self._types_of(term)
        if any(one is T for one in known):
            return YES
        if self._is_judged_of(term, T):
            return YES
        found = self._prove_by_form(term, T, where)
        if found.yes:
            return found
        if self._follows_in_each_case(term, T, known):
            return YES
        if self._follows_from_denial(term, T, known):
            return YES
        if isinstance(term, Application) and self._follows_from_function(term, T):
            return YES
        return found

    def _is_judged_of(self, term: Object, T: TypeNode) -> bool:
        """Is a term certainly of T in the model, with what places surely are?"""
        if self.is_judged is None:
            return False
        wanted = self.witness.normalise(T)
        return (
            isinstance(wanted, TypeNode)
            and _is_closed(term, wanted)
            and self.is_judged(term, wanted)
        )

    def _prove_by_form(self, term: Object, T: TypeNode, where: Where) -> Finding:
        match T:
            case Basic() | PType():
                return self._prove_atom(term, T, where)
            case Singleton(base, value):
                return self._prove_singleton(term, base, value, where)
            case Meet(parts):
                return every(self.prove(term, part, where) for part in parts)
            case Join() | Negation():
                return self._prove_clauses(term, T, where)
            case ListOf(item) | NonEmpty(item) | SetOf(item):
                return self._prove_collection(term, T, item, where)
            case Str() | Plus():
                return self._prove_string(term, T, where)
            case FunType():
                return self._prove_function(term, T, where)
            case RecordType():
                return self._prove_record(term, T, where)
            case Universe():
                return self._prove_universe(term, T, where)
            case Application():
                return self._prove_application(term, T, where)
            case TypeAt():
                return self._prove_type_at(term, T, where)
        raise assert_never(T)  # type: ignore[arg-type]

    # --- atoms, singletons, types of types ---

    def _prove_atom(self, term: Object, T: Basic | PType, where: Where) -> Finding:
        wanted = self.witness.normalise(T)
        for known in self._types_of(term):
            if known is wanted:
                return YES
            if not isinstance(known, Basic | PType):
                continue
            for axiom, upper in supertypes(known, self.theory.axioms):
                if upper is wanted:
                    return Finding(True, partial("by the axiom {}".format, axiom))
        for way in self._ways_to_follow(term, wanted):
            return Finding(True, partial(_why_by_conditions, way, self.theory))
        if isinstance(term, Operation) and term.name == "fst":
            return self._prove_first(term, T, where)
        return self._not_below(term, wanted, where)

    def _ways_to_follow(self, term: Object, T: Basic | PType) -> Iterator[Way]:
        """The ways in which T follows by axioms whose conditions are derivable."""
        if not self.theory.conditional_axioms:
            return
        known = [K for K in self._types_of(term) if isinstance(K, Basic | PType)]
        for way in ways_to_follow(T, known, self.theory):
            if all(one.compare(self.theory)[0] == "yes" for one in way.conditions):
                yield way

    def _prove_first(self, term: Operation, T: TypeNode, where: Where) -> Finding:
        """The first element of a list is of the type of all its elements."""
        (source,) = term.args
        if not isinstance(source, Path) or not self._has_first(source):
            return self._not_below(term, T, where)
        place = element(source)
        return replace(self, given=self.given | {place}).prove(place, T, where)

    def _has_first(self, source: Object) -> bool:
        return any(isinstance(known, NonEmpty) for known in self._types_of(source))

    def _prove_singleton(
        self, term: Object, base: TypeNode, value: Object, where: Where
    ) -> Finding:
        wanted = self._apply_functions(self.witness.normalise(value))
        if self.witness.are_equal(term, wanted):
            return self.prove(term, base, where)
        return no(where, partial(self._why_not_equal, term, wanted, where))

    def _prove_universe(self, term: Object, T: Universe, where: Where) -> Finding:
        if isinstance(term, Merge):
            return every(self.prove(freeze(part), T, where) for part in term.parts)
        if isinstance(term, TypeNode) and not isinstance(term, Application):
            outside = why_outside(term, T)
            if not outside:
                return self._prove_levels(term, T, where)
            return no(where, lambda: f"{self._format(term)}: {outside}")
        for known in self._types_of(term):
            if isinstance(known, Universe) and _is_among(known, T):
                return YES
        return self._not_below(term, T, where)

    def _prove_levels(self, term: TypeNode, T: Universe, where: Where) -> Finding:
        """Are the types that paths in a type lead to of no higher level?"""
        most = Universe("Type", T.level)
        found = every(self.prove(path, most, where) for path in paths_to_types(term))
        if not found.yes:
            return found
        for path, arguments in paths_with_arguments(term):
            level = self._level_of_value(path, arguments)
            if level > T.level:
                return no(where, partial(self._why_level, term, path, level))
        return YES

    def _level_of_value(self, path: Path, arguments: int) -> int:
        """The level of the types in what a path leads to, applied to arguments."""
        known = self._types_of(self.witness.normalise(path))
        levels = [_level_of_result(T, arguments) for T in known]
        return min((level for level in levels if level is not None), default=0)

    def _why_level(self, term: TypeNode, path: Path, level: int) -> str:
        of_path = self._format(path)
        return f"{self._format(term)} may be of level {level}, as {of_path} may be"

    # --- joins and negations ---

    def _prove_clauses(self, term: Object, T: TypeNode, where: Where) -> Finding:
        found = clauses(T)
        if found is None:
            return no(where, lambda: f"{self._format(T)} has too many cases")
        return every(self._prove_clause(term, clause, T, where) for clause in found)

    def _prove_clause(
        self, term: Object, clause: Clause, T: TypeNode, where: Where
    ) -> Finding:
        """Is the term of one of the types? What the clause denies may be assumed."""
        plain = [part for part in clause if not isinstance(part, Negation)]
        denied = [part for part in clause if isinstance(part, Negation)]
        known = self._types_of(term)
        if any(self.witness.normalise(part) in known for part in denied):
            return YES
        found = self._prove_one_of(term, plain, where)
        if found.yes:
            return YES
        told = [(term, part.body) for part in denied]
        further = self._assume_new([*told, *_all_but_last_denied(term, plain)])
        if further is not self:
            if further.is_impossible:
                return YES
            found = further._prove_one_of(term, plain, ())
        if found.yes:
            return YES
        why_not = self._not_below(term, T, where)
        return replace(why_not, assumed=found.assumed or further.assumed)

    def _prove_one_of(
        self, term: Object, parts: list[TypeNode], where: Where
    ) -> Finding:
        """Is the term of one of the types, or a string of their join?"""
        if any(self.prove(term, part, where).yes for part in parts):
            return YES
        strings = [part for part in parts if is_of_strings(part)]
        return self._included_in(term, join(*strings)) if strings else Finding(False)

    def _assume_new(self, assumptions: Iterable[Assumption]) -> Prover:
        """The prover that also assumes what is not assumed yet.

        It is this one where that is nothing, or where too much is assumed already.
        """
        so_far = {(identity(term), T) for term, T in self.assumed}
        new = [
            (term, T) for term, T in assumptions if (identity(term), T) not in so_far
        ]
        if not new or len(self.assumed) >= ASSUMPTIONS:
            return self
        return self.assume(*new)

    def _follows_in_each_case(
        self, term: Object, T: TypeNode, known: list[TypeNode]
    ) -> bool:
        """Is the term of a join, and of T whichever part of the join it is of?"""
        joins = [one for one in known if isinstance(one, Join)]
        joins = [one for one in joins if not any(part in known for part in one.parts)]
        if not joins:
            return False

        def is_ruled_out(case: TypeNode) -> bool:
            further = self._assume_new([(term, case)])
            if further is self:
                return False
            return further.is_impossible or further.prove(term, T).yes

        atoms = [one for one in known if isinstance(one, Basic | PType | Negation)]
        whole = meet(*joins, *atoms)
        wanted = self.witness.normalise(T)
        return is_every_case_ruled_out(whole, wanted, self.theory, is_ruled_out)

    def _follows_from_denial(
        self, term: Object, T: TypeNode, known: list[TypeNode]
    ) -> bool:
        """Is the term of T in whichever field it fails to be of a denied record type?

        A record that is not of a type, but has its labels, is not of it in some field.
        One denial is taken apart, and the others then are in each case.
        """
        if not isinstance(term, Path) or len(self.assumed) >= DENIALS:
            return False
        labels = {label for R in known if isinstance(R, RecordType) for label in R}
        for one in known:
            if not (isinstance(one, Negation) and isinstance(one.body, RecordType)):
                continue
            fields = one.body.fields
            further = [
                self._assume_new([(step(term, label), _denial(field, term))])
                for label, field in fields
                if label in labels
            ]
            if len(further) == len(fields) and further and self not in further:
                return all(
                    case.is_impossible or case.prove(term, T).yes for case in further
                )
        return False

    # --- lists, sets and strings ---

    def _prove_collection(
        self,
        term: Object,
        T: ListOf | NonEmpty | SetOf,
        item: TypeNode,
        where: Where,
    ) -> Finding:
        if isinstance(term, Operation):
            return self._prove_computed_list(term, T, where)
        written = _written_elements(term, T)
        if written is not None:
            return every(self.prove(one, item, where) for one in written)
        known = self._types_of(term)
        below = any(isinstance(one, _BELOW[type(T)]) for one in known)
        if not (below or _has_some(known, T)):
            return self._not_below(term, T, where)
        if not isinstance(term, Path):
            return self._prove_elementwise(term, T, where)
        place = element(term)
        inside = replace(self, given=self.given | {place})
        if inside._has_misfit or (place not in self.given and inside.is_impossible):
            return YES
        found = inside.prove(place, item, where)
        if not found.yes and isinstance(T, ListOf):
            none = [one.body for one in known if isinstance(one, Negation)]
            if any(
                isinstance(U, NonEmpty) and inside.prove(place, U.item).yes
                for U in none
            ):
                return YES
        return found

    def _prove_elementwise(
        self, term: Object, T: ListOf | NonEmpty | SetOf, where: Where
    ) -> Finding:
        """Are the elements of a list or set that a function gives of T's items?"""
        one = self._new_place()
        for known in self._types_of(term):
            if not isinstance(known, ListOf | NonEmpty | SetOf):
                continue
            if self._prove_in_cases(one, known.item, _ask_of(one, T.item)).yes:
                return YES
        return self._not_below(term, T, where)

    def _prove_computed_list(
        self, term: Operation, T: ListOf | NonEmpty | SetOf, where: Where
    ) -> Finding:
        if isinstance(T, SetOf) or term.name == "fst":
            return self._not_below(term, T, where)
        there = self._types_of(term) or self._has_first(term.args[0])
        if term.name == "rst" and not there:
            return self._not_below(term, T, where)
        whole = ListOf(T.item)
        found = every(self.prove(part, whole, where) for part in term.args)
        if not found.yes or isinstance(T, ListOf):
            return found
        if term.name == "+" and any(self.prove(part, T).yes for part in term.args):
            return YES
        return self._not_below(term, T, where)

    def _prove_string(self, term: Object, T: Str | Plus, where: Where) -> Finding:
        events = self._events(term)
        if events is not None:
            found = automaton(T)
            if accepts(len(events), found, lambda i, U: self.prove(events[i], U).yes):
                return YES
        inclusion = self._included_in(term, T)
        if inclusion.yes:
            return inclusion
        return replace(self._not_below(term, T, where), assumed=inclusion.assumed)

    def _events(self, term: Object) -> Sequence[Object] | None:
        """The events of a string, or None where it is not known how many they are."""
        if isinstance(term, EventString):
            return term.items
        strings = [T for T in self._types_of(term) if isinstance(T, Str)]
        lengths = [len(items) for T in strings if (items := events_of(T)) is not None]
        if not lengths or not isinstance(term, Path):
            return None
        return [event(term, number) for number in range(lengths[0])]

    def _included_in(self, term: Object, T: TypeNode) -> Finding:
        """Is every string of the types known of a term one of T, event by event?

        A part that is a type of strings is first compared as a whole, then piece by
        piece. If the answer is no, a string that may be a counterexample is assumed.
        """
        known = self._string_type_of(term)
        if known is None or identity(term) in self.inside_strings:
            return Finding(False)
        inside = self._inside_string(term)
        found = Inclusion(False)
        with suppress(UnsupportedError):
            supertypes = automaton(T)
            for one in (automaton, automaton_above):
                found = check_inclusion(one(known), supertypes, inside._is_event_below)
                if found.yes:
                    return YES
        if found.against is None:
            return Finding(False)
        return Finding(False, None, (*self.assumed, (term, Str(*found.against))))

    def _inside_string(self, term: Object) -> Prover:
        """The prover for the events of a string, which does not divide it once more."""
        return replace(self, inside_strings=self.inside_strings | {identity(term)})

    def _string_type_of(self, term: Object) -> TypeNode | None:
        """The strings that a term may be, as one type; None if it need not be one."""
        known = self._types_of(term)
        strings = [T for T in known if is_of_strings(T)]
        if not strings:
            return None
        denied = [T for T in known if isinstance(T, Negation) and is_regular(T.body)]
        return meet(*strings, *denied)

    def _is_event_below(self, S: TypeNode, types: tuple[TypeNode, ...]) -> bool:
        """Is an event of S surely of one of the types?

        If there are no types: can there be no such event?
        """
        if len(self.assumed) >= ASSUMPTIONS:
            return False
        one = self._new_place()
        T = join(*types) if types else None

        def is_ruled_out(case: TypeNode) -> bool:
            q = self.assume((one, case))
            if q._has_misfit or q._is_contradictory:
                return True
            return T is not None and q.prove(one, T).yes

        return is_every_case_ruled_out(S, T, self.theory, is_ruled_out)

    # --- functions ---

    def _prove_function(self, term: Object, T: FunType, where: Where) -> Finding:
        if isinstance(term, Function):
            return self._prove_maps(term.domain, term.body, T, where)
        known = [one for one in self._types_of(term) if isinstance(one, FunType)]
        if known and self._prove_covers(known, T).yes:
            return YES
        return self._not_below(term, T, where)

    def _prove_maps(
        self, domain: TypeNode, body: Object, T: FunType, where: Where
    ) -> Finding:
        """Is the function defined on T's domain, with values of T's result?"""
        x = self._new_place()

        def prove_value(q: Prover) -> Finding:
            inside = q.prove(x, domain, where)
            value = substitute_variable(body, x)
            return (
                q.prove(value, substitute_variable(T.result, x), where)
                if inside.yes
                else inside
            )

        return self._prove_in_cases(x, T.domain, prove_value)

    def _prove_covers(self, known: list[FunType], T: FunType) -> Finding:
        """Is every function of all the known types one of T?"""
        x = self._new_place()
        wanted = substitute_variable(T.result, x)
        return self._prove_in_cases(
            x, T.domain, lambda q: q._prove_value(x, known, wanted)
        )

    def _prove_value(self, x: Path, known: list[FunType], wanted: TypeNode) -> Finding:
        """Is the value for x, of a function of the known types, of the wanted type?

        It is of each result whose domain x is in. If that is not enough, x is in a
        further domain or it is not.
        """
        covering = [one for one in known if self.prove(x, one.domain).yes]
        if covering:
            y = self._new_place()
            result = meet(*[substitute_variable(one.result, x) for one in covering])
            found = self._prove_in_cases(y, result, lambda q: q.prove(y, wanted))
            if found.yes:
                return found
        for one in known:
            if one in covering:
                continue
            outside = self._assume_new([(x, Negation(one.domain))])
            inside = self._assume_new([(x, one.domain)])
            rest = [other for other in known if other is not one]
            if self not in (outside, inside):
                return every(
                    YES
                    if case._has_misfit or case._is_denied(x)
                    else case._prove_value(x, others, wanted)
                    for case, others in ((outside, rest), (inside, known))
                )
        return Finding(False)

    def _new_place(self) -> Path:
        """A place of which nothing is known yet."""
        return new_place(len(self.assumed))

    def _prove_in_cases(
        self, place: Path, S: TypeNode, prove_case: Callable[[Prover], Finding]
    ) -> Finding:
        """Does it hold in each case of S, when something of S is at the place?"""
        if len(self.assumed) >= ASSUMPTIONS:
            return Finding(False, lambda: "this nests too deep to be followed")
        further = [self.assume((place, case)) for case in cases_or_whole(S)]
        return every(
            prove_case(q) for q in further if not (q._has_misfit or q._is_denied(place))
        )

    def _follows_from_function(self, term: Application, T: TypeNode) -> bool:
        """Is a value of T because of the type of the function that gives it?"""
        for result in self._result_types(term):
            further = self._assume_new([(term, result)])
            if further is not self and further.prove(term, T).yes:
                return True
        return False

    def _result_types(self, term: Application) -> Iterator[TypeNode]:
        """What the types of a function say of its value; also of f(a), in f(a)(b)."""
        function, argument = term.function, term.argument
        known = self._types_of(function)
        if isinstance(function, Application):
            known = [*known, *self._result_types(function)]
        for one in known:
            if isinstance(one, FunType) and self.prove(argument, one.domain).yes:
                yield substitute_variable(one.result, argument)

    def _prove_application(self, term: Object, T: Application, where: Where) -> Finding:
        wanted = self.witness.normalise(T)
        if any(known is wanted for known in self._types_of(term)):
            return YES
        value = self._apply_functions(wanted)
        if isinstance(value, TypeNode) and value is not wanted:
            return self.prove(term, value, where)
        return self._not_below(term, wanted, where)

    def _prove_type_at(self, term: Object, T: TypeAt, where: Where) -> Finding:
        wanted = self.witness.normalise(T)
        if not isinstance(wanted, TypeAt):
            return self.prove(term, wanted, where)
        if any(known is wanted for known in self._types_of(term)):
            return YES
        return self._not_below(term, wanted, where)

    def _apply_functions(self, value: Object) -> Object:
        """The value of an application whose argument is surely in the domain."""
        while isinstance(value, Application):
            function, argument = self._apply_functions(value.function), value.argument
            if not isinstance(function, Function):
                return value
            if not self.prove(argument, function.domain).yes:
                return value
            value = self.witness.normalise(substitute_variable(function.body, argument))
        return value

    # --- records ---

    def _prove_record(self, term: Object, T: RecordType, where: Where) -> Finding:
        known = [R for R in self._types_of(term) if isinstance(R, RecordType)]
        if not known and not isinstance(term, Record):
            return self._not_below(term, T, where)
        for label, field in T.fields:
            if isinstance(term, Record) and label in term:
                inner = term[label]
            elif isinstance(term, Path) and any(label in R for R in known):
                inner = step(term, label)
            else:
                return no(where, partial(self._why_no_field, term, label))
            found = self.prove(inner, field_type(field, term), (*where, label))
            if not found.yes:
                return found
        return YES

    def labels_of(self, term: Object) -> tuple[str, ...]:
        """The labels that a term surely has, each once.

        >>> from ttr import Ind, rectype
        >>> Prover.for_type(rectype(x=Ind, y=Ind), Signature()).labels_of(ITSELF)
        ('x', 'y')
        """
        term = self._apply_functions(self.witness.normalise(term))
        if isinstance(term, Record):
            return tuple(term)
        known = [R for R in self._types_of(term) if isinstance(R, RecordType)]
        return tuple(dict.fromkeys(label for R in known for label in R))

    def atoms_of(self, term: Object) -> list[Basic | PType] | None:
        """The types known of a place, if each is a basic type or a ptype; else None.

        Then it is surely of these atoms and of what axioms put above them, and of no
        other.
        """
        term = self.witness.normalise(term)
        known = self._types_of(term)
        atoms = [T for T in known if isinstance(T, Basic | PType)]
        simple = isinstance(term, Path | str) and len(atoms) == len(known)
        return atoms if simple else None

    # --- what is known, in words ---

    def _types_of(self, term: Object) -> list[TypeNode]:
        return self.witness.types_of(term, self.given)

    def _not_below(self, term: Object, T: TypeNode, where: Where) -> Finding:
        return no(where, partial(self._why_not_below, term, T))

    def _why_not_below(self, term: Object, T: TypeNode) -> str:
        return f"{self._format_types(term)} is not below {self._format(T)}"

    def _why_not_equal(self, term: Object, wanted: Object, where: Where) -> str:
        whole = f"a witness of {self.S}" if term is ITSELF else self._format(term)
        return f"{'.'.join(where) or whole} need not be {self._format(wanted)}"

    def _why_no_field(self, term: Object, label: str) -> str:
        return f"{self._format_types(term)} has no field {label}"

    def _format_types(self, term: Object) -> str:
        """The types known of a term, written as a meet."""
        known = self._types_of(term)
        written = dict.fromkeys(map(self._format, known))
        return " /\\ ".join(written) or self._format(term)

    def _format(self, value: Object) -> str:
        """The notation of a value, with places as paths or under names of their own."""
        labels = frozenset(self.S.labels if isinstance(self.S, RecordType) else ())
        named = replace_paths(value, lambda place: name_place(place, labels))
        names = {path.labels[0] for path in free_paths(named) if path.up == 0}
        return notation(named, (labels | names,))


def _why_by_conditions(way: Way, theory: Signature) -> str:
    """The axioms, and why their conditions hold: by which relabelling, say."""
    axioms = " and ".join(map(str, way.axioms))
    reasons = "; ".join(one.compare(theory)[1] for one in way.conditions)
    return f"by the axiom {axioms}: {reasons}" if reasons else f"by the axiom {axioms}"


_BELOW: dict[type[TypeNode], tuple[type[TypeNode], ...]] = {
    ListOf: (ListOf, NonEmpty),
    NonEmpty: (NonEmpty,),
    SetOf: (SetOf,),
}
"""The kinds of collection types that lie below one."""


def _denial(field: TypeNode, term: Object) -> TypeNode:
    """That what is in a field of a term is not of its type."""
    return push_negations_inwards(Negation(field_type(field, term)))


def _has_some(known: list[TypeNode], T: TypeNode) -> bool:
    """Is it a list that has elements, as it is denied to be of a type of lists?"""
    denied = [one.body for one in known if isinstance(one, Negation)]
    is_list = any(isinstance(one, ListOf) for one in known)
    no_list = any(isinstance(one, ListOf) for one in denied)
    return isinstance(T, NonEmpty) and is_list and no_list


def _all_but_last_denied(term: Object, parts: list[TypeNode]) -> list[Assumption]:
    """That a term is of no record type but the last of several, if these are few.

    If it is of one of them or of the last, then it is of the last where it is of none.
    So it is with lists that have elements beside other lists.
    """
    lists = [part for part in parts if isinstance(part, NonEmpty)]
    if lists and any(isinstance(part, ListOf) for part in parts):
        return [(term, Negation(T)) for T in lists]
    records = [part for part in parts if isinstance(part, RecordType)]
    if prod(len(T.fields) for T in records) > RECORDS:
        return []
    return [(term, Negation(T)) for T in records[:-1]]


def _written_elements(
    term: Object, T: ListOf | NonEmpty | SetOf
) -> tuple[Object, ...] | None:
    """The elements of an object that is written as such a collection, else None."""
    kind = FiniteSet if isinstance(T, SetOf) else tuple
    inside = elements(term) if isinstance(term, kind) else None
    return None if isinstance(T, NonEmpty) and not inside else inside


def _ask_of(term: Object, T: TypeNode) -> Callable[[Prover], Finding]:
    return lambda prover: prover.prove(term, T)


def _is_closed(term: Object, T: TypeNode) -> bool:
    """Can a model be asked? Questions about functions are answered here."""
    return not (isinstance(T, FunType) or free_paths(term) or free_paths(T))


def _level_of_result(T: TypeNode, arguments: int = 0) -> int | None:
    """The level of the types in what is of T, applied to arguments; None for none.

    A record may have more fields: what is in those is not counted.
    """
    match T:
        case FunType():
            return _level_of_result(T.result, max(0, arguments - 1))
        case Universe():
            return T.level
        case ListOf(item) | NonEmpty(item) | SetOf(item) | Plus(item):
            return _level_of_result(item)
        case RecordType(fields):
            levels = [_level_of_result(field) for _, field in fields]
            return max((one for one in levels if one is not None), default=None)
    return None


def _is_among(U: Universe, T: Universe) -> bool:
    """Is every type of U one of T?"""
    return U.level <= T.level and T.name in ("Type", U.name)
