"""What must never happen in a run: P1, P4, P7 and P17; and that rules are pure, P2.

Source: the faults of other toolkits in states, rules and repetitions, distinguished by
the error that ends the dialogue.
"""

from __future__ import annotations

from collections.abc import Iterator

from ttr.dialogues.dialogue import Dialogue
from ttr.errors import EndlessError, NoStateError, RuleFailedError, TTRError
from ttr.probability import CERTAIN
from ttr.testing.properties.property import Breaches, Property
from ttr.testing.single_rules import state_when_rerun
from ttr.testing.strategies.discourse_roles import Roles
from ttr.types.objects import UnresolvedError
from ttr.types.records import differences
from ttr.updates.running import Step


def _is_missing_name(fault: Exception) -> bool:
    """Did a rule fail because something that it names does not exist?"""
    cause = fault.__cause__
    if not isinstance(fault, RuleFailedError) or cause is None:
        return False
    if isinstance(cause, AttributeError | KeyError | NameError | UnresolvedError):
        return True
    return isinstance(cause, TTRError) and "cannot be replaced" in cause.message


def _check_type(dialogue: Dialogue, roles: Roles) -> Breaches:
    if isinstance(dialogue.fault, NoStateError):
        yield len(dialogue.trials), str(dialogue.fault)


def _check_termination(dialogue: Dialogue, roles: Roles) -> Breaches:
    if isinstance(dialogue.fault, EndlessError):
        yield len(dialogue.trials), str(dialogue.fault)


def _check_names(dialogue: Dialogue, roles: Roles) -> Breaches:
    if dialogue.fault is not None and _is_missing_name(dialogue.fault):
        yield len(dialogue.trials), str(dialogue.fault)


def _check_no_error(dialogue: Dialogue, roles: Roles) -> Breaches:
    fault = dialogue.fault
    if (
        fault is None
        or isinstance(fault, NoStateError | EndlessError)
        or _is_missing_name(fault)
    ):
        return
    text = str(fault)
    named = text if isinstance(fault, TTRError) else f"{type(fault).__name__}: {text}"
    yield len(dialogue.trials), named


def _check_purity(dialogue: Dialogue, roles: Roles) -> Breaches:
    for number, trial in enumerate(dialogue.trials, start=1):
        if trial.tampered:
            yield number, f"a rule changed the state it was given, at {trial.tampered}"
    # Applying rules again takes time: only two trials are examined.
    count = len(dialogue.trials)
    for number in sorted({(count + 1) // 2, count} - {0}):
        steps = dialogue.trials[number - 1].steps
        yield from ((number, why) for why in _why_tampered(steps, dialogue))


def _why_tampered(steps: tuple[Step, ...], dialogue: Dialogue) -> Iterator[str]:
    """Why a state between two rules was changed in place.

    The rule that gave it gives another state when it is applied again.
    """
    for step in steps:
        if step.p != CERTAIN:
            continue  # other alternatives of the event are not known
        after = state_when_rerun(step, dialogue.game)
        if after is None:
            yield f"{step.rule} no longer applies to the state that it was given"
        elif after != step.after:
            what = next(differences(after, step.after), "")
            yield f"the state that {step.rule} gave was changed later: {what}"


KEEPS_TYPE = Property(
    "P1",
    "type preservation",
    "after every rule the state is of its type, and of what the rule promises.",
    _check_type,
)
PURE = Property(
    "P2",
    "pure rules",
    "a rule never changes the state that it is given, whether it applies or not.",
    _check_purity,
)
TERMINATES = Property(
    "P4",
    "termination",
    "every repetition, and every agenda, comes to an end.",
    _check_termination,
)
NAMES_BOUND = Property(
    "P7",
    "no unbound name",
    "every path and name that a rule reads or writes exists.",
    _check_names,
)
NEVER_BREAKS = Property(
    "P17",
    "no crash",
    "whatever happens, no rule, move or text raises an error.",
    _check_no_error,
)
