"""Several things at once: the tutor teaches what they all are, or asks where they are.

"These are cups." is said of all that is in view: a lesson about each thing there, but
for those that the robot knows to be something else. Where fewer than two are left it
is not plain which ones are meant, and the robot asks to be shown one at a time; so it
does where "both" is said of more than two. "None of these is a cup." is a lesson about
each thing there, too.

"All but the left one are cups." is a lesson about each of the others. So is "The cups
are red." about each cup, and "The cup and the bowl are red." about these two.

"Everything here is a cup." is a lesson about each thing, and "Only this is a cup." one
about this, and one about each other thing, that it is not. Where something else was
said of such a thing before, the robot asks first.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from kille.dialogue.beliefs import is_sure, knows, names_of
from kille.dialogue.commitments import kind_of, opposite_lesson_keys, plan_learning
from kille.dialogue.games.finding import plan_pointing
from kille.dialogue.games.surveying import in_view
from kille.dialogue.meanings import (
    DialogueTypes,
    claims,
    denial,
    is_denial,
    mentions,
    set_at,
    set_to,
    value_at,
)
from kille.dialogue.moves import content_of, hear_as, issue, number_field, plan, said_of
from kille.dialogue.reference import PARTS, PhraseJudge, fits_well, phrase_at, thing_at
from kille.dialogue.rules import rule
from kille.dialogue.unknown_words import plan_first_unknown
from ttr import Model, Record, RecordType, record, rectype, replace
from ttr.updates import first

EVERY, ONLY = "AskEvery", "AskOnly"
"""The questions whether it is so of a thing of which something else was said."""

EXACTLY = "exactly"
"""The label of how many things there have to be: "both are cups"."""

AMONG = "among"
"""The label of the phrase for the things that are meant: "the cups are red"."""

OTHER_THAN = "other than"
"""The stance of who asks which things something is not true of."""

NUMBERS = {"two": 2, "three": 3, "four": 4, "five": 5}
"""How many that is."""


@rule(answers="InstructSeveral")
def ask_each(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """It is plain which things are meant, and one is known to be something else."""
    noun, things = _claimed_word(s), _things_meant(s)
    if not _are_plainly_meant(s, things):
        return None
    other = next((x for x in things if _is_other(s, model, x, noun)), None)
    if other is None:
        return None
    return _plan_question(s, EVERY, noun, other, types=types)


def _are_plainly_meant(s: Record, things: Sequence[str]) -> bool:
    """Whether the tutor has said which things are meant, or how many: "all three"."""
    content = content_of(s)
    if EXACTLY in content:
        return len(things) == NUMBERS[str(value_at(content, EXACTLY))]
    return "landmark" in content


@rule(answers="InstructSeveral")
def need_as_many(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """Of both, or all three, is spoken where more or fewer things may be meant."""
    if EXACTLY not in content_of(s):
        return None
    number = NUMBERS[str(value_at(content_of(s), EXACTLY))]
    things = without_others(
        s, model, _fitting_things(s, model, types=types), _claimed_word(s)
    )
    return None if len(things) == number else plan(s, "NeedSingle", types=types)


@rule(answers="InstructSeveral")
def learn_several(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """The tutor says what the things in view are: it is a lesson about each of them."""
    sign = _claimed_word(s)
    things = without_others(s, model, _fitting_things(s, model, types=types), sign)
    if things and (AMONG in content_of(s) or "landmark" in content_of(s)):
        return _plan_each(s, things, sign, types=types)
    return None if len(things) < 2 else plan_several(s, things, sign, types=types)


@rule(answers="InstructSeveral")
def miss_any(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """Nothing in view is what the tutor calls the things, or the word is new."""
    if AMONG not in content_of(s):
        return None
    among = phrase_at(content_of(s), AMONG)
    signs = [it for it in s.shared.latest.signs if mentions(among, it)]
    unknown = plan_first_unknown(s, signs, types=types)
    if unknown is not None:
        return unknown
    asked = rectype(look=types["Look"] @ s.view.look, target=among)
    return plan(s, "SeeNoSuch", asked, signs=signs, types=types)


def _plan_each(
    s: Record, things: Sequence[str], sign: Record, *, types: DialogueTypes
) -> Record:
    """The plan to learn of each of these things that it is so, and to say of which."""
    for x in sorted(things, key=s.view.things.index):
        s = plan_learning(s, _said_of(s, sign, x, types=types), types=types)
    return s


def without_others(
    s: Record, model: Model, things: Sequence[str], noun: Record
) -> list[str]:
    """Those of some things that are not known to be something else."""
    return [x for x in things if not _is_other(s, model, x, noun)]


def plan_several(
    s: Record, things: Sequence[str], sign: Record, *, types: DialogueTypes
) -> Record:
    """The plan to learn that each of these things is so."""
    teaches = [_said_of(s, sign, x, types=types) for x in things]
    seen = [record(sit=record(x=x), sign=sign) for x in things]
    is_noun = sign.kind == "noun"
    return plan(
        s,
        "LearnedSeveral",
        in_view(s, seen, (), (), types=types) if is_noun else sign.meaning,
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
    sign = _claimed_word(s)
    teaches = [denial(_said_of(s, sign, x, types=types)) for x in s.view.things]
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


# --- every and only -------------------------------------------------------------------


@rule(answers="InstructEvery")
def ask_every(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """Everything is said to be so, and something here is known to be something else."""
    noun = _claimed_word(s)
    things = _things_meant(s)
    other = next((x for x in things if _is_other(s, model, x, noun)), None)
    if other is None:
        return None
    return _plan_question(s, EVERY, noun, other, types=types)


@rule(answers="InstructEvery")
def learn_every(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor says what everything here is: it is a lesson about each thing."""
    things = _things_meant(s)
    if not things:
        return None
    return plan_several(s, things, _claimed_word(s), types=types)


@rule(answers="InstructOnly")
def ask_only(s: Record, *, types: DialogueTypes) -> Record | None:
    """Only this is said to be so, and another thing here was said to be so, too."""
    noun, this = _claimed_word(s), thing_at(content_of(s), "target")
    for x in s.view.things:
        if x != this and any(claims(it, noun) for it in _names_told(s, x)):
            return _plan_question(s, ONLY, noun, x, types=types)
    return None


@rule(answers="InstructOnly")
def learn_only(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor says that only this is so: a lesson about it, and one about each other
    thing here, that it is not."""
    if not s.view.things:
        return None
    return _plan_only(s, types=types)


@rule(answers="Affirm")
def learn_anyway(s: Record, *, types: DialogueTypes) -> Record | None:
    """It is so in spite of what was said before."""
    said = _said_in_question(s)
    if said is None:
        return None
    if s.shared.qud[0].ask == ONLY:
        return _plan_only(said, types=types)
    return plan_several(said, _things_meant(said), _claimed_word(said), types=types)


@rule(answers="Deny")
def learn_others(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """Not everything is so: of the other things here it is learned that they are."""
    said = _said_in_question(s)
    if said is None or s.shared.qud[0].ask != EVERY:
        return None
    noun = _claimed_word(said)
    things = without_others(said, model, _things_meant(said), noun)
    return plan_several(said, things, noun, types=types) if things else None


@rule(answers=("Deny", "ForgetThat", "ForgetLast"))
def leave_several(s: Record, *, types: DialogueTypes) -> Record | None:
    """What was said before stays, and nothing is learned."""
    said = _said_in_question(s)
    if said is None or kind_of(content_of(s)) is not None:
        return None
    return plan(said, "LetBe", types=types)


def _plan_question(
    s: Record, ask: str, noun: Record, x: str, *, types: DialogueTypes
) -> Record:
    """The plan to ask if it is so of a thing of which something else was said."""
    content = _said_of(s, noun, x, types=types)
    content = set_to(content, **number_field(s, x, types=types))
    asked = issue(ask, [s.shared.latest])
    return plan(s, ask, content, signs=[noun], asks=[asked], types=types)


def _said_in_question(s: Record) -> Record | None:
    """The state before the robot asked if it is so, if that is its question."""
    if not s.shared.qud or s.shared.qud[0].ask not in (EVERY, ONLY):
        return None
    asked, *rest = s.shared.qud
    return replace(s, {"shared.qud": rest, "shared.latest": asked.options[0]})


def _plan_only(s: Record, *, types: DialogueTypes) -> Record:
    """The plan to learn that one thing is so, and all others are not."""
    noun, this = _claimed_word(s), thing_at(content_of(s), "target") or ""
    own = _said_of(s, noun, this, types=types)
    others = (_said_of(s, noun, x, types=types) for x in s.view.things if x != this)
    teaches = [own, *map(denial, others)]
    forgets = [
        key for it in teaches for key in opposite_lesson_keys(s, it, types=types)
    ]
    content = set_to(own, **number_field(s, this, types=types))
    return plan(
        s,
        "LearnedOnly",
        content,
        signs=[noun],
        teaches=teaches,
        forgets=forgets,
        types=types,
    )


def _names_told(s: Record, x: str) -> list[RecordType]:
    """What the tutor has said that a thing in view is."""
    return [it for it in _lessons_about(s, x) if not is_denial(it)]


@rule(
    answers=(
        "InstructSeveral",
        "InstructSome",
        "InstructEvery",
        "InstructOnly",
        "RejectSeveral",
    )
)
def see_none(s: Record, *, types: DialogueTypes) -> Record | None:
    """Nothing is in view that could be meant."""
    return None if s.view.things else plan(s, "SeeNothing", types=types)


@rule(answers=("InstructSeveral", "InstructSome"))
def need_single(s: Record, *, types: DialogueTypes) -> Record:
    """It is not plain which things are meant: it asks to be shown one at a time."""
    return plan(s, "NeedSingle", types=types)


@rule(answers="InstructSeveral")
def ask_single(
    s: Record, *, model: Model, types: DialogueTypes
) -> tuple[Record, Model] | None:
    """One thing is called by a noun without a singular: "These are scissors."."""
    sign = _claimed_word(s)
    if len(s.view.things) != 1 or " " not in sign.article:
        return None
    content = _said_of(s, sign, s.view.things[0], types=types)
    move, model = hear_as(s, model, "Instruct", content, [sign], types=types)
    asks = [issue("AskMeant", [move])]
    return plan(s, "AskMeant", content, signs=[sign], asks=asks, types=types), model


@rule(answers="AskPlaces")
def miss_several(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor asks where things are, by a word that was never learned."""
    return plan_first_unknown(s, s.shared.latest.signs, types=types)


@rule(answers="AskPlaces")
def tell_places(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """It points at each of these things, by their numbers, and says where it is."""
    asked = phrase_at(content_of(s), "counted")
    things = fits_well(s, PhraseJudge(s, model, types=types).fits(asked))
    if "stance" in s.shared.latest and s.shared.latest.stance == OTHER_THAN:
        others = [x for x in s.view.things if x not in things]
        return _plan_others(s, model, others, types=types)
    if not things:
        return None
    act = "PointOut" if len(things) == 1 else "TellPlace"
    told = s
    for x in sorted(things, key=s.view.things.index):
        told = plan_pointing(
            told, model, act, _one_of(s, asked, x, types=types), x, types=types
        )
    return told if len(things) == 1 else replace(told, {"shared.pending": ()})


def _plan_others(
    s: Record, model: Model, things: Sequence[str], *, types: DialogueTypes
) -> Record | None:
    """The plan to point at each of the things that something is not true of."""
    plain = types.record_type("Phrase")
    told = s
    for x in things:
        asked = _one_of(s, plain, x, types=types)
        told = plan_pointing(told, model, "TellPlace", asked, x, types=types)
    return replace(told, {"shared.pending": ()}) if things else None


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


def _said_of(s: Record, sign: Record, x: str, *, types: DialogueTypes) -> RecordType:
    """That a thing is what a noun says, or as another word says how it is."""
    template = "Naming" if sign.kind == "noun" else "Having"
    return said_of(s, sign, x, template, types=types)


def _claimed_word(s: Record) -> Record:
    """The word that the tutor says of the things: a noun, or else how they are."""
    signs, content = s.shared.latest.signs, content_of(s)
    if AMONG in content or "landmark" in content:
        signs = [it for it in signs if mentions(phrase_at(content, "counted"), it)]
    word: Record = next((it for it in signs if it.kind == "noun"), signs[0])
    return word


def _fitting_things(s: Record, model: Model, *, types: DialogueTypes) -> list[str]:
    """The things in view of which the adjectives are true: "These are red cups."."""
    things = _things_meant(s)
    if AMONG in content_of(s):
        among = phrase_at(content_of(s), AMONG)
        things = fits_well(s, PhraseJudge(s, model, types=types).fits(among))
    if _claimed_word(s).kind != "noun":
        return things
    said = phrase_at(content_of(s), "counted")
    rest = rectype({label: T for label, T in said.fields if label != "c"})
    fits = fits_well(s, PhraseJudge(s, model, types=types).fits(rest))
    return [x for x in things if x in fits]


def _things_meant(s: Record) -> list[str]:
    """The two things that are named, or those in view but for an exception."""
    excepted, other = (thing_at(content_of(s), it) for it in PARTS)
    if excepted is not None and other is not None:
        return [excepted, other]
    return [x for x in s.view.things if x != excepted]


def _is_other(s: Record, model: Model, x: str, noun: Record) -> bool:
    """Whether a thing is known not to be what a noun says: it is something else.

    Of how it is, the tutor now says what counts.
    """
    if noun.kind != "noun":
        return False
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


THINGS_ANSWERED = first(learn_anyway, learn_others, leave_several)
"""What answers whether it is so of something of which something else was said."""

SEVERAL_THINGS = first(
    ask_each,
    need_as_many,
    learn_several,
    miss_any,
    reject_several,
    ask_every,
    learn_every,
    ask_only,
    learn_only,
    see_none,
    ask_single,
    need_single,
    miss_several,
    tell_places,
    miss_them,
)
