"""Show me the cup. The robot points at it, and says which one it is and where."""

from __future__ import annotations

from kille.dialogue.beliefs import beliefs_about, is_sure
from kille.dialogue.games.placing import landmark_for, name_thing
from kille.dialogue.meanings import DialogueTypes, set_to
from kille.dialogue.moves import (
    content_of,
    nouns_said,
    number_field,
    placement,
    plan,
    said_of,
)
from kille.dialogue.reference import phrase_at, thing_at
from kille.dialogue.rules import rule
from ttr import Model, Record, RecordType, record, replace
from ttr.updates import first


@rule(answers="AskFind")
def point_out(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """The tutor asks which thing it is: it points there, and says where that is."""
    x = thing_at(content_of(s), "target")
    return (
        None
        if x is None
        else plan_pointing(s, model, "PointOut", content_of(s), x, types=types)
    )


def plan_pointing(
    s: Record,
    model: Model,
    act: str,
    asked: RecordType,
    x: str,
    *,
    types: DialogueTypes,
) -> Record:
    """The plan to point at the thing that is asked for, and to say where it is."""
    found, called = name_thing(s, model, phrase_at(asked, "target"), x)
    signs = (*s.shared.latest.signs, *called)
    nouns = nouns_said(record(signs=signs), found)[:1]
    content, beside = _where(s, model, asked, x, nouns, types=types)
    content = set_to(content, target=found, **number_field(s, x, types=types))
    signs = tuple(dict.fromkeys((*signs, *beside)))
    claims = [said_of(s, noun, x, types=types) for noun in nouns]
    planned = plan(
        s, act, content, signs=signs, pending=claims, points=[x], types=types
    )
    return replace(planned, {"view.focus": (x,), "view.pointed": (x,)})


def _where(
    s: Record,
    model: Model,
    content: RecordType,
    x: str,
    nouns: list[Record],
    *,
    types: DialogueTypes,
) -> tuple[RecordType, list[Record]]:
    """How it stands to the other thing it knows best, if it is sure of that."""
    is_placed = "landmark" in phrase_at(content, "target")
    if not nouns or is_placed or x not in s.view.placed:
        return content, []
    thing = record(sit=record(x=x), sign=nouns[0])
    landmark = landmark_for(s, model, thing)
    if landmark is None:
        return content, []
    y, at = landmark.sit.x, landmark.sign
    stands = beliefs_about(s, model, s.private.relations, x, y)
    if not is_sure(s, stands):
        return content, []
    where = stands[0].sign
    return placement(s, x, nouns[0], y, at, where, types=types), [at, where]


FINDING = first(point_out)
