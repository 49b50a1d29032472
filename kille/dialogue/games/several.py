"""Several things at once: the tutor teaches what they all are, or asks where they are.

"These are cups." is said of all that is in view: a lesson about each thing there, but
for those that the robot knows to be something else. Where fewer than two are left it
is not plain which ones are meant, and the robot asks to be shown one at a time. "None
of these is a cup." is a lesson about each thing there, too.
"""

from __future__ import annotations

from collections.abc import Iterator

from kille.dialogue.beliefs import is_sure, knows, names_of
from kille.dialogue.commitments import kind_of, opposite_lesson_keys
from kille.dialogue.games.finding import plan_pointing
from kille.dialogue.games.surveying import in_view
from kille.dialogue.meanings import (
    DialogueTypes,
    claims,
    denial,
    is_denial,
    set_at,
    set_to,
)
from kille.dialogue.moves import content_of, plan, said_of
from kille.dialogue.reference import PhraseJudge, fits_well, phrase_at, thing_at
from kille.dialogue.rules import rule
from kille.dialogue.state import words
from ttr import Model, Record, RecordType, record, rectype, replace
from ttr.updates import first


@rule(answers="InstructSeveral")
def learn_several(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """The tutor says what the things in view are: it is a lesson about each of them."""
    sign = _noun(s)
    things = [
        x
        for x in _fitting_things(s, model, types=types)
        if not _is_other(s, model, x, sign)
    ]
    if len(things) < 2:
        return None
    teaches = [said_of(s, sign, x, types=types) for x in things]
    seen = [record(sit=record(x=x), sign=sign) for x in things]
    return plan(
        s,
        "LearnedSeveral",
        in_view(s, seen, (), (), types=types),
        signs=[sign],
        teaches=teaches,
        forgets=[
            key for it in teaches for key in opposite_lesson_keys(s, it, types=types)
        ],
        types=types,
    )


@rule(answers="RejectSeveral")
def reject_several(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor says what nothing in view is: it is a lesson about each thing."""
    if not s.view.things:
        return None
    sign = _noun(s)
    teaches = [denial(said_of(s, sign, x, types=types)) for x in s.view.things]
    forgets = [
        key for it in teaches for key in opposite_lesson_keys(s, it, types=types)
    ]
    return plan(
        s,
        "RejectedSeveral",
        sign.meaning,
        signs=[sign],
        teaches=teaches,
        forgets=forgets,
        types=types,
    )


@rule(answers=("InstructSeveral", "InstructSome", "RejectSeveral"))
def see_none(s: Record, *, types: DialogueTypes) -> Record | None:
    """Nothing is in view that could be meant."""
    return None if s.view.things else plan(s, "SeeNothing", types=types)


@rule(answers=("InstructSeveral", "InstructSome"))
def need_single(s: Record, *, types: DialogueTypes) -> Record:
    """It is not plain which things are meant: it asks to be shown one at a time."""
    return plan(s, "NeedSingle", types=types)


@rule(answers="AskPlaces")
def miss_several(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor asks where things are, by a word that was never learned."""
    for sign in s.shared.latest.signs:
        if not knows(words(s), sign):
            act = f"Unknown{sign.kind.capitalize()}"
            return plan(s, act, sign.meaning, signs=[sign], types=types)
    return None


@rule(answers="AskPlaces")
def tell_places(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """It points at each of these things, by their numbers, and says where it is."""
    asked = phrase_at(content_of(s), "counted")
    things = fits_well(s, PhraseJudge(s, model, types=types).fits(asked))
    if not things:
        return None
    act = "PointOut" if len(things) == 1 else "TellPlace"
    told = s
    for x in sorted(things, key=s.view.things.index):
        told = plan_pointing(
            told, model, act, _one_of(s, asked, x, types=types), x, types=types
        )
    return told if len(things) == 1 else replace(told, {"shared.pending": ()})


@rule(answers="AskPlaces")
def miss_them(s: Record, *, types: DialogueTypes) -> Record:
    """Nothing of the sort is in view."""
    content = content_of(s)
    asked = rectype(look=content["look"], target=phrase_at(content, "counted"))
    return plan(s, "SeeNoSuch", asked, signs=s.shared.latest.signs, types=types)


def _one_of(
    s: Record, phrase: RecordType, x: str, *, types: DialogueTypes
) -> RecordType:
    """What a question is about that asks for this one of the things of a phrase."""
    asked = set_at(
        set_at(types.record_type("Asked"), "look", s.view.look), "target.x", x
    )
    return set_to(
        asked, target=set_to(phrase, **dict(phrase_at(asked, "target").fields))
    )


def _noun(s: Record) -> Record:
    """The noun that the tutor says of the things."""
    noun: Record = next(it for it in s.shared.latest.signs if it.kind == "noun")
    return noun


def _fitting_things(s: Record, model: Model, *, types: DialogueTypes) -> list[str]:
    """The things in view of which the adjectives are true: "These are red cups."."""
    said = phrase_at(content_of(s), "counted")
    rest = rectype({label: T for label, T in said.fields if label != "c"})
    fits = fits_well(s, PhraseJudge(s, model, types=types).fits(rest))
    return [x for x in s.view.things if x in fits]


def _is_other(s: Record, model: Model, x: str, noun: Record) -> bool:
    """Whether a thing is known not to be what a noun says: it is something else."""
    if any(is_denial(it) == claims(it, noun) for it in _lessons_about(s, x)):
        return True
    beliefs = names_of(s, model, x)
    return is_sure(s, beliefs) and not knows([beliefs[0].sign], noun)


def _lessons_about(s: Record, x: str) -> Iterator[RecordType]:
    """What the tutor has said that a thing in view is, or is not."""
    for lesson in s.private.lessons:
        it = lesson.content
        is_here = kind_of(it) == "c" and it in s.shared.here
        if is_here and thing_at(it, "target") == x:
            yield it


SEVERAL = first(
    learn_several,
    reject_several,
    see_none,
    need_single,
    miss_several,
    tell_places,
    miss_them,
)
