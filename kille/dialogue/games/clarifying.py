"""Clarification: the tutor answers a question that the robot asked about what was said.

Such a question is an issue under discussion, and each of its options is the tutor's own
move, made specific in one way. An answer makes an option the latest move, and the games
go on as if it had been said so from the start. Whatever else is said drops the question
and is heard as itself; what answers it badly is asked back once.
"""

from __future__ import annotations

from collections.abc import Sequence

from kille.dialogue.commitments import opposite_lesson_keys
from kille.dialogue.games.continuing import NAMED_ALSO
from kille.dialogue.games.referring import about, differing_things, plan_question
from kille.dialogue.games.several_things import plan_several, without_others
from kille.dialogue.meanings import (
    DialogueTypes,
    claims,
    denial,
    is_denial,
    predicate_at,
    values_at,
)
from kille.dialogue.moves import content_of, hear_as, plan, said_of
from kille.dialogue.reference import PhraseJudge, fits_well, phrase_at
from kille.dialogue.rules import reply, rule
from ttr import Model, Record, replace
from ttr.updates import first, maybe, seq

AGAIN = {"AskReferent": "AskReferentAgain"}
"""How a question is put on record when it is asked once more."""

REFERENTS = ("AskReferent", "AskReferentAgain")
"""The questions which thing was meant."""


@rule(answers="Mention")
def take_described(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """The tutor says which one: "the red one", "the second", "this one"."""
    options = _fitting_options(s, model, types=types)
    return take_option(s, options[0], types=types) if len(options) == 1 else None


@rule(answers="Excluded")
def take_rest(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """The tutor says which one is not meant: the one that is left, or else it asks."""
    if not asks_which(s):
        return None
    options = _options(s)
    _, things = differing_things(options)
    phrase = phrase_at(content_of(s), "target")
    gone = fits_well(s, PhraseJudge(s, model, types=types).fits(phrase))
    left = [it for x, it in zip(things, options, strict=True) if x not in gone]
    if not 0 < len(left) < len(options):
        return _ask_again(s, model, types=types)
    if len(left) == 1:
        return take_option(s, left[0], types=types)
    ask = s.shared.qud[0].ask
    return plan_question(_drop_issue(s), model, left, ask, types=types)


@rule(answers="Excluded")
def take_as_no(
    s: Record, *, model: Model, types: DialogueTypes
) -> tuple[Record, Model] | None:
    """Nobody has asked which one is meant: it is a no to what was said of this one."""
    if asks_which(s):
        return None
    deny, model = hear_as(s, model, "Deny", types=types)
    return replace(s, {"shared.latest": deny}), model


@rule(answers="AffirmedOfAll")
def learn_all(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """A lesson is about all of these things: it is one about each.

    Not where one of them is known to be something else: then it asks again.
    """
    options = _options(s) if asks_which(s) else ()
    if not options or not any(
        types.has(options[0], it, model) for it in ("Instruct", "Describe")
    ):
        return None
    said = options[0]
    sign = next((it for it in said.signs if claims(said.content, it)), None)
    label, things = differing_things(options)
    if sign is None or label != "target":
        return None
    if len(without_others(s, model, things, sign)) < len(things):
        return None
    return plan_several(_drop_issue(s), things, sign, types=types)


@rule(answers="Affirm")
def take_only(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor says yes to the only option there is."""
    options = _options(s)
    return take_option(s, options[0], types=types) if len(options) == 1 else None


@rule(answers="DeniedOfAll")
def reject_all(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor says that none of these things is what a lesson is about."""
    options = _options(s) if asks_which(s) else ()
    sign = _word_of_all(options) if options else _word_missed(s)
    if sign is None or not s.view.things:
        return None
    _, things = differing_things(options) if options else ("", s.view.things)
    teaches = [denial(said_of(s, sign, x, types=types)) for x in things]
    return plan(
        _drop_issue(s) if options else s,
        "RejectedSeveral",
        sign.meaning,
        signs=[sign],
        teaches=teaches,
        forgets=[
            key for it in teaches for key in opposite_lesson_keys(s, it, types=types)
        ],
        types=types,
    )


def _word_of_all(options: Sequence[Record]) -> Record | None:
    """The noun that all these moves say of their things."""
    said = options[0]
    if "c" not in said.content or is_denial(said.content):
        return None
    return next((it for it in said.signs if claims(said.content, it)), None)


def _word_missed(s: Record) -> Record | None:
    """The noun of which the robot has just said that it does not know it."""
    for it in s.private.last[-1:]:
        if predicate_at(it, "e").name == "unknown_noun":
            return next(iter(values_at(it, "signs")), None)
    return None


@rule(answers="Deny")
def take_none(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor means none of these things: the question is dropped."""
    return plan(_drop_issue(s), "Resign", types=types) if asks_which(s) else None


@rule(answers="Mention")
def ask_fewer(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """The answer leaves some of the things open: it asks about those."""
    options = _fitting_options(s, model, types=types)
    if not 1 < len(options) < len(_options(s)):
        return None
    return plan_question(
        _drop_issue(s), model, options, s.shared.qud[0].ask, types=types
    )


@rule(answers="Mention")
def ask_once_more(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """The answer does not say which one: it asks the same once more."""
    return _ask_again(s, model, types=types)


@rule(answers="Affirm")
def ask_yes_to_which(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """The tutor says yes, but there are several things: it asks the same once more."""
    return _ask_again(s, model, types=types)


@rule(answers="Heard")
def drop_question(s: Record) -> Record | None:
    """Something else is said: the question is dropped, and what was claimed before."""
    return replace(_drop_issue(s), {"shared.pending": ()}) if s.shared.qud else None


wonder_at_mention = reply(
    "Mention", "WhatAbout", "The robot has asked nothing that this would answer."
)


def take_option(s: Record, option: Record, *, types: DialogueTypes) -> Record:
    """The state in which the tutor's move is this option of the question."""
    answered = replace(s, {"shared.qud": s.shared.qud[1:], "shared.latest": option})
    return about(answered, option.content, types=types)


def _options(s: Record) -> Sequence[Record]:
    """The options of the question under discussion, if there is one."""
    options: Sequence[Record] = s.shared.qud[0].options if s.shared.qud else ()
    return options


def asks_which(s: Record) -> bool:
    """Whether the question under discussion is which thing was meant."""
    return bool(s.shared.qud) and s.shared.qud[0].ask in REFERENTS


def _fitting_options(
    s: Record, model: Model, *, types: DialogueTypes
) -> Sequence[Record]:
    """The options about a thing that the tutor's phrase is true of."""
    if not asks_which(s):
        return ()
    options = _options(s)
    _, things = differing_things(options)
    phrase = phrase_at(content_of(s), "target")
    meant = fits_well(s, PhraseJudge(s, model, types=types).fits(phrase, things))
    return [it for x, it in zip(things, options, strict=True) if x in meant]


def _ask_again(s: Record, model: Model, *, types: DialogueTypes) -> Record | None:
    """The plan to ask the same question again, if it was asked only once."""
    if not s.shared.qud or s.shared.qud[0].ask not in AGAIN:
        return None
    return plan_question(
        _drop_issue(s), model, _options(s), AGAIN[s.shared.qud[0].ask], types=types
    )


def _drop_issue(s: Record) -> Record:
    """The state without the question under discussion."""
    return replace(s, {"shared.qud": s.shared.qud[1:]})


CLARIFYING = first(
    take_rest,
    take_described,
    learn_all,
    take_only,
    reject_all,
    take_none,
    ask_fewer,
    ask_once_more,
    ask_yes_to_which,
    seq(drop_question, maybe(wonder_at_mention)),
    NAMED_ALSO,
    wonder_at_mention,
)
EXCLUDED = take_as_no
MENTIONED = wonder_at_mention
"""What answers a phrase that turns out to have been said, when it was hardly heard."""
