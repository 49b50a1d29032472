"""What has been claimed and taught: which claims say the same, and which still stand.

A claim is a content that says a word of things, `This is a cup`, or denies it. Things
keep their names as long as they are in view, so that what was said of a thing in one
look holds of it in the next; `shared.here` is what was said of things since they came.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence

from kille.dialogue.meanings import (
    CLAIMS,
    DialogueTypes,
    claimed_words,
    denial,
    is_denial,
    word_of,
)
from kille.dialogue.moves import plan
from kille.dialogue.reference import PARTS, thing_at, things_in
from kille.dialogue.state import words
from ttr import Pred, Record, RecordType

LEARNED = {"c": "Learned", "a": "LearnedQuality", "rel": "LearnedRelation"}
"""What the robot says when it has learned a claim, by the claim's label."""

REJECTED = {"c": "Rejected", "a": "RejectedQuality", "rel": "RejectedRelation"}
"""What it says when it has learned that a claim does not hold."""


def kind_of(content: RecordType) -> str | None:
    """The label of the claim that a content makes, if it makes one."""
    return next((label for label in CLAIMS if label in content), None)


def act_of(content: RecordType) -> str:
    """What the robot says when it has learned a content."""
    acts = REJECTED if is_denial(content) else LEARNED
    return next(acts[label] for label in acts if label in content)


def affirmation(content: RecordType) -> RecordType:
    """What a content says of its things, or what it denies of them."""
    return denial(content) if is_denial(content) else content


def same(claim: RecordType, other: RecordType) -> bool:
    """Whether two claims say the same of the same things, also in different looks.

    >>> from kille.dialogue.meanings import meaning_at, noun, set_at
    >>> cup = set_at(meaning_at(noun("cup"), "Naming"), "target.x", "o1")
    >>> same(cup, set_at(cup, "look", "look2")), same(cup, denial(cup))
    (True, False)

    Contents without a claim are never the same.

    >>> from kille.dialogue.meanings import record_type
    >>> same(record_type("Asked"), record_type("Asked"))
    False
    """
    label = kind_of(claim)
    return (
        label is not None
        and claim[label] == other.get(label)
        and all(thing_at(claim, part) == thing_at(other, part) for part in PARTS)
        and claim.get("frame") == other.get("frame")
    )


# --- what is said of the things in view ----------------------------------------------


def keep_claims(here: Iterable[RecordType], kept: Collection[str]) -> list[RecordType]:
    """What is still said of things in view, when only these have stayed."""
    return [it for it in here if set(things_in(it)) <= set(kept)]


def claims_here(s: Record, said: Record, *, types: DialogueTypes) -> list[RecordType]:
    """What is said of the things in view, after the robot has made a move.

    These are the lessons about them, and what the robot claims. A claim that it has
    dropped, and was never taught, does not count.
    """
    fresh = (*s.shared.pending, *said.teaches)
    kept = {*fresh, *(it.content for it in s.private.lessons)}
    known = [it for it in s.shared.here if it in kept]
    new = (it for it in fresh if it not in known and is_here(s, it, types=types))
    return [*known, *new]


def lessons_in(s: Record, claim: RecordType, *, types: DialogueTypes) -> list[Record]:
    """The lessons that say what a claim says, about the very things it is about."""
    here = s.shared.here if is_here(s, claim, types=types) else ()
    return [
        it
        for it in s.private.lessons
        if same(it.content, claim)
        and (it.content["look"] == claim["look"] or it.content in here)
    ]


def is_here(s: Record, claim: RecordType, *, types: DialogueTypes) -> bool:
    """Whether what a claim is about is still in view, or was when it was denied."""
    now = types["Look"] @ s.view.look
    return claim["look"] == now or bool({claim, denial(claim)} & {*s.shared.here})


def knows_places(s: Record, content: RecordType) -> bool:
    """Whether it is known where the things are, if a content is about that."""
    things = {thing_at(content, part) for part in PARTS}
    return "rel" not in content or things <= set(s.view.placed)


# --- what is to be learned and unlearned ---------------------------------------------


def opposite_lesson_keys(
    s: Record, content: RecordType, *, types: DialogueTypes
) -> list[str]:
    """The keys of the lessons that say the opposite of a content."""
    return [it.key for it in lessons_in(s, denial(content), types=types)]


def effects_of_rejection(
    s: Record, wrong: Iterable[RecordType], *, types: DialogueTypes
) -> tuple[list[RecordType], list[str]]:
    """What is learned and which lessons are unlearned when these claims are wrong.

    A lesson that says so is unlearned. Of a claim that the robot made, or that nobody
    taught it, it learns that it is not so.
    """
    teaches: list[RecordType] = []
    forgets: list[str] = []
    for claim in wrong:
        taught = lessons_in(s, claim, types=types)
        forgets += (it.key for it in taught)
        if not taught or any(same(claim, it) for it in s.shared.pending):
            teaches.append(denial(claim))
    return teaches, forgets


def effects_of_denial(
    s: Record, claims: Iterable[RecordType], *, types: DialogueTypes
) -> tuple[list[RecordType], list[str]]:
    """What is learned and which lessons are unlearned when the tutor only says no.

    One no does not undo several lessons: of those that say what was claimed the last
    one is unlearned. What was taught once, or never, is rejected.
    """
    teaches: list[RecordType] = []
    forgets: list[str] = []
    for claim in claims:
        taught = lessons_in(s, claim, types=types)
        if len(taught) > 1:
            forgets.append(taught[-1].key)
            continue
        learned, unlearned = effects_of_rejection(s, [claim], types=types)
        teaches, forgets = [*teaches, *learned], [*forgets, *unlearned]
    return teaches, forgets


def signs_for(s: Record, *contents: RecordType) -> Sequence[Record]:
    """The words that these contents claim, as the tutor has said them."""
    said = s.shared.latest.signs if "signs" in s.shared.latest else ()
    found: dict[Pred, Record] = {}
    claimed = frozenset[Pred]().union(*map(claimed_words, contents))
    for sign in (*said, *words(s), *(it.sign for it in s.private.lessons)):
        if (word := word_of(sign)) in claimed:
            found.setdefault(word, sign)
    return tuple(found.values())


def plan_learning(s: Record, content: RecordType, *, types: DialogueTypes) -> Record:
    """The plan to learn a content, and to unlearn the lessons that it contradicts."""
    return plan(
        s,
        act_of(content),
        content,
        signs=signs_for(s, content),
        teaches=[content],
        forgets=opposite_lesson_keys(s, content, types=types),
        types=types,
    )
