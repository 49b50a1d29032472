"""The clauses of a : T, and the derivations made by them.

`Evaluator` says what a judgement comes down to, form by form. What is asked about it is
up to a subclass: `derivation` answers with the degree and the reason; `certainty` only
with whether the judgement is certain.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial
from itertools import islice, product
from typing import Any, ClassVar, Generic, TypeVar, cast

from ttr.computing.case_analysis import cases_or_whole
from ttr.computing.prover import Prover
from ttr.computing.strings.automata import automaton
from ttr.computing.strings.automaton_runs import Stop
from ttr.computing.strings.pieces import events_of
from ttr.computing.universe_levels import why_outside
from ttr.errors import RefusedError
from ttr.hooks import hook
from ttr.judging.assignments import Assignment
from ttr.judging.degrees_of_claims import explain_probability, probability_of
from ttr.judging.dependence_analysis import dependence
from ttr.judging.judgements import How, Why, combine_events, degree_if_decided
from ttr.judging.stated_dependence import Atom, Claim
from ttr.judging.string_segmentation import Segmentation, describe_stop, events_in_words
from ttr.probability import CERTAIN, REFUTED, UNKNOWN, Degree
from ttr.safety.budgets import spend
from ttr.types.interning import cache_on_node, identity
from ttr.types.objects import (
    BOUND,
    EventString,
    FiniteSet,
    Missing,
    Object,
    Record,
    UnresolvedError,
)
from ttr.types.paths import free_paths, map_parts, mentions
from ttr.types.printing import notation
from ttr.types.substitution import (
    Around,
    instantiate_body,
    resolve_paths,
    substitute_variable,
)
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
    Rec,
    RecordType,
    SetOf,
    Singleton,
    Str,
    TypeAt,
    TypeNode,
    Universe,
)

Answer = TypeVar("Answer")
"""What an evaluator gives: a derivation, or yes or no."""

TRIED = 100
"""The number of known objects that a function is tried on."""


@hook
def make_witness(
    facts: Assignment, T: TypeNode, size: int = 0
) -> tuple[Object, Assignment]:
    """A new witness, and the facts that make it one (`ttr.judging.creation`)."""
    raise NotImplementedError


def derivation(facts: Assignment, sit: Object, T: TypeNode, around: Around = ()) -> Why:
    """How probable sit : T is by the facts, and why.

    `around` are the scopes that paths in T lead out to, innermost first.

    An atom has the degree the facts give it. What is made of parts is as probable as
    its distinct atoms together: an atom that another one entails adds nothing, and
    the others are independent.
    """
    return _Derivation(facts).of(sit, T, around)


class Evaluator(ABC, Generic[Answer]):
    """What sit : T comes down to, by the form of T.

    Each clause either refutes sit : T by the form of sit, or combines the answers to
    simpler claims, which it gives one by one as they are asked for. A subclass defines
    what an answer is.

    `around` are the scopes that paths lead out to, innermost first; `where` is the
    label of the field that the claim is about, or empty.
    """

    _clauses: ClassVar[Mapping[type[TypeNode], Callable[..., Any]]]

    def __init_subclass__(cls) -> None:
        cls._clauses = {kind: getattr(cls, name) for kind, name in _CLAUSES.items()}

    def __init__(self, facts: Assignment) -> None:
        self.facts = facts

    def of(self, sit: Object, T: TypeNode, around: Around, where: str = "") -> Answer:
        """The answer to sit : T."""
        answer: Answer = self._clauses[type(T)](self, sit, T, around, where)
        return answer

    # --- what an answer is ---

    @abstractmethod
    def conclude(
        self, sit: Object, T: TypeNode, p: Degree, rule: str, where: str
    ) -> Answer:
        """The answer where sit : T is certain or refuted by a rule alone."""

    @abstractmethod
    def combine(
        self,
        sit: Object,
        T: TypeNode,
        around: Around,
        where: str,
        how: How,
        rule: str,
        grounds: Iterable[Answer],
    ) -> Answer:
        """The answer where sit : T holds if all of its grounds do, or any, or none."""

    @abstractmethod
    def judge_atom(self, sit: Object, T: Atom, where: str) -> Answer:
        """The answer for an atom without paths and applications."""

    @abstractmethod
    def judge_missing(self, label: str, T: TypeNode, around: Around) -> Answer:
        """The answer for a field of type T that a record lacks."""

    @abstractmethod
    def judge_pieces(
        self, sit: EventString, T: Str | Plus, around: Around, where: str
    ) -> Answer:
        """The answer for a string that may have to be divided into pieces."""

    @abstractmethod
    def judge_function(self, sit: Function, T: FunType, where: str) -> Answer:
        """The answer for a function; no path leads out of T."""

    # --- the clauses ---

    def _judge_basic(self, sit: Object, T: Basic, around: Around, where: str) -> Answer:
        return self.judge_atom(sit, T, where)

    def _judge_ptype(self, sit: Object, T: PType, around: Around, where: str) -> Answer:
        try:
            ground = T if is_reduced(T) else self._value_of(T, around)
            return self.judge_atom(sit, ground, where)
        except (UnresolvedError, RefusedError) as wrong:
            return self.conclude(sit, T, REFUTED, wrong.message, where)

    def _judge_application(
        self, sit: Object, T: Application, around: Around, where: str
    ) -> Answer:
        try:
            value = _reduce_head(self.facts, resolve_paths(T, around))
        except (UnresolvedError, RefusedError) as wrong:
            return self.conclude(sit, T, REFUTED, wrong.message, where)
        if isinstance(value, TypeNode):
            return self.of(sit, value, (), where)
        rule = f"{notation(value)} is no type"
        return self.conclude(sit, T, REFUTED, rule, where)

    def _judge_type_at(
        self, sit: Object, T: TypeAt, around: Around, where: str
    ) -> Answer:
        try:
            value = self._value_of(T, around)
        except (UnresolvedError, RefusedError) as wrong:
            return self.conclude(sit, T, REFUTED, wrong.message, where)
        if not isinstance(value, TypeAt):
            return self.of(sit, value, (), where)
        rule = f"{notation(value)} is no type"
        return self.conclude(sit, T, REFUTED, rule, where)

    def _judge_singleton(
        self, sit: Object, T: Singleton, around: Around, where: str
    ) -> Answer:
        spend()
        try:
            value = self._value_in(T, around)
        except (UnresolvedError, RefusedError) as wrong:
            return self.conclude(sit, T, REFUTED, wrong.message, where)
        ground = T if value is T.value else Singleton(T.base, value)
        if value is not sit and identity(value) != identity(sit):
            return self.conclude(sit, ground, REFUTED, "it is another object", where)
        base = (self.of(sit, T.base, around),)
        return self.combine(
            sit, ground, around, where, "all", "it is that object", base
        )

    def _judge_meet(self, sit: Object, T: Meet, around: Around, where: str) -> Answer:
        spend(len(T.parts))
        grounds = (self.of(sit, part, around) for part in T.parts)
        return self.combine(sit, T, around, where, "all", "each part", grounds)

    def _judge_join(self, sit: Object, T: Join, around: Around, where: str) -> Answer:
        return self.judge_one_of(sit, T, T.parts, around, where)

    def judge_one_of(
        self,
        sit: Object,
        T: Join,
        parts: Sequence[TypeNode],
        around: Around,
        where: str,
    ) -> Answer:
        """The answer for a join, given that sit can only be of these parts of it."""
        spend(len(parts))
        grounds = (self.of(sit, part, around) for part in parts)
        return self.combine(sit, T, around, where, "any", "one part", grounds)

    def _judge_negation(
        self, sit: Object, T: Negation, around: Around, where: str
    ) -> Answer:
        spend()
        grounds = (self.of(sit, body, around) for body in (T.body,))
        return self.combine(sit, T, around, where, "none", "what is denied", grounds)

    def _judge_list(
        self, sit: Object, T: ListOf | NonEmpty, around: Around, where: str
    ) -> Answer:
        if not isinstance(sit, tuple):
            return self.conclude(sit, T, REFUTED, "it is no list", where)
        if isinstance(T, NonEmpty) and not sit:
            return self.conclude(sit, T, REFUTED, "it is empty", where)
        return self._judge_each(sit, T, sit, around, where)

    def _judge_set(self, sit: Object, T: SetOf, around: Around, where: str) -> Answer:
        if not isinstance(sit, FiniteSet):
            return self.conclude(sit, T, REFUTED, "it is no set", where)
        return self._judge_each(sit, T, sit.items, around, where)

    def _judge_each(
        self,
        sit: Object,
        T: ListOf | NonEmpty | SetOf,
        inside: Sequence[Object],
        around: Around,
        where: str,
    ) -> Answer:
        spend(1 + len(inside))
        grounds = (self.of(element, T.item, around) for element in inside)
        return self.combine(sit, T, around, where, "all", "each element", grounds)

    def _judge_string(
        self, sit: Object, T: Str | Plus, around: Around, where: str
    ) -> Answer:
        if not isinstance(sit, EventString):
            return self.conclude(sit, T, REFUTED, "it is no string of events", where)
        items = None if isinstance(T, Plus) else events_of(T)
        if items is None:
            return self.judge_pieces(sit, T, around, where)
        if len(sit) != len(items):
            rule = f"it has {events_in_words(len(sit))}, not {len(items)}"
            return self.conclude(sit, T, REFUTED, rule, where)
        spend(1 + len(items))
        pairs = zip(sit, items, strict=True)
        grounds = (self.of(event, item, around) for event, item in pairs)
        return self.combine(sit, T, around, where, "all", "event by event", grounds)

    def _judge_function_type(
        self, sit: Object, T: FunType, around: Around, where: str
    ) -> Answer:
        try:
            ground = resolve_paths(T, around)
            if not isinstance(sit, Function):
                return self.conclude(sit, ground, REFUTED, "it is no function", where)
            return self.judge_function(sit, ground, where)
        except (UnresolvedError, RefusedError) as wrong:
            return self.conclude(sit, T, REFUTED, wrong.message, where)

    def _judge_record(
        self, sit: Object, T: RecordType, around: Around, where: str
    ) -> Answer:
        if not isinstance(sit, Record):
            return self.conclude(sit, T, REFUTED, "it is no record", where)
        spend(1 + len(T.fields))
        grounds = self._judge_fields(sit._fields, T, around)
        return self.combine(sit, T, around, where, "all", "field by field", grounds)

    def _judge_fields(
        self, found: Mapping[str, Object], T: RecordType, around: Around
    ) -> Iterator[Answer]:
        inside = (found, *around)
        for label, field in T.fields:
            if label in found:
                yield self.of(found[label], field, inside, label)
            else:
                yield self.judge_missing(label, field, inside)

    def _judge_universe(
        self, sit: Object, T: Universe, around: Around, where: str
    ) -> Answer:
        outside = why_outside(sit, T)
        p = REFUTED if outside else CERTAIN
        return self.conclude(sit, T, p, outside or "by its form", where)

    # --- what paths and applications come to ---

    def _value_of(self, value: Object, around: Around) -> Any:
        """The value without paths and applications."""
        if free_paths(value):
            value = resolve_paths(value, around)
        return reduce_applications(self.facts, value)

    def _value_in(self, T: Singleton, around: Around) -> Object:
        """The object that a singleton type is of."""
        return T.value if is_reduced(T) else self._value_of(T.value, around)


_CLAUSES: Mapping[type[TypeNode], str] = {
    Basic: "_judge_basic",
    PType: "_judge_ptype",
    Application: "_judge_application",
    TypeAt: "_judge_type_at",
    Singleton: "_judge_singleton",
    Meet: "_judge_meet",
    Merge: "_judge_meet",
    Join: "_judge_join",
    Negation: "_judge_negation",
    ListOf: "_judge_list",
    NonEmpty: "_judge_list",
    SetOf: "_judge_set",
    Str: "_judge_string",
    Plus: "_judge_string",
    FunType: "_judge_function_type",
    RecordType: "_judge_record",
    Universe: "_judge_universe",
}
"""The clause for each form of type."""


class _Derivation(Evaluator[Why]):
    """Gives the degree and the derivation of a claim.

    What other judgements leave of an uncertain one is worked out once for each.
    """

    def __init__(self, facts: Assignment) -> None:
        self.facts = facts
        self._adjusted: dict[object, Why] = {}

    def conclude(
        self, sit: Object, T: TypeNode, p: Degree, rule: str, where: str
    ) -> Why:
        return Why(sit, T, p, rule, where=where)

    def combine(
        self,
        sit: Object,
        T: TypeNode,
        around: Around,
        where: str,
        how: How,
        rule: str,
        grounds: Iterable[Why],
    ) -> Why:
        grounds = tuple(grounds)
        p = degree_if_decided(how, [ground.p for ground in grounds])
        if p is not None:
            return Why(sit, T, p, rule, grounds, where, how)
        known = dependence(self.facts, claims_of(grounds))
        found = probability_of(combine_events(how, grounds), known)
        said = partial(explain_probability, how, grounds, found, known)
        return Why(sit, T, found.p, rule, grounds, where, how, None, said)

    # --- atoms ---

    def judge_atom(self, sit: Object, T: Atom, where: str) -> Why:
        p, rule = self.facts.degree_of(sit, T)
        asked = self.facts if p == REFUTED else None
        why = Why(sit, T, p, rule, where=where, facts=asked)
        if p in (CERTAIN, REFUTED):
            return why
        key = identity(sit), T, where
        if key not in self._adjusted:
            self._adjusted[key] = self._adjust_for_dependence(why)
        return self._adjusted[key]

    def _adjust_for_dependence(self, why: Why) -> Why:
        """An uncertain judgement with the degree that others it depends on leave it."""
        known = dependence(self.facts, claims_of([why]))
        if not known.defined and all(one.is_order for one in known.components):
            return why
        found = probability_of(why.event(), known)
        if found.p == why.p and found.exact:
            return why
        rule = (
            explain_probability("all", (why,), found)
            or f"{why.rule}, and by other axioms"
        )
        return replace(why, p=found.p, rule=rule, alone=why.p)

    def judge_missing(self, label: str, T: TypeNode, around: Around) -> Why:
        with suppress(UnresolvedError):
            T = resolve_paths(T, around)
        rule = f"there is no {label}"
        return Why(Missing(), T, REFUTED, rule, where=label, facts=self.facts)

    # --- strings ---

    def judge_pieces(
        self, sit: EventString, T: Str | Plus, around: Around, where: str
    ) -> Why:
        """The string is divided in a way that is certain, else in each possible way."""

        def derives(part: Object, U: TypeNode) -> Why:
            spend()
            return self.of(part, U, around)

        found = automaton(T)
        dividing = Segmentation(self.facts, sit, derives, around)
        way = dividing.certain_way(found)
        if way is not None:
            return Why(sit, T, CERTAIN, "piece by piece", way, where)
        division = dividing.possible_ways(found)
        if isinstance(division, Stop):
            rule = describe_stop(self.facts, sit, division)
            return Why(sit, T, REFUTED, rule, where=where)
        if not division.all:
            rule = f"one of more than {len(division.ways)} ways to divide it"
            return Why(sit, T, dividing.chance(found), rule, where=where)
        ways = list(map(dividing.grounds, division.ways))
        if len(ways) == 1:
            return self.combine(sit, T, around, where, "all", "piece by piece", ways[0])
        each = [
            self.combine(sit, T, around, "", "all", "divided so", way) for way in ways
        ]
        rule = "one way to divide it"
        return self.combine(sit, T, around, where, "any", rule, each)

    # --- functions ---

    def judge_function(self, sit: Function, T: FunType, where: str) -> Why:
        """Does the function take whatever is of the domain to what is of the result?

        Certainly if that follows for an arbitrary object of the domain from the rules
        of subtyping and the facts about what the function mentions; certainly not if
        it fails for a known or a new object.
        """
        theory = self.facts.theory
        prover = replace(Prover.for_type(Rec, theory), is_judged=self._is_certain)
        found = prover.prove(sit, T)
        if found.yes:
            rule = "whatever it is applied to"
            return Why(sit, T, CERTAIN, rule, where=where)
        for x, facts in self._arguments(T.domain):
            grounds = _Derivation(facts)._derive_value(sit, T, x)
            rule = f"applied to {notation(x)}"
            whole = self.combine(sit, T, (), where, "all", rule, grounds)
            if whole.p == REFUTED:
                return whole
        return Why(sit, T, UNKNOWN, f"it may be, but {found.why}", where=where)

    def _is_certain(self, sit: Object, T: TypeNode) -> bool:
        return self.of(sit, T, ()).p == CERTAIN

    def _arguments(self, domain: TypeNode) -> Iterator[tuple[Object, Assignment]]:
        """Objects of the domain to try: some that are known, then new ones."""
        if isinstance(domain, Basic | PType):
            for x in islice(self.facts.witnesses(domain), TRIED):
                yield x, self.facts
        for case, size in product(cases_or_whole(domain), (1, 0, 2)):
            with suppress(RefusedError):
                yield make_witness(self.facts.with_assumptions(), case, size)

    def _derive_value(self, sit: Function, T: FunType, x: Object) -> list[Why]:
        """Is x of the function's domain, and the value for x of the result type?"""
        inside = self.of(x, sit.domain, ())
        if inside.p != CERTAIN:
            return [inside]
        scope: Around = ({BOUND: x},)
        try:
            value = reduce_applications(self.facts, resolve_paths(sit.body, scope))
        except (UnresolvedError, RefusedError) as wrong:
            result = substitute_variable(T.result, x)
            value = Application(sit, x)
            return [inside, Why(value, result, REFUTED, wrong.message)]
        return [inside, self.of(value, T.result, scope)]


def claims_of(grounds: Iterable[Why]) -> dict[Claim, Degree]:
    """The uncertain judgements of atoms behind the grounds, with their degrees."""
    return {
        Claim(step.sit, step.type): step.alone or step.p
        for ground in grounds
        for step in ground.uncertain()
        if isinstance(step.type, Basic | PType)
    }


# --- applications --------------------------------------------------------------------


def reduce_applications(facts: Assignment, value: Object) -> Object:
    """The value with every application in it reduced, except those that mention paths.

    Raises `RefusedError` where an argument is not certainly of the function's domain,
    and where something that is no function is applied.
    """
    spend()
    if not mentions(value, Application):
        return value
    value = map_parts(value, lambda part, _: reduce_applications(facts, part))
    if not isinstance(value, Application) or free_paths(value):
        return value
    return reduce_applications(facts, _apply(facts, value.function, value.argument))


def reduce_atom(facts: Assignment, T: Atom) -> Atom:
    """The atom with its arguments reduced; `RefusedError` where one has no value."""
    if not mentions(T, Application):
        return T
    return cast(Atom, reduce_applications(facts, T))


def _reduce_head(facts: Assignment, T: Application) -> Object:
    """The value of an application, with the applications inside it left as they are.

    So a join holds where one part does, even if another part cannot be reduced.
    """
    value: Object = T
    while isinstance(value, Application):
        function, argument = value.function, reduce_applications(facts, value.argument)
        if isinstance(function, Application):
            function = _reduce_head(facts, function)
        value = _apply(facts, function, argument)
    return value


def _apply(facts: Assignment, function: Object, argument: Object) -> Object:
    """The body of a function for an argument; `RefusedError` outside its domain."""
    if not isinstance(function, Function):
        whole = Application(function, argument)
        raise RefusedError(
            f"{notation(function)} is no function, so {whole} is nothing"
        )
    inside = derivation(facts, argument, function.domain)
    if inside.p != CERTAIN:
        raise RefusedError(
            f"{notation(function)} takes objects of {function.domain}, which "
            f"{notation(argument)} is not{_where(inside)}: "
            f"{(inside.failure() or inside).rule}{_known_types(facts, argument)}"
        )
    return instantiate_body(function, argument)


def _known_types(facts: Assignment, sit: Object) -> str:
    """What an object is of by the facts, as far as that is told."""
    known = sorted(map(str, facts.types_of(sit)))
    return f"; {notation(sit)} is of {', '.join(known)}" if known else ""


def _where(why: Why) -> str:
    return f" in the field {why.path()}" if why.path() else ""


@cache_on_node
def is_reduced(T: TypeNode) -> bool:
    """Is there nothing left to reduce in a type: no application, no path out of it?

    >>> from ttr import Ind, this
    >>> is_reduced(Ind @ "a"), is_reduced(Ind @ this.x)
    (True, False)
    """
    return not mentions(T, Application) and not free_paths(T)
