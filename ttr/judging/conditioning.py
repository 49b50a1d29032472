"""Conditional probability: judgements given others, and facts that depend on others.

p(a : T | b : S) = p(a : T and b : S) / p(b : S) (Cooper, Dobnik, Lappin and Larsson
2015).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from itertools import product

from ttr.errors import RefusedError, TTRError, UnsupportedError
from ttr.judging.assignments import Assignment
from ttr.judging.degrees_of_claims import probability_of
from ttr.judging.dependence_analysis import check_together, dependence
from ttr.judging.evaluator import claims_of, derivation
from ttr.judging.judgements import Why, combine_events
from ttr.judging.stated_dependence import Atom, Claim, Conditioned, Expectation
from ttr.probability import (
    All,
    Chance,
    Degree,
    Dependence,
    Event,
    ImpossibleError,
    are_apart,
    chance,
)
from ttr.safety.budgets import spend
from ttr.types.objects import Object
from ttr.types.printing import notation
from ttr.types.syntax import Basic, Meet, Negation, PType, TypeNode

Pair = tuple[Object, TypeNode]

PARENTS = 10
"""The largest number of judgements that a table may depend on."""


def derive_conditional(
    facts: Assignment, sit: Object, T: TypeNode, when: Sequence[Pair]
) -> Why:
    """Derive p(sit : T | when), the probability given other judgements.

    Raises `RefusedError` where these cannot all hold.
    """
    claim = derivation(facts, sit, T)
    conditions = tuple([derivation(facts, *pair) for pair in when])
    given = ", ".join([f"{notation(one.sit)} : {one.type}" for one in conditions])
    known = dependence(facts, claims_of([claim, *conditions]))
    event, condition = claim.event(), combine_events("all", conditions)
    try:
        found = probability_of(event, known, condition)
    except ImpossibleError:
        raise RefusedError(
            f"nothing follows given {given}, as that cannot be",
            hint="judge under conditions that are possible",
        ) from None
    said = partial(_explain_quotient, event, condition, known, found)
    parts = (claim, *conditions)
    return Why(sit, T, found.p, f"given {given}", parts, reckoned=said)


def _explain_quotient(
    event: Event, condition: Event, known: Dependence, found: Chance
) -> str:
    """Say how a conditional degree is computed: p(E and C) / p(C)."""
    links = [link for one in found.rests_on for link in one.links()]
    said = ["bounds, as too much hangs together"] * (not found.exact)
    if are_apart((event, condition), known):
        return "; ".join((*said, "which has nothing to do with it"))
    both = chance(All((event, condition)), known).p
    whole = chance(condition, known).p
    if both.lo == both.hi and whole.lo == whole.hi:
        said.append(f"{both} / {whole}")
    return "; ".join((*said, *links))


def with_conditional_fact(
    facts: Assignment, sit: Object, T: TypeNode, p: Degree, when: Sequence[Pair]
) -> Assignment:
    """The assignment in which p(sit : T | when) is p.

    Raises `RefusedError` where that contradicts the facts.
    """
    literals = [
        (Claim(one, kind), so)
        for one, S in when
        for kind, so in _literals(S, "a condition")
    ]
    target = Claim(sit, _atom(T, "what depends on others"))
    if any(claim.key == target.key for claim, _ in literals):
        raise TTRError(f"{target} cannot depend on itself")
    told = facts.with_conditioned(Conditioned(target, tuple(literals), p))
    check_together(told, target.sit, target.type)
    return told


def with_expectation(
    facts: Assignment, T: TypeNode, p: Degree, when: Sequence[TypeNode]
) -> Assignment:
    """The assignment in which p(T || when) is p for every object."""
    kind = _atom(T, "what depends on others")
    literals = [one for S in when for one in _literals(S, "a condition")]
    if not literals or any(one is kind for one, _ in literals):
        raise TTRError(f"{T} has to depend on some other type")
    return facts.with_expected(Expectation(kind, tuple(literals), p))


def with_unknown_dependence(facts: Assignment, claims: Sequence[Pair]) -> Assignment:
    """The assignment in which it is unknown how these claims depend on one another."""
    found = [Claim(sit, _atom(T, "what depends on others")) for sit, T in claims]
    if len(found) < 2:
        raise TTRError("two judgements or more depend on one another, found fewer")
    return facts.with_unknown(tuple(found))


def table_rows(
    on: Sequence[object], rows: Mapping[tuple[bool, ...], object]
) -> Iterator[tuple[tuple[bool, ...], object]]:
    """The rows of a table in order; `TTRError` if one is missing or superfluous."""
    if len(on) > PARENTS:
        raise TTRError(f"a table is on {PARENTS} judgements at most, found {len(on)}")
    if not isinstance(rows, Mapping):
        raise TTRError("the rows of a table are a dict from cases to probabilities")
    cases = list(product((True, False), repeat=len(on)))
    found = dict(rows)
    missing = [case for case in cases if case not in found]
    if missing:
        raise TTRError(
            f"the table has no row for {_case(missing[0])}",
            hint=f"give a probability for each of the {len(cases)} cases",
        )
    extra = next((case for case in found if case not in cases), None)
    if extra is not None:
        raise TTRError(
            f"the table has a row for {extra!r}, but it is about {len(on)} judgements",
            hint="a row is for a tuple of True and False, one for each of them",
        )
    yield from ((case, found[case]) for case in cases)


def _case(case: tuple[bool, ...]) -> str:
    return f"({', '.join(map(str, case))})"


def _atom(T: TypeNode, what: str) -> Atom:
    if isinstance(T, Basic | PType):
        return T
    raise UnsupportedError(f"{what} is of a basic type or a ptype, found {T}")


def _literals(T: TypeNode, what: str) -> list[tuple[Atom, bool]]:
    """The basic types and ptypes that T is a meet of; False for those it denies."""
    spend()
    match T:
        case Meet(parts):
            return [one for part in parts for one in _literals(part, what)]
        case Negation(body):
            return [(_atom(body, what), False)]
    return [(_atom(T, what), True)]
