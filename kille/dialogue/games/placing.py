"""Where is the book? The robot says how it stands to the other thing it knows best."""

from __future__ import annotations

from collections.abc import Mapping

from kille.dialogue.beliefs import (
    Beliefs,
    certainty,
    knows,
    names_of,
    relations_of,
    thinks,
)
from kille.dialogue.meanings import (
    DialogueTypes,
    mentions,
    merge_of,
    set_to,
    value_at,
)
from kille.dialogue.moves import content_of, nouns_said, placement, plan
from kille.dialogue.reference import PhraseJudge, phrase_at, thing_at
from kille.dialogue.reference.salience import choose
from kille.dialogue.rules import rule
from kille.dialogue.unknown_words import plan_first_unknown
from ttr import Model, Record, RecordType, record, rectype, replace
from ttr.types import PType, TypeNode
from ttr.updates import first

Update = tuple[Record, Model]

NAMELESS = "remaining"
"""The word of a phrase for what nobody has said a name of."""


@rule(answers="AskPlace")
def say_place(s: Record, *, model: Model, types: DialogueTypes) -> Update | None:
    """The tutor asks where a thing is: say how it stands to the best-known other.

    Where it has no word for that, it says how the other one stands to it, or else on
    which side it is.
    """
    x = thing_at(content_of(s), "target")
    if x is None or x not in s.view.placed:
        return None
    thing = asked_thing(s, model, x)
    if thing is None:
        return plan(s, "AdmitName", types=types), model
    landmark = landmark_for(s, model, thing)
    side = _side_field(s, model, x, types=types)
    if landmark is None:
        seen = set_to(thing.sign.meaning, **side)
        return plan(s, "NeedLandmark", seen, signs=[thing.sign], types=types), model
    relations, model = relations_of(s, model, x, landmark.sit.x)
    if not thinks(s, relations):
        converse, model = relations_of(s, model, landmark.sit.x, x)
        if thinks(s, converse):
            thing, landmark, relations = landmark, thing, converse
    believing = replace(s, {"private.beliefs": relations})
    told = _plan_place(believing, thing, landmark, relations, side, types=types)
    return told, model


@rule(answers="AskPlace")
def need_place(s: Record, *, types: DialogueTypes) -> Record:
    """The thing is in view, but not where it is."""
    return plan(s, "NeedDepth", types=types)


def asked_thing(s: Record, model: Model, x: str) -> Record | None:
    """The thing of which the tutor asks where it is, by the noun for it in the answer.

    That is the tutor's own noun, if they used one, or else the one that fits best.
    """
    target = phrase_at(content_of(s), "target")
    for noun in nouns_said(s.shared.latest, target):
        return record(sit=record(x=x), sign=noun)
    beliefs = names_of(s, model, x)
    return beliefs[0] if beliefs else None


def landmark_for(s: Record, model: Model, thing: Record) -> Record | None:
    """The other thing with a place that it knows best, as a belief worth saying.

    It is called something else: "The cup is to the left of the cup." would say nothing.
    """
    best: Record | None = None
    for y in s.view.placed:
        if y == thing.sit.x:
            continue
        beliefs = names_of(s, model, y)
        if not thinks(s, beliefs):
            continue
        if knows([thing.sign], beliefs[0].sign):
            continue
        if best is None or beliefs[0].p > best.p:
            best = beliefs[0]
    return best


def name_thing(
    s: Record, model: Model, phrase: RecordType, x: str
) -> tuple[RecordType, list[Record]]:
    """The phrase for a thing, with a noun if it has no words: "the biggest one".

    The noun is given as well; where the robot has none worth saying, none is added. Nor
    is one to what was asked for as having no name yet.
    """
    chosen = phrase.get("d")
    is_nameless = isinstance(chosen, PType) and chosen.pred.name == NAMELESS
    if is_nameless or any(label in phrase for label in ("c", "a", "rel")):
        return phrase, []
    names = names_of(s, model, x)
    if not thinks(s, names):
        return phrase, []
    noun = names[0].sign
    meaning = set_to(noun.meaning, look=phrase["look"], x=phrase["x"])
    return merge_of(phrase, meaning), [noun]


def _side_field(
    s: Record, model: Model, x: str, *, types: DialogueTypes
) -> dict[str, TypeNode]:
    """The field that says on which side of what is in view a thing is, if on any."""
    sides = _sides_of(s, model, x, types=types) if len(s.view.things) > 1 else {}
    on = next((side for side, is_there in sides.items() if is_there), None)
    return {} if on is None else {SIDE: types["Text"] @ on}


def _plan_place(
    s: Record,
    thing: Record,
    landmark: Record,
    relations: Beliefs,
    side: Mapping[str, TypeNode],
    *,
    types: DialogueTypes,
) -> Record:
    """The plan to say how the thing stands, as certain as the robot is of it.

    Where it has no word for that, it says on which side of the table the thing is.
    """

    def stands(*relation: Record) -> RecordType:
        return placement(
            s,
            thing.sit.x,
            thing.sign,
            landmark.sit.x,
            landmark.sign,
            *relation,
            types=types,
        )

    nouns = [thing.sign, landmark.sign]
    how = certainty(s, relations)
    if how == "Admit":
        placed = set_to(stands(), **side)
        return plan(s, "AdmitPlace", placed, signs=nouns, types=types)
    best = relations[0].sign
    content, signs = stands(best), [*nouns, best]
    if how != "Hedge":
        return plan(
            s, f"{how}Place", content, signs=signs, pending=[content], types=types
        )
    other = relations[1].sign
    rival, both = stands(other), [*signs, other]
    return plan(
        s,
        "HedgePlace",
        content,
        rival,
        signs=both,
        pending=[content, rival],
        types=types,
    )


@rule(answers="AskBetween")
def miss_between(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor asks what is between things by a word that was never learned."""
    amid = phrase_at(content_of(s), AMID)
    signs = (it for it in s.shared.latest.signs if mentions(amid, it))
    return plan_first_unknown(s, signs, types=types)


@rule(answers="AskBetween")
def tell_between(s: Record, *, model: Model, types: DialogueTypes) -> Record:
    """The tutor asks if a thing is between two others: it says if it sees that.

    That is no lesson, and is measured. In between it says that it does not know.
    """
    return plan_between(s, model, types=types)


def plan_between(s: Record, model: Model, *, types: DialogueTypes) -> Record:
    """The plan to say if a thing is between two others, as the latest move asks."""
    content, signs = content_of(s), s.shared.latest.signs
    x = str(thing_at(content, "target"))
    if x not in s.view.placed:
        return plan(s, "NeedDepth", types=types)
    p = _degree_between(s, model, phrase_at(content, AMID), x, types=types)
    if p is None:
        return plan(s, "SeeNoSuch", types=types)
    bands = s.private.strategy.bands
    act = "AdmitWhether"
    if p >= bands.sure or p <= bands.unlikely:
        act = "SayBetween" if p >= bands.sure else "DenyBetween"
    target, called = name_thing(s, model, phrase_at(content, "target"), x)
    told = set_to(content, target=target)
    return plan(s, act, told, signs=[*signs, *called], types=types)


def _degree_between(
    s: Record, model: Model, amid: RecordType, x: str, *, types: DialogueTypes
) -> float | None:
    """How probably x is between the things of a phrase; None if these are not seen."""
    others = [y for y in s.shared.salient if y != x]
    judge = PhraseJudge(replace(s, {"shared.salient": others}), model, types=types)
    flanks = rectype({label: T for label, T in amid.fields if label != "b"})
    seen = judge.fits(flanks, [x])
    if x not in seen or seen[x].weakest < s.private.strategy.bands.likely:
        return None
    found = judge.fits(amid, [x])
    if x not in found:
        return 0.0
    return judge.degree(types["between"], *found[x].things, s.view.look)


@rule(answers="AskSide")
def tell_side(s: Record, *, model: Model, types: DialogueTypes) -> Record:
    """The tutor asks if a thing is on the left, say: it tells if it sees it so.

    On the left is the first thing of the row, on the right the last, as the viewer sees
    them. Of a single thing it does not know.
    """
    content, signs = content_of(s), s.shared.latest.signs
    x = str(thing_at(content, "target"))
    if len(s.view.things) == 1:
        return plan(s, "AdmitWhether", types=types)
    target, called = name_thing(s, model, phrase_at(content, "target"), x)
    asked, told = value_at(content, SIDE), set_to(content, target=target)
    sides = _sides_of(s, model, x, types=types)
    other = next((side for side, is_there in sides.items() if is_there), None)
    act = "SaySide" if sides.get(asked) else "SayOtherSide" if other else "DenySide"
    if act == "SayOtherSide":
        told = set_to(told, side=types["Text"] @ other)
    return plan(s, act, told, signs=[*signs, *called], types=types)


def _sides_of(
    s: Record, model: Model, x: str, *, types: DialogueTypes
) -> dict[str, bool]:
    """Whether a thing is on each side, or in the middle of more than two."""
    return {
        side: x in choose(s, model, types[pred], s.view.things, types=types)
        for side, pred in _CHOOSES.items()
        if side != "at_middle" or len(s.view.things) > _PAIR
    }


AMID = "amid"
"""The label of the phrase that says between which things a thing is."""

SIDE = "side"
"""The label of the value that says on which side a thing is."""

_PAIR = 2
"""So many things in a row have none in the middle."""

_CHOOSES = {"at_left": "leftmost", "at_right": "rightmost", "at_middle": "middle"}
"""Which of the things in a row is on a side, by the name of that side."""

PLACING = first(say_place, need_place, tell_side)
BETWEEN = first(miss_between, tell_between)
"""What answers whether a thing is between two others."""
