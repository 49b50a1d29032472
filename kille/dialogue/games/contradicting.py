"""Earlier you told me otherwise: the robot asks which is right, before it learns that.

What was taught in another dialogue is remembered. Where the tutor says what is against
it, that a mug is no kind of cup, or that the colour does matter, the robot says what it
was told, and when, and asks. It learns what the tutor says again: what they say now, in
place of the other, or what they said then. "No." straight after takes that back.
"""

from __future__ import annotations

from collections.abc import Sequence

from kille.dialogue.commitments import kind_of
from kille.dialogue.criteria import (
    COMPONENT,
    PROPERTY,
    SUBJECT,
    criteria_about,
    learned_act,
    sign_at,
)
from kille.dialogue.meanings import DialogueTypes, predicate_at, value_at
from kille.dialogue.moves import content_of, issue, plan
from kille.dialogue.rules import reply, rule
from kille.dialogue.taxonomy import LOWER
from ttr import Model, Record, RecordType, rectype, replace
from ttr.updates import first

EARLIER = "AskEarlier"
"""The question which is right: its options are what is said now, and what was then."""

RESTATING = ("Classify", "Unclassify", "Reject", "WeighCue", "Generalise")
"""The moves by which the tutor may say again what is right."""


def plan_earlier_question(
    s: Record, now: Record, then: Record, *, types: DialogueTypes
) -> Record:
    """The plan to ask which is right: what a move says, or what was taught earlier.

    That is one of the kinds or the criteria of the state.
    """
    before = replace(now, content=then.content, signs=then.signs)
    return plan(
        s,
        EARLIER,
        then.content,
        signs=then.signs,
        pending=s.shared.pending,
        cites=[then.key],
        asks=[issue(EARLIER, [now, before])],
        types=types,
    )


@rule(answers=RESTATING)
def take_restated(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """The tutor says one of the two again: that is right."""
    if not _asks(s):
        return None
    now, before = s.shared.qud[0].options
    if _says_same(s, model, now, types=types):
        return _plan_now(s, types=types)
    said = content_of(s)
    if LOWER in before.content:
        again = types.has(s.shared.latest, "Classify", model)
    else:
        again = SUBJECT not in said or said[SUBJECT] == before.content[SUBJECT]
        said = rectype({**dict(said.fields), SUBJECT: before.content[SUBJECT]})
    return _plan_before(s, types=types) if again and said == before.content else None


@rule(answers="PreferNow")
def take_now(s: Record, *, types: DialogueTypes) -> Record | None:
    """What the tutor says now is right: it is learned in place of the other."""
    return _plan_now(s, types=types) if _asks(s) else None


@rule(answers="PreferEarlier")
def keep_earlier(s: Record, *, types: DialogueTypes) -> Record | None:
    """What the tutor said earlier is right, and stays."""
    return _plan_before(s, types=types) if _asks(s) else None


@rule(answers=("Affirm", "Deny"))
def ask_earlier_again(s: Record, *, types: DialogueTypes) -> Record | None:
    """Yes or no does not say which of the two is right: it asks again."""
    if not _asks(s):
        return None
    now, before = s.shared.qud[0].options
    for then in _axioms_saying(s, before.content):
        return plan_earlier_question(_settle(s), now, then, types=types)
    return None


@rule(answers=("ForgetThat", "ForgetLast"))
def leave_earlier(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor takes back what they have said: what was taught earlier stays."""
    if not _asks(s) or kind_of(content_of(s)) is not None:
        return None
    return plan(_settle(s), "LetBe", types=types)


@rule(answers=("Deny", "ForgetThat"))
def learn_kind_again(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor takes back that one kind is no kind of another: it is one again."""
    if len(s.private.last) != 1 or s.shared.qud:
        return None
    said = s.private.last[0]
    if predicate_at(said, "e").name != "unlearned_kind":
        return None
    content, signs = value_at(said, "content"), value_at(said, "signs")
    assert isinstance(content, RecordType)
    return plan(
        s, "LearnedKind", content, signs=signs, classifies=[content], types=types
    )


def _asks(s: Record) -> bool:
    """Whether the question under discussion is which is right."""
    return bool(s.shared.qud) and s.shared.qud[0].ask == EARLIER


def _settle(s: Record) -> Record:
    """The state in which that question is no longer under discussion."""
    return replace(s, {"shared.qud": s.shared.qud[1:]})


def _says_same(s: Record, model: Model, move: Record, *, types: DialogueTypes) -> bool:
    """Whether the latest move says again what a move has said."""
    said, content = s.shared.latest, content_of(s)
    alike = any(
        types.has(said, it, model) and types.has(move, it, model) for it in RESTATING
    )
    if SUBJECT in move.content and SUBJECT not in content:
        subject = move.content[SUBJECT]
        content = rectype({**dict(content.fields), SUBJECT: subject})
    if "target" in content:
        return alike and {*_words(said)} == {*_words(move)}
    return alike and content == move.content


def _words(move: Record) -> Sequence[str]:
    return [it.form for it in move.signs]


def _axioms_saying(s: Record, content: RecordType) -> list[Record]:
    """The kinds and criteria of the state that say this."""
    known = (*s.private.kinds, *s.private.criteria)
    return [it for it in known if it.content == content]


def _plan_before(s: Record, *, types: DialogueTypes) -> Record:
    """The plan to keep to what was taught earlier."""
    before = s.shared.qud[0].options[1]
    return plan(
        _settle(s), "KeptEarlier", before.content, signs=before.signs, types=types
    )


def _plan_now(s: Record, *, types: DialogueTypes) -> Record:
    """The plan to learn what is said now, in place of what was taught earlier."""
    now, before = s.shared.qud[0].options
    keys = [it.key for it in _axioms_saying(s, before.content)]
    left = _settle(s)
    if LOWER in before.content:
        return plan(
            left,
            "UnlearnedKind",
            before.content,
            signs=before.signs,
            forgets=keys,
            types=types,
        )
    content = now.content
    gone = [it.key for it in criteria_about(s, content)]
    labels = (SUBJECT, PROPERTY, COMPONENT)
    found = (sign_at(content, it, now.signs) for it in labels)
    return plan(
        left,
        learned_act(content),
        content,
        before.content,
        signs=[it for it in found if it is not None],
        weighs=[content],
        forgets=gone or keys,
        pending=s.shared.pending,
        types=types,
    )


CONTRADICTING = first(
    learn_kind_again,
    reply("PreferNow", "Wonder", "It has not asked which of two things is right."),
    reply("PreferEarlier", "Wonder", "It has not asked which of two things is right."),
)
EARLIER_ANSWERED = first(
    take_restated, take_now, keep_earlier, ask_earlier_again, leave_earlier
)
"""What answers which is right, what is said now or what was taught earlier."""
