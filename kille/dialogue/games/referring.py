"""What is talked about: noun phrases of the tutor's are set to things in view.

Only then do the games answer it. What fits several things is asked about, and what fits
nothing is said not to be there.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import partial

from kille.dialogue.beliefs import knows_word
from kille.dialogue.commitments import kind_of
from kille.dialogue.describing import Description, describe
from kille.dialogue.meanings import (
    DialogueTypes,
    mentions,
    set_to,
    word_of,
)
from kille.dialogue.moves import content_of, issue, nouns_said, plan
from kille.dialogue.reference import (
    PARTS,
    Reading,
    across,
    fitting_readings,
    in_view,
    intended_readings,
    meant_by,
    phrase_at,
    phrases,
    possible_readings,
    roles_in,
    thing_at,
)
from kille.dialogue.reference.comparing import is_of_all
from kille.dialogue.reference.demonstratives import THAT, THIS, distal, proximal
from kille.dialogue.reference.salience import (
    compares,
    is_talked_of,
    needs_salience,
    notice,
)
from kille.dialogue.rules import rule
from kille.dialogue.unknown_words import plan_unknown_word
from ttr import Model, Record, RecordType, rectype, replace
from ttr.safety.budgets import cache_in_question
from ttr.updates import first

OFFERED = 4
"""How many things are offered to choose from, at most."""


@rule(answers="Heard")
def refer(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """The tutor talks of things in view: the one way to take it that fits is meant."""
    match _readings(s, model, types=types):
        case [meant]:
            word, this = _demonstrative(meant, types=types)
            claims = kind_of(content_of(s)) is not None
            shown = this if claims and word == THIS else ()
            after = about(s, meant.content, shown=shown, types=types)
            if claims or not this:
                return after
            return _notice_asked(after, word, this, model, types=types)
    return None


@rule(answers=("AskFind", "AskName"))
def cannot_choose(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """The tutor asks which thing is the biggest, and that cannot be seen."""
    said = content_of(s).get("target")
    if not isinstance(said, RecordType) or not compares(said):
        return None
    several = len(_readings(s, model, types=types)) > 1
    return plan(s, "CannotCompare", types=types) if several else None


@rule(answers="Heard")
def ask_referent(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """What is said fits several things: it asks which of them is meant."""
    readings = _readings(s, model, types=types)
    label = _open_phrase(readings)
    if label is None:
        return None
    said = s.shared.latest
    meant = {it.things[label]: phrase_at(it.content, label) for it in readings[::-1]}
    options = [
        replace(said, content=set_to(said.content, **{label: meant[x]}))
        for x in across(s, model, meant, types=types)
    ]
    return plan_question(s, model, options, "AskReferent", types=types)


@rule(answers="Heard")
def trust_pointing(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """A lesson is about the one thing that is shown, whatever it is said to be like."""
    content = content_of(s)
    shown = s.view.pointed[:1] or s.view.things
    if len(shown) != 1 or "target" not in phrases(content) or "rel" in content:
        return None
    phrase = phrase_at(content, "target")
    said_of_it = set(phrase.labels) <= {"x", "look", "a"}
    if not said_of_it or not _teaches(s, model, types=types):
        return None
    if not any(
        it.kind == "adjective" and mentions(phrase, it) and not _judges(s, model, it)
        for it in s.shared.latest.signs
    ):
        return None
    plain = set_to(types.record_type("Phrase"), x=types["Ind"] @ shown[0])
    target = set_to(phrase_at(types.record_type("Asked"), "target"), x=plain["x"])
    return about(s, set_to(content, target=target), types=types)


@rule(answers="Heard")
def miss_word(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """The tutor talks of things by a word that was never learned."""
    said = s.shared.latest
    for label in phrases(said.content):
        for sign in said.signs:
            if mentions(said.content[label], sign) and not _judges(s, model, sign):
                return plan_unknown_word(s, sign, types=types)
    return None


@rule(answers="Heard")
def miss_second(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """The tutor talks of two things, and only one and the same is in view for both."""
    content = content_of(s)
    both = len(phrases(content)) > 1 and not any(
        _unfitting_phrases(s, model, content, types=types)
    )
    return plan(s, "SameThing", types=types) if both else None


@rule(answers="Heard")
def miss_thing(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """The tutor talks of something that is not in view."""
    content = content_of(s)
    if not phrases(content):
        return None
    missing, signs = (
        next(_unfitting_phrases(s, model, content, types=types), content),
        s.shared.latest.signs,
    )
    if not s.view.things and not any(mentions(missing, it) for it in signs):
        return plan(s, "SeeNothing", types=types)
    return plan(s, "SeeNoSuch", missing, signs=signs, types=types)


def about(
    s: Record,
    content: RecordType,
    *,
    shown: Sequence[str] | None = None,
    types: DialogueTypes,
) -> Record:
    """The state in which this is what the latest move is about, as it is seen now.

    The things it is about are the topic, and the ones that were talked about last.
    `shown` is what it calls "this", if that is another than before.
    """
    roles = roles_in(content)
    changes = {
        "shared.latest.content": in_view(s, content, types=types),
        "shared.salient": tuple(dict.fromkeys((*roles, *s.shared.salient))),
        "shared.topic": tuple(roles),
        "shared.noticed": notice(s.shared.noticed, roles, s.private.cost.turns),
    }
    if shown is not None and shown != s.shared.shown:
        changes["shared.shown"] = shown
    return replace(s, changes)


def plan_question(
    s: Record,
    model: Model,
    options: Sequence[Record],
    ask: str,
    *,
    types: DialogueTypes,
) -> Record:
    """The plan to ask which of these moves was meant, where they differ in one thing.

    Things that can be told apart in words are offered, if they are not too many. What
    was claimed before stays pending.
    """
    label, things = differing_things(options)
    said = options[0]
    phrase = phrase_at(said.content, label)
    nouns = nouns_said(said, phrase)
    told = _distinguish(s, model, things, nouns, types=types)
    signs = tuple(dict.fromkeys(sign for it in told for sign in it.signs))
    match [it.phrase for it in told]:
        case []:
            move = partial(
                plan,
                s,
                "AskReferent",
                _question_about(meant_by(nouns, types=types), types=types),
                signs=nouns,
            )
        case [one, other]:
            both = (
                _question_about(one, types=types),
                _question_about(other, types=types),
            )
            move = partial(plan, s, "OfferReferents", *both, signs=signs)
        case several:
            move = partial(
                plan, s, "OfferReferents", _among(several, types=types), signs=signs
            )
    return move(asks=[issue(ask, options)], pending=s.shared.pending, types=types)


def _distinguish(
    s: Record,
    model: Model,
    things: Sequence[str],
    nouns: Sequence[Record],
    *,
    types: DialogueTypes,
) -> list[Description]:
    """How to say which of these things is meant; nothing if that takes too much."""
    if len(things) > OFFERED:
        return []
    told = [
        describe(s, model, x, among=things, nouns=nouns, types=types) for x in things
    ]
    found = [it for it in told if it is not None]
    return found if len(found) == len(things) else []


def differing_things(options: Sequence[Record]) -> tuple[str, Sequence[str]]:
    """The first phrase that these moves set to different things, and the things."""
    for label in PARTS:
        things = dict.fromkeys(thing_at(it.content, label) for it in options)
        if len(things) > 1:
            return label, [x for x in things if x is not None]
    return "", ()


@cache_in_question
def _readings(s: Record, model: Model, *, types: DialogueTypes) -> Sequence[Reading]:
    """The ways to take the phrases of the latest move that are meant."""
    content = content_of(s)
    if not phrases(content):
        return ()
    readings = intended_readings(
        s, possible_readings(s, model, content, types=types), types=types
    )
    if is_of_all(content):
        readings = [*{it.things["target"]: it for it in readings[::-1]}.values()][::-1]
    if len(readings) < 2 or _teaches(s, model, types=types):
        return readings
    return _by_distance(s, readings, types=types)


def _by_distance(
    s: Record, readings: Sequence[Reading], *, types: DialogueTypes
) -> Sequence[Reading]:
    """The readings of a question in which "this" is near, and "that" is not.

    Where a question does not say more than that, it is about the focus, or about what
    is farther away. So it is with "it", unless several things were talked about.
    """
    left = readings
    for label in PARTS:
        if label in left[0].things and _is_shown(left[0], label):
            things = [it.things[label] for it in left]
            near = _nearer(s, phrase_at(left[0].open, label), things, types=types)
            left = [it for it in left if it.things[label] in near] or left
    return left


def _nearer(
    s: Record, phrase: RecordType, things: Sequence[str], *, types: DialogueTypes
) -> Sequence[str]:
    """Those of the things that are as near as a phrase without a noun says."""
    if phrase.get("d") == types.record_type("That")["d"]:
        return distal(s, things)
    if needs_salience(phrase, types) and is_talked_of(s, things):
        return things
    return proximal(s, things)


def _is_shown(reading: Reading, label: str) -> bool:
    """Whether a phrase of a reading says of its thing only that it is shown."""
    phrase = phrase_at(reading.open, label)
    return set(phrase.labels) <= {"x", "look", "d"} and not compares(phrase)


def _teaches(s: Record, model: Model, *, types: DialogueTypes) -> bool:
    """Whether the latest move is a lesson, or says what is not so."""
    latest = s.shared.latest
    return any(types.has(latest, it, model) for it in ("Teaching", "Reject"))


def _demonstrative(
    meant: Reading, *, types: DialogueTypes
) -> tuple[str, Sequence[str]]:
    """The word by which a move points to what it is about, "this" or "that"; and it."""
    if "target" in meant.things:
        said = phrase_at(meant.open, "target").get("d")
        for word, name in ((THIS, "This"), (THAT, "That")):
            if said == types.record_type(name)["d"]:
                return word, (meant.things["target"],)
    return "", ()


def _notice_asked(
    s: Record, word: str, things: Sequence[str], model: Model, *, types: DialogueTypes
) -> Record:
    """The state in which it is noticed if the tutor has asked what "this" (that) is."""
    if not types.has(s.shared.latest, "AskName", model):
        return s
    asked = dict.fromkeys(things, word)
    noticed = notice(s.shared.noticed, asked, s.private.cost.turns)
    return replace(s, {"shared.noticed": noticed})


def _question_about(phrase: RecordType, *, types: DialogueTypes) -> RecordType:
    """What a question is about that asks for the thing of a phrase."""
    return rectype(look=types["Look"], target=phrase)


def _among(phrases: Iterable[RecordType], *, types: DialogueTypes) -> RecordType:
    """What a question is about that asks for one of the things of several phrases."""
    choices = {f"choice{n:02}": it for n, it in enumerate(phrases, start=1)}
    return set_to(types.record_type("Scene"), **choices)


def _open_phrase(readings: Sequence[Reading]) -> str | None:
    """The first phrase that is set to different things in these readings."""
    things = {label: {it.things.get(label) for it in readings} for label in PARTS}
    return next((label for label in PARTS if len(things[label]) > 1), None)


def _judges(s: Record, model: Model, sign: Record) -> bool:
    """Whether the robot knows a word, or can judge it without having learned it."""
    return knows_word(s, sign) or word_of(sign) in model.facts.functions


def _unfitting_phrases(
    s: Record, model: Model, content: RecordType, *, types: DialogueTypes
) -> Iterator[RecordType]:
    """What is asked for by the phrases that fit nothing in view by themselves."""
    for label in phrases(content):
        look = content.get("look") or types["Look"]
        alone = rectype(look=look, target=content[label])
        if not fitting_readings(s, possible_readings(s, model, alone, types=types)):
            yield alone


CHOOSING = first(cannot_choose)
"""What answers which thing is the biggest, where that cannot be seen."""

REFERRING = first(refer, ask_referent, trust_pointing)
"""What settles of which things something is said, or asks."""

MISSING = first(miss_word, miss_second, miss_thing)
"""What says that nothing is in view of which it could be said."""
