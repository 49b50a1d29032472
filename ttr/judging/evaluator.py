"""Deriving a judgement: a : T from the facts, with the derivation as its reason."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import replace
from functools import partial
from itertools import islice, product
from typing import assert_never

from ttr.computing.case_analysis import cases
from ttr.computing.prover import Prover
from ttr.computing.strings.automata import automaton
from ttr.computing.strings.pieces import events_of
from ttr.computing.strings.runs import Stop
from ttr.computing.universe_levels import why_outside
from ttr.errors import Refused
from ttr.hooks import hook
from ttr.judging.assignments import Assignment
from ttr.judging.degrees_of_claims import reckoned, reckoning
from ttr.judging.dependence_analysis import dependence
from ttr.judging.judgements import How, Why, together
from ttr.judging.segmentation import Dividing, events_in_words, stopped
from ttr.judging.stated_dependence import Atom, Claim
from ttr.probability import CERTAIN, REFUTED, UNKNOWN, Degree
from ttr.safety.budgets import spend
from ttr.types.objects import Missing, Unresolved
from ttr.types.paths import escaping, mentions, rebuilt
from ttr.types.printing import notation
from ttr.types.substitution import Around, grounded
from ttr.types.syntax import (
    BOUND,
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
    Plus,
    PType,
    Rec,
    Record,
    RecordType,
    SetOf,
    Singleton,
    Str,
    TypeNode,
    Universe,
    identity,
)

__all__ = ["claims_of", "derivation", "reduced", "stands"]

TRIED = 100
"""How many known objects a function is tried on."""


@hook
def made_up(facts: Assignment, T: TypeNode, size: int = 0) -> tuple[Object, Assignment]:
    """A made-up witness, and the facts that make it one (`ttr.judging.creation`)."""
    raise NotImplementedError


def derivation(facts: Assignment, sit: Object, T: TypeNode, around: Around = ()) -> Why:
    """How probable sit : T is by the facts, and why.

    `around` are the scopes that paths in T lead out to, innermost first.

    An atom has the degree the facts give it. What is made of parts is as probable as
    its distinct atoms together: an atom that another one entails adds nothing, and
    the others are independent.
    """
    return _Derivation(facts).of(sit, T, around, "")


class _Derivation:
    """Derives claims; `around` are the scopes around a field, innermost first."""

    def __init__(self, facts: Assignment) -> None:
        self._facts = facts

    def of(self, sit: Object, T: TypeNode, around: Around, where: str) -> Why:
        match T:
            case Basic():
                return self._atom(sit, T, where)
            case PType() | Application() | FunType():
                return self._ground(sit, T, around, where)
            case Singleton():
                return self._singleton(sit, T, around, where)
            case Meet(parts):
                spend(len(parts))
                grounds = [self.of(sit, part, around, "") for part in parts]
                return self._whole(sit, T, "each part", grounds, where)
            case Join(parts):
                spend(len(parts))
                grounds = [self.of(sit, part, around, "") for part in parts]
                return self._whole(sit, T, "one part", grounds, where, "any")
            case Negation(body):
                spend()
                grounds = [self.of(sit, body, around, "")]
                return self._whole(sit, T, "what is denied", grounds, where, "none")
            case ListOf() | NonEmpty() | SetOf():
                return self._collection(sit, T, around, where)
            case Str() | Plus():
                return self._string(sit, T, around, where)
            case RecordType():
                return self._record(sit, T, around, where)
            case Universe():
                outside = why_outside(sit, T)
                p = REFUTED if outside else CERTAIN
                return Why(sit, T, p, outside or "by its form", where=where)
        raise assert_never(T)  # type: ignore[arg-type]

    # --- what paths and functions come to ---

    def _ground(
        self, sit: Object, T: PType | Application | FunType, around: Around, where: str
    ) -> Why:
        """A claim of a type that has to be worked out first."""
        try:
            ground = grounded(T, around)
            if isinstance(ground, FunType):
                return self._function(sit, ground, where)
            if isinstance(ground, PType):
                return self._atom(sit, reduced(self._facts, ground), where)
            value = _worked_out(self._facts, ground)
        except (Unresolved, Refused) as wrong:
            return Why(sit, T, REFUTED, wrong.message, where=where)
        if isinstance(value, TypeNode):
            return self.of(sit, value, (), where)
        return Why(sit, T, REFUTED, f"{notation(value)} is no type", where=where)

    def _atom(self, sit: Object, T: Atom, where: str) -> Why:
        p, rule = self._facts.degree_of(sit, T)
        asked = self._facts if p == REFUTED else None
        why = Why(sit, T, p, rule, where=where, facts=asked)
        return why if p in (CERTAIN, REFUTED) else self._linked(why)

    def _linked(self, why: Why) -> Why:
        """An uncertain judgement in the light of those that it depends on."""
        known = dependence(self._facts, claims_of([why]))
        if not known.defined and all(one.is_order for one in known.components):
            return why
        found = reckoned(why.event(), known)
        if found.p == why.p and found.exact:
            return why
        rule = reckoning("all", (why,), found) or f"{why.rule}, and by other axioms"
        return replace(why, p=found.p, rule=rule, alone=why.p)

    def _singleton(self, sit: Object, T: Singleton, around: Around, where: str) -> Why:
        spend()
        try:
            wanted = reduced(self._facts, grounded(T.value, around))
        except (Unresolved, Refused) as wrong:
            return Why(sit, T, REFUTED, wrong.message, where=where)
        ground = Singleton(T.base, wanted)
        if identity(sit) != identity(wanted):
            return Why(sit, ground, REFUTED, "it is another object", where=where)
        base = self.of(sit, T.base, around, "")
        return self._whole(sit, ground, "it is that object", [base], where)

    # --- lists, sets and strings ---

    def _collection(
        self, sit: Object, T: ListOf | NonEmpty | SetOf, around: Around, where: str
    ) -> Why:
        if isinstance(T, SetOf):
            inside = sit.items if isinstance(sit, FiniteSet) else None
        else:
            inside = sit if isinstance(sit, tuple) else None
        if inside is None:
            kind = "set" if isinstance(T, SetOf) else "list"
            return Why(sit, T, REFUTED, f"it is no {kind}", where=where)
        if isinstance(T, NonEmpty) and not inside:
            return Why(sit, T, REFUTED, "it is empty", where=where)
        spend(1 + len(inside))
        grounds = [self.of(element, T.item, around, "") for element in inside]
        return self._whole(sit, T, "each element", grounds, where)

    def _string(self, sit: Object, T: Str | Plus, around: Around, where: str) -> Why:
        if not isinstance(sit, EventString):
            return Why(sit, T, REFUTED, "it is no string of events", where=where)
        items = None if isinstance(T, Plus) else events_of(T)
        if items is None:
            return self._divided(sit, T, around, where)
        if len(sit) != len(items):
            rule = f"it has {events_in_words(len(sit))}, not {len(items)}"
            return Why(sit, T, REFUTED, rule, where=where)
        spend(1 + len(items))
        pairs = zip(sit, items, strict=True)
        grounds = [self.of(event, item, around, "") for event, item in pairs]
        return self._whole(sit, T, "event by event", grounds, where)

    def _divided(
        self, sit: EventString, T: Str | Plus, around: Around, where: str
    ) -> Why:
        """Pieces in a row: in a way that is certain, or in one of those possible."""

        def derives(part: Object, U: TypeNode) -> Why:
            spend()
            return self.of(part, U, around, "")

        found = automaton(T)
        dividing = Dividing(self._facts, sit, derives, around)
        way = dividing.certain_way(found)
        if way is not None:
            return Why(sit, T, CERTAIN, "piece by piece", way, where)
        division = dividing.possible_ways(found)
        if isinstance(division, Stop):
            rule = stopped(self._facts, sit, division)
            return Why(sit, T, REFUTED, rule, where=where)
        if not division.all:
            rule = f"one of more than {len(division.ways)} ways to divide it"
            return Why(sit, T, dividing.chance(found), rule, where=where)
        ways = list(map(dividing.grounds, division.ways))
        if len(ways) == 1:
            return self._whole(sit, T, "piece by piece", ways[0], where)
        each = [self._whole(sit, T, "divided so", way, "") for way in ways]
        return self._whole(sit, T, "one way to divide it", each, where, "any")

    # --- functions and records ---

    def _function(self, sit: Object, T: FunType, where: str) -> Why:
        """Does the function take whatever is of the domain to what is of the result?

        Certainly if that follows for an arbitrary object of the domain, from the rules
        of subtyping and the facts about what the function mentions; not if it fails for
        a known object or a made-up one.
        """
        if not isinstance(sit, Function):
            return Why(sit, T, REFUTED, "it is no function", where=where)
        theory = self._facts.theory
        prover = replace(Prover.for_type(Rec, theory), is_judged=self._certain)
        found = prover.prove(sit, T)
        if found.yes:
            rule = "whatever it is applied to"
            return Why(sit, T, CERTAIN, rule, where=where)
        for x, facts in self._arguments(T.domain):
            grounds = _Derivation(facts).applied(sit, T, x)
            whole = self._whole(sit, T, f"applied to {notation(x)}", grounds, where)
            if whole.p == REFUTED:
                return whole
        return Why(sit, T, UNKNOWN, f"it may be, but {found.why}", where=where)

    def _certain(self, sit: Object, T: TypeNode) -> bool:
        return self.of(sit, T, (), "").p == CERTAIN

    def _arguments(self, domain: TypeNode) -> Iterator[tuple[Object, Assignment]]:
        """Objects of a domain to try: some that are known, and made-up ones."""
        if isinstance(domain, Basic | PType):
            for x in islice(self._facts.witnesses(domain), TRIED):
                yield x, self._facts
        for case, size in product(cases(domain) or (domain,), (1, 0, 2)):
            with suppress(Refused):
                yield made_up(self._facts, case, size)

    def applied(self, sit: Function, T: FunType, x: Object) -> list[Why]:
        """Is the object of the function's domain, and what it gives of the result?"""
        inside = self.of(x, sit.domain, (), "")
        if inside.p != CERTAIN:
            return [inside]
        return [inside, self._given(sit.body, T.result, ({BOUND: x},))]

    def _given(self, body: Object, T: TypeNode, scope: Around) -> Why:
        """Is what a function gives of a type?"""
        try:
            value = reduced(self._facts, grounded(body, scope))
        except (Unresolved, Refused) as wrong:
            return Why(body, T, REFUTED, wrong.message)
        return self.of(value, T, scope, "")

    def _record(self, sit: Object, T: RecordType, around: Around, where: str) -> Why:
        if not isinstance(sit, Record):
            return Why(sit, T, REFUTED, "it is no record", where=where)
        spend(1 + len(T.fields))
        inside = (sit._fields, *around)
        grounds = [
            self.of(sit._fields[label], field, inside, label)
            if label in sit
            else self._missing(label, field, inside)
            for label, field in T.fields
        ]
        return self._whole(sit, T, "field by field", grounds, where)

    def _missing(self, label: str, T: TypeNode, around: Around) -> Why:
        with suppress(Unresolved):
            T = grounded(T, around)
        rule = f"there is no {label}"
        return Why(Missing(), T, REFUTED, rule, where=label, facts=self._facts)

    # --- claims with grounds ---

    def _whole(
        self,
        sit: Object,
        T: TypeNode,
        rule: str,
        grounds: Iterable[Why],
        where: str,
        how: How = "all",
    ) -> Why:
        """A claim that holds where all its grounds do, or any, or none of them."""
        grounds = tuple(grounds)
        p = _decided(how, [ground.p for ground in grounds])
        if p is not None:
            return Why(sit, T, p, rule, grounds, where, how)
        known = dependence(self._facts, claims_of(grounds))
        found = reckoned(together(how, grounds), known)
        said = partial(reckoning, how, grounds, found, known)
        return Why(sit, T, found.p, rule, grounds, where, how, None, said)


def claims_of(grounds: Iterable[Why]) -> dict[Claim, Degree]:
    """The uncertain judgements of atoms that grounds rest on, each with its degree."""
    return {
        Claim(step.sit, step.type): step.alone or step.p
        for ground in grounds
        for step in ground.uncertain()
        if isinstance(step.type, Basic | PType)
    }


def _decided(how: How, degrees: list[Degree]) -> Degree | None:
    """What is certain of a claim, whatever its uncertain grounds come to; else None."""
    if how == "all":
        if REFUTED in degrees:
            return REFUTED
        return CERTAIN if all(p == CERTAIN for p in degrees) else None
    some = CERTAIN in degrees
    if not some and any(p != REFUTED for p in degrees):
        return None
    return CERTAIN if some == (how == "any") else REFUTED


# --- applications --------------------------------------------------------------------


def reduced(facts: Assignment, value: Object) -> Object:
    """The value with every application in it worked out that mentions no path.

    Raises `Refused` where an argument is not certainly of the function's domain, or
    what is applied is no function.
    """
    spend()
    if not mentions(value, Application):
        return value
    value = rebuilt(value, lambda part, _: reduced(facts, part))
    if not isinstance(value, Application) or escaping(value):
        return value
    return reduced(facts, _applied(facts, value.function, value.argument))


def _worked_out(facts: Assignment, T: Application) -> Object:
    """What an application gives; applications inside that are left as they are.

    So a join holds where one part does, whatever becomes of the others.
    """
    value: Object = T
    while isinstance(value, Application):
        function, argument = value.function, reduced(facts, value.argument)
        if isinstance(function, Application):
            function = _worked_out(facts, function)
        value = _applied(facts, function, argument)
    return value


def _applied(facts: Assignment, function: Object, argument: Object) -> Object:
    """The body of a function for an argument of its domain; else `Refused`."""
    if not isinstance(function, Function):
        whole = Application(function, argument)
        raise Refused(f"{notation(function)} is no function, so {whole} is nothing")
    inside = derivation(facts, argument, function.domain)
    if inside.p != CERTAIN:
        raise Refused(
            f"{notation(function)} takes objects of {function.domain}, which "
            f"{notation(argument)} is not{_where(inside)}: "
            f"{(inside.failure() or inside).rule}"
        )
    return grounded(function.body, ({BOUND: argument},))


def _where(why: Why) -> str:
    return f" in the field {why.path()}" if why.path() else ""


def stands(T: TypeNode) -> bool:
    """Whether nothing in a type is to be worked out: no path leads out, no function.

    >>> from ttr.types.syntax import Ind, this
    >>> stands(Ind @ "a"), stands(Ind @ this.x)
    (True, False)
    """
    return not mentions(T, Application) and not escaping(T)
