"""Static checks of rules: what is wrong with a rule set before anything runs."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, TypeAlias

from ttr.errors import UpdateError
from ttr.judging.models import Model, as_model
from ttr.safety.budgets import within_budget
from ttr.types.syntax import Record, RecordType, TypeNode, freeze
from ttr.updates.algorithms import Algorithm, checked
from ttr.updates.checks.bindings import circular, unlisted
from ttr.updates.checks.conflicting_rules import disagreements
from ttr.updates.checks.endless_loops import endless
from ttr.updates.checks.faults import Fault
from ttr.updates.checks.rulesets import RuleSet
from ttr.updates.checks.unknown_paths import misread, missing, unbound
from ttr.updates.checks.unreachable_rules import dead
from ttr.updates.checks.untriggered_rules import unheard, unset
from ttr.updates.checks.wrong_values import misfits
from ttr.updates.rules import Rule

if TYPE_CHECKING:
    from ttr.updates.games import Game

__all__ = ["Fault", "faults", "faults_alone", "faults_of"]

Check: TypeAlias = Callable[[RuleSet], Iterator[Fault]]
"""What looks for faults of some sort."""


def faults(
    algorithm: Algorithm,
    type: RecordType,
    *,
    start: Record | None = None,
    model: Model | None = None,
    hears: Iterable[TypeNode] = (),
) -> tuple[Fault, ...]:
    """What is wrong with the rules of a strategy, over states of this type.

    Nothing is run. Where the `start` is known, rules that wait for what nothing brings
    about are found, too; with a `model`, values that it says are of other types; where
    events are of the types `hears` only, rules for other events. What cannot be
    followed is left alone: what is found is wrong, but what is not found need not be
    right. Raises `UpdateError` for what is no strategy, no type of states or no events.

    >>> from ttr.building.constructors import rectype
    >>> from ttr.types.records import replace
    >>> from ttr.types.syntax import Basic
    >>> from ttr.updates import rule
    >>> Count = Basic("Count")
    >>> @rule(when=rectype(nn=Count))
    ... def reset(s):
    ...     "Begins anew."
    ...     return replace(s, nn=0)
    >>> faults(reset, rectype(n=Count))[0].message
    'the rule reset asks for nn, but a state has no nn'
    """
    checked("faults", (algorithm,))
    if not isinstance(type, RecordType):
        raise UpdateError(f"the type of a state is a record type, found {type!r}")
    known = Model() if model is None else as_model(model)
    given = None if start is None else freeze(start)
    return _found(RuleSet(algorithm, type, given, known, _events(hears)))


def _events(hears: object) -> tuple[TypeNode, ...]:
    found = tuple(hears) if isinstance(hears, Iterable) else (hears,)
    if isinstance(hears, TypeNode) or not all(isinstance(T, TypeNode) for T in found):
        raise UpdateError(f"what is heard is a list of types, found {hears!r}")
    return found


def faults_of(game: Game) -> tuple[Fault, ...]:
    """What is wrong with the rules of a game, its start and the moves that it plans."""
    agenda = None if game.agenda is None else tuple(game.agenda.split("."))
    rules = RuleSet(
        game.algorithm, game.type, game.start, game.model, game.hears, agenda
    )
    return _found(rules)


def faults_alone(rule: Rule) -> tuple[Fault, ...]:
    """What is wrong with a rule whatever the states are that it is meant for.

    Raises `UpdateError` for what is no rule.
    """
    if not isinstance(rule, Rule):
        raise UpdateError(f"faults_alone takes a rule, found {rule!r}")
    return _found(RuleSet(rule, rule.when, None, Model(), ()), ALONE)


CHECKS = (
    unbound,
    unlisted,
    missing,
    circular,
    misfits,
    dead,
    unset,
    unheard,
    disagreements,
    endless,
)
"""What is looked for, in the order in which it is reported."""

ALONE = (unbound, unlisted, misread, circular, dead)
"""What is looked for in a rule of which it is not known what its states are."""

NEVER = ("dead", "unset")
"""The sorts of faults that say that a rule never fires."""


@within_budget
def _found(rules: RuleSet, checks: Iterable[Check] = CHECKS) -> tuple[Fault, ...]:
    """The faults, but that a rule never fires where it has another that explains it."""
    found: dict[object, Fault] = {}
    explained: set[Rule | None] = set()
    for check in checks:
        told = list(check(rules))
        for fault in told:
            if fault.sort not in NEVER or fault.rule not in explained:
                found.setdefault(_place(fault), fault)
        explained |= {fault.rule for fault in told}
    return tuple(found.values())


def _place(fault: Fault) -> object:
    """What is told once: several rules may share what is written in one place."""
    if fault.sort == "missing" and fault.span:
        return fault.span, fault.hint
    return fault
