"""Which is bigger? The robot compares things by what it measures of them.

It needs no lesson for that, and takes none: what the tutor says of sizes and distances
it confirms, or says what it sees instead. A difference that is too small to be seen it
does not decide.
"""

from __future__ import annotations

from kille.dialogue.commitments import kind_of, plan_learning
from kille.dialogue.games.placing import AMID, SIDE, name_thing
from kille.dialogue.meanings import (
    DialogueTypes,
    claims,
    denial,
    set_at,
    set_to,
    value_at,
    word_of,
)
from kille.dialogue.moves import content_of, number_field, plan
from kille.dialogue.reference import PARTS, across, phrase_at, thing_at
from kille.dialogue.reference.comparing import COMPARATIVES, SCALE, exceeds, is_of_all
from kille.dialogue.rules import rule
from ttr import Model, Pred, Record, RecordType, rectype
from ttr.types import Singleton, TypeNode
from ttr.updates import first


@rule(answers=("AskWhether", "AskMore"))
def compare(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """The tutor compares two things: it says which one is more, if it can see that."""
    content = content_of(s)
    if SCALE not in content:
        return None
    sign = next(it for it in s.shared.latest.signs if claims(content, it))
    if not _is_measured(sign, types=types):
        return _learn_comparison(s, model, content, types=types)
    if word_of(sign) not in model.facts.functions:
        return plan(s, "UnknownRelation", sign.meaning, signs=[sign], types=types)
    content = _with_rival(s, model, content, word_of(sign))
    x, y = (str(thing_at(content, it)) for it in ("target", "landmark"))
    if not {x, y} <= {*s.view.placed}:
        return plan(s, "NeedDepth", types=types)
    asks_which = types.has(s.shared.latest, "AskMore", model)
    more, sure = word_of(sign), s.private.strategy.bands.sure
    called, signs = _with_names(s, model, content, types=types)
    if exceeds(s, model, more, x, y) >= sure:
        act = "TellMore" if asks_which else "SayYes"
        return _plan(s, act, called, signs, x, types=types)
    if more.name not in COMPARATIVES.values():
        return _plan(s, "SayNo", denial(called), signs, x, types=types)
    if exceeds(s, model, more, y, x) < sure:
        return plan(s, "CannotCompare", called, signs=signs, types=types)
    swapped = set_to(called, target=called["landmark"], landmark=called["target"])
    if asks_which:
        return _plan(s, "TellMore", swapped, signs, y, types=types)
    if all(_is_called(called, it) for it in ("target", "landmark")):
        rival = denial(called)
        return plan(s, "SayRather", swapped, rival, signs=signs, types=types)
    return _plan(s, "SayNo", denial(called), signs, x, types=types)


def _with_rival(s: Record, model: Model, content: RecordType, more: Pred) -> RecordType:
    """The content, where it speaks of all things about the one that may be the most.

    "The book is the biggest." is so if it is bigger than whichever else may be.
    """
    x = str(thing_at(content, "target"))
    others = [y for y in s.view.placed if y != x]
    if not is_of_all(content) or not others:
        return content

    def leads(y: str) -> float:
        return exceeds(s, model, more, y, x) - exceeds(s, model, more, x, y)

    return set_at(content, "landmark.x", max(others, key=leads))


@rule(answers="AskSize")
def tell_size(s: Record, *, model: Model, types: DialogueTypes) -> Record:
    """The tutor asks how big a thing is, or how far away: it says what it measures."""
    content, signs = content_of(s), s.shared.latest.signs
    x = str(thing_at(content, "target"))
    if x not in s.view.placed:
        return plan(s, "NeedDepth", types=types)
    phrase, called = name_thing(s, model, phrase_at(content, "target"), x)
    told = set_to(content, target=phrase)
    signs = (*signs, *called)
    return plan(s, "TellSize", told, signs=signs, measures=[x], types=types)


@rule(answers="AskDifference")
def tell_difference(s: Record, *, types: DialogueTypes) -> Record:
    """The tutor asks in what two things differ: it says what it measures of each."""
    content = content_of(s)
    things = [str(thing_at(content, it)) for it in PARTS]
    if not {*things} <= {*s.view.placed}:
        return plan(s, "NeedDepth", types=types)
    signs = s.shared.latest.signs
    return plan(s, "TellDifference", content, signs=signs, measures=things, types=types)


@rule(answers=("AskWhy", "Deny"))
def explain_measure(s: Record, *, types: DialogueTypes) -> Record | None:
    """What it has said of sizes and places it has measured, whatever the tutor says."""
    said = s.private.last[0] if len(s.private.last) == 1 else None
    if said is None or s.shared.pending or kind_of(content_of(s)) is not None:
        return None
    if not all(isinstance(said[it], Singleton) for it in ("content", "signs")):
        return None  # a rule of one's own has left open what it says
    told = value_at(said, "content")
    if not isinstance(told, RecordType) or not {SCALE, AMID, SIDE} & {*told.labels}:
        return None
    compared = ("target", "landmark") if SCALE in told else ()
    things = [x for it in compared if (x := thing_at(told, it)) in s.view.things]
    here = told.get("look") == types["Look"] @ s.view.look
    return plan(
        s,
        "ExplainMeasure",
        told,
        signs=value_at(said, "signs"),
        measures=things if here else (),
        types=types,
    )


def _plan(
    s: Record,
    act: str,
    content: RecordType,
    signs: tuple[Record, ...],
    x: str,
    *,
    types: DialogueTypes,
) -> Record:
    """The plan to say how two things compare, and to show which one is more."""
    if act != "TellMore":
        return plan(s, act, content, signs=signs, types=types)
    shown = set_to(content, **number_field(s, x, types=types))
    return plan(s, act, shown, signs=signs, points=[x], types=types)


def _is_measured(sign: Record, *, types: DialogueTypes) -> bool:
    """Whether the theory has the relation, as one that is seen by measuring."""
    return word_of(sign).name in types and types[word_of(sign).name] is word_of(sign)


def _learn_comparison(
    s: Record, model: Model, content: RecordType, *, types: DialogueTypes
) -> Record | None:
    """The plan to learn in what two things compare by a word that nothing measures.

    "The one is thicker than the other." is how they stand to one another, here.
    Where it is asked, it is answered as other relations are.
    """
    landmark = phrase_at(content, "landmark")
    if "d" in landmark or not types.has(s.shared.latest, "Asserted", model):
        return None
    if not {str(thing_at(content, it)) for it in PARTS} <= {*s.view.placed}:
        return plan(s, "NeedDepth", types=types)
    told = rectype({label: T for label, T in content.fields if label != SCALE})
    return plan_learning(s, told, types=types)


def _with_names(
    s: Record, model: Model, content: RecordType, *, types: DialogueTypes
) -> tuple[RecordType, tuple[Record, ...]]:
    """The content with nouns for things that the tutor has not described.

    The words in it are given as well, also those of the robot's own. Things that would
    be called by the same words are told apart by their places.
    """
    signs = s.shared.latest.signs
    for label in ("target", "landmark"):
        x = str(thing_at(content, label))
        phrase, called = name_thing(s, model, phrase_at(content, label), x)
        content, signs = set_to(content, **{label: phrase}), (*signs, *called)
    content = _tell_apart(s, model, content, types=types)
    return content, tuple(dict.fromkeys(signs))


def _tell_apart(
    s: Record, model: Model, content: RecordType, *, types: DialogueTypes
) -> RecordType:
    """The content, where things that are called the same are the left and the right."""
    target, landmark = (phrase_at(content, it) for it in PARTS)
    if _words_in(target) != _words_in(landmark):
        return content
    things = {str(thing_at(content, it)): it for it in PARTS}
    row = across(s, model, things, types=types)
    sides = (types.record_type(it)["d"] for it in ("Leftmost", "Rightmost"))
    placed = {
        things[x]: set_to(phrase_at(content, things[x]), d=side)
        for x, side in zip(row, sides, strict=True)
    }
    return set_to(content, **placed)


def _words_in(phrase: RecordType) -> dict[str, TypeNode]:
    """What a phrase says of its thing."""
    return {label: T for label, T in phrase.fields if label not in ("x", "look")}


def _is_called(content: RecordType, label: str) -> bool:
    """Whether a phrase has words for its thing."""
    return any(it in phrase_at(content, label) for it in ("c", "a", "rel"))


COMPARING = first(compare, tell_size, tell_difference)
MEASURING = explain_measure
"""What answers why it has compared things so, and that this is wrong."""
