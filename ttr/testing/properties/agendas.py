"""A planned move leaves the agenda when it has been made, and not before: P23."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ttr.dialogues.dialogue import Dialogue, Trial
from ttr.judging.certainty import is_certain
from ttr.testing.event_subjects import (
    format_objects,
    items_at,
    items_not_in,
)
from ttr.testing.properties.property import Breaches, Property
from ttr.testing.strategies.discourse_roles import Roles
from ttr.types.interning import identity
from ttr.types.objects import Object
from ttr.types.paths import free_paths
from ttr.types.printing import notation
from ttr.types.records import field_at
from ttr.types.syntax import NonEmpty, Singleton, TypeNode
from ttr.updates.running import Step


def _check_agenda(dialogue: Dialogue, roles: Roles) -> Breaches:
    path = str(roles.agenda)
    for number, trial in enumerate(dialogue.trials, start=1):
        for steps in _steps_by_event(trial):
            if why := _why_undone(steps, path):
                yield number, why


def _steps_by_event(trial: Trial) -> Iterator[Sequence[Step]]:
    """The steps of a turn, grouped by the event that the rules took."""
    steps: list[Step] = []
    event: Object = None
    for step in trial.steps:
        if step.rule.on is not None and step.event is not event:
            if steps:
                yield steps
            steps, event = [], step.event
        steps.append(step)
    if steps:
        yield steps


def _why_undone(steps: Sequence[Step], path: str) -> str:
    """Why an agenda is wrong after the steps on one event."""
    first, last = steps[0], steps[-1]
    before, after = items_at(first.before, path), items_at(last.after, path)
    if not before:
        return ""
    if _is_made(before[0], first):
        if _are_same(before, after):
            return f"{notation(before[0])} was made, and is still on {path}"
        lost = items_not_in(before[1:], after)
        if lost and _is_changed_once(steps, path):
            named = format_objects(lost)
            return f"{first.rule} takes {named} off {path}, but nobody made that move"
        return ""
    for step in steps:
        if why := _why_overwritten(step, path):
            return why
    return ""


def _is_changed_once(steps: Sequence[Step], path: str) -> bool:
    """Did a single step change the agenda? If several did, they planned it anew."""
    changed = [
        step
        for step in steps
        if not _are_same(items_at(step.before, path), items_at(step.after, path))
    ]
    return len(changed) == 1


def _why_overwritten(step: Step, path: str) -> str:
    """Why a rule that does not look at the agenda may not replace what is on it."""
    before, after = items_at(step.before, path), items_at(step.after, path)
    lost = items_not_in(before, after)
    if not lost or not after or _looks_at(step, path):
        return ""
    named = format_objects(lost)
    return f"{step.rule} replaces {named} on {path} with something else"


def _looks_at(step: Step, path: str) -> bool:
    """Does a rule look at the agenda, in its condition or its bindings?"""
    labels = tuple(path.split("."))
    if isinstance(field_at(step.rule.when, labels), Singleton | NonEmpty):
        return True
    bound = free_paths(step.rule.where) if step.rule.where is not None else ()
    return any(one.labels[1:][: len(labels)] == labels for one in bound)


def _is_made(planned: Object, step: Step) -> bool:
    return (
        step.rule.on is not None
        and isinstance(planned, TypeNode)
        and is_certain(step.model.facts, step.event, planned)
    )


def _are_same(one: Sequence[Object], other: Sequence[Object]) -> bool:
    return identity(tuple(one)) == identity(tuple(other))


DONE_ONCE = Property(
    "P23",
    "agenda",
    "a move that was made leaves the agenda; others only by rules that look at it.",
    _check_agenda,
    needs=("agenda",),
)
