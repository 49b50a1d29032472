"""What is planned is done, and is planned no longer when it has been done: P23."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ttr.dialogues.dialogue import Dialogue, Trial
from ttr.judging.certainty import certainly
from ttr.testing.event_subjects import field_at, items_at, same
from ttr.testing.properties import Checked, Property
from ttr.testing.strategies.discourse_roles import Roles
from ttr.types.paths import escaping
from ttr.types.printing import notation
from ttr.types.syntax import NonEmpty, Object, Singleton, TypeNode, identity
from ttr.updates.running import Step

__all__ = ["DONE_ONCE"]


def _undone(dialogue: Dialogue, roles: Roles) -> Checked:
    path = str(roles.agenda)
    for number, trial in enumerate(dialogue.trials, start=1):
        for steps in _by_event(trial):
            if why := _undone_by(steps, path):
                yield number, why


def _by_event(trial: Trial) -> Iterator[Sequence[Step]]:
    """The steps of a turn, those on one event together."""
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


def _undone_by(steps: Sequence[Step], path: str) -> str:
    """What went wrong with an agenda when something happened."""
    first, last = steps[0], steps[-1]
    before, after = items_at(first.before, path), items_at(last.after, path)
    if not before:
        return ""
    if _is_made(before[0], first):
        if _is_same(before, after):
            return f"{notation(before[0])} was made, and is still on {path}"
        lost = _lost(before[1:], after)
        if lost and _one_rule(steps, path):
            named = ", ".join(map(notation, lost))
            return f"{first.rule} takes {named} off {path}, which nobody made"
        return ""
    for step in steps:
        if why := _overwritten(step, path):
            return why
    return ""


def _one_rule(steps: Sequence[Step], path: str) -> bool:
    """Whether a single step changed the agenda: what others planned anew is meant."""
    changed = [
        step
        for step in steps
        if not _is_same(items_at(step.before, path), items_at(step.after, path))
    ]
    return len(changed) == 1


def _overwritten(step: Step, path: str) -> str:
    """Whether a rule that does not look at the agenda puts another in its place."""
    before, after = items_at(step.before, path), items_at(step.after, path)
    lost = _lost(before, after)
    if not lost or not after or _looks_at(step, path):
        return ""
    named = ", ".join(map(notation, lost))
    return f"{step.rule} puts something else in the place of {named} on {path}"


def _looks_at(step: Step, path: str) -> bool:
    """Whether a rule asks what is on the agenda, in its condition or its bindings."""
    if isinstance(field_at(step.rule.when, path), Singleton | NonEmpty):
        return True
    labels = tuple(path.split("."))
    bound = escaping(step.rule.where) if step.rule.where is not None else ()
    return any(one.labels[1:][: len(labels)] == labels for one in bound)


def _is_made(planned: Object, step: Step) -> bool:
    return (
        step.rule.on is not None
        and isinstance(planned, TypeNode)
        and certainly(step.model.facts, step.event, planned)
    )


def _is_same(one: Sequence[Object], other: Sequence[Object]) -> bool:
    return identity(tuple(one)) == identity(tuple(other))


def _lost(before: Sequence[Object], after: Sequence[Object]) -> list[Object]:
    """What was there and is there no longer."""
    return [one for one in before if not any(same(one, kept) for kept in after)]


DONE_ONCE = Property(
    "P23",
    "agenda",
    "what was made leaves the agenda, and nothing else does unless a rule looks at it.",
    _undone,
    needs=("agenda",),
)
