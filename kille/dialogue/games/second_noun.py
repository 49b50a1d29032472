"""A second noun for one thing: the robot asks if it is both, before it learns that.

"This is a cup." – "This is a mug.": the tutor may have corrected themselves, or mean
that it is both, or speak of another thing. Yes is a lesson; after no the robot asks
which of the two it is, and unlearns the other. Where the robot has just said itself
what it takes the thing for, the tutor knows that, and it does not ask. A thing that it
knows again from another dialogue was called something then: it says so, and asks.
"""

from __future__ import annotations

from kille.dialogue.beliefs import knows, names_of
from kille.dialogue.commitments import (
    opposite_lesson_keys,
    plan_learning,
    same,
    signs_for,
)
from kille.dialogue.games.correcting import CORRECTED
from kille.dialogue.meanings import DialogueTypes, claims, denial, is_denial
from kille.dialogue.moves import content_of, instead, issue, plan
from kille.dialogue.reference import in_view, phrase_at, thing_at
from kille.dialogue.rules import rule
from kille.dialogue.taxonomy import are_related
from ttr import Model, Record, RecordType, replace
from ttr.updates import first

BOTH = "AskBoth"
"""The question whether both nouns are right; its options: the new and the old one."""

EITHER = "AskEither"
"""The question which of the two is right, with the same options."""

KNOWN_AGAIN = 0.9
"""From this probability on a thing counts as what was taught in another dialogue."""

THIS = {"x", "look", "d"}
"""The labels of a phrase that describes no thing, such as "this" and "it"."""


@rule(answers="Instruct")
def ask_both(s: Record, *, types: DialogueTypes) -> Record | None:
    """A thing was called something else: is it both?"""
    content = content_of(s)
    before = _other_name(s, content)
    if before is None or any("c" in it for it in s.shared.pending):
        return None
    signs = signs_for(s, content, before)
    options = [s.shared.latest, replace(s.shared.latest, content=before)]
    asks = [issue(BOTH, options)]
    return plan(s, BOTH, before, content, signs=signs, asks=asks, types=types)


@rule(answers="Instruct")
def ask_earlier_name(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """A thing was called something else in another dialogue: which of the two is it?

    It is as good as certain that it is that, and it was not talked of in this one.
    """
    content = content_of(s)
    said = next((it for it in s.shared.latest.signs if claims(content, it)), None)
    x = thing_at(content, "target")
    if said is None or x is None or s.shared.pending:
        return None
    earlier = [it.sign for it in s.private.taught]
    if not earlier or x not in s.view.things or _is_named_here(s, x):
        return None
    beliefs = names_of(s, model, x)
    best = beliefs[0] if beliefs else None
    if best is None or best.p < KNOWN_AGAIN or not knows(earlier, best.sign):
        return None
    here = [it.sign for it in s.private.lessons]
    if knows(here, best.sign) or are_related(s, best.sign, said):
        return None
    before = instead(content, best.sign, types=types)
    options = [s.shared.latest, replace(s.shared.latest, content=before)]
    return plan(
        s,
        "AskEarlier",
        before,
        content,
        signs=signs_for(s, content, before),
        explains=[before],
        asks=[issue(EITHER, options)],
        types=types,
    )


def _is_named_here(s: Record, x: str) -> bool:
    """Whether the tutor has said in this dialogue what a thing in view is."""
    return any(
        "c" in it.content
        and it.content in s.shared.here
        and thing_at(it.content, "target") == x
        for it in s.private.lessons
    )


@rule(answers="Affirm")
def learn_both(s: Record, *, types: DialogueTypes) -> Record | None:
    """It is both: the new noun is a lesson, and the old one stays."""
    if not _asks(s, BOTH):
        return None
    asked, *rest = s.shared.qud
    left = replace(s, {"shared.qud": rest, "shared.latest": asked.options[0]})
    new = in_view(left, asked.options[0].content, types=types)
    return plan_learning(left, new, types=types)


@rule(answers=("Affirm", "Deny"))
def ask_either(s: Record, *, types: DialogueTypes) -> Record | None:
    """It is not both: which is it? Yes or no does not say that, and it asks again."""
    if not (_asks(s, BOTH) or _asks(s, EITHER)):
        return None
    asked, *rest = s.shared.qud
    new, old = (it.content for it in asked.options)
    return plan(
        replace(s, {"shared.qud": rest}),
        "AskWhich",
        old,
        new,
        signs=(*asked.options[0].signs, *signs_for(s, old, new)),
        asks=[issue(EITHER, asked.options)],
        types=types,
    )


@rule(answers="Instruct")
def take_either(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor says which of the two it is: the other is unlearned."""
    return _plan_either(s, types=types)


@rule(answers="Correct")
def correct_either(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor corrects the robot's doubt: it is one of the two, and not the other."""
    return _plan_either(s, types=types)


@rule(answers="PreferNow")
def take_new_name(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor prefers what they have just called the thing to what it was called."""
    return _plan_option(s, 0, types=types)


@rule(answers="PreferEarlier")
def keep_old_name(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor prefers what the thing was called before."""
    return _plan_option(s, 1, types=types)


def _plan_option(s: Record, number: int, *, types: DialogueTypes) -> Record | None:
    """The plan to learn the option of this number, and to unlearn the other."""
    if not (_asks(s, EITHER) or _asks(s, BOTH)):
        return None
    preferred = s.shared.qud[0].options[number]
    return _plan_either(replace(s, {"shared.latest": preferred}), types=types)


def _plan_either(s: Record, *, types: DialogueTypes) -> Record | None:
    """The plan to learn the one of the two that is said, and to unlearn the other."""
    if not (_asks(s, EITHER) or _asks(s, BOTH)):
        return None
    asked, *rest = s.shared.qud
    new, old = (it.content for it in asked.options)
    left = replace(s, {"shared.qud": rest})
    if _says(s, old, types=types):
        return plan_learning(left, in_view(s, old, types=types), types=types)
    if not _says(s, new, types=types):
        return None
    new = in_view(s, new, types=types)
    before = [it.key for it in s.private.lessons if same(it.content, old)]
    weaker = [] if before else [denial(in_view(s, old, types=types))]
    return plan(
        left,
        CORRECTED["c"],
        new,
        old,
        signs=(*asked.options[0].signs, *signs_for(s, old, new)),
        teaches=[*weaker, new],
        forgets=[*before, *opposite_lesson_keys(s, new, types=types)],
        types=types,
    )


def _asks(s: Record, question: str) -> bool:
    """Whether this question is under discussion."""
    return bool(s.shared.qud) and s.shared.qud[0].ask == question


def _says(s: Record, content: RecordType, *, types: DialogueTypes) -> bool:
    """Whether the latest move says the same noun, and not of another thing."""
    said, x = content_of(s), thing_at(content, "target")
    if not _says_bare(s, content) and said.get("c") != content["c"]:
        return False
    if "target" in said and not _points_to_it(said, types=types):
        return False
    return not s.view.pointed or x in s.view.pointed


def _says_bare(s: Record, content: RecordType) -> bool:
    """Whether the latest move says the noun of a content without an article: "mug"."""
    said = content_of(s)
    if "a" not in said or is_denial(said):
        return False
    forms = {it.form for it in s.shared.latest.signs if claims(said, it)}
    named = [it for option in s.shared.qud[0].options for it in option.signs]
    named = [*named, *signs_for(s, content)]
    return any(it.form in forms for it in named if claims(content, it))


def _points_to_it(said: RecordType, *, types: DialogueTypes) -> bool:
    """Whether a claim calls its thing no more than "this", "that" or "it"."""
    phrase = phrase_at(said, "target")
    words = [types.record_type(it)["d"] for it in ("This", "That", "It")]
    return set(phrase.labels) <= THIS and phrase.get("d") in (None, *words)


def _other_name(s: Record, content: RecordType) -> RecordType | None:
    """What else the tutor has said that the thing is, since it came in view."""
    x = thing_at(content, "target")
    said = [it for it in s.shared.latest.signs if claims(content, it)]
    names = [
        it.content
        for it in s.private.lessons
        if it.content in s.shared.here
        and "c" in it.content
        and not is_denial(it.content)
        and thing_at(it.content, "target") == x
        and (claims(content, it.sign) or not are_related(s, it.sign, said[0]))
    ]
    if any(same(it, content) for it in names):
        return None
    return names[-1] if names else None


BOTH_ANSWERED = first(
    learn_both, ask_either, take_either, correct_either, take_new_name, keep_old_name
)
"""What answers whether it is both, or which of the two it is."""

SECOND_NOUN = first(ask_both, ask_earlier_name)
