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
from ttr.signature.signature import Signature, head
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
    linked = _follow_links(facts, asked)
    more, whole = _relatives(facts, linked.claims)
    while more:
        linked = _follow_links(facts, [*linked.claims, *more])
        more, whole = _relatives(facts, linked.claims)
    untold = _known_by_axioms(facts, linked)
    claims = [claim for claim in linked.claims if claim not in untold]
    entailed = tuple(_entailments(facts, claims))
    exclusive = tuple(_exclusions(facts, claims))
    conditionals = tuple([_by_keys(one) for one in linked.said])
    links: list[tuple[Hashable, ...]] = [*entailed, *exclusive, *linked.unknown]
    links += [one.atoms for one in conditionals]
    degrees: dict[Hashable, Degree] = {
        claim.key: asked.get(claim) or facts.degree_of(claim.sit, claim.type)[0]
        for claim in claims
    }
    defined = _definitions(facts, untold, claims, degrees)
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
    facts: Assignment,
    untold: Iterable[Claim],
    claims: Iterable[Claim],
    degrees: Mapping[Hashable, Degree],
) -> dict[Hashable, Event]:
    """The claims known by axioms only, defined in terms of the other claims.

    Such a claim holds if one does that entails it. It may hold, with unknown
    probability, if all those hold that it entails and none that excludes it.
    """
    theory = facts.theory
    known = [(claim, Atomic(claim.key, degrees[claim.key])) for claim in claims]
    said: list[tuple[Claim, Event]] = list(known)
    found: dict[Hashable, Event] = {}
    for claim in untold:
        T, above_it = claim.type, supertype_set(claim.type, theory)
        mine = [pair for pair in said if _of_same(pair[0], claim)]
        enough = [event for one, event in mine if T in supertype_set(one.type, theory)]
        needed = [event for one, event in mine if one.type in above_it]
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


def _relatives(facts: Assignment, claims: Iterable[Claim]) -> tuple[list[Claim], bool]:
    """Other claims of the same objects that axioms relate to these; are they all?

    Certain claims are left out, as `Assignment.degree_of` draws what follows from them.
    """
    heads = facts.theory.axiom_heads
    subject = [claim for claim in claims if head(claim.type) in heads]
    found: list[Claim] = []
    whole = True
    for mine in _by_object(subject).values():
        known = set(mine)
        related = [
            other
            for other in dict.fromkeys(_others(facts, mine[0].sit))
            if head(other.type) in heads and other not in known
            if any(_is_related(facts.theory, claim.type, other.type) for claim in mine)
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


def _is_related(theory: Signature, S: Atom, T: Atom) -> bool:
    if T in supertype_set(S, theory) or S in supertype_set(T, theory):
        return True
    return find_exclusion(S, T, theory) is not None


def _entailments(
    facts: Assignment, claims: Iterable[Claim]
) -> Iterator[tuple[Key, Key]]:
    heads = facts.theory.axiom_heads
    for mine in _by_object(claims).values():
        types = [claim for claim in mine if head(claim.type) in heads]
        for one, other in permutations(types, 2):
            if other.type in supertype_set(one.type, facts.theory):
                yield one.key, other.key


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
