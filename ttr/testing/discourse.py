"""Properties of what is under discussion and what is agreed on: P8, P9 and P10.

Source: Ginzburg 2012 and Larsson 2002 for questions under discussion: a question is put
once, and leaves when it is resolved; what has been agreed on stays.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ttr.printing import notation
from ttr.strategies.playing import Dialogue, Trial, taken
from ttr.strategies.roles import Roles, at
from ttr.subtyping import subtype
from ttr.syntax import FiniteSet, Object, Record, TypeNode, identity
from ttr.testing.properties import Checked, Property
from ttr.updates.nbest import NBest
from ttr.updates.running import Step

__all__ = ["COMMITMENTS_STAY", "DOWNDATES_ONCE", "QUD_DISCIPLINE"]


def _items(state: Record, path: str | None) -> Sequence[Object]:
    """What is in the list or set at a path; a type is what there is of itself."""
    found = None if path is None else at(state, path)
    if isinstance(found, tuple):
        return found
    if isinstance(found, FiniteSet):
        return found.items
    return () if found is None else (found,)


def _doubled(items: Sequence[Object]) -> int:
    """How many items are there that have been there before."""
    return len(items) - len(set(map(identity, items)))


def _gone(before: Sequence[Object], after: Sequence[Object]) -> list[Object]:
    """What was there and is no longer."""
    if before is after:
        return []
    left = set(map(identity, after))
    return [one for one in before if identity(one) not in left]


# --- P8 ------------------------------------------------------------------------------


def _careless(dialogue: Dialogue, roles: Roles) -> Checked:
    for number, trial in enumerate(dialogue.trials, start=1):
        for step in trial.steps:
            if why := _careless_step(step, trial, roles):
                yield number, why
        if why := _still_asked(trial, roles):
            yield number, why


def _careless_step(step: Step, trial: Trial, roles: Roles) -> str:
    qud = _items(step.after, roles.qud)
    before = _items(step.before, roles.qud)
    if qud is before:
        return ""
    if _doubled(qud):
        return f"after {step.rule} a question is twice on {roles.qud}: {_shown(qud)}"
    if step.rule.name in roles.drops:
        return ""
    for question in _gone(before, qud):
        if not _settled(question, step, trial, roles):
            return f"{step.rule} drops {notation(question)}, which nothing resolves"
    return ""


def _settled(question: Object, step: Step, trial: Trial, roles: Roles) -> bool:
    """Whether something answers or resolves a question; if nobody can tell, whether
    anything was said or agreed on."""
    agreed = _items(step.after, roles.commitments)
    events = _events(trial)
    if roles.resolves is None and roles.answers is None:
        return bool(events) or bool(
            _gone(agreed, _items(step.before, roles.commitments))
        )
    resolves, answers = roles.resolves, roles.answers
    if resolves is not None and any(resolves(one, question) for one in agreed):
        return True
    return answers is not None and any(answers(one, question) for one in events)


def _still_asked(trial: Trial, roles: Roles) -> str:
    """Whether a question that was answered is still there when all has been said."""
    qud = _items(trial.before.state, roles.qud)
    if trial.turn is None or not roles.answers or not qud:
        return ""
    after = _items(trial.after.state, roles.qud)
    top = qud[0]
    answered = any(roles.answers(event, top) for event in _heard(trial))
    if answered and not _gone((top,), after):
        return f"{notation(top)} was answered, but is still on {roles.qud}"
    return ""


# --- P9 ------------------------------------------------------------------------------


def _downdates_twice(dialogue: Dialogue, roles: Roles) -> Checked:
    for number, trial in enumerate(dialogue.trials, start=1):
        if trial.turn is None:
            continue
        gone = _resolved(trial, roles)
        new = _agreed(trial, roles)
        if len(gone) > max(1, len(new)):
            yield number, f"one answer takes away {len(gone)} questions: {_shown(gone)}"
        if why := _counts_again(dialogue, trial, roles):
            yield number, why


def _resolved(trial: Trial, roles: Roles) -> list[Object]:
    """The questions that the rules took away in a turn, but for those that may drop."""
    return [
        question
        for step in trial.steps
        if step.rule.name not in roles.drops
        for question in _gone(
            _items(step.before, roles.qud), _items(step.after, roles.qud)
        )
    ]


def _agreed(trial: Trial, roles: Roles) -> list[Object]:
    """What became agreed on in a turn."""
    before = _items(trial.before.state, roles.commitments)
    return _gone(_items(trial.after.state, roles.commitments), before)


def _counts_again(dialogue: Dialogue, trial: Trial, roles: Roles) -> str:
    """What an answer resolves or adds twice when it is given once more.

    It may be taken for the answer to another question that was planned.
    """
    state = trial.after.state
    answered = _is_answer(trial, trial.before.state, roles)
    if not answered or _is_answer(trial, state, roles):
        return ""
    again = taken(dialogue.game, trial.after, trial.given)
    # A question that a rule takes away to ask it anew is still there at the end.
    left = _gone(_items(state, roles.qud), _items(again.after.state, roles.qud))
    gone = [question for question in _resolved(again, roles) if question in left]
    if gone:
        return f"the same answer once more takes away {_shown(gone)}"
    twice = _doubled(_items(again.after.state, roles.commitments))
    if twice > _doubled(_items(state, roles.commitments)):
        return f"the same answer is on {roles.commitments} once more"
    return ""


def _is_answer(trial: Trial, state: Record, roles: Roles) -> bool:
    """Whether what was heard answers a question that is under discussion."""
    answers = roles.answers
    return answers is not None and any(
        answers(event, question)
        for event in _heard(trial)
        for question in _items(state, roles.qud)
    )


# --- P10 -----------------------------------------------------------------------------


def _forgets(dialogue: Dialogue, roles: Roles) -> Checked:
    for number, trial in enumerate(dialogue.trials, start=1):
        for step in trial.steps:
            if step.rule.name in roles.retracts:
                continue
            if why := _forgotten(step, str(roles.commitments)):
                yield number, why


def _forgotten(step: Step, path: str) -> str:
    before, after = at(step.before, path), at(step.after, path)
    if before is after:
        return ""
    if isinstance(before, TypeNode) and isinstance(after, TypeNode):
        if subtype(after, before).yes:
            return ""
        return f"after {step.rule} {path} is {after}, which is no longer {before}"
    gone = _gone(_items(step.before, path), _items(step.after, path))
    return f"{step.rule} takes {_shown(gone)} from {path}" if gone else ""


# --- what happened -------------------------------------------------------------------


def _heard(trial: Trial) -> Sequence[Object]:
    """The event of the turn, if it is certain what it was."""
    if trial.turn is None or trial.turn.heard is None:
        return ()
    event = trial.turn.heard
    return () if isinstance(event, NBest) else (event,)


def _events(trial: Trial) -> Sequence[Object]:
    """What was heard, or may have been, and what the system said."""
    if trial.turn is None:
        return ()
    event = trial.turn.heard
    perhaps = [one for one, _ in event] if isinstance(event, NBest) else ()
    said = [move.sit for move in trial.turn.said]
    return (*_heard(trial), *perhaps, *said)


def _shown(objects: Iterable[Object]) -> str:
    return ", ".join(map(notation, objects))


QUD_DISCIPLINE = Property(
    "P8",
    "questions under discussion",
    "no question is there twice; it goes when it is resolved, and not before.",
    _careless,
    needs=("qud",),
)
DOWNDATES_ONCE = Property(
    "P9",
    "downdate once",
    "one answer resolves one question; given once more, it resolves no other.",
    _downdates_twice,
    needs=("qud",),
)
COMMITMENTS_STAY = Property(
    "P10",
    "commitments stay",
    "what is agreed on stays so, but for rules that take it back.",
    _forgets,
    needs=("commitments",),
)
