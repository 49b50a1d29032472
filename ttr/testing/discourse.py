"""Properties of what is under discussion and what is agreed on: P8, P9 and P10.

Source: Ginzburg 2012 and Larsson 2002 for questions under discussion: a question is put
once, and leaves when it is resolved; what has been agreed on stays.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from collections.abc import Set as AbstractSet

from ttr.computing.subtyping import subtype
from ttr.dialogues.dialogue import Dialogue, Trial, give
from ttr.semantics.questions import resolves
from ttr.testing.event_subjects import item_type, items_at, kin, mentions, same
from ttr.testing.properties import Checked, Property
from ttr.testing.strategies.discourse_roles import Roles, at
from ttr.types.printing import notation
from ttr.types.syntax import Function, Object, Record, RecordType, TypeNode, identity
from ttr.updates.games import Game
from ttr.updates.nbest import NBest
from ttr.updates.running import Step

__all__ = ["COMMITMENTS_STAY", "DOWNDATES_ONCE", "QUD_DISCIPLINE"]


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
    labels: set[str] = set()
    for number, trial in enumerate(dialogue.trials, start=1):
        for step in trial.steps:
            labels.update(_asking_labels(step, str(roles.qud)))
            if why := _careless_step(step, trial, roles, dialogue.game, labels):
                yield number, why
        if why := _still_asked(trial, roles):
            yield number, why


def _asking_labels(step: Step, path: str) -> Iterator[str]:
    """Under which labels of an event the questions stand that it puts."""
    if step.rule.on is None or not isinstance(step.event, Record):
        return
    new = _gone(items_at(step.after, path), items_at(step.before, path))
    for label, value in step.event._fields.items():
        if any(same(value, one) for one in new):
            yield label


def _careless_step(
    step: Step, trial: Trial, roles: Roles, game: Game, labels: AbstractSet[str]
) -> str:
    qud = items_at(step.after, roles.qud)
    before = items_at(step.before, roles.qud)
    if qud is before:
        return ""
    if _doubled(qud):
        return f"after {step.rule} a question is twice on {roles.qud}: {_shown(qud)}"
    if step.rule.name in roles.drops:
        return ""
    for question in _gone(before, qud):
        if not _settled(question, step, trial, roles):
            return f"{step.rule} drops {notation(question)}, which nothing resolves"
        if why := _beside_the_point(question, step, roles, game, labels):
            return why
    return ""


def _beside_the_point(
    question: Object, step: Step, roles: Roles, game: Game, labels: AbstractSet[str]
) -> str:
    """Whether a question goes by what is about another one of its sort.

    It may go by a rule that takes no event, for what has been agreed on before. Where
    the sort does not tell, what stands under a label of questions is one.
    """
    if roles.resolves is not None or roles.answers is not None:
        return ""  # then it is known what answers what
    agreed = items_at(step.after, roles.commitments)
    if step.rule.on is None and _is_among(question, agreed):
        return ""
    T = item_type(game.type, str(roles.qud))
    others = kin(question, T, step.event, step.model, game)
    if not others and isinstance(question, str) and isinstance(step.event, Record):
        fields = step.event._fields.items()
        others = tuple(one for label, one in fields if label in labels)
    if others and not _is_about(question, step, others):
        asked, about = notation(question), _shown(others)
        return f"{step.rule} drops {asked}, though what happened is about {about}"
    new = _gone(agreed, items_at(step.before, roles.commitments))
    fresh = [one for one in new if kin(question, T, one, step.model, game)]
    if isinstance(question, str) and fresh and not _is_among(question, fresh):
        return f"{step.rule} drops {notation(question)}, but agrees on {_shown(fresh)}"
    return ""


def _is_about(question: Object, step: Step, others: Sequence[Object]) -> bool:
    """Whether an event mentions a question, or a type that is more or less specific."""
    if any(same(question, one) for one in mentions(step.event, step.model)):
        return True
    return isinstance(question, RecordType) and any(
        subtype(question, one).yes or subtype(one, question).yes
        for one in others
        if isinstance(one, RecordType)
    )


def _is_among(item: Object, others: Sequence[Object]) -> bool:
    """Whether an item is one of these, or stands in one of them that is a record."""
    return any(same(item, one) or _stands_in(item, one) for one in others)


def _stands_in(item: Object, other: Object) -> bool:
    return isinstance(other, Record) and any(
        same(item, value) for value in other._fields.values()
    )


def _settled(question: Object, step: Step, trial: Trial, roles: Roles) -> bool:
    """Whether something answers or resolves a question; if nobody can tell, whether
    anything was said or agreed on."""
    agreed = items_at(step.after, roles.commitments)
    events = _events(trial)
    if roles.resolves is None and roles.answers is None:
        return bool(events) or bool(
            _gone(agreed, items_at(step.before, roles.commitments))
        )
    settles, answers = roles.resolves, roles.answers
    if settles is not None and any(settles(one, question) for one in agreed):
        return True
    return answers is not None and any(answers(one, question) for one in events)


def _still_asked(trial: Trial, roles: Roles) -> str:
    """Whether a question that was answered is still there when all has been said."""
    qud = items_at(trial.before.state, roles.qud)
    after = items_at(trial.after.state, roles.qud)
    for path in (roles.qud, roles.pending):
        if why := _settled_and_still_there(trial, path, roles):
            return why
    if trial.turn is None or not roles.answers or not qud:
        return ""
    top = qud[0]
    answered = any(roles.answers(event, top) for event in _heard(trial))
    if answered and not _gone((top,), after):
        return f"{notation(top)} was answered, but is still on {roles.qud}"
    return ""


def _settled_and_still_there(trial: Trial, path: str | None, roles: Roles) -> str:
    """Whether what has just been agreed on is still asked, or pending, at the end."""
    if path is None or roles.commitments is None or path == roles.commitments:
        return ""
    for one in _agreed(trial, roles):
        for item in items_at(trial.after.state, path):
            if same(one, item):
                return f"{notation(item)} has been agreed on, but is still on {path}"
    return ""


# --- P9 ------------------------------------------------------------------------------


def _downdates_twice(dialogue: Dialogue, roles: Roles) -> Checked:
    for number, trial in enumerate(dialogue.trials, start=1):
        if trial.turn is None:
            continue
        gone = _resolved(trial, roles)
        new = _agreed(trial, roles)
        if len(gone) > max(1, len(new)) and not _all_resolved(gone, trial, roles):
            yield number, f"one answer takes away {len(gone)} questions: {_shown(gone)}"
        if why := _counts_again(dialogue, trial, roles):
            yield number, why


def _all_resolved(gone: Sequence[Object], trial: Trial, roles: Roles) -> bool:
    """Whether each question is one that a proposition agreed on resolves.

    An answer that is accepted resolves what was asked, and whether it is so.
    """
    agreed = items_at(trial.after.state, roles.commitments)
    model = trial.after.model
    return all(
        isinstance(question, Function)
        and any(resolves(one, question, model) for one in agreed)
        for question in gone
    )


def _resolved(trial: Trial, roles: Roles) -> list[Object]:
    """The questions that the rules took away in a turn, but for those that may drop."""
    return [
        question
        for step in trial.steps
        if step.rule.name not in roles.drops
        for question in _gone(
            items_at(step.before, roles.qud), items_at(step.after, roles.qud)
        )
    ]


def _agreed(trial: Trial, roles: Roles) -> list[Object]:
    """What became agreed on in a turn."""
    before = items_at(trial.before.state, roles.commitments)
    return _gone(items_at(trial.after.state, roles.commitments), before)


def _counts_again(dialogue: Dialogue, trial: Trial, roles: Roles) -> str:
    """What an answer resolves or adds twice when it is given once more.

    It may be taken for the answer to another question that was planned.
    """
    state = trial.after.state
    answered = _is_answer(trial, trial.before.state, roles)
    if not answered or _is_answer(trial, state, roles):
        return ""
    again = give(dialogue.game, trial.after, trial.given)
    # A question that a rule takes away to ask it anew is still there at the end.
    left = _gone(items_at(state, roles.qud), items_at(again.after.state, roles.qud))
    gone = [question for question in _resolved(again, roles) if question in left]
    if gone:
        return f"the same answer once more takes away {_shown(gone)}"
    twice = _doubled(items_at(again.after.state, roles.commitments))
    if twice > _doubled(items_at(state, roles.commitments)):
        return f"the same answer is on {roles.commitments} once more"
    return ""


def _is_answer(trial: Trial, state: Record, roles: Roles) -> bool:
    """Whether what was heard answers a question that is under discussion."""
    answers = roles.answers
    return answers is not None and any(
        answers(event, question)
        for event in _heard(trial)
        for question in items_at(state, roles.qud)
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
    gone = _gone(items_at(step.before, path), items_at(step.after, path))
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
