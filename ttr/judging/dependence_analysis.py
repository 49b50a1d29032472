"""How the judgements that a claim rests on depend on one another by the facts."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Mapping
from itertools import combinations, permutations
from typing import NamedTuple

from ttr.errors import RefusedError
from ttr.judging.assignments import Assignment
from ttr.judging.stated_dependence import Atom, Claim, Conditioned, Key
from ttr.probability import (
    CERTAIN,
    INDEPENDENT,
    REFUTED,
    UNKNOWN,
    All,
    AnyOf,
    Atomic,
    Component,
    Conditional,
    Degree,
    Dependence,
    Event,
    Not,
    feasible,
)
from ttr.safety.budgets import spend
from ttr.signature.axioms import find_exclusion, supertype_set
from ttr.signature.conditional_axioms import ways_to_follow
from ttr.signature.signature import head
from ttr.types.interning import identity
from ttr.types.objects import Object

RELATIVES = 32
"""The number of related judgements of one object that are taken into account."""

SHOWN = 3
"""The number of links or judgements that a message names."""


def dependence(facts: Assignment, asked: Mapping[Claim, Degree]) -> Dependence:
    """How these claims depend on one another, and on others that bear on them.

    `asked` gives the claims with their degrees.
    """
    theory = facts.theory
    if not (theory.axioms or theory.exclusions or facts.links):
        return INDEPENDENT
    axioms = _Axioms(facts)
    linked = _follow_links(facts, asked)
    more, whole = _relatives(axioms, linked.claims)
    while more:
        linked = _follow_links(facts, [*linked.claims, *more])
        more, whole = _relatives(axioms, linked.claims)
    unclear = tuple(_unclear_entailments(axioms, linked.claims))
    linked = linked._replace(unknown=(*linked.unknown, *unclear))
    untold = _known_by_axioms(facts, linked)
    claims = [claim for claim in linked.claims if claim not in untold]
    entailed = tuple(_entailments(axioms, claims))
    exclusive = tuple(_exclusions(facts, claims))
    conditionals = tuple([_by_keys(one) for one in linked.said])
    links: list[tuple[Hashable, ...]] = [*entailed, *exclusive, *linked.unknown]
    links += [one.atoms for one in conditionals]
    degrees: dict[Hashable, Degree] = {
        claim.key: asked.get(claim) or facts.degree_of(claim.sit, claim.type)[0]
        for claim in claims
    }
    defined = _definitions(axioms, untold, claims, degrees)
    if not (links or defined):
        return INDEPENDENT
    return Dependence(
        degrees,
        entailed,
        exclusive,
        conditionals,
        linked.unknown,
        whole,
        {claim.key: claim for claim in linked.claims},
        defined,
    )


def _known_by_axioms(facts: Assignment, linked: _LinkedClaims) -> dict[Claim, None]:
    """The claims that are known by axioms only, in a fixed order."""
    heads = facts.theory.axiom_heads
    targets = {claim for one in linked.said for claim in one.claims()}
    together = {key for group in linked.unknown for key in group}
    found = [
        claim
        for claim in linked.claims
        if head(claim.type) in heads
        and claim not in targets
        and claim.key not in together
        and not facts.is_told(claim.sit, claim.type)
    ]
    return dict.fromkeys(sorted(found, key=str))


def _definitions(
    axioms: _Axioms,
    untold: Iterable[Claim],
    claims: Iterable[Claim],
    degrees: Mapping[Hashable, Degree],
) -> dict[Hashable, Event]:
    """The claims known by axioms only, defined in terms of the other claims.

    Such a claim holds if one does that entails it. It may hold, with unknown
    probability, if all those hold that it entails and none that excludes it.
    """
    theory = axioms.facts.theory
    known = [(claim, Atomic(claim.key, degrees[claim.key])) for claim in claims]
    said: list[tuple[Claim, Event]] = list(known)
    found: dict[Hashable, Event] = {}
    for claim in untold:
        T = claim.type
        mine = [pair for pair in said if _of_same(pair[0], claim)]
        enough = [event for one, event in mine if axioms.entail(one.type, T)]
        needed = [event for one, event in mine if axioms.entail(T, one.type)]
        apart = [
            Not(event) for one, event in mine if find_exclusion(one.type, T, theory)
        ]
        if not (enough or needed or apart):
            said.append((claim, Atomic(claim.key, UNKNOWN)))
            continue
        free = Atomic(("only axioms tell of", claim.key), UNKNOWN)
        event = AnyOf((*enough, All((*needed, *apart, free))))
        found[claim.key] = event
        said.append((claim, event))
    return found


def _of_same(one: Claim, other: Claim) -> bool:
    return identity(one.sit) == identity(other.sit)


def _by_keys(said: Conditioned) -> Conditional:
    condition = tuple([(claim.key, so) for claim, so in said.condition])
    return Conditional(said.target.key, condition, said.p)


class _LinkedClaims(NamedTuple):
    """Claims with those they are conditioned on and those conditioned on them."""

    claims: list[Claim]
    said: list[Conditioned]
    unknown: tuple[tuple[Key, ...], ...]


def _follow_links(facts: Assignment, claims: Iterable[Claim]) -> _LinkedClaims:
    """The claims and all that are linked to them by what was said of dependence."""
    links = facts.links
    found = {claim.key: claim for claim in claims}
    said: list[Conditioned] = []
    unknown: dict[tuple[Key, ...], None] = {}
    waiting = list(found.values())
    while waiting:
        claim = waiting.pop()
        mine = links.of(claim)
        if not mine and not facts.is_told(claim.sit, claim.type):
            mine = links.in_general(claim)
        said += mine
        together = links.unknown.get(claim.key, ())
        unknown.update((tuple([one.key for one in group]), None) for group in together)
        more = [other for one in mine for other, _ in one.condition]
        more += [other for other in links.on(claim) if _is_informative(facts, other)]
        more += [other for group in together for other in group]
        for other in more:
            if other.key not in found:
                found[other.key] = other
                waiting.append(other)
    return _LinkedClaims(list(found.values()), said, tuple(unknown))


def _is_informative(facts: Assignment, claim: Claim) -> bool:
    """Does a claim tell anything about the claims that it is conditioned on?

    In a network a claim does not of which nothing else is known, nor of what is
    conditioned on it. There all conditionals of a claim have the same conditions, and
    no axiom is about it.
    """
    waiting, seen = [claim], {claim.key}
    while waiting:
        spend()
        one = waiting.pop()
        if facts.degree_of(one.sit, one.type)[0] != UNKNOWN:
            return True
        parents = [
            frozenset(on.key for on, _ in said.condition)
            for said in facts.links.of(one)
        ]
        if len(set(parents)) > 1 or head(one.type) in facts.theory.axiom_heads:
            return True
        further = [other for other in facts.links.on(one) if other.key not in seen]
        seen.update(other.key for other in further)
        waiting += further
    return False


# --- what axioms link ---


class _Axioms:
    """What the axioms say of two types of one object, in a model.

    Axioms with conditions say it where the conditions hold there.
    """

    def __init__(self, facts: Assignment) -> None:
        self.facts = facts
        self._asked: dict[tuple[Atom, Atom], Degree] = {}

    def entail(self, S: Atom, T: Atom) -> bool:
        """Is whatever is of S also of T?"""
        if T in supertype_set(S, self.facts.theory):
            return True
        return S is not T and self._degree(S, T) == CERTAIN

    def leave_open(self, S: Atom, T: Atom) -> bool:
        """Is it open whether what is of S is of T, as a condition is uncertain?"""
        return S is not T and self._degree(S, T) not in (CERTAIN, REFUTED)

    def _degree(self, S: Atom, T: Atom) -> Degree:
        """How certain it is that axioms with conditions lead from S to T."""
        if head(T) not in self.facts.theory.conditional_heads:
            return REFUTED
        if (S, T) not in self._asked:
            ways = ways_to_follow(T, (S,), self.facts.theory)
            degrees = [self.facts.degree_of_conditions(way)[0] for way in ways]
            best = max((p.lo for p in degrees), default=0.0)
            most = max((p.hi for p in degrees), default=0.0)
            self._asked[S, T] = Degree(best, most)
        return self._asked[S, T]

    def relate(self, S: Atom, T: Atom) -> bool:
        """Do they say anything of how S and T depend on one another?"""
        for one, other in ((S, T), (T, S)):
            if self.entail(one, other) or self.leave_open(one, other):
                return True
        return find_exclusion(S, T, self.facts.theory) is not None


def _relatives(axioms: _Axioms, claims: Iterable[Claim]) -> tuple[list[Claim], bool]:
    """Other claims of the same objects that axioms relate to these; are they all?

    Certain claims are left out, as `Assignment.degree_of` draws what follows from them.
    """
    facts, heads = axioms.facts, axioms.facts.theory.axiom_heads
    subject = [claim for claim in claims if head(claim.type) in heads]
    found: list[Claim] = []
    whole = True
    for mine in _by_object(subject).values():
        known = set(mine)
        related = [
            other
            for other in dict.fromkeys(_others(facts, mine[0].sit))
            if head(other.type) in heads and other not in known
            if any(axioms.relate(claim.type, other.type) for claim in mine)
        ]
        room = max(0, RELATIVES - len(mine))
        whole = whole and len(related) <= room
        found += sorted(related, key=str)[:room]
    return found, whole


def _others(facts: Assignment, sit: Object) -> Iterator[Claim]:
    """The uncertain claims of an object, in no order."""
    yield from facts.links.claims_about(sit)
    yield from (Claim(sit, T) for T in facts.seen_types())
    for T in facts.types_of(sit):
        if facts.told_degree(sit, T) != CERTAIN:
            yield Claim(sit, T)


def _entailments(axioms: _Axioms, claims: Iterable[Claim]) -> Iterator[tuple[Key, Key]]:
    for one, other in _pairs_of_types(axioms, claims):
        if axioms.entail(one.type, other.type):
            yield one.key, other.key


def _unclear_entailments(
    axioms: _Axioms, claims: Iterable[Claim]
) -> Iterator[tuple[Key, Key]]:
    """The claims of which one may entail another: how they depend is unknown."""
    if not axioms.facts.theory.conditional_axioms:
        return
    for one, other in _pairs_of_types(axioms, claims):
        if axioms.leave_open(one.type, other.type):
            yield one.key, other.key


def _pairs_of_types(
    axioms: _Axioms, claims: Iterable[Claim]
) -> Iterator[tuple[Claim, Claim]]:
    """Each two claims of one object that axioms are about, in both orders."""
    heads = axioms.facts.theory.axiom_heads
    for mine in _by_object(claims).values():
        types = [claim for claim in mine if head(claim.type) in heads]
        yield from permutations(types, 2)


def _exclusions(
    facts: Assignment, claims: Iterable[Claim]
) -> Iterator[tuple[Key, Key]]:
    if not facts.theory.exclusions:
        return
    for mine in _by_object(claims).values():
        for one, other in combinations(mine, 2):
            if find_exclusion(one.type, other.type, facts.theory):
                yield one.key, other.key


def _by_object(claims: Iterable[Claim]) -> dict[object, list[Claim]]:
    found: dict[object, list[Claim]] = {}
    for claim in claims:
        found.setdefault(identity(claim.sit), []).append(claim)
    return found


# --- what cannot be ---


def check_together(facts: Assignment, sit: Object, T: Atom) -> None:
    """Raise `RefusedError` where sit : T contradicts other judgements of sit."""
    claim = Claim(sit, T)
    known = dependence(facts, {claim: facts.degree_of(sit, T)[0]})
    number = known.place.get(claim.key)
    if number is not None and not feasible(known.components[number], claim.key):
        raise contradiction(known.components[number])


def contradiction(component: Component) -> RefusedError:
    """The error that says which judgements cannot all be as they were given."""
    degrees = [
        f"{component.format_atom(atom)} with {p}"
        for atom, p in component.degrees.items()
        if p != UNKNOWN
    ]
    links = component.links()
    said = "; ".join((", ".join(degrees[:SHOWN]), *links[:SHOWN]))
    return RefusedError(
        f"these cannot all be so: {said}",
        hint="change one of the degrees, or what was said of how they depend",
    )
