"""Static checks of rules: what is wrong with a rule set before anything runs.

`rulesets` holds what all checks look at, `effect_summaries` what is known of effects;
`notation_effects` and `python_effects` find that out. Each other module has the checks
for one sort of faults. The checks may use the rest of `updates`, and what it may use.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, TypeAlias

from ttr.errors import UpdateError
from ttr.judging.models import Model, as_model
from ttr.safety.budgets import within_budget
from ttr.types.objects import Record, freeze
from ttr.types.syntax import RecordType, TypeNode
from ttr.updates.checks.bindings import find_circular_fields, find_unlistable_bindings
from ttr.updates.checks.conflicting_rules import find_conflicts
from ttr.updates.checks.endless_loops import find_endless_loops
from ttr.updates.checks.faults import Fault
from ttr.updates.checks.rulesets import RuleSet
from ttr.updates.checks.unknown_paths import (
    find_misread_paths,
    find_missing_paths,
    find_unbound_names,
)
from ttr.updates.checks.unreachable_rules import find_unreachable_rules
from ttr.updates.checks.untriggered_rules import (
    find_untaken_events,
    find_untriggered_rules,
)
from ttr.updates.checks.wrong_values import find_wrong_values
from ttr.updates.rules import Rule
from ttr.updates.update_strategies import Algorithm, check_strategies

if TYPE_CHECKING:
    from ttr.updates.games import Game

__all__ = ["Fault", "faults", "faults_alone", "faults_of"]

Check: TypeAlias = Callable[[RuleSet], Iterator[Fault]]
"""A function that finds faults of some sort."""


def faults(
    algorithm: Algorithm,
    type: RecordType,
    *,
    start: Record | None = None,
    model: Model | None = None,
    hears: Iterable[TypeNode] = (),
) -> tuple[Fault, ...]:
    """What is wrong with the rules of a strategy, over states of this type.

    Nothing is run. Given the `start`, rules that wait for what nothing brings about are
    found, too; given a `model`, values that it judges to be of other types; and if all
    events are of the types `hears`, rules for other events. What is found is certainly
    wrong, but what cannot be analysed is passed over. Raises `UpdateError` for what is
    no strategy, no type of states or no types of events.

    >>> from ttr import Basic, rectype, replace
    >>> from ttr.updates import rule
    >>> Count = Basic("Count")
    >>> @rule(when=rectype(nn=Count))
    ... def reset(s):
    ...     "Begins anew."
    ...     return replace(s, nn=0)
    >>> faults(reset, rectype(n=Count))[0].message
    'the rule reset asks for nn, but a state has no nn'
    """
    check_strategies("faults", (algorithm,))
    if not isinstance(type, RecordType):
        raise UpdateError(f"the type of a state is a record type, found {type!r}")
    known = Model() if model is None else as_model(model)
    given = None if start is None else freeze(start)
    return _find_faults(RuleSet(algorithm, type, given, known, _events(hears)))


def _events(hears: object) -> tuple[TypeNode, ...]:
    found = tuple(hears) if isinstance(hears, Iterable) else (hears,)
    if isinstance(hears, TypeNode) or not all(isinstance(T, TypeNode) for T in found):
        raise UpdateError(f"what is heard is a list of types, found {hears!r}")
    return found


def faults_of(game: Game) -> tuple[Fault, ...]:
    """What is wrong with the rules of a game, its start and the moves that it plans.

    >>> from ttr import Theory
    >>> desk = Theory.parse('''
    ...     basic Ind
    ...     object a : Ind
    ...     Desk := [open : list(Ind)]
    ...     rule close(s : [open : nelist(Ind)]) := [opne = [] : list(Ind)]
    ...     game desk({open = [a]} : Desk) := close
    ... ''')
    >>> print(faults_of(desk.games["desk"])[0].message)
    the rule close writes opne, but a state has no opne
    """
    agenda = None if game.agenda is None else tuple(game.agenda.split("."))
    theory = game.theory
    opening = theory.openings.get(game.name) if theory else None
    rules = RuleSet(
        game.algorithm,
        game.type,
        game.start,
        game.model,
        game.hears,
        agenda,
        game.name,
        tuple(theory.rules.values()) if theory else (),
        opening.heard_at if opening and opening.hears == game.hears else (),
    )
    return _find_faults(rules)


def faults_alone(rule: Rule) -> tuple[Fault, ...]:
    """What is wrong with a rule, whatever states it is meant for.

    Raises `UpdateError` for what is no rule.

    >>> from ttr import Ind, outer, rectype, replace
    >>> from ttr.updates import rule
    >>> @rule(when=rectype(spkr=Ind), where=rectype(you=Ind @ outer.s.addr))
    ... def take_turn(s, you):
    ...     return replace(s, spkr=you)
    >>> [fault.message for fault in faults_alone(take_turn)]
    ['the rule take_turn reads s.addr, but s has no addr']
    """
    if not isinstance(rule, Rule):
        raise UpdateError(f"faults_alone takes a rule, found {rule!r}")
    return _find_faults(RuleSet(rule, rule.when, None, Model(), ()), ALONE)


CHECKS = (
    find_unbound_names,
    find_unlistable_bindings,
    find_missing_paths,
    find_circular_fields,
    find_wrong_values,
    find_unreachable_rules,
    find_untriggered_rules,
    find_untaken_events,
    find_conflicts,
    find_endless_loops,
)
"""All checks, in the order in which their faults are reported."""

ALONE = (
    find_unbound_names,
    find_unlistable_bindings,
    find_misread_paths,
    find_circular_fields,
    find_unreachable_rules,
)
"""The checks of a rule whose states are not known."""

NEVER = ("dead", "unset")
"""The sorts of faults that mean that a rule never fires."""


@within_budget
def _find_faults(rules: RuleSet, checks: Iterable[Check] = CHECKS) -> tuple[Fault, ...]:
    """The faults, except that a rule never fires if another fault explains it."""
    found: dict[object, Fault] = {}
    explained: set[Rule | None] = set()
    for check in checks:
        new = list(check(rules))
        for fault in new:
            if fault.sort not in NEVER or fault.rule not in explained:
                found.setdefault(_place(fault), fault)
        explained |= {fault.rule for fault in new}
    return tuple(found.values())


def _place(fault: Fault) -> object:
    """What makes a fault the same: rules may share what is written in one place."""
    if fault.sort == "missing" and fault.span:
        return fault.span, fault.hint
    return fault
