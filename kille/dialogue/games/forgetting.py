"""The tutor has the robot forget: a lesson, a word with all its lessons, or everything.

What is unlearned is as if it had never been taught. A word of which no lesson is left
is no longer known.
"""

from __future__ import annotations

from collections.abc import Iterable

from kille.dialogue.beliefs import knows
from kille.dialogue.commitments import kind_of, lessons_in, plan_learning
from kille.dialogue.games.surveying import in_view
from kille.dialogue.meanings import (
    DialogueTypes,
    claims,
    denial,
    is_denial,
    mentions,
    predicate_at,
    values_at,
    word_of,
)
from kille.dialogue.moves import content_of, hear_as, issue, plan, said_of
from kille.dialogue.reference import thing_at, things_in
from kille.dialogue.reference.salience import talked_about
from kille.dialogue.rules import rule
from kille.dialogue.state import words
from ttr import Model, Record, RecordType, record, replace
from ttr.updates import first

FORGOT = {"c": "Forgot", "a": "ForgotQuality", "rel": "ForgotRelation"}
"""What the robot says when it has forgotten a lesson, by the label of its claim."""

FORGOT_NOT = {"c": "ForgotNot", "a": "ForgotNotQuality", "rel": "ForgotNotRelation"}
"""What it says when the lesson was that something is not so."""

FORGOT_WORD = {
    "noun": "ForgotNoun",
    "adjective": "ForgotAdjective",
    "relation": "ForgotRelationWord",
}
"""What it says when it has forgotten a word of a kind."""


ALL = "AskForgetAll"
"""The question whether everything is to be forgotten."""

FORGET = "AskForget"
"""The question whether a word of another dialogue is to be forgotten."""


@rule(answers="ForgetThat")
def forget_claim(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor says what is to be forgotten: all lessons that say so are unlearned."""
    content = content_of(s)
    if kind_of(content) is None:
        return None
    lessons = lessons_in(s, content, types=types)
    return (
        plan_forgetting(s, *lessons, types=types)
        if lessons
        else plan(s, "ForgetNothing", types=types)
    )


@rule(answers="ForgetThat")
def forget_that(s: Record, *, types: DialogueTypes) -> Record | None:
    """The latest lesson about the thing that is talked of is unlearned.

    If it was one about several things, or said several things, all of it is.
    """
    talked_of = set(talked_about(s))
    lessons = [
        it
        for it in s.private.lessons
        if it.content in s.shared.here and talked_of & set(things_in(it.content))
    ]
    if not lessons:
        return None
    return plan_taking_back(s, taught_together(s, lessons[-1]), types=types)


@rule(answers="ForgetAbout")
def forget_about(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor takes back what they said about a thing: the latest lesson about it.

    That it is what they call it is taken back only where nothing else was said of it.
    """
    x, phrase = thing_at(content_of(s), "target"), content_of(s).get("target")
    about = [
        it
        for it in s.private.lessons
        if it.content in s.shared.here and x in things_in(it.content)
    ]
    own = [it for it in about if phrase and mentions(phrase, it.sign)]
    others = [it for it in about if it not in own]
    for lesson in (others or own)[-1:]:
        return plan_taking_back(s, taught_together(s, lesson), types=types)
    return None


@rule(answers="CorrectThing")
def move_lesson(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor has said it of the wrong thing: it is learned of the other instead."""
    lesson, x = (
        next(iter(s.private.lessons[-1:]), None),
        thing_at(content_of(s), "target"),
    )
    if lesson is None or x is None or "rel" in lesson.content:
        return None
    if kind_of(content_of(s)) is not None and not claims(content_of(s), lesson.sign):
        return None
    taught = {content for it in s.private.last for content in values_at(it, "teaches")}
    if lesson.content not in taught or thing_at(lesson.content, "target") == x:
        return None
    moved = said_of(s, lesson.sign, x, _SAID[lesson.sign.kind], types=types)
    moved = denial(moved) if is_denial(lesson.content) else moved
    return plan_learning(plan_forgetting(s, lesson, types=types), moved, types=types)


@rule(answers="CorrectThing")
def take_as_correction(
    s: Record, *, model: Model, types: DialogueTypes
) -> tuple[Record, Model] | None:
    """It says what another thing is, but that was not just said of one: it corrects."""
    said = s.shared.latest
    sign = next((it for it in said.signs if claims(said.content, it)), None)
    taught = [it for move in s.private.last for it in values_at(move, "teaches")]
    if sign is None or any(claims(it, sign) for it in taught):
        return None
    move, model = hear_as(s, model, "Correct", said.content, said.signs, types=types)
    return replace(s, {"shared.latest": move}), model


@rule(answers="CorrectThing")
def move_nothing(s: Record, *, types: DialogueTypes) -> Record:
    """Nothing was just said of another thing."""
    return plan(s, "WhatAbout", types=types)


_SAID = {"noun": "Naming", "adjective": "Having"}
"""As what words of a kind are said of a thing."""


@rule(answers="ForgetThat")
def ask_forget(s: Record, *, types: DialogueTypes) -> Record | None:
    """What it has claimed was taught in another dialogue: shall it forget the word?"""
    known = [it.sign for it in s.private.taught]
    claims_ = s.shared.pending[:1]
    for sign in words(s):
        if knows(known, sign) and any(claims(it, sign) for it in claims_):
            asked = issue(FORGET, [replace(s.shared.latest, signs=[sign])])
            return plan(
                s, FORGET, sign.meaning, signs=[sign], asks=[asked], types=types
            )
    return None


@rule(answers="Affirm")
def forget_asked(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor wants it to forget the word."""
    if not _asks_to_forget(s):
        return None
    asked, *rest = s.shared.qud
    [sign] = asked.options[0].signs
    return _plan_forgetting_word(replace(s, {"shared.qud": rest}), sign, types=types)


@rule(answers="Deny")
def keep_asked(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor wants it to keep the word."""
    if not _asks_to_forget(s):
        return None
    return plan(replace(s, {"shared.qud": s.shared.qud[1:]}), "Noted", types=types)


@rule(answers="ForgetThat")
def forget_that_earlier(s: Record, *, types: DialogueTypes) -> Record | None:
    """Nothing was taught or said in this dialogue: the latest lesson is unlearned."""
    before = s.private.taught or s.private.kinds or s.private.criteria
    if not before or s.private.lessons or s.private.last:
        return None
    return plan(s, "ForgotLast", undoes=["latest"], types=types)


@rule(answers="ForgetLast")
def forget_last(s: Record, *, types: DialogueTypes) -> Record | None:
    """The latest lesson is unlearned."""
    return (
        plan_forgetting(s, s.private.lessons[-1], types=types)
        if s.private.lessons
        else None
    )


@rule(answers="ForgetAll")
def ask_forget_all(s: Record, *, types: DialogueTypes) -> Record:
    """The tutor wants everything forgotten: that cannot be undone, so it asks.

    Where nothing was taught there is nothing to ask.
    """
    if not _taught_words(s):
        return plan(s, "ForgetNothing", types=types)
    return plan(s, ALL, asks=[issue(ALL, [s.shared.latest])], types=types)


@rule(answers="Affirm")
def forget_all(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor means it: every word that was taught is forgotten."""
    if not _asks_all(s):
        return None
    known = _taught_words(s)
    left = replace(s, {"shared.qud": s.shared.qud[1:]})
    said = [it.key for it in (*s.private.kinds, *s.private.criteria)]
    return plan(left, "ForgotAll", signs=known, drops=known, forgets=said, types=types)


@rule(answers="Deny")
def forget_none(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor does not mean it: nothing is forgotten."""
    if not _asks_all(s):
        return None
    return plan(replace(s, {"shared.qud": s.shared.qud[1:]}), "Noted", types=types)


def _taught_words(s: Record) -> list[Record]:
    """The words that it knows, but for the colours that it came with."""
    return [it for it in words(s) if not knows(s.private.colours, it)]


def _asks_all(s: Record) -> bool:
    return bool(s.shared.qud) and s.shared.qud[0].ask == ALL


@rule(answers="ForgetWord")
def forget_word(s: Record, *, types: DialogueTypes) -> Record | None:
    """A word is forgotten with all lessons in it, those of other dialogues too."""
    known = list(words(s))
    for said in s.shared.latest.signs:
        if knows(known, said):
            sign = next(it for it in known if word_of(it) is word_of(said))
            return _plan_forgetting_word(s, sign, types=types)
    return None


@rule(answers="ForgetWord")
def miss_forgotten(s: Record, *, types: DialogueTypes) -> Record:
    """The word is not known, so that there is nothing to forget."""
    sign = s.shared.latest.signs[0]
    return plan(s, "UnknownWord", sign.meaning, signs=[sign], types=types)


@rule(answers=("ForgetThat", "ForgetAbout"))
def forget_no_such(s: Record, *, types: DialogueTypes) -> Record:
    """Nothing was taught about the thing that is talked of."""
    return plan(s, "ForgetNothing", types=types)


@rule(answers="ForgetLast")
def forget_earlier(s: Record, *, types: DialogueTypes) -> Record:
    """Nothing is left of this dialogue: the latest of all lessons is unlearned."""
    return plan(s, "ForgotLast", undoes=["latest"], types=types)


def _asks_to_forget(s: Record) -> bool:
    """Whether the question under discussion is if a word is to be forgotten."""
    return bool(s.shared.qud) and s.shared.qud[0].ask == FORGET


def _plan_forgetting_word(s: Record, sign: Record, *, types: DialogueTypes) -> Record:
    """The plan to forget a word, with all its lessons and what was said of its kind."""
    said = (*s.private.kinds, *s.private.criteria)
    kinds = [it.key for it in said if knows(it.signs, sign)]
    return plan(
        s,
        FORGOT_WORD[sign.kind],
        sign.meaning,
        signs=[sign],
        drops=[sign],
        forgets=kinds,
        types=types,
    )


def plan_forgetting(s: Record, *lessons: Record, types: DialogueTypes) -> Record:
    """The plan to unlearn lessons that say the same."""
    lesson = lessons[-1]
    acts = FORGOT_NOT if is_denial(lesson.content) else FORGOT
    return plan(
        s,
        acts[kind_of(lesson.content) or ""],
        lesson.content,
        signs=[lesson.sign],
        forgets=[it.key for it in lessons],
        types=types,
    )


def taught_together(s: Record, lesson: Record) -> list[Record]:
    """The lessons that the robot has just acknowledged together with this one.

    Only this one, if that was not just now.
    """
    moves = [it for it in s.private.last if _acknowledges(it)]
    contents = {content for it in moves for content in values_at(it, "teaches")}
    if lesson.content not in contents:
        return [lesson]
    return [it for it in s.private.lessons if it.content in contents]


def _acknowledges(move: RecordType) -> bool:
    """Whether a move says what the robot has learned, and corrects nothing."""
    act: str = predicate_at(move, "e").name
    return act.startswith("learned") or act == "rejected_several"


def plan_taking_back(
    s: Record, lessons: Iterable[Record], *, types: DialogueTypes
) -> Record:
    """The plan to unlearn lessons that need not say the same, word by word."""
    alike: dict[object, list[Record]] = {}
    for it in lessons:
        alike.setdefault((it.sign, is_denial(it.content)), []).append(it)
    for them in alike.values():
        several = len({it.content for it in them}) > 1
        plan_all = _plan_forgetting_several if several else plan_forgetting
        s = plan_all(s, *them, types=types)
    return s


def _plan_forgetting_several(
    s: Record, *lessons: Record, types: DialogueTypes
) -> Record:
    """The plan to unlearn that several things are so, or are not."""
    sign, denies = lessons[0].sign, is_denial(lessons[0].content)
    things = [x for it in lessons for x in things_in(it.content)]
    seen = [record(sit=record(x=x), sign=sign) for x in things]
    listed = sign.kind == "noun" and not denies
    return plan(
        s,
        "ForgotNotSeveral" if denies else "ForgotSeveral",
        in_view(s, seen, (), (), types=types) if listed else sign.meaning,
        signs=[sign],
        forgets=[it.key for it in lessons],
        types=types,
    )


FORGETTING = first(
    forget_claim,
    forget_that,
    forget_about,
    move_lesson,
    move_nothing,
    ask_forget,
    forget_that_earlier,
    forget_last,
    ask_forget_all,
    forget_word,
    miss_forgotten,
    forget_no_such,
    forget_earlier,
)

RETHINKING = take_as_correction
"""What takes what is said of another thing for a correction."""

FORGET_ANSWERED = first(forget_all, forget_none, forget_asked, keep_asked)
"""What answers whether a word, or everything, is to be forgotten."""
