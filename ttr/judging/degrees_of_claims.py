"""The degree of a claim from those of its grounds, and the arithmetic in words."""

from __future__ import annotations

from collections.abc import Sequence

from ttr.judging.dependence_analysis import contradiction
from ttr.judging.judgements import How, Why
from ttr.probability import (
    CERTAIN,
    INDEPENDENT,
    REFUTED,
    All,
    Chance,
    ContradictionError,
    Degree,
    Dependence,
    Event,
    ImpossibleError,
    are_apart,
    chance,
)
from ttr.probability.events import SURE, atoms

SHOWN = 6
"""The number of factors of a product that are shown."""

NAMED = 3
"""The number of links between judgements that are named."""


def probability_of(event: Event, known: Dependence, given: Event = SURE) -> Chance:
    """The probability of an event; `RefusedError` where the facts are contradictory."""
    try:
        return chance(event, known, given)
    except ContradictionError as wrong:
        raise contradiction(wrong.component) from None


def explain_probability(
    how: How,
    grounds: Sequence[Why],
    found: Chance,
    known: Dependence = INDEPENDENT,
) -> str:
    """Say how a degree follows from those of the grounds: a product, or their links.

    >>> from ttr import Ind
    >>> from ttr.probability import All, Atomic
    >>> some = [Why(a, Ind, Degree(0.5, 0.5), "given") for a in ("a", "b")]
    >>> explain_probability("any", some, chance(All(())))
    '1 − (1 − 0.5) × (1 − 0.5)'
    """
    uncertain = [ground for ground in grounds if ground.p not in (CERTAIN, REFUTED)]
    apart = are_apart([ground.event() for ground in uncertain], known)
    keys = {atom.atom for g in uncertain for atom in atoms(known.spelt_out(g.event()))}
    linked = [one for one in known.components if not keys.isdisjoint(one.atoms)]
    links = [
        link for component in linked or found.rests_on for link in component.links()
    ]
    said = ["bounds, as too much hangs together"] * (not found.exact)
    if apart and (len(uncertain) > 1 or how == "none"):
        return "; ".join((_product(how, [ground.p for ground in uncertain]), *said))
    if links and how == "all" and 1 < len(uncertain) <= SHOWN:
        said.append(_chain(uncertain, known))
    elif not (links or apart):
        said.append("some of these are the same judgement")
    said += [*links[:NAMED], *["…"] * (len(links) > NAMED)]
    return "; ".join(filter(None, said))


def _chain(grounds: Sequence[Why], known: Dependence) -> str:
    """The chain rule: the degree of each ground given those before it."""
    events = [ground.event() for ground in grounds]
    before = [All(tuple(events[:number])) for number in range(len(events))]
    try:
        pairs = zip(events, before, strict=True)
        factors = [chance(event, known, given).p for event, given in pairs]
    except ImpossibleError:
        return ""
    return f"{' × '.join(map(str, factors))}, each given those before"


def _product(how: How, degrees: Sequence[Degree]) -> str:
    """The product of the degrees of independent judgements, in words."""
    some = degrees[:SHOWN]
    more = f" × … ({len(degrees)} of them)" if len(degrees) > SHOWN else ""
    match how:
        case "all":
            return " × ".join(map(str, some)) + more
        case "any":
            return "1 − " + " × ".join(f"(1 − {p})" for p in some) + more
    return f"1 − {degrees[0]}"  # one judgement is denied
