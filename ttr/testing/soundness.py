"""Properties of what a run must never come to: P1, P4, P7 and P17, and purity, P2.

Source: the states, the rules and the repetitions that broke other toolkits, which are
told apart by what ended the dialogue.
"""

from __future__ import annotations

from collections.abc import Iterator

from ttr.dialogues.dialogue import Dialogue
from ttr.errors import Endless, NoState, RuleFailed, TTRError
from ttr.probability import CERTAIN
from ttr.testing.properties import Checked, Property
from ttr.testing.single_rules import rerun
from ttr.testing.strategies.discourse_roles import Roles
from ttr.types.objects import Unresolved
from ttr.types.records import differences
from ttr.updates.running import Step

__all__ = ["KEEPS_TYPE", "NAMES_BOUND", "NEVER_BREAKS", "PURE", "TERMINATES"]


def _missing_name(fault: Exception) -> bool:
    """Whether a rule failed because something that it names is not there."""
    cause = fault.__cause__
    if not isinstance(fault, RuleFailed) or cause is None:
        return False
    if isinstance(cause, AttributeError | KeyError | NameError | Unresolved):
        return True
    return isinstance(cause, TTRError) and "cannot be replaced" in cause.message


def _leaves_type(dialogue: Dialogue, roles: Roles) -> Checked:
    if isinstance(dialogue.fault, NoState):
        yield len(dialogue.trials), str(dialogue.fault)


def _is_endless(dialogue: Dialogue, roles: Roles) -> Checked:
    if isinstance(dialogue.fault, Endless):
        yield len(dialogue.trials), str(dialogue.fault)


def _names_nothing(dialogue: Dialogue, roles: Roles) -> Checked:
    if dialogue.fault is not None and _missing_name(dialogue.fault):
        yield len(dialogue.trials), str(dialogue.fault)


def _breaks(dialogue: Dialogue, roles: Roles) -> Checked:
    fault = dialogue.fault
    if fault is None or isinstance(fault, NoState | Endless) or _missing_name(fault):
        return
    text = str(fault)
    named = text if isinstance(fault, TTRError) else f"{type(fault).__name__}: {text}"
    yield len(dialogue.trials), named


def _mutates(dialogue: Dialogue, roles: Roles) -> Checked:
    for number, trial in enumerate(dialogue.trials, start=1):
        if trial.tampered:
            yield number, f"a rule changed the state it was given, at {trial.tampered}"
    # To apply rules once more takes time, so that not all trials are looked at.
    count = len(dialogue.trials)
    for number in sorted({(count + 1) // 2, count} - {0}):
        steps = dialogue.trials[number - 1].steps
        yield from ((number, why) for why in _tampered(steps, dialogue))


def _tampered(steps: tuple[Step, ...], dialogue: Dialogue) -> Iterator[str]:
    """Steps after which the state between two rules was changed where it stood.

    Their rules, applied once more, give other states than those that are there.
    """
    for step in steps:
        if step.p != CERTAIN:
            continue  # it is not known what else may have happened
        after = rerun(step, dialogue.game)
        if after is None:
            yield f"{step.rule} does not apply any more to the state that it was given"
        elif after != step.after:
            what = next(differences(after, step.after), "")
            yield f"what {step.rule} gave was changed later on: {what}"


KEEPS_TYPE = Property(
    "P1",
    "type preservation",
    "after every rule the state is of the type that it, and the rule, declare.",
    _leaves_type,
)
PURE = Property(
    "P2",
    "pure rules",
    "a rule, applied or not, leaves the state that it is given as it was.",
    _mutates,
)
TERMINATES = Property(
    "P4",
    "termination",
    "every repetition, and every agenda, comes to an end.",
    _is_endless,
)
NAMES_BOUND = Property(
    "P7",
    "no unbound name",
    "every path and name that a rule reads or writes is there.",
    _names_nothing,
)
NEVER_BREAKS = Property(
    "P17",
    "no crash",
    "whatever happens gives a state; no rule, move or text raises an error.",
    _breaks,
)
