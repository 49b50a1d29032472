"""What the robot says of words that it was never taught."""

from __future__ import annotations

from collections.abc import Iterable

from kille.dialogue.beliefs import knows_word
from kille.dialogue.meanings import DialogueTypes
from kille.dialogue.moves import plan
from ttr import Record
from ttr.types import TypeNode


def plan_unknown_word(
    s: Record,
    sign: Record,
    *,
    pending: Iterable[TypeNode] = (),
    types: DialogueTypes,
) -> Record:
    """The plan to say that this noun, adjective or relation is not known."""
    act = f"Unknown{sign.kind.capitalize()}"
    return plan(s, act, sign.meaning, signs=[sign], pending=pending, types=types)


def plan_first_unknown(
    s: Record,
    signs: Iterable[Record],
    *,
    pending: Iterable[TypeNode] = (),
    types: DialogueTypes,
) -> Record | None:
    """The plan to say that a word is not known: the first of these that is not.

    None if all are known.
    """
    sign = next((it for it in signs if not knows_word(s, it)), None)
    if sign is None:
        return None
    return plan_unknown_word(s, sign, pending=pending, types=types)
