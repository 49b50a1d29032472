"""The tutor sets something right: "No, this is a mug." "This is not a cup."

What the robot claimed, and the tutor rejects, it learns not to be so in the look that
it was claimed of; what it was taught by mistake it unlearns. Then it learns what is
right, from the look in which it is told. Nothing else that is agreed on changes.

Source: Larsson 2013, "Formal semantics for perceptual classification", for corrective
feedback; docs/decisions/052-corrections-in-talk.md.
"""

from __future__ import annotations

from collections.abc import Sequence

from kille.dialogue.commitments import (
    act_of,
    affirmation,
    effects_of_rejection,
    is_here,
    kind_of,
    knows_places,
    lessons_in,
    opposite_lesson_keys,
    plan_learning,
    same,
    signs_for,
)
from kille.dialogue.meanings import DialogueTypes, denial, is_denial, set_to
from kille.dialogue.moves import content_of, plan
from kille.dialogue.reference import PARTS, thing_at
from kille.dialogue.rules import rule
from ttr import Record, RecordType, join, rectype
from ttr.updates import first

CORRECTED = {"c": "Corrected", "a": "CorrectedQuality", "rel": "CorrectedRelation"}
"""What the robot says when it has learned one claim in place of another."""

DENIED = "denied"
"""The label under which a correction says what it denies."""


@rule(answers="Correct")
def correct(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor says what is so instead: learn that, and unlearn what was said."""
    content = _right(s)
    wrong = _wrong(s, content, types=types)
    if not wrong or not knows_places(s, content):
        return None
    weaker, forgets = effects_of_rejection(s, wrong, types=types)
    teaches = [*weaker, content]
    return plan(
        s,
        CORRECTED[kind_of(content) or ""],
        content,
        _either(wrong),
        signs=signs_for(s, *teaches, *wrong),
        teaches=teaches,
        forgets=[*forgets, *opposite_lesson_keys(s, content, types=types)],
        types=types,
    )


@rule(answers="Correct")
def accept(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor corrects what nobody has said: learn what is so."""
    content = _right(s)
    return plan_learning(s, content, types=types) if knows_places(s, content) else None


@rule(answers="Reject")
def reject(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor says what is not so: unlearn that it is, or learn that it is not."""
    content = content_of(s)
    if not knows_places(s, content):
        return None
    wrong = affirmation(content)
    was_taught = bool(lessons_in(s, wrong, types=types))
    was_claimed = any(
        same(wrong, it) and is_here(s, it, types=types) for it in s.shared.pending
    )
    if was_claimed or not was_taught:
        return plan_learning(s, content, types=types)
    return plan(
        s,
        act_of(content),
        content,
        signs=signs_for(s, content),
        forgets=opposite_lesson_keys(s, content, types=types),
        types=types,
    )


@rule(answers="Correct")
def need_places_to_correct(s: Record, *, types: DialogueTypes) -> Record:
    """The things are in view, but not where they are."""
    return plan(s, "NeedDepth", types=types)


@rule(answers="Reject")
def need_places_to_reject(s: Record, *, types: DialogueTypes) -> Record:
    """The things are in view, but not where they are."""
    return plan(s, "NeedDepth", types=types)


def _right(s: Record) -> RecordType:
    """What is so, by a correction."""
    content = content_of(s)
    return rectype({k: field for k, field in content.fields if k != DENIED})


def _wrong(
    s: Record, content: RecordType, *, types: DialogueTypes
) -> Sequence[RecordType]:
    """What is not so, by a correction: what it names, or was claimed, or was taught."""
    named = content_of(s).get(DENIED)
    if isinstance(named, RecordType):
        wrong = _in_place(content, denial(named))
        return [] if same(wrong, content) else [wrong]
    claimed = [
        it
        for it in s.shared.pending
        if _alike(it, content) and is_here(s, it, types=types)
    ]
    if claimed:
        return [it for it in claimed if _rivals(it, content)]
    taught = [it.content for it in s.private.lessons if _rivals(it.content, content)]
    return [it for it in taught if it in s.shared.here][-1:]


def _in_place(content: RecordType, wrong: RecordType) -> RecordType:
    """The content with the claim of another one in place of its own."""
    label = kind_of(wrong) or ""
    return set_to(content, **{label: wrong[label]})


def _either(claims: Sequence[RecordType]) -> RecordType:
    """That one of these claims about the same target is true."""
    first, *others = claims
    if not others:
        return first
    label = kind_of(first) or ""
    return set_to(first, **{label: join(*(it[label] for it in claims))})


def _alike(claim: RecordType, content: RecordType) -> bool:
    """Whether two claims say something of the same kind about the same things."""
    things = [(thing_at(claim, part), thing_at(content, part)) for part in PARTS]
    return kind_of(claim) == kind_of(content) and all(x == y for x, y in things)


def _rivals(claim: RecordType, content: RecordType) -> bool:
    """Whether a claim says something else of the same kind about the same things."""
    return _alike(claim, content) and not is_denial(claim) and not same(claim, content)


CORRECTING = first(
    correct, accept, reject, need_places_to_correct, need_places_to_reject
)
