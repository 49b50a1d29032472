"""Properties of what is under discussion and what is agreed on: P8, P9 and P10.

Source: Ginzburg 2012 and Larsson 2002 for questions under discussion: a question is put
once, and leaves when it is resolved; what has been agreed on stays.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from collections.abc import Set as AbstractSet

from ttr.computing.subtyping import subtype
from ttr.dialogues.dialogue import Dialogue, Trial, give
from ttr.semantics.questions import resolves
from ttr.testing.event_subjects import (
    format_objects,
    is_same,
    item_type,
    items_at,
    items_not_in,
    mentions,
    mentions_of_sort,
)
from ttr.testing.properties.property import Breaches, Property
from ttr.testing.strategies.discourse_roles import Roles
from ttr.types.interning import identity
from ttr.types.objects import Object, Record
from ttr.types.printing import notation
from ttr.types.records import value_at
from ttr.types.syntax import Function, RecordType, TypeNode
from ttr.updates.games import Game
from ttr.updates.nbest import NBest
from ttr.updates.running import Step


def _count_duplicates(items: Sequence[Object]) -> int:
    """How many of the items have occurred before in the list."""
    return len(items) - len(set(map(identity, items)))


# --- P8 ------------------------------------------------------------------------------


def _check_questions(dialogue: Dialogue, roles: Roles) -> Breaches:
    labels: set[str] = set()
    for number, trial in enumerate(dialogue.trials, start=1):
        for step in trial.steps:
            labels.update(_labels_of_questions(step, str(roles.qud)))
            if why := _why_careless(step, trial, roles, dialogue.game, labels):
                yield number, why
        if why := _why_still_asked(trial, roles):
            yield number, why


def _labels_of_questions(step: Step, path: str) -> Iterator[str]:
    """The labels of an event that lead to the questions that it raises."""
    if step.rule.on is None or not isinstance(step.event, Record):
        return
    new = items_not_in(items_at(step.after, path), items_at(step.before, path))
    for label, value in step.event._fields.items():
        if any(is_same(value, one) for one in new):
            yield label


def _why_careless(
    step: Step, trial: Trial, roles: Roles, game: Game, labels: AbstractSet[str]
) -> str:
    qud = items_at(step.after, roles.qud)
    before = items_at(step.before, roles.qud)
    if qud is before:
        return ""
    if _count_duplicates(qud):
        questions = format_objects(qud)
        return f"after {step.rule} a question is twice on {roles.qud}: {questions}"
    if step.rule.name in roles.drops:
        return ""
    for question in items_not_in(before, qud):
        if not _is_settled(question, step, trial, roles):
            return f"{step.rule} drops {notation(question)}, which nothing resolves"
        if why := _why_beside_the_point(question, step, roles, game, labels):
            return why
    return ""


def _why_beside_the_point(
    question: Object, step: Step, roles: Roles, game: Game, labels: AbstractSet[str]
) -> str:
    """Why an event that removes a question is about another one of the same sort.

    A rule without an event may remove a question for what has been agreed on before.
    Where sorts do not distinguish them, what an event has at a label at which other
    events raised questions is taken for a question.
    """
    if roles.resolves is not None or roles.answers is not None:
        return ""  # then it is known what answers what
    agreed = items_at(step.after, roles.commitments)
    if step.rule.on is None and _is_among(question, agreed):
        return ""
    T = item_type(game.type, str(roles.qud))
    others = mentions_of_sort(question, T, step.event, step.model, game)
    if not others and isinstance(question, str) and isinstance(step.event, Record):
        fields = step.event._fields.items()
        others = tuple(one for label, one in fields if label in labels)
    if others and not _is_about(question, step, others):
        dropped, about = notation(question), format_objects(others)
        return f"{step.rule} drops {dropped}, but the event is about {about}"
    new = items_not_in(agreed, items_at(step.before, roles.commitments))
    fresh = [one for one in new if mentions_of_sort(question, T, one, step.model, game)]
    if isinstance(question, str) and fresh and not _is_among(question, fresh):
        dropped, about = notation(question), format_objects(fresh)
        return f"{step.rule} drops {dropped}, but agrees on {about}"
    return ""


def _is_about(question: Object, step: Step, others: Sequence[Object]) -> bool:
    """Does an event mention the question, or a more or less specific type?"""
    if any(is_same(question, one) for one in mentions(step.event, step.model)):
        return True
    return isinstance(question, RecordType) and any(
        subtype(question, one).yes or subtype(one, question).yes
        for one in others
        if isinstance(one, RecordType)
    )


def _is_among(item: Object, others: Sequence[Object]) -> bool:
    """Is an item one of these, or in one of them that is a record?"""
    return any(is_same(item, one) or _is_in_record(item, one) for one in others)


def _is_in_record(item: Object, other: Object) -> bool:
    return isinstance(other, Record) and any(
        is_same(item, value) for value in other._fields.values()
    )


def _is_settled(question: Object, step: Step, trial: Trial, roles: Roles) -> bool:
    """Does anything answer or resolve a question?

    Where the roles do not say what answers what: is anything said or agreed on at all?
    """
    agreed = items_at(step.after, roles.commitments)
    events = _possible_events(trial)
    if roles.resolves is None and roles.answers is None:
        return bool(events) or bool(
            items_not_in(agreed, items_at(step.before, roles.commitments))
        )
    settles, answers = roles.resolves, roles.answers
    if settles is not None and any(settles(one, question) for one in agreed):
        return True
    return answers is not None and any(answers(one, question) for one in events)


def _why_still_asked(trial: Trial, roles: Roles) -> str:
    """Why a question that was answered is still there after the turn."""
    qud = items_at(trial.before.state, roles.qud)
    after = items_at(trial.after.state, roles.qud)
    for path in (roles.qud, roles.pending):
        if why := _why_agreed_but_still_there(trial, path, roles):
            return why
    if trial.turn is None or not roles.answers or not qud:
        return ""
    top = qud[0]
    answered = any(roles.answers(event, top) for event in _certain_events(trial))
    if answered and not items_not_in((top,), after):
        return f"{notation(top)} was answered, but is still on {roles.qud}"
    return ""


def _why_agreed_but_still_there(trial: Trial, path: str | None, roles: Roles) -> str:
    """Why what has just been agreed on is still asked, or pending, after the turn."""
    if path is None or roles.commitments is None or path == roles.commitments:
        return ""
    for one in _items_agreed_on(trial, roles):
        for item in items_at(trial.after.state, path):
            if is_same(one, item):
                about = notation(item)
                why = f"{about} has been agreed on, but is still on {path}"
                rule = _rule_that_agrees(item, trial, roles)
                return f"{why}: {rule} put it on {roles.commitments}{_and_off(path)}"
    return ""


def _rule_that_agrees(item: Object, trial: Trial, roles: Roles) -> str:
    """The name of the rule that put an item among what is agreed on."""
    for step in trial.steps:
        before = items_at(step.before, roles.commitments)
        after = items_at(step.after, roles.commitments)
        if any(is_same(item, one) for one in items_not_in(after, before)):
            return step.rule.name
    return "a rule"


def _and_off(path: str) -> str:
    return f", let it take it off {path}, too, as by {path} = rst(s.{path})"


# --- P9 ------------------------------------------------------------------------------


def _check_downdates(dialogue: Dialogue, roles: Roles) -> Breaches:
    for number, trial in enumerate(dialogue.trials, start=1):
        if trial.turn is None:
            continue
        gone = _questions_removed(trial, roles)
        new = _items_agreed_on(trial, roles)
        if len(gone) > max(1, len(new)) and not _are_all_resolved(gone, trial, roles):
            yield (
                number,
                f"one answer takes away {len(gone)} questions: {format_objects(gone)}",
            )
        if why := _why_counted_again(dialogue, trial, roles):
            yield number, why


def _are_all_resolved(gone: Sequence[Object], trial: Trial, roles: Roles) -> bool:
    """Is each of these questions resolved by a proposition that was agreed on?

    An accepted answer may resolve two: what was asked, and whether the answer is right.
    """
    agreed = items_at(trial.after.state, roles.commitments)
    model = trial.after.model
    return all(
        isinstance(question, Function)
        and any(resolves(one, question, model) for one in agreed)
        for question in gone
    )


def _questions_removed(trial: Trial, roles: Roles) -> list[Object]:
    """The questions removed in a turn, except by rules that may drop questions."""
    return [
        question
        for step in trial.steps
        if step.rule.name not in roles.drops
        for question in items_not_in(
            items_at(step.before, roles.qud), items_at(step.after, roles.qud)
        )
    ]


def _items_agreed_on(trial: Trial, roles: Roles) -> list[Object]:
    """What was agreed on in a turn, and not before."""
    before = items_at(trial.before.state, roles.commitments)
    return items_not_in(items_at(trial.after.state, roles.commitments), before)


def _why_counted_again(dialogue: Dialogue, trial: Trial, roles: Roles) -> str:
    """What an answer resolves or adds twice when it is given once more.

    It may be taken for the answer to another question that was planned.
    """
    state = trial.after.state
    answered = _is_answer(trial, trial.before.state, roles)
    if not answered or _is_answer(trial, state, roles):
        return ""
    again = give(dialogue.game, trial.after, trial.given)
    # A question that a rule takes away to ask it anew is still there at the end.
    left = items_not_in(
        items_at(state, roles.qud), items_at(again.after.state, roles.qud)
    )
    gone = [
        question for question in _questions_removed(again, roles) if question in left
    ]
    if gone:
        return f"the same answer, given again, removes {format_objects(gone)}"
    twice = _count_duplicates(items_at(again.after.state, roles.commitments))
    if twice > _count_duplicates(items_at(state, roles.commitments)):
        return f"the same answer, given again, is on {roles.commitments} twice"
    return ""


def _is_answer(trial: Trial, state: Record, roles: Roles) -> bool:
    """Does what was heard answer a question under discussion?"""
    answers = roles.answers
    return answers is not None and any(
        answers(event, question)
        for event in _certain_events(trial)
        for question in items_at(state, roles.qud)
    )


# --- P10 -----------------------------------------------------------------------------


def _check_commitments(dialogue: Dialogue, roles: Roles) -> Breaches:
    for number, trial in enumerate(dialogue.trials, start=1):
        for step in trial.steps:
            if step.rule.name in roles.retracts:
                continue
            if why := _why_forgotten(step, str(roles.commitments)):
                yield number, why


def _why_forgotten(step: Step, path: str) -> str:
    before, after = value_at(step.before, path), value_at(step.after, path)
    if before is after:
        return ""
    if isinstance(before, TypeNode) and isinstance(after, TypeNode):
        if subtype(after, before).yes:
            return ""
        return f"after {step.rule} {path} is {after}, which is no longer {before}"
    gone = items_not_in(items_at(step.before, path), items_at(step.after, path))
    return f"{step.rule} takes {format_objects(gone)} from {path}" if gone else ""


# --- events --------------------------------------------------------------------------


def _certain_events(trial: Trial) -> Sequence[Object]:
    """The event of the turn, if it is certain what it is."""
    if trial.turn is None or trial.turn.heard is None:
        return ()
    event = trial.turn.heard
    return () if isinstance(event, NBest) else (event,)


def _possible_events(trial: Trial) -> Sequence[Object]:
    """What was heard, or may have been heard, and what the system said."""
    if trial.turn is None:
        return ()
    event = trial.turn.heard
    perhaps = [one for one, _ in event] if isinstance(event, NBest) else ()
    said = [move.sit for move in trial.turn.said]
    return (*_certain_events(trial), *perhaps, *said)


QUD_DISCIPLINE = Property(
    "P8",
    "questions under discussion",
    "no question is there twice; it is removed when it is resolved, and not before.",
    _check_questions,
    needs=("qud",),
)
DOWNDATES_ONCE = Property(
    "P9",
    "downdate once",
    "one answer resolves one question; given again, it resolves no other.",
    _check_downdates,
    needs=("qud",),
)
COMMITMENTS_STAY = Property(
    "P10",
    "commitments stay",
    "what is agreed on stays agreed on, unless a rule for that takes it back.",
    _check_commitments,
    needs=("commitments",),
)
