"""Where several things are in view, the robot says which of them it has learned about.

"OK, the one on the left (#2) is a cup.": so a lesson that was taken of the wrong thing
is seen at once. Where there is one thing it says what the paper has.
"""

from __future__ import annotations

from kille.dialogue.meanings import DialogueTypes, predicate_at, set_to, value_at
from kille.dialogue.moves import number_field
from kille.dialogue.reference import across, thing_at
from kille.dialogue.rules import rule
from ttr import Model, Record, RecordType, RecType, replace
from ttr.types import TypeNode

LESSONS = (
    "learned",
    "learned_quality",
    "corrected",
    "corrected_quality",
    "rejected",
    "rejected_quality",
)
"""What the robot says when it has learned something of one thing."""

SIDES = {
    2: ("on_the_left", "on_the_right"),
    3: ("on_the_left", "in_the_middle", "on_the_right"),
}
"""How things are told apart by their places, for so many."""


@rule(when="State")
def say_which(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """It has learned something of one of several things: it says of which."""
    if len(s.view.things) < 2 or not s.private.agenda:
        return None
    told = [_say_which(s, model, it, types=types) for it in s.private.agenda]
    if all(it is was for it, was in zip(told, s.private.agenda, strict=True)):
        return None
    return replace(s, {"private.agenda": told})


def _say_which(
    s: Record, model: Model, planned: RecordType, *, types: DialogueTypes
) -> RecordType:
    """The planned move, which says of which thing it has learned, if it has."""
    if predicate_at(planned, "e").name not in LESSONS:
        return planned
    content = value_at(planned, "content")
    if not isinstance(content, RecordType):
        return planned
    fields = say_where(s, model, content, types=types)
    if not fields:
        return planned
    return set_to(planned, content=RecType @ set_to(content, **fields))


def say_where(
    s: Record, model: Model, content: RecordType, *, types: DialogueTypes
) -> dict[str, TypeNode]:
    """The fields that say which of several things a claim is about; none of one."""
    x = thing_at(content, "target")
    if len(s.view.things) < 2 or x is None or x not in s.view.things:
        return {}
    fields = number_field(s, x, types=types)
    sides = SIDES.get(len(s.view.things))
    if sides:
        place = sides[across(s, model, s.view.things, types=types).index(x)]
        fields["one"] = types["Text"] @ place
    return fields


DISTINGUISHING = say_which
