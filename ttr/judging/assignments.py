"""Assignments: which objects are judged to be of which basic types and ptypes.

An assignment is an immutable value that is cheap to extend: facts with their degrees,
witness functions, and the open types. It is about atoms only; `evaluator` derives what
follows for records, lists and other types.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from heapq import nsmallest
from operator import itemgetter
from typing import Any, TypeAlias

from ttr.errors import RefusedError, TTRError, describe_error
from ttr.judging.stated_dependence import Atom, Claim, Conditioned, Expectation, Links
from ttr.persistent_maps import Map
from ttr.probability import (
    CERTAIN,
    REFUTED,
    UNKNOWN,
    Degree,
    complement,
    degree,
)
from ttr.safety.budgets import spend
from ttr.signature.axioms import (
    find_exclusion,
    match_schema,
    subtypes,
    supertypes,
)
from ttr.signature.conditional_axioms import Way, heads_below, ways_to_follow
from ttr.signature.signature import Axiom, Condition, Signature, head
from ttr.types.interning import identity
from ttr.types.objects import Object
from ttr.types.paths import free_paths, subterms
from ttr.types.printing import notation
from ttr.types.syntax import Basic, Pred, PType, TypeNode

Head: TypeAlias = Basic | Pred
"""What is open or has a witness function: a basic type, or a predicate's ptypes."""

WitnessFunction = Callable[..., object]
"""A function from objects to a truth value, a number in [0, 1] or an interval."""

Facts: TypeAlias = Map[Atom, Degree]
"""The types that one object is judged to be of, with degrees."""

Bound: TypeAlias = tuple[float, str]
"""A bound on a probability, and the rule that sets it."""


_EMPTY: Map[Any, Any] = Map()

_NO_LOWER: Bound = (0.0, "")
_NO_UPPER: Bound = (1.0, "")
"""The bounds on a type that no axiom is about."""

NO_LINKS = Links()
"""The links where nothing was said of how judgements depend."""


@dataclass(frozen=True, eq=False)
class Assignment:
    """Facts, witness functions and open types, under the axioms of a theory.

    `known` has an entry for every object that a fact is about, or that a ptype with a
    fact mentions; `told` has the objects that were told to be of a type, each with its
    number, so that they have an order, and is another for a type of which anything was
    told anew; `created` counts the names given out, `facts` the facts told. `replaced`
    is the last judgement whose degree took the place of another. Facts that are told
    after the first `assumed_after` are assumed, for the sake of argument.
    """

    theory: Signature
    known: Map[object, Facts] = _EMPTY
    told: Map[Atom, Map[object, tuple[int, Object]]] = _EMPTY
    functions: Map[Head, WitnessFunction] = _EMPTY
    opened: Map[Head, bool] = _EMPTY
    links: Links = NO_LINKS
    created: int = 0
    facts: int = 0
    replaced: Claim | None = None
    assumed_after: int | None = None

    def degree_of(self, sit: Object, T: Atom) -> tuple[Degree, str]:
        """The probability of sit : T, and the rule that gives it."""
        facts = self.known.get(identity(sit), _EMPTY)
        told = facts.get(T)
        if told is not None and told in (CERTAIN, REFUTED):
            return told, "assumed" if self._is_assumed(sit, T) else "given"
        perceptual = head(T) in self.functions
        if told is None and perceptual and isinstance(T, Basic):
            seen = self.perceive(sit, T) or UNKNOWN
            if T in self.theory.axiom_heads:
                seen = self._clip(sit, T, seen, *self._bounds(facts, sit, T))
            return seen, f"by the witness function of {T.name}"
        (least, lower), (most, upper) = self._bounds(facts, sit, T)
        if told is not None:
            rule = f"seen as {head(T).name}" if perceptual else "given"
            return self._clip(sit, T, told, (least, lower), (most, upper)), rule
        if least > 0.0:
            known = Degree(least, 1.0)
            return self._clip(sit, T, known, (least, lower), (most, upper)), lower
        if perceptual or self._is_open(T):
            return Degree(0.0, most), upper or "nothing is known of it"
        if not self.theory.conditional_axioms:
            return REFUTED, "nothing says so"
        failed = ""
        for p, way in self._degrees_by_conditions(facts, sit, T):
            if p.hi > 0.0:
                return Degree(0.0, most), f"it may be {way}"
            failed = failed or f", not {way}"
        return REFUTED, f"nothing says so{failed}"

    def _is_assumed(self, sit: Object, T: Atom) -> bool:
        if self.assumed_after is None:
            return False
        number, _ = self.told[T][identity(sit)]
        return number > self.assumed_after

    def with_assumptions(self) -> Assignment:
        """The assignment in which all that is told from now on is assumed."""
        if self.assumed_after is not None:
            return self
        return self._replace(assumed_after=self.facts)

    def _is_open(self, T: Atom) -> bool:
        """May other objects be of T than the facts say, by itself or by an axiom?"""
        heads = [head(T), *(head(one) for _, one in subtypes(T, self.theory.axioms))]
        if self.theory.conditional_axioms:
            heads += heads_below(heads, self.theory)
        return any(one in self.opened or one in self.functions for one in heads)

    def can_be(self, sit: Object, pred: Pred) -> bool:
        """May sit be a situation in which this predicate is true?

        It is quick: sit may not where no fact, function, open type or axiom says so.
        """
        if (
            pred in self.functions
            or pred in self.opened
            or pred in self.theory.axiom_heads
        ):
            return True
        for T in self.known.get(identity(sit), _EMPTY):
            if isinstance(T, PType) and T.pred is pred:
                return True
        return False

    def perceive(self, sit: Object, T: Atom) -> Degree | None:
        """The answer of the witness function of T, or None where there is none.

        For a basic type it is asked of the object, for a ptype of its arguments. What
        is seen of a ptype is seen of those above it as well: by `mug(x) <: cup(x)`,
        cup(o1) is at least as probable as mug(o1).
        """
        own = self._ask(sit, T)
        if isinstance(T, Basic) or T.pred not in self.theory.axiom_heads:
            return own
        below = (
            self._ask(sit, lower)
            for _, lower in subtypes(T, self.theory.axioms)
            if not free_paths(lower)
        )
        least = max((seen.lo for seen in below if seen is not None), default=0.0)
        if own is None:
            return Degree(least, 1.0) if least > 0.0 else None
        return own if own.lo >= least else Degree(least, max(least, own.hi))

    def _ask(self, sit: Object, T: Atom) -> Degree | None:
        """The answer of T's own witness function, or None where there is none."""
        function = self.functions.get(head(T))
        if function is None:
            return None
        args = (sit,) if isinstance(T, Basic) else T.args
        try:
            answer = function(*args)
            if isinstance(answer, bool):
                return CERTAIN if answer else REFUTED
            return degree(answer, "the answer")
        except TTRError as error:
            raise TTRError(f"{_call(T, args)}: {error.message}") from error
        except Exception as error:
            fault = describe_error(error)
            raise TTRError(f"{_call(T, args)} failed: {fault}") from error

    def told_degree(self, sit: Object, T: Atom) -> Degree | None:
        """The probability given for sit : T; None if none was."""
        return self.known.get(identity(sit), _EMPTY).get(T)

    def seen_types(self) -> list[Basic]:
        """The basic types that witness functions judge, and axioms are about."""
        related = self.theory.axiom_heads
        return [T for T in self.functions if isinstance(T, Basic) and T in related]

    def is_told(self, sit: Object, T: Atom) -> bool:
        """Does a fact or a witness function give the probability of sit : T?"""
        return T in self.functions or self.told_degree(sit, T) is not None

    def types_of(self, sit: Object) -> list[Atom]:
        """The types with a fact that the object may be of them, in no order."""
        facts = self.known.get(identity(sit), _EMPTY)
        return [T for T, p in facts.items() if p.hi > 0.0]

    def objects(self) -> list[Object]:
        """The objects that facts are about, in the order of the facts."""
        told: dict[object, tuple[int, Object]] = {}
        for entries in self.told.values():
            for key, entry in entries.items():
                told[key] = min(told.get(key, entry), entry, key=itemgetter(0))
        return [sit for _, sit in sorted(told.values(), key=itemgetter(0))]

    def leaves_open(self, T: TypeNode) -> bool:
        """Does a type mention atoms that other objects may be of than the facts say?"""
        atoms = (part for part in subterms([T]) if isinstance(part, Atom))
        return any(map(self._is_open, atoms))

    def witnesses(self, T: Atom) -> Iterator[Object]:
        """The objects that are certainly of T, in the order of the facts."""
        yield from self.told_of(T, lambda p: p == CERTAIN)

    def told_of(self, T: Atom, enough: Callable[[Degree], bool]) -> Iterator[Object]:
        """The objects with a fact for T whose degree is enough."""
        for sit in self.told_in_order(T):
            if enough(self.degree_of(sit, T)[0]):
                yield sit

    def told_in_order(self, T: Atom) -> list[Object]:
        """The objects with a fact for T, or for a type below it, in the order of facts.

        Their degree may be 0.
        """
        kinds = [T]
        for _, lower in subtypes(T, self.theory.axioms):
            kinds += _instances(lower, self.told)
        if self.theory.conditional_axioms:
            below = frozenset(heads_below([head(T)], self.theory))
            kinds += sorted((K for K in self.told if head(K) in below), key=str)
        told = {
            key: entry
            for kind in kinds
            for key, entry in self.told.get(kind, _EMPTY).items()
        }
        return [sit for _, sit in sorted(told.values(), key=itemgetter(0))]

    # --- new assignments -----------------------------------------------------------

    def first_told(self, most: int) -> list[tuple[Object, Atom, Degree]]:
        """The first judgements that were told, at most so many, in order."""
        numbered = (
            (number, sit, T)
            for T, objects in self.told.items()
            for number, sit in objects.values()
        )
        first = nsmallest(most, numbered, key=itemgetter(0))
        return [(sit, T, self.told_degree(sit, T) or UNKNOWN) for _, sit, T in first]

    def with_fact(self, sit: Object, T: Atom, p: Degree) -> Assignment:
        """The assignment in which also sit : T, in place of an earlier fact.

        Raises `RefusedError` where a witness function says no, or an axiom contradicts.
        """
        self._check(sit, T, p)
        opened = self._opened_by(T, p)
        told = self._with(sit, T, p)
        return told if opened is self.opened else told._replace(opened=opened)

    def with_conditioned(self, said: Conditioned) -> Assignment:
        """The assignment in which a judgement depends on others so."""
        known = self.known
        for claim in (said.target, *[claim for claim, _ in said.condition]):
            for name in (identity(claim.sit), *_names(claim.type)):
                known = known if name in known else known.set(name, _EMPTY)
        links = self.links.with_conditioned(said)
        opened = self.opened.set(head(said.target.type), True)
        return self._replace(known=known, links=links, opened=opened)

    def with_expected(self, said: Expectation) -> Assignment:
        """The assignment in which whatever is of some types so probably is of T."""
        opened = self.opened.set(head(said.type), True)
        return self._replace(links=self.links.with_expected(said), opened=opened)

    def with_unknown(self, claims: tuple[Claim, ...]) -> Assignment:
        """The assignment in which nothing is known of how these claims depend."""
        return self._replace(links=self.links.with_unknown(claims))

    def with_perceived(self, sit: Object, T: PType) -> Assignment:
        """The assignment in which sit is of T as far as T's witness function says.

        Raises `RefusedError` where an axiom and what was judged before contradict it.
        """
        seen = self._with(sit, T, self.perceive(sit, T) or UNKNOWN)
        seen.degree_of(sit, T)
        return seen

    def with_function(self, of: Head, function: WitnessFunction) -> Assignment:
        """The assignment in which a function says what is of a type."""
        return self._replace(functions=self.functions.set(of, function))

    def under(self, theory: Signature) -> Assignment:
        """The assignment of the same facts under another theory."""
        return self if theory is self.theory else self._replace(theory=theory)

    def with_new(self, stem: str) -> tuple[str, Assignment]:
        """A name that no fact mentions and no earlier call gave out."""
        number = self.created + 1
        while f"{stem}{number}" in self.known:
            number += 1
        return f"{stem}{number}", self._replace(created=number)

    def _replace(self, **changes: Any) -> Assignment:
        """The assignment with other fields: every fact told makes one, so it is quick.

        It is what `dataclasses.replace` gives, in a fifth of the time.
        """
        changed = object.__new__(Assignment)
        changed.__dict__.update(self.__dict__, **changes)
        return changed

    def _with(self, sit: Object, T: Atom, p: Degree) -> Assignment:
        key = identity(sit)
        facts = self.known.get(key, _EMPTY)
        if facts.get(T) == p:
            return self
        spend(8)  # four maps are made anew, and what was before may be kept
        known = self.known.set(key, facts.set(T, p))
        for name in _names(T):
            if name not in known:
                known = known.set(name, _EMPTY)
        mine = self.told.get(T, _EMPTY)
        number = self.facts + 1
        entry = (mine[key][0], sit) if key in mine else (number, sit)
        told = self.told.set(T, mine.set(key, entry))
        new = self._replace(known=known, told=told, facts=number)
        return new._replace(replaced=Claim(sit, T)) if T in facts else new

    def _opened_by(self, T: Atom, p: Degree) -> Map[Head, bool]:
        """What is open once something is of T with a degree between."""
        if p in (CERTAIN, REFUTED) or head(T) in self.opened:
            return self.opened
        return self.opened.set(head(T), True)

    def _check(self, sit: Object, T: Atom, p: Degree) -> None:
        if head(T) not in self.functions and head(T) not in self.theory.axiom_heads:
            return  # nothing is said of it but facts
        facts = self.known.get(identity(sit), _EMPTY)
        kinds = (T, *(upper for _, upper in supertypes(T, self.theory.axioms)))
        for kind in kinds:
            if self._refuses(sit, kind, p):
                raise RefusedError(
                    f"{notation(sit)} : {T} is refused by the witness function of "
                    f"{head(kind).name}"
                )
        self._clip(sit, T, p, *self._bounds(facts, sit, T))

    def _clip(
        self,
        sit: Object,
        T: Atom,
        p: Degree,
        lower: Bound,
        upper: Bound,
    ) -> Degree:
        """The degree within the bounds that axioms set; `RefusedError` if it is
        outside.
        """
        lo, hi = max(p.lo, lower[0]), min(p.hi, upper[0])
        if lo > hi:
            raise RefusedError(
                f"{notation(sit)} : {T} cannot have the probability {p}: "
                f"{upper[1] if p.lo > upper[0] else lower[1]}"
            )
        return Degree(lo, hi)

    def _refuses(self, sit: Object, T: Atom, p: Degree) -> bool:
        """Whether a witness function rules out what is told for certain."""
        return p.lo > 0.0 and self.perceive(sit, T) == REFUTED

    # --- what axioms say -----------------------------------------------------------

    def _bounds(self, facts: Facts, sit: Object, T: Atom) -> tuple[Bound, Bound]:
        """How probable a : T is at least and at most, and by which axiom."""
        if head(T) not in self.theory.axiom_heads:
            return _NO_LOWER, _NO_UPPER
        return self._bound_below(facts, sit, T), self._bound_above(facts, sit, T)

    def _bound_below(self, facts: Facts, sit: Object, T: Atom) -> Bound:
        """a : T is at least as probable as a : S, wherever S <: T; and by which."""
        best, why = 0.0, ""
        for axiom, lower in subtypes(T, self.theory.axioms):
            seen = self.perceive(sit, lower) if isinstance(lower, Basic) else None
            if seen is not None and seen.lo > best and lower not in facts:
                best, why = seen.lo, f"by {axiom} and the witness function of {lower}"
            for kind in _instances(lower, facts):
                if facts[kind].lo > best:
                    best = facts[kind].lo
                    why = f"by {axiom} and {notation(sit)} : {kind}"
        for p, way in self._degrees_by_conditions(facts, sit, T):
            if p.lo > best:
                best, why = p.lo, way
        return best, why

    def _degrees_by_conditions(
        self, facts: Facts, sit: Object, T: Atom
    ) -> Iterator[tuple[Degree, str]]:
        """How probable T is by each way to follow under conditions, and by which."""
        if not self.theory.conditional_axioms:
            return
        for way in ways_to_follow(T, facts, self.theory):
            p, reason = self.degree_of_conditions(way)
            axioms = " and ".join(map(str, way.axioms))
            said = f"by {axioms} and {notation(sit)} : {way.source}"
            said = f"{said}: {reason}" if reason else said
            yield _degree_of_all([facts[way.source], p]), said

    def degree_of_conditions(self, way: Way) -> tuple[Degree, str]:
        """How certain it is that all conditions of a way hold, and why.

        They may depend on one another, so that there are Fréchet's bounds.
        """
        degrees, reasons = [], []
        for condition in way.conditions:
            p, reason = condition.degree(self)
            degrees.append(p)
            reasons.append(reason)
            if p == REFUTED:
                return p, reason
        return _degree_of_all(degrees), "; ".join(filter(None, reasons))

    def _bound_above(self, facts: Facts, sit: Object, T: Atom) -> Bound:
        """a : T is at most as probable as a : U, wherever T <: U; and by which."""
        best, why = 1.0, ""
        for axiom, upper in supertypes(T, self.theory.axioms):
            seen = self.perceive(sit, upper) if isinstance(upper, Basic) else None
            if seen is not None and seen.hi < best and upper not in facts:
                best, why = seen.hi, f"by {axiom} and the witness function of {upper}"
            for kind in _instances(upper, facts):
                if facts[kind].hi < best:
                    best = facts[kind].hi
                    why = f"by {axiom} and {notation(sit)} : {kind} with {facts[kind]}"
        for p, reason in self._limits_by_conditions(facts, sit, T):
            if p < best:
                best, why = p, reason
        apart, excluded = self._bound_by_exclusion(facts, sit, T)
        return (apart, excluded) if apart < best else (best, why)

    def _limits_by_conditions(
        self, facts: Facts, sit: Object, T: Atom
    ) -> Iterator[Bound]:
        """How probable T is at most by what it would entail, or has as a condition."""
        for axiom, condition in self.requirements(T):
            p, reason = condition.degree(self)
            yield p.hi, f"by {axiom}: {reason}"
        if not self.theory.conditional_axioms:
            return
        for kind, p in facts.items():
            if p.hi == 1.0:
                continue
            for way in ways_to_follow(kind, (T,), self.theory):
                if self.degree_of_conditions(way)[0] == CERTAIN:
                    axioms = " and ".join(map(str, way.axioms))
                    yield p.hi, f"by {axioms} and {notation(sit)} : {kind} with {p}"

    def requirements(self, T: Atom) -> Iterator[tuple[Axiom, Condition]]:
        """The conditions on which alone something is of T, each with its axiom."""
        if not self.theory.restrictive_axioms:
            return
        for kind in (T, *(upper for _, upper in supertypes(T, self.theory.axioms))):
            for axiom in self.theory.restrictive_axioms:
                bound = match_schema(axiom.lower, kind)
                for condition in axiom.only if bound is not None else ():
                    yield axiom, condition.with_values(bound or {})

    def _bound_by_exclusion(self, facts: Facts, sit: Object, T: Atom) -> Bound:
        """a : T is as probable as what is left by a : S, wherever S <: ~T."""
        itself = find_exclusion(T, T, self.theory)
        if itself:
            return 0.0, f"by {itself}"
        found = [(1.0, "")]
        for kind, p in facts.items():
            exclusion = find_exclusion(T, kind, self.theory) if p.lo > 0.0 else None
            if exclusion:
                why = f"by {exclusion} and {notation(sit)} : {kind}"
                found.append((complement(p.lo), why))
        for one in self.seen_types() if self.theory.exclusions else ():
            exclusion = (
                find_exclusion(T, one, self.theory) if one not in facts else None
            )
            seen = self.perceive(sit, one) if exclusion else None
            if seen is not None and seen.lo > 0.0:
                why = f"by {exclusion} and the witness function of {one}"
                found.append((complement(seen.lo), why))
        return min(found)


def _degree_of_all(degrees: Iterable[Degree]) -> Degree:
    """The bounds on all at once, however they depend on one another.

    >>> print(_degree_of_all([Degree(0.8, 0.9), Degree(0.7, 1.0)]))
    [0.5, 0.9]
    """
    found = [p for p in degrees if p != CERTAIN] or [CERTAIN]
    least = sum(p.lo for p in found) - (len(found) - 1)
    return Degree(max(0.0, least), min(p.hi for p in found))


def _instances(schema: Atom, facts: Map[Atom, Any]) -> list[Atom]:
    """The types of facts that one side of an axiom stands for, in a fixed order."""
    if not free_paths(schema):
        return [schema] if schema in facts else []
    return sorted((T for T in facts if match_schema(schema, T) is not None), key=str)


def _names(T: Atom) -> Iterator[str]:
    """The objects with names that a ptype is about."""
    if isinstance(T, PType):
        yield from (arg for arg in T.args if isinstance(arg, str))


def _call(T: Atom, args: tuple[Object, ...]) -> str:
    shown = ", ".join(map(notation, args))
    return f"the witness function of {head(T).name}({shown})"
