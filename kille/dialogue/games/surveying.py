"""What do you see? The robot lists what is in view, by how certain it is of it."""

from __future__ import annotations

from collections.abc import Iterable

from kille.dialogue.beliefs import Beliefs, is_sure, names_of, thinks
from kille.dialogue.meanings import DialogueTypes, set_at, set_to, value_at
from kille.dialogue.moves import content_of, plan
from kille.dialogue.reference import across, thing_at
from kille.dialogue.rules import rule
from ttr import Model, Record, RecordType, rectype
from ttr.updates import first

SURE, LIKELY, UNKNOWN = "thing", "maybe", "unknown"
"""How the parts of what is seen are labelled, with a number after it."""

ORDER, FROM_LEFT = "order", "from the left"
"""The label for where a list in a row begins, and what it says of the left."""


@rule(answers=("AskView", "AskGuess"))
def see_nothing(s: Record, *, types: DialogueTypes) -> Record | None:
    """Nothing is in view."""
    return None if s.view.things else plan(s, "SeeNothing", types=types)


@rule(answers="AskView")
def list_view(s: Record, *, model: Model, types: DialogueTypes) -> Record:
    """It says what it is sure of, what it thinks, and how much it does not know."""
    beliefs = {x: names_of(s, model, x) for x in s.view.things}
    sure = [it[0] for it in beliefs.values() if is_sure(s, it)]
    likely = [it[0] for it in beliefs.values() if thinks(s, it) and not is_sure(s, it)]
    unknown = [x for x, it in beliefs.items() if not thinks(s, it)]
    content = in_view(s, _rank(sure), _rank(likely), unknown, types=types)
    if ORDER in content_of(s):
        content = _in_order(s, model, content, types=types)
    signs = tuple(dict.fromkeys(it.sign for it in _rank([*sure, *likely])))
    return plan(s, "ListView", content, signs=signs, types=types)


def _in_order(
    s: Record, model: Model, content: RecordType, *, types: DialogueTypes
) -> RecordType:
    """The type of the situation in view, with its parts as they stand in a row."""
    order = value_at(content_of(s), ORDER)
    row = [*across(s, model, s.view.things, types=types)]
    row = row if order == FROM_LEFT else row[::-1]
    parts = {label: T for label, T in content.fields if thing_at(content, label)}
    rest = {label: T for label, T in content.fields if label not in parts}
    places = {label: row.index(str(thing_at(content, label))) for label in parts}
    in_row = {
        f"{label.rstrip('0123456789')}{places[label]:02}": T
        for label, T in parts.items()
    }
    return rectype({**rest, **in_row, ORDER: types["Text"] @ order})


def in_view(
    s: Record,
    sure: Iterable[Record],
    likely: Iterable[Record],
    unknown: Iterable[str],
    *,
    types: DialogueTypes,
) -> RecordType:
    """The type of the situation in view: a part for each thing, and what it is.

    The labels of the parts say how certain it is: thing01, maybe01, unknown01.
    """
    parts = {
        **_label_parts(
            SURE, [set_at(it.sign.meaning, "x", it.sit.x) for it in sure], types=types
        ),
        **_label_parts(
            LIKELY,
            [set_at(it.sign.meaning, "x", it.sit.x) for it in likely],
            types=types,
        ),
        **_label_parts(
            UNKNOWN,
            [set_at(types.record_type("Phrase"), "x", x) for x in unknown],
            types=types,
        ),
    }
    look = set_at(types.record_type("Scene"), "look", s.view.look)
    return set_to(look, **parts)


def _label_parts(
    label: str, parts: Iterable[RecordType], *, types: DialogueTypes
) -> dict[str, RecordType]:
    inner = types.record_type("Asked")["target"]
    assert isinstance(inner, RecordType)
    return {
        f"{label}{n:02}": set_to(part, look=inner["look"])
        for n, part in enumerate(parts, start=1)
    }


def _rank(beliefs: Iterable[Record]) -> Beliefs:
    """The most certain first."""
    return sorted(beliefs, key=lambda it: (-it.p, it.sign.form))


SURVEYING = first(see_nothing, list_view)
