"""Some rule takes each event that can be heard: P27."""

from __future__ import annotations

from collections.abc import Iterator

from ttr.computing.subtyping import subtype
from ttr.testing.coverage import Coverage
from ttr.testing.properties.property import Property
from ttr.testing.strategies.random_states import heard_by
from ttr.theories.theory import Theory
from ttr.types.objects import Object
from ttr.types.paths import subterms
from ttr.types.syntax import PType, RecordType, TypeNode
from ttr.updates.games import Game
from ttr.updates.rules import Body, Rule
from ttr.updates.update_strategies import event_types, rules_of


def _why_dropped(coverage: Coverage) -> str:
    untaken = tuple(untaken_events(coverage.game))
    if not untaken:
        return ""
    names = ", ".join(untaken)
    if len(untaken) == 1:
        return f"{names} looks like an event, but no rule of the game takes it"
    return f"{names} look like events, but no rule of the game takes them"


def untaken_events(game: Game) -> Iterator[str]:
    """The names of the types that a theory defines as events and no rule takes.

    A record type counts as an event if it has a proof object at a label where all
    events of the game have one. What a rule plans, asks for or speaks of does not.
    """
    theory = game.theory
    if theory is None or game.name not in theory.openings:
        return
    taken = event_types(_rules_of_games(theory))
    labels = _common_proof_labels(taken)
    if not labels:
        return
    used = _types_used_as_objects(theory)
    for name, T in theory.definitions.items():
        if not isinstance(T, RecordType) or T in used or not labels & _proof_labels(T):
            continue
        if not any(_are_comparable(T, on, theory) for on in (*taken, *heard_by(game))):
            yield name


def _rules_of_games(theory: Theory) -> Iterator[Rule]:
    """The rules of all the games of a theory."""
    for opening in theory.openings.values():
        yield from rules_of(opening.algorithm)


def _common_proof_labels(taken: tuple[TypeNode, ...]) -> frozenset[str]:
    """The labels at which every event that some rule takes has a proof object."""
    sets = [_proof_labels(T) for T in taken if isinstance(T, RecordType)]
    return frozenset.intersection(*sets) if sets else frozenset()


def _proof_labels(T: RecordType) -> frozenset[str]:
    return frozenset(label for label, one in T.fields if isinstance(one, PType))


def _types_used_as_objects(theory: Theory) -> frozenset[TypeNode]:
    """The record types that occur in a rule, a start, a fact or a ptype."""
    values: list[Object] = [
        given.type for given in theory.givens if hasattr(given, "type")
    ]
    for rule in _rules_of_games(theory):
        effect = rule.effect.value if isinstance(rule.effect, Body) else None
        values += [one for one in (rule.when, rule.where, effect) if one is not None]
    for opening in theory.openings.values():
        values += [opening.start, opening.type]
    for T in theory.definitions.values():
        values += [part for part in subterms((T,)) if isinstance(part, PType)]
    return frozenset(
        part
        for value in values
        for part in subterms((value,))
        if isinstance(part, RecordType)
    )


def _are_comparable(T: RecordType, on: TypeNode, theory: Theory) -> bool:
    """Is one of two types more specific than the other?"""
    return subtype(T, on, theory).yes or subtype(on, T, theory).yes


NOTHING_DROPPED = Property(
    "P27",
    "nothing heard is dropped",
    "some rule takes each type of events that the theory defines.",
    overall=_why_dropped,
)
