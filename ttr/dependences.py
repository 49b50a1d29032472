"""How the judgements that a claim rests on depend on one another, by the facts."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Mapping
from itertools import combinations
from typing import NamedTuple

from ttr.assignments import Assignment, head
from ttr.axioms import above, excluding
from ttr.errors import Refused
from ttr.links import Atom, Claim, Conditioned, Key
from ttr.probability import (
    CERTAIN,
    INDEPENDENT,
    UNKNOWN,
    Component,
    Conditional,
    Degree,
    Dependence,
    feasible,
)
from ttr.syntax import Object, identity

__all__ = ["check_together", "contradiction", "dependence"]

RELATIVES = 8
"""How many judgements of one object are looked at, where some bear on others."""

SHOWN = 3
"""How many links or judgements are named."""


def dependence(facts: Assignment, asked: Mapping[Claim, Degree]) -> Dependence:
    """What is known of how these claims depend, and of others that tell of them.

    Each comes with its degree, as far as it is known.
    """
    theory = facts.theory
    if not (theory.axioms or theory.exclusions or facts.links):
        return INDEPENDENT
    linked = _linked(facts, asked)
    more = _relatives(facts, linked.claims)
    while more:
        linked = _linked(facts, [*linked.claims, *more])
        more = _relatives(facts, linked.claims)
    entailed = tuple(_entailed(facts, linked.claims))
    exclusive = tuple(_exclusive(facts, linked.claims))
    conditionals = tuple([_by_keys(one) for one in linked.said])
    links: list[tuple[Hashable, ...]] = [*entailed, *exclusive, *linked.unknown]
    links += [one.atoms for one in conditionals]
    if not links:
        return INDEPENDENT
    involved = {key for link in links for key in link}
    degrees: dict[Hashable, Degree] = {
        claim.key: asked.get(claim) or facts.degree_of(claim.sit, claim.type)[0]
        for claim in linked.claims
        if claim.key in involved
    }
    names: dict[Hashable, object] = {claim.key: claim for claim in linked.claims}
    return Dependence(degrees, entailed, exclusive, conditionals, linked.unknown, names)


def _by_keys(said: Conditioned) -> Conditional:
    condition = tuple([(claim.key, so) for claim, so in said.condition])
    return Conditional(said.target.key, condition, said.p)


class _Linked(NamedTuple):
    """Claims, with those they are conditioned on and those that may depend on them."""

    claims: list[Claim]
    said: list[Conditioned]
    unknown: tuple[tuple[Key, ...], ...]


def _linked(facts: Assignment, claims: Iterable[Claim]) -> _Linked:
    """The claims and what was said of how they depend, followed all the way."""
    links = facts.links
    found = {claim.key: claim for claim in claims}
    said: list[Conditioned] = []
    unknown: dict[tuple[Key, ...], None] = {}
    waiting = list(found.values())
    while waiting:
        claim = waiting.pop()
        mine = links.of(claim)
        said += mine
        together = links.unknown.get(claim.key, ())
        unknown.update((tuple([one.key for one in group]), None) for group in together)
        more = [other for one in mine for other, _ in one.condition]
        more += [other for other in links.on(claim) if _is_known(facts, other)]
        more += [other for group in together for other in group]
        for other in more:
            if other.key not in found:
                found[other.key] = other
                waiting.append(other)
    return _Linked(list(found.values()), said, tuple(unknown))


def _is_known(facts: Assignment, claim: Claim) -> bool:
    """Whether something is known of a claim apart from what it is conditioned on."""
    return facts.degree_of(claim.sit, claim.type)[0] != UNKNOWN


# --- what axioms link ---


def _relatives(facts: Assignment, claims: Iterable[Claim]) -> list[Claim]:
    """What else is known of the same objects, and related to the claims by axioms.

    What is certain is left out: axioms say of each claim by itself what follows.
    """
    heads = facts.theory.related
    subject = [claim for claim in claims if head(claim.type) in heads]
    found: list[Claim] = []
    for mine in _by_object(subject).values():
        known = set(mine)
        others = _others(facts, mine[0].sit)
        related = [
            other
            for other in others
            if head(other.type) in heads and other not in known
            if any(_is_related(facts, claim, other) for claim in mine)
        ]
        room = max(0, RELATIVES - len(mine))
        found += sorted(dict.fromkeys(related), key=str)[:room]
    return found


def _others(facts: Assignment, sit: Object) -> Iterator[Claim]:
    """What is known, but not for certain, of an object; in no order."""
    yield from facts.links.targets(sit)
    for T in facts.types_of(sit):
        if facts.told_degree(sit, T) != CERTAIN:
            yield Claim(sit, T)


def _is_related(facts: Assignment, one: Claim, other: Claim) -> bool:
    axioms = facts.theory.axioms
    return (
        any(upper is other.type for _, upper in above(one.type, axioms))
        or any(upper is one.type for _, upper in above(other.type, axioms))
        or excluding(one.type, other.type, facts.theory) is not None
    )


def _entailed(facts: Assignment, claims: Iterable[Claim]) -> Iterator[tuple[Key, Key]]:
    axioms = facts.theory.axioms
    known = {claim.key for claim in claims} if axioms else ()
    for sit, T in known:
        for _, upper in above(T, axioms):
            if (sit, upper) in known:
                yield (sit, T), (sit, upper)


def _exclusive(facts: Assignment, claims: Iterable[Claim]) -> Iterator[tuple[Key, Key]]:
    if not facts.theory.exclusions:
        return
    for mine in _by_object(claims).values():
        for one, other in combinations(mine, 2):
            if excluding(one.type, other.type, facts.theory):
                yield one.key, other.key


def _by_object(claims: Iterable[Claim]) -> dict[object, list[Claim]]:
    found: dict[object, list[Claim]] = {}
    for claim in claims:
        found.setdefault(identity(claim.sit), []).append(claim)
    return found


# --- what cannot be ---


def check_together(facts: Assignment, sit: Object, T: Atom) -> None:
    """Raises `Refused` where what was told of an object contradicts that it is of T."""
    claim = Claim(sit, T)
    known = dependence(facts, {claim: facts.degree_of(sit, T)[0]})
    number = known.place.get(claim.key)
    if number is not None and not feasible(known.components[number]):
        raise contradiction(known.components[number])


def contradiction(component: Component) -> Refused:
    """The error that says which judgements cannot all be as they were given."""
    degrees = [
        f"{component.written(atom)} with {p}"
        for atom, p in component.degrees.items()
        if p != UNKNOWN
    ]
    links = component.links()
    said = "; ".join((", ".join(degrees[:SHOWN]), *links[:SHOWN]))
    return Refused(
        f"these cannot all be so: {said}",
        hint="change one of the degrees, or what was said of how they depend",
    )
