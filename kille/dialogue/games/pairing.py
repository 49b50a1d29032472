"""You mixed them up: two things have one another's names, or the same one.

The tutor says so of two things that the robot has just named, or that are in view. It
says what that means, and learns it from a yes: of each that it is the other, and not
what it was called. It objects where an axiom of kinds is against that. Asked if they
are the same, it says what it takes each for.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from kille.dialogue.answered_questions import NAMING_ACTS, last_act
from kille.dialogue.beliefs import knows, names_of, thinks
from kille.dialogue.commitments import (
    effects_of_rejection,
    kind_of,
    opposite_lesson_keys,
    signs_for,
)
from kille.dialogue.games.distinguishing import say_where
from kille.dialogue.games.kinds_of_kinds import plan_objection
from kille.dialogue.meanings import DialogueTypes, denial, is_denial, set_to
from kille.dialogue.moves import content_of, hear_as, issue, plan, said_of
from kille.dialogue.reference import thing_at
from kille.dialogue.rules import rule
from kille.dialogue.taxonomy import are_related
from ttr import Model, Record, replace
from ttr.updates import first

SWAPPED = "AskSwapped"
"""The question whether two things are to have one another's names.

Its options have what is so then, and what was said before.
"""


class NamedThing(NamedTuple):
    """A thing in view, and the noun that it is called by."""

    x: str
    sign: Record


@rule(answers="Swap")
def ask_swapped(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """The tutor says that it has mixed two things up: it says what that means."""
    two = _named_pair(s, model)
    if two is None or are_related(s, two[0].sign, two[1].sign):
        return None
    one, other = two
    right = [
        said_of(s, sign, x, types=types)
        for x, sign in ((one.x, other.sign), (other.x, one.sign))
    ]
    shown = [set_to(it, **say_where(s, model, it, types=types)) for it in right]
    wrong = [said_of(s, it.sign, it.x, types=types) for it in two]
    signs = [it.sign for it in two]
    options = [
        replace(s.shared.latest, content=it, signs=signs) for it in (*right, *wrong)
    ]
    for claim in (*right, *map(denial, wrong)):
        said = replace(s.shared.latest, content=claim, signs=signs)
        objection = plan_objection(replace(s, {"shared.latest": said}), types=types)
        if objection is not None:
            return objection
    asks = [issue(SWAPPED, options)]
    asked = plan(s, "AskMeant", shown[0], signs=signs, asks=asks, types=types)
    return plan(asked, "AskMeantToo", shown[1], signs=signs, types=types)


@rule(answers="Swap")
def wonder_what_is_swapped(s: Record, *, types: DialogueTypes) -> Record:
    """It has not called two things by two names."""
    return plan(s, "Wonder", types=types)


@rule(answers="Reversed")
def take_as_swap(
    s: Record, *, model: Model, types: DialogueTypes
) -> tuple[Record, Model] | None:
    """It is the other way round, after it has named both things: they are mixed up."""
    if s.shared.qud or last_act(s) not in NAMING_ACTS or len(s.view.things) != _PAIR:
        return None
    if _named_pair(s, model) is None:
        return None
    swapped, model = hear_as(s, model, "Swap", types=types)
    return replace(s, {"shared.latest": swapped, "shared.pending": ()}), model


_PAIR = 2
"""So many things may have been called by one another's names."""


@rule(answers="Affirm")
def learn_swapped(s: Record, *, types: DialogueTypes) -> Record | None:
    """They were mixed up: each is the other, and not what it was called."""
    if not _asks(s):
        return None
    asked, *rest = s.shared.qud
    contents = [it.content for it in asked.options]
    learned = replace(s, {"shared.qud": rest})
    for right, wrong in zip(contents[:2], contents[2:], strict=True):
        weaker, forgets = effects_of_rejection(s, [wrong], types=types)
        teaches = [*weaker, right]
        learned = plan(
            learned,
            "Corrected",
            right,
            wrong,
            signs=signs_for(s, *teaches, wrong),
            teaches=teaches,
            forgets=[*forgets, *opposite_lesson_keys(s, right, types=types)],
            types=types,
        )
    return learned


@rule(answers=("Deny", "ForgetThat", "ForgetLast"))
def leave_swapped(s: Record, *, types: DialogueTypes) -> Record | None:
    """They were not mixed up: nothing is learned."""
    if not _asks(s) or kind_of(content_of(s)) is not None:
        return None
    return plan(replace(s, {"shared.qud": s.shared.qud[1:]}), "LetBe", types=types)


@rule(answers="AskSame")
def tell_same(s: Record, *, model: Model, types: DialogueTypes) -> Record:
    """The tutor asks if two things are of one kind: it says what it takes them for."""
    if not s.view.things:
        return plan(s, "SeeNothing", types=types)
    two = _named_pair(s, model)
    if two is None:
        return plan(s, "AdmitWhether", types=types)
    one, other = two
    if knows([one.sign], other.sign):
        return plan(s, "SaySame", one.sign.meaning, signs=[one.sign], types=types)
    content, rival = (said_of(s, it.sign, it.x, types=types) for it in two)
    signs = [one.sign, other.sign]
    return plan(s, "SayDifferent", content, rival, signs=signs, types=types)


def _asks(s: Record) -> bool:
    """Whether the question under discussion is if two things were mixed up."""
    return bool(s.shared.qud) and s.shared.qud[0].ask == SWAPPED


def _named_pair(s: Record, model: Model) -> tuple[NamedThing, NamedThing] | None:
    """The two things in view, or talked about last, by what the robot calls them."""
    found = [_named_thing(s, model, x) for x in _pair(s)]
    match [it for it in found if it is not None]:
        case [one, other]:
            return one, other
    return None


def _pair(s: Record) -> Sequence[str]:
    """The two things in view, or of more those that were talked about last."""
    things = s.view.things
    if len(things) > 2:
        things = [x for x in s.shared.salient if x in things][:2]
    return sorted(things, key=s.view.things.index) if len(things) == 2 else ()


def _named_thing(s: Record, model: Model, x: str) -> NamedThing | None:
    """A thing by the name that it was given, or that the robot thinks it has."""
    for it in s.private.lessons[::-1]:
        content = it.content
        is_name = it.sign.kind == "noun" and content in s.shared.here
        if is_name and not is_denial(content) and thing_at(content, "target") == x:
            return NamedThing(x, it.sign)
    beliefs = names_of(s, model, x)
    return NamedThing(x, beliefs[0].sign) if thinks(s, beliefs) else None


PAIRING = first(ask_swapped, wonder_what_is_swapped, tell_same)
PAIR_ANSWERED = first(learn_swapped, leave_swapped, take_as_swap)
"""What answers whether two things were mixed up, and says that they were."""
