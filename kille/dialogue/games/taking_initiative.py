"""Game 4: the robot does something of its own accord, when the floor is free.

It does one thing at a time, the one with the highest expected utility by its strategy,
if that is positive: silence costs nothing. It does nothing twice in a scene. When
something has just come into view, or is pointed at, the tutor speaks first. While the
tutor keeps the floor it does nothing.

Source: Dobnik and de Graaf 2017, section 3; Skočaj et al. 2011 for the modes.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

from kille.dialogue.beliefs import (
    beliefs_about,
    doubt,
    is_sure,
    knows,
    lead,
    names_of,
    thinks,
)
from kille.dialogue.meanings import DialogueTypes, claims, set_at, set_to
from kille.dialogue.moves import number_field, placement, plan, said_of
from kille.dialogue.reference import thing_at
from kille.dialogue.reference.salience import notice_in_view
from kille.dialogue.rules import rule
from kille.dialogue.strategies import Option, Stake, best
from ttr import Model, Record, record, replace
from ttr.updates import first


class Initiative(NamedTuple):
    """Something it might do: the option, what it asks about, and the plan."""

    option: Option
    question: Record
    planned: Record


@rule(when="FreeFloor", on="Seen")
def learn_alone(
    s: Record, seen: Record, *, model: Model, types: DialogueTypes
) -> Record | None:
    """It is so sure what a thing is that it learns this look of it by itself."""
    wants = s.private.strategy.wants.learning
    return _take_best(
        s, _lessons(s, model, Stake(wants.right, wants.wrong), types=types)
    )


@rule(when="State", on="Seen")
def stay(s: Record, seen: Record) -> Record | None:
    """All is as it was at the last look, and the tutor leaves the floor to it."""
    view = seen.view
    is_same = view.things == s.view.things and view.focus == s.view.focus
    return s if is_same and set(view.things) <= set(seen.kept) else None


@rule(when="FreeFloor", on="Seen")
def ask_relation(
    s: Record, seen: Record, *, model: Model, types: DialogueTypes
) -> Record | None:
    """Two things that it knows are in view, and it asks how they stand."""
    return _take_best(s, _relations(s, model, types=types))


@rule(when="FreeFloor", on="Seen")
def ask(
    s: Record, seen: Record, *, model: Model, types: DialogueTypes
) -> Record | None:
    """It asks for what it would like to know most."""
    return ask_most_wanted(s, model, types=types)


def ask_most_wanted(s: Record, model: Model, *, types: DialogueTypes) -> Record | None:
    """The state in which it asks what it would like to know most, if anything."""
    return _take_best(
        s,
        [
            *_relations(s, model, types=types),
            *_things(s, model, types=types),
            *_examples(s, types=types),
        ],
    )


def _take_best(s: Record, initiatives: Iterable[Initiative]) -> Record | None:
    """The state in which it does the best of these that it has not done yet."""
    new = [it for it in initiatives if it.question not in s.private.asked]
    option = best(it.option for it in new)
    if option is None:
        return None
    chosen = next(it for it in new if it.option == option)
    return replace(
        chosen.planned, {"private.asked": (*s.private.asked, chosen.question)}
    )


def _option_to_ask(s: Record, about: str, p: float) -> Option:
    """The option to ask about something, which is needed with this probability."""
    wants = s.private.strategy.wants
    return Option(about, p, Stake(wants[about] - wants.asking, -wants.asking))


def question(act: str, *about: str, things: tuple[str, ...] = ()) -> Record:
    """A question of the robot's own, by which it knows that it has asked it."""
    return record(act=act, about=about, things=things)


def _relations(
    s: Record, model: Model, *, types: DialogueTypes
) -> Iterator[Initiative]:
    """How two things stand that it knows, if it cannot say it."""
    known = _known_pair(s, model)
    if known is None or not _is_worth(s, "relation"):
        return
    target, landmark = known
    x, y = target.sit.x, landmark.sit.x
    stand = beliefs_about(s, model, s.private.relations, x, y)
    if is_sure(s, stand):
        return
    signs = [target.sign, landmark.sign]
    content = placement(s, x, target.sign, y, landmark.sign, types=types)
    yield Initiative(
        _option_to_ask(s, "relation", doubt(stand)),
        question("AskRelation", *sorted(it.form for it in signs)),
        plan(s, "AskRelation", content, signs=signs, types=types),
    )


def _known_pair(s: Record, model: Model) -> tuple[Record, Record] | None:
    """The two nearest things with a place that it recognises as different things."""
    found: list[Record] = []
    for x in s.view.placed:
        beliefs = names_of(s, model, x)
        if not is_sure(s, beliefs) or knows([b.sign for b in found], beliefs[0].sign):
            continue
        found.append(beliefs[0])
        if len(found) == 2:
            return found[0], found[1]
    return None


def _things(s: Record, model: Model, *, types: DialogueTypes) -> Iterator[Initiative]:
    """What a thing is that it does not know: the one in focus, and then the others."""
    if not _is_worth(s, "thing"):
        return
    for x in sorted(s.view.things, key=lambda it: it not in s.view.focus):
        beliefs = names_of(s, model, x)
        if thinks(s, beliefs) or is_told(s, x):
            continue
        content = set_at(
            set_at(types.record_type("Asked"), "look", s.view.look), "target.x", x
        )
        number = number_field(s, x, types=types) if len(s.view.things) > 1 else {}
        planned = plan(
            s, "AskThing", set_to(content, **number), points=[x], types=types
        )
        yield Initiative(
            _option_to_ask(s, "thing", doubt(beliefs)),
            question("AskThing", things=(x,)),
            turn_to(planned, x),
        )
        return


def turn_to(s: Record, x: str) -> Record:
    """The state in which the robot talks about a thing, and points at it."""
    salient = (x, *(it for it in s.shared.salient if it != x))
    changes = {
        "view.focus": (x,),
        "view.pointed": (x,),
        "shared.salient": salient,
        "shared.noticed": notice_in_view(s, [x], (), s.view.things),
    }
    return replace(s, changes)


def _examples(s: Record, *, types: DialogueTypes) -> Iterator[Initiative]:
    """Another example of a word that it has failed at."""
    if not _is_worth(s, "example"):
        return
    for sign in dict.fromkeys(s.private.failed):
        if not knows(s.private.nouns, sign):
            continue
        failed = sum(knows([it], sign) for it in s.private.failed)
        taught = sum(claims(it.content, sign) for it in s.private.lessons)
        yield Initiative(
            _option_to_ask(s, "example", failed / (taught + failed)),
            question("AskExample", sign.form, str(failed)),
            plan(s, "AskExample", sign.meaning, signs=[sign], types=types),
        )


def _lessons(
    s: Record, model: Model, stake: Stake, *, types: DialogueTypes
) -> Iterator[Initiative]:
    """What things are, which it is sure of and has not been told."""
    if stake.right <= 0.0:
        return
    for x in s.view.things:
        beliefs = names_of(s, model, x)
        if not is_sure(s, beliefs) or is_told(s, x):
            continue
        content, sign = said_of(s, beliefs[0].sign, x, types=types), beliefs[0].sign
        yield Initiative(
            Option(x, lead(beliefs), stake),
            question("LearnedAlone", things=(x,)),
            plan(
                s, "LearnedAlone", content, signs=[sign], teaches=[content], types=types
            ),
        )


def _is_worth(s: Record, about: str) -> bool:
    """Whether it could be worth to ask about this at all."""
    return bool(s.private.strategy.wants[about] > s.private.strategy.wants.asking)


def is_told(s: Record, x: str) -> bool:
    """Whether the tutor has said something of a thing since it came into view."""
    return any(thing_at(it, "target") == x for it in s.shared.here)


OWN_QUESTIONS = ("ask_relation", "ask_thing", "ask_example", "ask_new", "ask_new_name")
"""What it asks of its own accord, once each."""

STAYING = stay
TAKING_INITIATIVE = first(learn_alone, ask_relation)
IDLING = first(learn_alone, ask)
